"""Piece meshes as USD arrays: every distinct mesh converted once, in a few whole-array operations.

Normals are authored rather than left to the viewer. Edges sharper than :data:`SMOOTHING_ANGLE_DEG` stay hard,
gentler ones are smoothed, and nothing is smoothed across the border of a face group (a fracture surface meets
the outside in a hard edge). A mesh on which nothing is smooth, a brick or a shard, carries one normal a face
instead of one a corner.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from pxr import Sdf, Vt

from brisance.formats.usd.authoring import apply, attribute, define, relate
from brisance.formats.usd.materials import broken_path, material_path
from brisance.piece import PieceMesh

SMOOTHING_ANGLE_DEG = 30.0
"""Faces that meet at less than this angle are shaded as one surface [degrees]."""

_MOST_FACES_AT_A_POINT = 64
"""Points where more faces meet (the tip of a fine cone) keep hard edges: pairing them costs the square."""

_NO_FACES = np.empty(0, dtype=np.int32)
_T = Sdf.ValueTypeNames


@dataclass(frozen=True, eq=False)
class Geometry:
    """The arrays of one mesh, ready to author."""

    points: Vt.Vec3fArray
    counts: Vt.IntArray
    indices: Vt.IntArray
    normals: Vt.Vec3fArray
    normals_interpolation: str
    uvs: Vt.Vec2fArray | None
    extent: Vt.Vec3fArray
    radius: float
    """Of the sphere about the body's origin that holds the mesh [m]."""
    broken: Vt.IntArray | None
    """Faces of the group ``broken``, None where there is no such group or nothing in it."""
    outside: Vt.IntArray
    """The other faces; empty where ``broken`` is None."""


class Geometries:
    """The :class:`Geometry` of each distinct mesh, looked up by the mesh itself.

    Of ``hard`` meshes every edge is hard: for shards, whose faces are flat, in a third of the time.
    """

    def __init__(self, meshes: Sequence[PieceMesh], *, hard: Sequence[PieceMesh] = ()) -> None:
        self._meshes: list[PieceMesh] = []
        self._by_id: dict[int, Geometry] = {}
        for group, smooth in ((meshes, True), (hard, False)):
            distinct = list({id(mesh): mesh for mesh in group}.values())
            self._meshes += distinct
            if distinct:
                self._by_id.update(zip(map(id, distinct), _convert(distinct, smooth), strict=True))

    def __getitem__(self, mesh: PieceMesh) -> Geometry:
        return self._by_id[id(mesh)]


def author_shape(prim: Sdf.PrimSpec, geometry: Geometry, *, material: str) -> None:
    """Author the shape of a Mesh prim, and a subset with the broken look where it has ``broken`` faces.

    The other faces then form a subset ``outside``: the material of the mesh holds for them anyway, but
    Blender looks at the subsets alone.
    """
    attribute(prim, "points", _T.Point3fArray, geometry.points)
    attribute(prim, "faceVertexCounts", _T.IntArray, geometry.counts)
    attribute(prim, "faceVertexIndices", _T.IntArray, geometry.indices)
    attribute(
        prim, "normals", _T.Normal3fArray, geometry.normals, interpolation=geometry.normals_interpolation
    )
    attribute(prim, "extent", _T.Float3Array, geometry.extent)
    attribute(prim, "subdivisionScheme", _T.Token, "none", uniform=True)
    if geometry.uvs is not None:
        attribute(prim, "primvars:st", _T.TexCoord2fArray, geometry.uvs, interpolation="faceVarying")
    if geometry.broken is not None:
        attribute(prim, "subsetFamily:materialBind:familyType", _T.Token, "partition", uniform=True)
        _author_subset(prim, "broken", geometry.broken, broken_path(material))
        if len(geometry.outside):
            _author_subset(prim, "outside", geometry.outside, material_path(material))


def _author_subset(prim: Sdf.PrimSpec, name: str, faces: Vt.IntArray, material: Sdf.Path) -> None:
    subset = define(prim, name, "GeomSubset")
    apply(subset, "MaterialBindingAPI")
    attribute(subset, "elementType", _T.Token, "face", uniform=True)
    attribute(subset, "familyName", _T.Token, "materialBind", uniform=True)
    attribute(subset, "indices", _T.IntArray, faces)
    relate(subset, "material:binding", [material])


