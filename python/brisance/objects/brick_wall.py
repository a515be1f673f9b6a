"""A wall of bricks in running bond.

Courses are numbered from the foot. Even ones hold whole bricks only; odd ones begin and end with a half
brick, so that their joints stand half a brick from those above and below, and all courses end flush. With
joints of width g and bricks of length L, a half brick is (L - g)/2 long.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from brisance import _engine
from brisance.model import BrickWall
from brisance.objects.block import box_mesh
from brisance.piece import PieceSet
from brisance.rotation import rotate

BEVEL = 0.04
"""Bevel of a brick's edges, as a part of its smallest edge length."""


@dataclass(frozen=True, eq=False)
class Layout:
    """Where the bricks of a wall are, in the wall's own frame, courses from the foot up, each from left
    (-x) to right.
    """

    row: NDArray[np.int64]
    """(n,) course of each brick, from 0."""
    column: NDArray[np.int64]
    """(n,) place of each brick in its course, from 0."""
    whole: NDArray[np.bool_]
    """(n,) whether it is a whole brick."""
    size: NDArray[np.float64]
    """(n, 3) edge lengths [m]."""
    centre: NDArray[np.float64]
    """(n, 3) centres [m]; the origin is the middle of the wall's foot."""
    buried: NDArray[np.bool_]
    """(n, 6) which sides -x, +x, -y, +y, -z, +z lie against a neighbour or the ground, unloaded."""


def layout(wall: BrickWall) -> Layout:
    """Lay the bricks of a wall."""
    length, height, _ = wall.brick_size
    gap, columns, rows = wall.mortar_gap, wall.columns, wall.rows
    half = (length - gap) / 2
    in_row = columns + np.arange(rows) % 2
    row = np.repeat(np.arange(rows), in_row)
    column = np.arange(len(row)) - np.repeat(np.cumsum(in_row) - in_row, in_row)
    last = in_row[row] - 1
    at_end = (column == 0) | (column == last)
    whole = (row % 2 == 0) | ~at_end

    size = np.tile(np.array(wall.brick_size), (len(row), 1))
    size[~whole, 0] = half
    # Places in a course are counted from its middle: left and right mirror each other to the last bit.
    from_middle = column - last / 2
    centre = np.empty((len(row), 3))
    centre[:, 0] = from_middle * (length + gap)
    centre[~whole, 0] = np.sign(from_middle[~whole]) * (wall.size[0] - half) / 2
    centre[:, 1] = row * (height + gap) + height / 2
    centre[:, 2] = 0.0

    buried = np.zeros((len(row), 6), dtype=np.bool_)
    buried[:, 0] = column > 0
    buried[:, 1] = column < last
    buried[:, 2] = True
    buried[:, 3] = row < rows - 1
    return Layout(row=row, column=column, whole=whole, size=size, centre=centre, buried=buried)


def wall_pieces(wall: BrickWall, *, name: str) -> PieceSet:
    """The bricks of a wall as one assembly; all whole bricks share one mesh, all halves another."""
    bricks = layout(wall)
    bevel = BEVEL * float(bricks.size.min())
    whole = box_mesh(wall.brick_size, bevel)
    half = whole if bricks.whole.all() else box_mesh(bricks.size[~bricks.whole][0], bevel)
    mass = wall.whole_mass * bricks.size[:, 0] / wall.brick_size[0]

    def add_to(engine: _engine.Scene) -> None:
        orientation = np.array(wall.orientation(), dtype=np.float64)
        engine.add_boxes(
            size=bricks.size,
            position=rotate(orientation, bricks.centre) + np.array(wall.position),
            orientation=np.tile(orientation, (len(mass), 1)),
            mass=mass,
            buried=bricks.buried,
            assembly=True,
            behaviour=wall.behaviour(),
            mortar=wall.mortar,
        )

    return PieceSet(
        name=name,
        material=wall.material,
        names=[
            f"{name}_r{row}_c{column}"
            for row, column in zip(bricks.row.tolist(), bricks.column.tolist(), strict=True)
        ],
        meshes=[whole if is_whole else half for is_whole in bricks.whole.tolist()],
        add_to=add_to,
    )
