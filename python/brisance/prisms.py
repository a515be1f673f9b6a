"""From the engine's solid pieces of a pane to the meshes that scenes and writers use."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from brisance import _engine
from brisance.piece import PieceMesh


def piece_meshes(pattern: _engine.FracturePattern, solids: _engine.Pieces) -> list[PieceMesh]:
    """One closed mesh a fragment, about its centre of mass, with the group ``"broken"`` of cut faces.

    Faces are triangles: of each piece those of the front, of the back, and two for each side of its rings.
    """
    counts = solids.counts.astype(np.int64)
    corner_ends = np.cumsum(counts[:, 0])
    face_ends = np.cumsum(counts[:, 1:].sum(axis=1))
    points = solids.vertices.astype(np.float32)
    triangles = solids.triangles.astype(np.int32)
    corner_starts = corner_ends - counts[:, 0]
    face_counts = np.diff(face_ends, prepend=0)
    uvs = solids.uv.astype(np.float32)[triangles + np.repeat(corner_starts, face_counts)[:, None]]
    cut = np.split(_cut_sides(pattern), np.cumsum(counts[:, 3] // 2)[:-1])
    threes = np.full(int(face_counts.max(initial=0)), 3, dtype=np.int32)
    meshes = []
    for index, (front, back, sides) in enumerate(counts[:, 1:].tolist()):
        faces = slice(face_ends[index] - face_counts[index], face_ends[index])
        first = front + back + 2 * np.flatnonzero(cut[index]).astype(np.int32)
        broken = np.stack([first, first + 1], axis=1).ravel()
        meshes.append(
            PieceMesh(
                points=points[corner_starts[index] : corner_ends[index]],
                face_counts=threes[: front + back + sides],
                face_indices=triangles[faces].ravel(),
                uvs=uvs[faces].reshape(-1, 2),
                groups={"broken": broken} if len(broken) else {},
            )
        )
    return meshes


def _cut_sides(pattern: _engine.FracturePattern) -> NDArray[np.bool_]:
    """For every side of every piece, in the order of its faces, whether a crack cut it.

    The faces of a ring begin with the side that ends at its first vertex.
    """
    sizes = pattern.ring_sizes.astype(np.int64)
    starts = np.cumsum(sizes) - sizes
    before = np.arange(sizes.sum()) - 1
    before[starts] = starts + sizes - 1
    cut: NDArray[np.bool_] = ~pattern.on_border[before]
    return cut
