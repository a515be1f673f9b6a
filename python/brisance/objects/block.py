"""A box as one rigid piece, and the box-shaped meshes that blocks and bricks look like."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from brisance import _engine
from brisance.model import Block
from brisance.piece import PieceMesh, PieceSet


def block_pieces(block: Block, *, name: str) -> PieceSet:
    """The single piece of a block."""

    def add_to(engine: _engine.Scene) -> None:
        engine.add_boxes(
            size=np.array([block.size], dtype=np.float64),
            position=np.array([block.position], dtype=np.float64),
            orientation=np.array([block.orientation()], dtype=np.float64),
            mass=np.array([block.weight], dtype=np.float64),
            buried=np.zeros((1, 6), dtype=np.bool_),
            assembly=False,
            behaviour=block.behaviour(),
        )

    return PieceSet(
        name=name, material=block.material, names=[name], meshes=[box_mesh(block.size)], add_to=add_to
    )


def box_mesh(size: Sequence[float], bevel: float = 0.0) -> PieceMesh:
    """A box of the given edge lengths [m] centred on its origin, its edges cut off by ``bevel`` [m].

    The bevel catches the light along the edges of a rendered brick; it is far too small to weigh anything,
    and mass and loads are those of the full box. Texture coordinates are in metres, each face seen straight
    on.
    """
    half = np.asarray(size, dtype=np.float64) / 2
    corners = np.array(list(itertools.product((-1.0, 1.0), repeat=3)))
    if bevel > 0:
        # Corner c of the box becomes three points: point 3c + a lies on the face across axis a.
        points = np.repeat(corners * (half - bevel), 3, axis=0)
        rows = np.arange(len(points))
        points[rows, rows % 3] = (corners * half)[rows // 3, rows % 3]
        faces = _sides(3) + _edges() + [[3 * c, 3 * c + 1, 3 * c + 2] for c in range(8)]
    else:
        points, faces = corners * half, _sides(1)
    faces = [_outward(points, face) for face in faces]
    counts = np.array([len(face) for face in faces], dtype=np.int32)
    indices = np.array(list(itertools.chain.from_iterable(faces)), dtype=np.int32)
    uvs = np.concatenate([_flat(points[face], half) for face in faces])
    return PieceMesh(points=points.astype(np.float32), face_counts=counts, face_indices=indices, uvs=uvs)


def _corner(x: int, y: int, z: int) -> int:
    return 4 * x + 2 * y + z


def _sides(points_per_corner: int) -> list[list[int]]:
    """The six sides, each through its four corners in turn or, with bevels, the points that lie on it."""
    faces = []
    for axis, side in itertools.product(range(3), (0, 1)):
        face = []
        for first, second in ((0, 0), (0, 1), (1, 1), (1, 0)):
            place = [0, 0, 0]
            place[axis], place[(axis + 1) % 3], place[(axis + 2) % 3] = side, first, second
            face.append(_corner(*place) * points_per_corner + (axis if points_per_corner > 1 else 0))
        faces.append(face)
    return faces


def _edges() -> list[list[int]]:
    """The twelve strips that bevel the edges: each joins the two sides that meet in an edge along
    ``axis``.
    """
    faces = []
    for axis, one, two in itertools.product(range(3), (0, 1), (0, 1)):
        across, over = (axis + 1) % 3, (axis + 2) % 3
        ends = []
        for end in (0, 1):
            place = [0, 0, 0]
            place[axis], place[across], place[over] = end, one, two
            ends.append(_corner(*place))
        faces.append([3 * ends[0] + across, 3 * ends[0] + over, 3 * ends[1] + over, 3 * ends[1] + across])
    return faces


def _outward(points: NDArray[np.float64], face: list[int]) -> list[int]:
    """The face, turned so that it runs counter-clockwise seen from outside the (convex, centred) box."""
    a, b, c = points[face[:3]]
    return face if np.cross(b - a, c - b) @ points[face].mean(axis=0) > 0 else face[::-1]


def _flat(corners: NDArray[np.float64], half: NDArray[np.float64]) -> NDArray[np.float32]:
    """Texture coordinates [m] of a face: its corners, upright, seen along the axis it faces most."""
    a, b, c = corners[:3]
    normal = np.cross(b - a, c - b)
    axis = int(np.argmax(np.abs(normal)))
    sign = 1.0 if normal[axis] > 0 else -1.0
    along, up = {0: (2, 1), 1: (0, 2), 2: (0, 1)}[axis]
    across = corners[:, along] * (sign if axis == 2 else -sign if axis == 0 else 1.0) + half[along]
    upward = corners[:, up] * (-sign if axis == 1 else 1.0) + half[up]
    return np.column_stack([across, upward]).astype(np.float32)
