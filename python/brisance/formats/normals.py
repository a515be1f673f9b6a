"""Normals of a mesh's faces and corners, for every writer that shows one.

Edges sharper than :data:`SMOOTHING_ANGLE_DEG` stay hard, gentler ones are smoothed, and nothing is smoothed
across the border of a face group (a fracture surface meets the outside in a hard edge).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from brisance.piece import PieceMesh

SMOOTHING_ANGLE_DEG = 30.0
"""Faces that meet at less than this angle are shaded as one surface [degrees]."""

_MOST_FACES_AT_A_POINT = 64
"""Points where more faces meet (the tip of a fine cone) keep hard edges: pairing them costs the square."""


def face_labels(meshes: list[PieceMesh]) -> NDArray[np.int64]:
    """One number a face that differs between the groups of its mesh."""
    labels = []
    for mesh in meshes:
        own = np.zeros(len(mesh.face_counts), dtype=np.int64)
        for number, name in enumerate(sorted(mesh.groups), start=1):
            own[mesh.groups[name]] = number
        labels.append(own)
    return np.concatenate(labels)


def area_vectors(
    points: NDArray[np.float32], counts: NDArray[np.int64], vertices: NDArray[np.int64]
) -> NDArray[np.float64]:
    """Return a vector along the normal of every face, as long as twice its area."""
    if (counts == 3).all():
        # Shards come by the hundred thousand triangles, which need no sums over corners.
        corners = points[vertices].astype(np.float64).reshape(-1, 3, 3)
        (ax, ay, az), (bx, by, bz) = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
        return np.stack([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx], axis=1)
    ends = np.cumsum(counts)
    starts = ends - counts
    faces = np.repeat(np.arange(len(counts)), counts)
    following = np.arange(1, len(vertices) + 1)
    following[ends - 1] = starts
    origin = points[vertices[starts]].astype(np.float64)
    arms = points[vertices] - origin[faces]
    summed: NDArray[np.float64] = np.add.reduceat(np.cross(arms, arms[following]), starts)
    return summed


def smooth_normals(
    areas: NDArray[np.float64],
    faces: NDArray[np.int64],
    vertices: NDArray[np.int64],
    labels: NDArray[np.int64],
) -> NDArray[np.float32]:
    """Return the unit normal of every face corner, smoothed; ``faces`` says which face each belongs to."""
    units = unit(areas)
    first, second = _corner_pairs(vertices)
    a, b = faces[first], faces[second]
    joined = (units[a] * units[b]).sum(axis=1) > math.cos(math.radians(SMOOTHING_ANGLE_DEG))
    joined &= (labels[a] == labels[b]) & (a != b)
    sums = areas[faces]
    for axis in range(3):
        sums[:, axis] += np.bincount(first[joined], areas[b[joined], axis], minlength=len(vertices))
    return unit(sums).astype(np.float32)


def _corner_pairs(vertices: NDArray[np.int64]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """All ordered pairs of face corners that lie on the same point."""
    order = np.argsort(vertices, kind="stable")
    valence = np.bincount(vertices)
    group_starts = np.cumsum(valence) - valence
    corners = np.flatnonzero(valence[vertices] <= _MOST_FACES_AT_A_POINT)
    repeats = valence[vertices[corners]]
    first = np.repeat(corners, repeats)
    within = np.arange(len(first)) - np.repeat(np.cumsum(repeats) - repeats, repeats)
    return first, order[group_starts[vertices[first]] + within]


def unit(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    """Scale vectors to unit length; one without length becomes +Y."""
    lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
    up = np.broadcast_to(np.array([0.0, 1.0, 0.0]), vectors.shape).copy()
    return np.divide(vectors, lengths, out=up, where=lengths > 0)
