"""Meshes that tests write to files and read back as bodies."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from brisance import _engine
from brisance.model import MeshObject
from brisance.objects.mesh import MeshBody, mesh_body

Floats = NDArray[np.float64]
Faces = Sequence[tuple[int, ...]] | NDArray[np.int64]

CUBE_POINTS = np.array([(x, y, z) for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)])
CUBE_QUADS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
"""Faces -x, +x, -y, +y, -z, +z of the unit cube, counter-clockwise seen from outside."""
CUBE_TRIANGLES = [(a, b, c) for p, q, r, s in CUBE_QUADS for a, b, c in ((p, q, r), (p, r, s))]
ROUNDING = 1e-9
"""Relative; sums of some thousand terms lose far less than this in double precision."""


def write_obj(path: Path, points: ArrayLike, faces: Faces) -> Path:
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in np.asarray(points, float).tolist()]
    lines += ["f " + " ".join(str(int(index) + 1) for index in face) for face in faces]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def body_of(path: Path, **keys: object) -> MeshBody:
    weight = {} if "mass" in keys or "density" in keys else {"density": 1000.0}
    obj = MeshObject.model_validate({"file": path.name, **weight, **keys})
    return mesh_body(obj, base_folder=path.parent, name="prop")


def body_of_faces(folder: Path, points: ArrayLike, faces: Faces, **keys: object) -> MeshBody:
    return body_of(write_obj(folder / "prop.obj", points, faces), **keys)


def solid(body: MeshBody) -> tuple[float, Floats, Floats]:
    """Volume [m³], centre [m] and inertia per density [m⁵] as the engine takes them."""
    found = _engine.mass_properties(vertices=body.vertices, triangles=body.triangles)
    inertia = np.asarray(found["inertia_per_density"], np.float64)
    return float(found["volume_m3"]), np.asarray(found["centre_m"], np.float64), inertia


def shifted(offset: ArrayLike, *, size: ArrayLike = 1.0) -> Floats:
    """The points of the unit cube, stretched and moved."""
    moved: Floats = CUBE_POINTS * np.asarray(size) + np.asarray(offset)
    return moved


def l_shape(depth: float = 1.0) -> tuple[Floats, list[tuple[int, ...]]]:
    """Three unit squares in an L, drawn out along z, its ends one concave face each."""
    outline = np.array([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)], float)
    count = len(outline)
    points = np.concatenate([np.column_stack([outline, np.full(count, z)]) for z in (0.0, depth)])
    sides = [(n, (n + 1) % count, (n + 1) % count + count, n + count) for n in range(count)]
    return points, [tuple(range(count - 1, -1, -1)), tuple(range(count, 2 * count)), *sides]
