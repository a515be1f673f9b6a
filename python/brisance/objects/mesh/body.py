"""A mesh object of a scene as one rigid piece."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from brisance.errors import InputError
from brisance.model import MeshObject
from brisance.model.objects import check_weight
from brisance.objects.mesh.file import read_mesh_file
from brisance.objects.mesh.measure import centroid, mesh_contains, volume
from brisance.objects.mesh.polygons import Indices, Points, PolygonMesh, triangulate
from brisance.objects.mesh.repair import RepairedMesh, repair
from brisance.piece import PieceMesh, PieceSet

if TYPE_CHECKING:
    from brisance import _engine


@dataclass(frozen=True, eq=False)
class MeshBody:
    """One body from a mesh file: a closed surface for the physics, and its look."""

    obj: MeshObject
    name: str
    vertices: Points
    """(n, 3) of the closed surface in the object's own frame, which is the file's times ``scale`` [m]."""
    triangles: Indices
    """(t, 3), counter-clockwise seen from outside."""
    centre: Points
    """(3,) centre of mass in the object's own frame [m]."""
    volume: float
    """Enclosed volume [m³]."""
    look: PieceMesh
    """The faces of the file, about the centre of mass."""
    warnings: list[str]
    """At most one sentence for what reading left out and one for what repair did."""

    @property
    def mass(self) -> float:
        """The mass given, else density times volume [kg]."""
        return self.obj.mass if self.obj.mass is not None else (self.obj.density or 0.0) * self.volume

    def encloses(self, point: Sequence[float]) -> bool:
        """Whether a point of the world [m] lies inside the body."""
        return mesh_contains(self.vertices, self.triangles, self.obj.to_own_frame(point))

    def add_to(self, engine: _engine.Scene) -> None:
        """Adds the body to an engine scene."""
        engine.add_mesh(
            vertices=self.vertices,
            triangles=self.triangles,
            position=self.obj.position,
            orientation=self.obj.orientation(),
            mass=self.mass,
            behaviour=self.obj.behaviour(),
        )

    def pieces(self) -> PieceSet:
        """The body as the single piece of its object."""
        return PieceSet(
            name=self.name,
            material=self.obj.material,
            names=[self.name],
            meshes=[self.look],
            add_to=self.add_to,
            encloses=self.encloses,
            warnings=self.warnings,
        )


def mesh_body(obj: MeshObject, *, base_folder: Path, name: str) -> MeshBody:
    """Reads and repairs the mesh of an object; its file is looked for in ``base_folder``.

    Raises :class:`brisance.errors.InputError` for a missing or unreadable file and an empty or flat mesh.
    """
    label = f'mesh "{name}": file "{obj.file}"'
    polygons = read_mesh_file(base_folder / obj.file, label=label)
    polygons = polygons.transformed(np.diag([obj.scale, obj.scale, obj.scale, 1.0]))
    triangles, face = triangulate(polygons)
    closed = repair(polygons.points, triangles, label=label)
    centre = centroid(closed.points, closed.triangles)
    warnings = ["; ".join(clauses) for clauses in (polygons.warnings, closed.clauses) if clauses]
    body = MeshBody(
        obj=obj,
        name=name,
        vertices=np.ascontiguousarray(closed.points),
        triangles=np.ascontiguousarray(closed.triangles),
        centre=centre,
        volume=volume(closed.points, closed.triangles),
        look=_look(polygons, face, closed, centre),
        warnings=[f"{label}: {warning}" for warning in warnings],
    )
    try:
        check_weight(body.mass, body.volume)
    except ValueError as error:
        raise InputError(f'mesh "{name}" {error}') from None
    return body


def mesh_pieces(obj: MeshObject, *, base_folder: Path, name: str) -> PieceSet:
    """The single piece of a mesh object, as :func:`mesh_body` reads it."""
    return mesh_body(obj, base_folder=base_folder, name=name).pieces()


def _look(polygons: PolygonMesh, face: Indices, closed: RepairedMesh, centre: Points) -> PieceMesh:
    """The faces as they are in the file, without those repair dropped, turned outwards where it did so."""
    shown = polygons.select(
        _any_of(face, closed.kept, len(polygons.face_counts)),
        turned=_any_of(face, closed.turned, len(polygons.face_counts)),
    )
    used, indices = np.unique(shown.face_indices, return_inverse=True)
    return PieceMesh(
        points=(shown.points[used] - centre).astype(np.float32),
        face_counts=shown.face_counts.astype(np.int32),
        face_indices=indices.reshape(-1).astype(np.int32),
        uvs=None if shown.uvs is None else shown.uvs.astype(np.float32),
    )


def _any_of(face: Indices, chosen: NDArray[np.bool_], count: int) -> NDArray[np.bool_]:
    """(count,) faces of which a triangle is chosen."""
    faces = np.zeros(count, bool)
    faces[face[chosen]] = True
    return faces
