"""From an object of the scene to its rigid pieces: one file a kind of object."""

from __future__ import annotations

from pathlib import Path

from brisance.model import AnyObject, Block, BrickWall
from brisance.piece import PieceSet


def pieces(obj: AnyObject, *, base_folder: Path) -> PieceSet:
    """The pieces of one object of a scene. Files it names are looked for in ``base_folder``."""
    name = obj.name or obj.kind
    if isinstance(obj, Block):
        from brisance.objects.block import block_pieces

        return block_pieces(obj, name=name)
    if isinstance(obj, BrickWall):
        from brisance.objects.brick_wall import wall_pieces

        return wall_pieces(obj, name=name)
    from brisance.objects.mesh import mesh_pieces

    return mesh_pieces(obj, base_folder=base_folder, name=name)
