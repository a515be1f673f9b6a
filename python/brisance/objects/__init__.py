"""From an object of the scene to its rigid pieces: one file a kind of object."""

from __future__ import annotations

from pathlib import Path

from brisance.model import AnyObject, Block, BrickWall, Window
from brisance.piece import PieceSet


def pieces(obj: AnyObject, *, base_folder: Path, seed: int) -> PieceSet:
    """The pieces of one object of a scene; of a window those of its frame, for its own are known after a run.

    Files it names are looked for in ``base_folder``; its random draws come from ``seed``.
    """
    name = obj.name or obj.kind
    if isinstance(obj, Block):
        from brisance.objects.block import block_pieces

        return block_pieces(obj, name=name)
    if isinstance(obj, BrickWall):
        from brisance.objects.brick_wall import wall_pieces

        return wall_pieces(obj, name=name)
    if isinstance(obj, Window):
        from brisance.objects.window import frame_pieces, glazing

        return frame_pieces(glazing(obj, base_folder=base_folder), name=name, seed=seed)
    from brisance.objects.mesh import mesh_pieces

    return mesh_pieces(obj, base_folder=base_folder, name=name)
