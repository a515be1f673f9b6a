"""Mesh files of all kinds read as one polygon mesh, in metres with Y up."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from brisance.errors import InputError
from brisance.objects.mesh.obj_file import read_obj
from brisance.objects.mesh.polygons import Points, PolygonMesh, merged

if TYPE_CHECKING:
    import trimesh

USD = (".usd", ".usda", ".usdc", ".usdz")
TRIANGLES = (".stl", ".ply", ".off", ".glb", ".gltf")
SUFFIXES = (".obj", *TRIANGLES, *USD)
"""File name endings that can be read."""


def read_mesh_file(path: Path, *, label: str) -> PolygonMesh:
    """All meshes of a file as one, every transform in it applied.

    OBJ, STL, PLY and OFF have no unit: their numbers are metres. glTF is in metres by definition and USD says
    its unit and its upward axis. Faces keep their corners in OBJ and USD; the other formats give triangles.

    Raises :class:`InputError`, beginning with ``label``, for a file that is missing, of another kind, or
    unreadable.
    """
    if not path.exists():
        raise InputError(
            f"{label} does not exist: {path.resolve()} is not there; give a path that starts "
            "from the scene's folder"
        )
    if not path.is_file():
        raise InputError(f"{label} is a folder; give a mesh file ({', '.join(SUFFIXES)})")
    suffix = path.suffix.lower()
    if suffix not in SUFFIXES:
        raise InputError(f"{label} is of a kind that cannot be read; give one of {', '.join(SUFFIXES)}")
    try:
        if suffix == ".obj":
            return read_obj(path)
        if suffix in USD:
            from brisance.objects.mesh.usd_file import read_usd  # USD takes a while to load

            return read_usd(path)
        return _read_triangles(path, suffix)
    except InputError:
        raise
    except MemoryError:
        raise InputError(
            f"{label} is too large for this machine's memory; give a mesh of fewer faces"
        ) from None
    except Exception as error:  # readers raise all kinds of exceptions on broken files
        reason = " ".join(str(error).split())[:120] or type(error).__name__
        raise InputError(
            f"{label} cannot be read as {suffix[1:].upper()}: {reason}; export it anew"
        ) from None


def _read_triangles(path: Path, suffix: str) -> PolygonMesh:
    """STL, PLY, OFF and glTF by trimesh."""
    import trimesh  # it takes a while to load

    with path.open("rb") as stream:
        resolver = trimesh.resolvers.FilePathResolver(str(path))
        scene = trimesh.load_scene(stream, file_type=suffix[1:], resolver=resolver, process=False)
    meshes: list[PolygonMesh] = []
    for node in scene.graph.nodes_geometry:
        transform, name = scene.graph[node]
        geometry = scene.geometry[name]
        if isinstance(geometry, trimesh.Trimesh):
            meshes.append(_polygons(geometry).transformed(np.asarray(transform, np.float64)))
    return merged(meshes) if meshes else PolygonMesh(np.empty((0, 3)), *np.empty((2, 0), np.int64))


def _polygons(mesh: trimesh.Trimesh) -> PolygonMesh:
    points = np.array(mesh.vertices, np.float64)
    faces = np.array(mesh.faces, np.int64).reshape(-1, 3)
    if len(faces) and (faces.min() < 0 or faces.max() >= len(points)):
        raise ValueError(f"a face names a vertex that is not among its {len(points)}")
    uv = getattr(mesh.visual, "uv", None)
    uvs: Points | None = None
    if uv is not None and len(uv) == len(points):
        uvs = np.asarray(uv, np.float64)[:, :2][faces.ravel()]
    return PolygonMesh(points, np.full(len(faces), 3, np.int64), faces.ravel(), uvs)