def _convert(meshes: list[PieceMesh], smoothing: bool) -> list[Geometry]:
    point_ends = np.cumsum([len(mesh.points) for mesh in meshes])
    face_ends = np.cumsum([len(mesh.face_counts) for mesh in meshes])
    corner_ends = np.cumsum([len(mesh.face_indices) for mesh in meshes])
    points = np.ascontiguousarray(np.concatenate([mesh.points for mesh in meshes]), dtype=np.float32)
    counts = np.concatenate([mesh.face_counts for mesh in meshes]).astype(np.int64)
    point_starts = np.concatenate([[0], point_ends[:-1]])
    vertices = np.concatenate(
        [mesh.face_indices.astype(np.int64) + start for mesh, start in zip(meshes, point_starts, strict=True)]
    )
    areas = _areas(points, counts, vertices)
    face_normals = _unit(areas).astype(np.float32)
    corner_starts = np.concatenate([[0], corner_ends[:-1]])
    smooth = np.zeros(len(meshes), dtype=np.bool_)
    if smoothing:
        corner_faces = np.repeat(np.arange(len(counts)), counts)
        corner_normals = _smoothed(areas, corner_faces, vertices, _face_labels(meshes))
        bent = np.abs(corner_normals - face_normals[corner_faces]).max(axis=1) > 1e-6
        smooth = np.logical_or.reduceat(bent, corner_starts)
    extents = np.stack(
        [np.minimum.reduceat(points, point_starts), np.maximum.reduceat(points, point_starts)], axis=1
    )
    radius = np.sqrt(np.maximum.reduceat((points.astype(np.float64) ** 2).sum(axis=1), point_starts))

    geometries = []
    for i, mesh in enumerate(meshes):
        if smooth[i]:
            normals, interpolation = corner_normals[corner_starts[i] : corner_ends[i]], "faceVarying"
        else:
            normals, interpolation = (
                face_normals[face_ends[i] - len(mesh.face_counts) : face_ends[i]],
                "uniform",
            )
        broken = np.unique(mesh.groups["broken"]).astype(np.int32) if "broken" in mesh.groups else _NO_FACES
        geometries.append(
            Geometry(
                points=Vt.Vec3fArray.FromNumpy(points[point_starts[i] : point_ends[i]]),
                counts=Vt.IntArray.FromNumpy(np.ascontiguousarray(mesh.face_counts, dtype=np.int32)),
                indices=Vt.IntArray.FromNumpy(np.ascontiguousarray(mesh.face_indices, dtype=np.int32)),
                normals=Vt.Vec3fArray.FromNumpy(normals),
                normals_interpolation=interpolation,
                uvs=None
                if mesh.uvs is None
                else Vt.Vec2fArray.FromNumpy(np.ascontiguousarray(mesh.uvs, dtype=np.float32)),
                extent=Vt.Vec3fArray.FromNumpy(extents[i]),
                radius=float(radius[i]),
                broken=None if len(broken) == 0 else Vt.IntArray.FromNumpy(broken),
                outside=Vt.IntArray.FromNumpy(_others(broken, len(mesh.face_counts))),
            )
        )
    return geometries


def _others(faces: NDArray[np.int32], count: int) -> NDArray[np.int32]:
    """Return the faces out of ``count`` that are not among some; none at all where there are no some."""
    if len(faces) == 0:
        return _NO_FACES
    left = np.ones(count, dtype=np.bool_)
    left[faces] = False
    return np.flatnonzero(left).astype(np.int32)


def _face_labels(meshes: list[PieceMesh]) -> NDArray[np.int64]:
    """One number a face that differs between the groups of its mesh."""
    labels = []
    for mesh in meshes:
        own = np.zeros(len(mesh.face_counts), dtype=np.int64)
        for number, name in enumerate(sorted(mesh.groups), start=1):
            own[mesh.groups[name]] = number
        labels.append(own)
    return np.concatenate(labels)


def _areas(
    points: NDArray[np.float32], counts: NDArray[np.int64], vertices: NDArray[np.int64]
) -> NDArray[np.float64]:
    """Return a vector along the normal of every face, as long as twice its area."""
    ends = np.cumsum(counts)
    starts = ends - counts
    faces = np.repeat(np.arange(len(counts)), counts)
    following = np.arange(1, len(vertices) + 1)
    following[ends - 1] = starts
    origin = points[vertices[starts]].astype(np.float64)
    arms = points[vertices] - origin[faces]
    summed: NDArray[np.float64] = np.add.reduceat(np.cross(arms, arms[following]), starts)
    return summed


def _smoothed(
    areas: NDArray[np.float64],
    faces: NDArray[np.int64],
    vertices: NDArray[np.int64],
    labels: NDArray[np.int64],
) -> NDArray[np.float32]:
    """Return the unit normal of every face corner, smoothed; ``faces`` says which face each belongs to."""
    units = _unit(areas)
    first, second = _corner_pairs(vertices)
    a, b = faces[first], faces[second]
    joined = (units[a] * units[b]).sum(axis=1) > math.cos(math.radians(SMOOTHING_ANGLE_DEG))
    joined &= (labels[a] == labels[b]) & (a != b)
    sums = areas[faces]
    for axis in range(3):
        sums[:, axis] += np.bincount(first[joined], areas[b[joined], axis], minlength=len(vertices))
    return _unit(sums).astype(np.float32)


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


def _unit(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    """Scale vectors to unit length; one without length becomes +Y."""
    lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
    up = np.broadcast_to(np.array([0.0, 1.0, 0.0]), vectors.shape).copy()
    return np.divide(vectors, lengths, out=up, where=lengths > 0)
