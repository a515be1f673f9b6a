"""The pieces' shapes as few batches, each drawn in one call.

A mesh that many pieces share is a batch of instances; all other pieces are merged into one batch whose
vertices say which piece they belong to. See-through pieces are batches of their own, since they are drawn
after the others.
"""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from brisance.formats.normals import area_vectors, face_labels, smooth_normals
from brisance.objects.mesh.polygons import PolygonMesh, triangulate
from brisance.piece import PieceMesh

SHARED_BY = 4
"""Pieces from which on a shared mesh is instanced: below, a draw call costs more than the copies."""
_NONE = np.empty(0, dtype=np.int32)

MOST_INSTANCED = 16
"""Instanced batches at most; the meshes that would save the most vertices have them."""


@dataclass(frozen=True, eq=False)
class Batch:
    """What one draw call draws. A vertex is in its piece's own frame."""

    position: NDArray[np.float32]
    """(V, 3) [m]."""
    normal: NDArray[np.int8]
    """(V, 4) outward normal in 127ths, and 127 on a fracture surface, else 0."""
    index: NDArray[np.uint32]
    """(T, 3) triangles, counter-clockwise seen from outside."""
    piece: NDArray[np.float32]
    """Piece of each instance, or of each vertex: numbers that single precision holds exactly."""
    instanced: bool
    transparent: bool

    @property
    def triangles(self) -> int:
        """Triangles drawn, instances counted."""
        return len(self.index) * (len(self.piece) if self.instanced else 1)


def shape_key(meshes: Sequence[PieceMesh], clear: NDArray[np.bool_]) -> str:
    """A key of what :func:`batches` would give: equal keys, equal batches. It takes far less time than they
    do.
    """
    digest = hashlib.blake2b(clear.tobytes(), digest_size=12)
    numbers: dict[int, int] = {}
    owners = [numbers.setdefault(id(mesh), len(numbers)) for mesh in meshes]
    digest.update(np.array(owners, dtype=np.int64).tobytes())
    for mesh in {id(mesh): mesh for mesh in meshes}.values():
        for array in (mesh.points, mesh.face_counts, mesh.face_indices, mesh.groups.get("broken", _NONE)):
            digest.update(len(array).to_bytes(8, "little"))
            digest.update(array.tobytes())
    return digest.hexdigest()


def batches(meshes: Sequence[PieceMesh], clear: NDArray[np.bool_]) -> list[Batch]:
    """The batches of pieces; ``clear`` (N,) says which are see-through."""
    made = []
    for transparent in (False, True):
        pieces = np.flatnonzero(clear == transparent)
        made += _of_kind(meshes, pieces, transparent)
    return made


def _of_kind(meshes: Sequence[PieceMesh], pieces: NDArray[np.int64], transparent: bool) -> list[Batch]:
    users: dict[int, list[int]] = {}
    for piece in pieces.tolist():
        users.setdefault(id(meshes[piece]), []).append(piece)
    shared = sorted(
        (group for group in users.values() if len(group) >= SHARED_BY),
        key=lambda group: -len(group) * len(meshes[group[0]].face_indices),
    )[:MOST_INSTANCED]
    instanced = {group[0] for group in shared}
    made = []
    for group in shared:
        mesh = meshes[group[0]]
        position, normal, index, _ = _surface([mesh], smooth="broken" not in mesh.groups)
        piece = np.array(group, dtype=np.float32)
        made.append(Batch(position, normal, index, piece, instanced=True, transparent=transparent))
    rest = [piece for group in users.values() if group[0] not in instanced for piece in group]
    if rest:
        made.append(_merged(meshes, rest, transparent))
    return made


def _merged(meshes: Sequence[PieceMesh], pieces: list[int], transparent: bool) -> Batch:
    """One batch of many meshes. Shards have flat faces, so only the others are smoothed."""
    surfaces, owners, start = [], [], 0
    for smooth in (False, True):
        own = [piece for piece in pieces if ("broken" not in meshes[piece].groups) == smooth]
        if not own:
            continue
        position, normal, index, counts = _surface([meshes[piece] for piece in own], smooth=smooth)
        surfaces.append((position, normal, index + np.uint32(start)))
        owners.append(np.repeat(np.array(own, dtype=np.float32), counts))
        start += len(position)
    position, normal, index = (np.concatenate(parts) for parts in zip(*surfaces, strict=True))
    return Batch(position, normal, index, np.concatenate(owners), instanced=False, transparent=transparent)


def _surface(
    meshes: list[PieceMesh], *, smooth: bool
) -> tuple[NDArray[np.float32], NDArray[np.int8], NDArray[np.uint32], NDArray[np.int64]]:
    """Positions, normals and triangles of meshes put together, and how many vertices each has given.

    Face corners at the same point with the same normal are one vertex.
    """
    ends = np.cumsum([0] + [len(mesh.points) for mesh in meshes])
    points = np.concatenate([mesh.points for mesh in meshes])
    counts = np.concatenate([mesh.face_counts for mesh in meshes]).astype(np.int64)
    corners = np.concatenate(
        [mesh.face_indices.astype(np.int64) + start for mesh, start in zip(meshes, ends, strict=False)]
    )
    faces = np.repeat(np.arange(len(counts)), counts)
    areas = area_vectors(points, counts, corners)
    if smooth:
        normals = smooth_normals(areas, faces, corners, face_labels(meshes))
    else:
        lengths = np.linalg.norm(areas, axis=1, keepdims=True)
        normals = (areas / np.where(lengths > 0, lengths, 1.0)).astype(np.float32)[faces]
    packed = np.zeros((len(corners), 4), dtype=np.int8)
    packed[:, :3] = np.rint(normals * 127.0)
    packed[:, 3] = np.where(_broken(meshes)[faces], 127, 0)
    keys = (corners << 32) | packed.view(np.uint32)[:, 0]
    _, kept, vertex = np.unique(keys, return_index=True, return_inverse=True)
    starts = np.cumsum(counts) - counts
    triangles = _triangles(points, counts, corners, faces, starts)
    made = np.searchsorted(corners[kept], ends)
    return (
        points[corners[kept]].astype(np.float32),
        packed[kept],
        vertex.reshape(-1)[triangles].astype(np.uint32),
        np.diff(made),
    )


def _triangles(
    points: NDArray[np.float32],
    counts: NDArray[np.int64],
    corners: NDArray[np.int64],
    faces: NDArray[np.int64],
    starts: NDArray[np.int64],
) -> NDArray[np.int64]:
    """(T, 3) triangles as numbers of face corners."""
    if (counts == 3).all():
        return np.arange(len(corners)).reshape(-1, 3)
    # A mesh in which every face corner is a point of its own: its triangles are numbers of corners.
    apart = PolygonMesh(points[corners].astype(np.float64), counts, np.arange(len(corners)))
    return triangulate(apart)[0]


def _broken(meshes: list[PieceMesh]) -> NDArray[np.bool_]:
    """Which faces of the meshes, one after the other, are fracture surfaces."""
    flags = []
    for mesh in meshes:
        own = np.zeros(len(mesh.face_counts), dtype=np.bool_)
        if "broken" in mesh.groups:
            own[mesh.groups["broken"]] = True
        flags.append(own)
    return np.concatenate(flags)
