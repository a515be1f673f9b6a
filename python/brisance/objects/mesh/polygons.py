"""Polygon meshes as files hold them, and their cutting into triangles.

A convex face is cut as a fan; a concave one is cut inside its own outline, so that no triangle lies outside
the face.
"""

from __future__ import annotations

from dataclasses import dataclass

import manifold3d
import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]
Indices = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class PolygonMesh:
    """Faces of any number of corners, as read."""

    points: Points
    """(n, 3) [m]."""
    face_counts: Indices
    """(f,) corners of each face."""
    face_indices: Indices
    """(sum of face_counts,) indices into ``points``, counter-clockwise seen from outside."""
    uvs: Points | None = None
    """(sum of face_counts, 2) texture coordinates, one a face corner, or None."""
    warnings: tuple[str, ...] = ()
    """What was left out or changed in reading: clauses without the file's name."""

    def transformed(self, matrix: Points) -> PolygonMesh:
        """The mesh under an affine map (4, 4) of column vectors; mirrored faces still look outwards."""
        with np.errstate(invalid="ignore"):  # a corner that is not a number is repair's affair
            points = self.points @ matrix[:3, :3].T + matrix[:3, 3]
        mesh = PolygonMesh(points, self.face_counts, self.face_indices, self.uvs, self.warnings)
        if np.linalg.det(matrix[:3, :3]) < 0.0:
            return mesh.select(
                np.ones(len(self.face_counts), bool), turned=np.ones(len(self.face_counts), bool)
            )
        return mesh

    def select(self, kept: NDArray[np.bool_], *, turned: NDArray[np.bool_]) -> PolygonMesh:
        """The faces where ``kept`` (f,), those where ``turned`` (f,) with their corners reversed."""
        starts = np.cumsum(self.face_counts) - self.face_counts
        face = np.repeat(np.arange(len(self.face_counts)), self.face_counts)
        place = np.arange(len(self.face_indices)) - starts[face]
        corner = starts[face] + np.where(turned[face], self.face_counts[face] - 1 - place, place)
        corner = corner[kept[face]]
        uvs = None if self.uvs is None else self.uvs[corner]
        return PolygonMesh(self.points, self.face_counts[kept], self.face_indices[corner], uvs, self.warnings)


def merged(meshes: list[PolygonMesh]) -> PolygonMesh:
    """Meshes (at least one) as one; corners without texture coordinates get (0, 0) if others have them."""
    offsets = np.cumsum([0] + [len(mesh.points) for mesh in meshes[:-1]])
    uvs: Points | None = None
    if any(mesh.uvs is not None for mesh in meshes):
        uvs = np.concatenate(
            [np.zeros((len(mesh.face_indices), 2)) if mesh.uvs is None else mesh.uvs for mesh in meshes]
        )
    return PolygonMesh(
        points=np.concatenate([mesh.points for mesh in meshes]),
        face_counts=np.concatenate([mesh.face_counts for mesh in meshes]),
        face_indices=np.concatenate(
            [mesh.face_indices + offset for mesh, offset in zip(meshes, offsets, strict=True)]
        ),
        uvs=uvs,
        warnings=tuple(dict.fromkeys(warning for mesh in meshes for warning in mesh.warnings)),
    )


def triangulate(mesh: PolygonMesh) -> tuple[Indices, Indices]:
    """Triangles (t, 3) that cover the faces, and the face (t,) of each, in the order of the faces.

    Faces of fewer than three corners give no triangle.
    """
    starts = np.cumsum(mesh.face_counts) - mesh.face_counts
    triangles: list[Indices] = [np.empty((0, 3), np.int64)]
    owners: list[Indices] = [np.empty(0, np.int64)]
    for count in np.unique(mesh.face_counts):
        if count < 3:
            continue
        faces = np.flatnonzero(mesh.face_counts == count)
        corners = mesh.face_indices[starts[faces][:, None] + np.arange(count)]
        fan = np.stack([np.zeros(count - 2, np.int64), np.arange(1, count - 1), np.arange(2, count)], axis=1)
        cut = np.broadcast_to(fan, (len(faces), count - 2, 3)).copy()
        if count > 3:
            for face in np.flatnonzero(_is_concave(mesh.points[corners])):
                cut[face] = triangulate_loop(mesh.points[corners[face]])
        triangles.append(np.take_along_axis(corners, cut.reshape(len(faces), -1), axis=1).reshape(-1, 3))
        owners.append(np.repeat(faces, count - 2))
    owner = np.concatenate(owners)
    order = np.argsort(owner, kind="stable")
    return np.concatenate(triangles)[order], owner[order]


def _is_concave(corners: Points) -> NDArray[np.bool_]:
    """Which polygons (m, k, 3) have a corner that turns against the polygon's own normal."""
    before = corners - np.roll(corners, 1, axis=1)
    after = np.roll(corners, -1, axis=1) - corners
    turn = np.einsum("mki,mi->mk", np.cross(before, after), newell_normal(corners))
    concave: NDArray[np.bool_] = turn.min(axis=1) < -1e-9 * np.abs(turn).max(axis=1)
    return concave


def newell_normal(corners: Points) -> Points:
    """Area vectors (m, 3) of polygons (m, k, 3): along the normal, as long as the enclosed area [m²]."""
    relative = corners - corners[:, :1]
    area: Points = 0.5 * np.cross(relative, np.roll(relative, -1, axis=1)).sum(axis=1)
    return area


def triangulate_loop(loop: Points) -> Indices:
    """Triangles (k - 2, 3) spanning a closed loop of points (k, 3), wound as the loop is.

    The loop is cut in the plane in which it encloses the largest area. A loop that encloses none (points on a
    line, a figure of eight) is cut as a fan, which closes it all the same.
    """
    count = len(loop)
    fan: Indices = np.stack(
        [np.zeros(count - 2, np.int64), np.arange(1, count - 1), np.arange(2, count)], axis=1
    )
    normal = newell_normal(loop[None])[0]
    area = float(np.linalg.norm(normal))
    size = float(np.ptp(loop, axis=0).max())
    if count == 3 or not np.isfinite(size) or area <= 1e-9 * size * size:
        return fan
    normal /= area
    side = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])
    side /= np.linalg.norm(side)
    flat = np.ascontiguousarray((loop - loop.mean(axis=0)) @ np.stack([side, np.cross(normal, side)], axis=1))
    triangles: Indices = np.asarray(manifold3d.triangulate([flat]), dtype=np.int64)
    cut: Indices = triangles if triangles.shape == fan.shape else fan
    return cut
