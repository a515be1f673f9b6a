"""Whether charges and objects stand where they can: no charge inside a body, no body sunk into the ground."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from brisance.errors import InputError
from brisance.model import AnyObject, BrickWall, MeshObject, Scene, Window
from brisance.piece import PieceSet
from brisance.rotation import rotate

SUNK = 1e-3
"""Depth [m] below the ground from which on a body counts as sunk into it."""


def check_charges(scene: Scene, sets: Sequence[PieceSet]) -> None:
    """Raise :class:`InputError` if a charge is inside a mesh; boxes and walls are the model's own check."""
    for group in sets:
        for number, charge in enumerate(scene.charges):
            if group.encloses is not None and group.encloses(charge.position):
                raise InputError(
                    f"charge.{number}.position is inside the mesh {group.name!r}; move one of them."
                )


def ground_warnings(scene: Scene, sets: Sequence[PieceSet], centres: NDArray[np.float64]) -> list[str]:
    """One sentence for each object that begins partly below the ground.

    ``centres`` (B, 3) are the bodies' centres of mass in their objects' own frames [m].
    """
    if scene.ground is None:
        return []
    warnings = []
    start = 0
    for obj, group in zip(scene.objects, sets, strict=True):
        depth = scene.ground.height - _lowest(obj, group, centres[start:])
        start += len(group)
        if depth > SUNK and not obj.anchored:
            warnings.append(
                f"{obj.name} begins {depth:.3g} m below the ground; raise its position to let it rest there."
            )
    return warnings


def _lowest(obj: AnyObject, group: PieceSet, centres: NDArray[np.float64]) -> float:
    """Height [m] of the lowest point of an object."""
    if isinstance(obj, MeshObject):
        points = group.meshes[0].points + centres[0]
    elif isinstance(obj, Window):
        # Where a file says the outline, its size is not known here.
        width, height = obj.size or (0.0, 0.0)
        points = np.array(list(itertools.product((-0.5, 0.5), repeat=3))) * (width, height, obj.thickness)
    else:
        points = np.array(list(itertools.product((-0.5, 0.5), repeat=3))) * obj.size
        if isinstance(obj, BrickWall):
            points[:, 1] += obj.size[1] / 2
    return float(rotate(obj.orientation(), points)[:, 1].min()) + obj.position[1]
