"""Volume, area, centre and inside of triangulated surfaces."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from brisance.objects.mesh.polygons import Indices, Points


def volumes(points: Points, triangles: Indices) -> Points:
    """(t,) signed volume of the cone from the middle of the points' box to each triangle [m³].

    Their sum over a closed surface is what it encloses, positive if its faces look outwards.
    """
    corners = points[triangles] - _middle(points, triangles)
    cones: Points = np.einsum("ti,ti->t", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6.0
    return cones


def volume(points: Points, triangles: Indices) -> float:
    """Signed volume of a closed surface [m³]."""
    return float(volumes(points, triangles).sum())


def areas(points: Points, triangles: Indices) -> Points:
    """(t,) area of each triangle [m²]."""
    a, b, c = points[triangles].transpose(1, 0, 2)
    result: Points = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)
    return result


def centroid(points: Points, triangles: Indices) -> Points:
    """(3,) centre of the volume of a closed surface [m]."""
    cones = volumes(points, triangles)
    middle = _middle(points, triangles)
    moment = (cones[:, None] * (points[triangles] - middle).sum(axis=1)).sum(axis=0) / 4.0
    centre: Points = middle + moment / cones.sum()
    return centre


def size(points: Points, triangles: Indices) -> float:
    """Diagonal of the surface's bounding box [m]; 0 without triangles."""
    if not len(triangles):
        return 0.0
    corners = points[triangles]
    return float(np.linalg.norm(corners.max(axis=(0, 1)) - corners.min(axis=(0, 1))))


def is_flat(enclosed: float, points: Points, triangles: Indices) -> bool:
    """Whether a volume [m³] is nothing next to its surface: a sheet thinner than millionths of its width."""
    return abs(enclosed) <= 1e-6 * float(areas(points, triangles).sum()) * size(points, triangles)


def mesh_contains(points: ArrayLike, triangles: ArrayLike, point: ArrayLike) -> bool:
    """Whether a point (3,) lies inside a closed surface of points (n, 3) and triangles (t, 3).

    The winding number is the solid angle of all triangles seen from the point (van Oosterom and Strackee,
    1983), so a ray that would graze an edge is no special case. On the surface itself either answer may come.
    """
    corners = np.asarray(points, np.float64)[np.asarray(triangles, np.int64)] - np.asarray(point, np.float64)
    a, b, c = corners.transpose(1, 0, 2)
    la, lb, lc = np.linalg.norm(corners, axis=2).T
    above = np.einsum("ti,ti->t", a, np.cross(b, c))
    below = (
        la * lb * lc
        + np.einsum("ti,ti->t", a, b) * lc
        + np.einsum("ti,ti->t", b, c) * la
        + np.einsum("ti,ti->t", c, a) * lb
    )
    return bool(abs(np.arctan2(above, below).sum()) > np.pi)


def _middle(points: Points, triangles: Indices) -> Points:
    corners = points[triangles]
    middle: Points = 0.5 * (corners.min(axis=(0, 1)) + corners.max(axis=(0, 1)))
    return middle
