"""Piece meshes as USD arrays: every distinct mesh converted once, in a few whole-array operations.

Normals are authored rather than left to the viewer, as :mod:`brisance.formats.normals` has them. A mesh on
which nothing is smooth, a brick or a shard, carries one normal a face instead of one a corner.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from pxr import Sdf, Vt

from brisance.formats.normals import area_vectors, face_labels, smooth_normals, unit
from brisance.formats.usd.authoring import apply, attribute, define, relate
from brisance.formats.usd.materials import broken_path, material_path
from brisance.piece import PieceMesh

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
    areas = area_vectors(points, counts, vertices)
    face_normals = unit(areas).astype(np.float32)
    corner_starts = np.concatenate([[0], corner_ends[:-1]])
    smooth = np.zeros(len(meshes), dtype=np.bool_)
    if smoothing:
        corner_faces = np.repeat(np.arange(len(counts)), counts)
        corner_normals = smooth_normals(areas, corner_faces, vertices, face_labels(meshes))
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
