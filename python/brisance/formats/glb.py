"""glTF binary: a result as one animated ``.glb`` for game engines, web pages and Blender.

.. code-block:: text

    wall                     a node an object
      wall_r0_c0 …           a node a piece, at the pose of frame 0; mass and arrival as extras
    materials                brick; brick_broken for fracture surfaces, as a second primitive of a mesh
    animation "blast"        translation and rotation of each piece that moves, a key a frame while it does

glTF's own axes and units are ours: right-handed, Y up, metres, seconds. Pieces that share a mesh share it
here too. The charge and the ground are left out.
"""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

import brisance
from brisance.formats.atomic import replacing
from brisance.formats.normals import area_vectors, face_labels, smooth_normals
from brisance.formats.packed.poses import moving
from brisance.formats.usd.materials import Look, look
from brisance.objects.mesh.polygons import PolygonMesh, triangulate
from brisance.piece import PieceMesh

if TYPE_CHECKING:
    from brisance.result import Result, Source

_FLOAT, _UINT = 5126, 5125
_VERTICES, _INDICES = 34962, 34963
_MAGIC, _VERSION, _JSON, _BIN = 0x46546C67, 2, 0x4E4F534A, 0x004E4942


def write_glb(result: Result, path: Path | str) -> None:
    """Write a result as glTF binary, whole or not at all; the same result gives the same bytes."""
    data = glb(result)
    with replacing(path) as temporary:
        temporary.write_bytes(data)


def glb(result: Result) -> bytes:
    """The bytes of the file."""
    made = _Builder()
    roots = [_object(made, result, source) for source in result.sources]
    _animate(made, result)
    made.document["scenes"][0]["nodes"] = roots
    made.document["scenes"][0]["name"] = result.scene.name
    made.document["scenes"][0]["extras"] = {"seed": result.scene.seed, "frame_rate": result.frame_rate}
    return made.data()


class _Builder:
    """A document under way and its binary part."""

    def __init__(self) -> None:
        self.document: dict[str, Any] = {
            "asset": {"version": "2.0", "generator": f"brisance {brisance.__version__}"},
            "scene": 0,
            "scenes": [{}],
            "nodes": [],
            "meshes": [],
            "materials": [],
            "accessors": [],
            "bufferViews": [],
        }
        self.piece_nodes: list[int] = []
        self._parts: list[bytes] = []
        self._end = 0
        self._meshes: dict[tuple[int, str], int] = {}
        self._materials: dict[str, int] = {}

    def add(self, kind: str, entry: dict[str, Any]) -> int:
        """Append to one of the document's lists and return the number of the entry."""
        self.document[kind].append(entry)
        return len(self.document[kind]) - 1

    def view(self, array: NDArray[Any], target: int | None = None) -> int:
        """Put an array into the binary part; its number as a buffer view."""
        data = np.ascontiguousarray(array, dtype=array.dtype.newbyteorder("<")).tobytes()
        entry = {"buffer": 0, "byteOffset": self._end, "byteLength": len(data)}
        self._parts += [data, b"\0" * (-len(data) % 4)]
        self._end += len(data) + -len(data) % 4
        return self.add("bufferViews", entry if target is None else {**entry, "target": target})

    def accessor(self, view: int, kind: str, count: int, **more: Any) -> int:
        """Name the numbers in a view; ``kind`` is SCALAR, VEC2, VEC3 or VEC4 of floats unless said."""
        entry = {"bufferView": view, "componentType": _FLOAT, "type": kind, "count": count, **more}
        return self.add("accessors", entry)

    def material(self, name: str, *, broken: bool) -> int:
        """Number of a material, made when first asked for."""
        key = f"{name}_broken" if broken else name
        if key not in self._materials:
            self._materials[key] = self.add("materials", _material(key, look(name), broken))
        return self._materials[key]

    def mesh(self, mesh: PieceMesh, material: str) -> int:
        """Number of a mesh in a material, made when first asked for."""
        key = (id(mesh), material)
        if key not in self._meshes:
            self._meshes[key] = self.add("meshes", {"primitives": _primitives(self, mesh, material)})
        return self._meshes[key]

    def data(self) -> bytes:
        """The whole file."""
        self.document["buffers"] = [{"byteLength": self._end}]
        whole = {key: value for key, value in self.document.items() if value != []}
        text = json.dumps(whole, separators=(",", ":"), ensure_ascii=False, allow_nan=False).encode()
        text += b" " * (-len(text) % 4)
        size = 12 + 8 + len(text) + 8 + self._end
        head = struct.pack("<IIIII", _MAGIC, _VERSION, size, len(text), _JSON)
        return b"".join([head, text, struct.pack("<II", self._end, _BIN), *self._parts])


def _object(made: _Builder, result: Result, source: Source) -> int:
    """Add the pieces of one object under a node of its own and return its number."""
    children = []
    for piece in range(source.start, source.stop):
        w, x, y, z = result.orientations[0, piece].tolist()
        facts = {"mass_kg": float(result.bodies.mass_kg[piece])}
        arrival = float(result.bodies.arrival_time_s[piece])
        if np.isfinite(arrival):
            facts["arrival_time_s"] = arrival
        node = {
            "name": result.bodies.names[piece],
            "mesh": made.mesh(result.meshes[piece], source.material),
            "translation": result.positions[0, piece].tolist(),
            "rotation": [x, y, z, w],
            "extras": facts,
        }
        children.append(made.add("nodes", node))
    made.piece_nodes += children
    return made.add(
        "nodes", {"name": source.name, "children": children} if children else {"name": source.name}
    )


def _animate(made: _Builder, result: Result) -> None:
    first, last = moving(result.positions, result.orientations)
    movers = np.flatnonzero(last > first)
    if len(movers) == 0:
        return
    times = made.view(result.times.astype(np.float32))
    inputs: dict[tuple[int, int], int] = {}
    samplers: list[dict[str, Any]] = []
    channels: list[dict[str, Any]] = []
    for piece in movers.tolist():
        start, stop = int(first[piece]), int(last[piece]) + 1
        if (start, stop) not in inputs:
            bounds = result.times[[start, stop - 1]].astype(np.float32).tolist()
            inputs[start, stop] = made.accessor(
                times, "SCALAR", stop - start, byteOffset=4 * start, min=[bounds[0]], max=[bounds[1]]
            )
        turns = result.orientations[start:stop, piece][:, [1, 2, 3, 0]]
        for path, kind, values in (
            ("translation", "VEC3", result.positions[start:stop, piece]),
            ("rotation", "VEC4", turns),
        ):
            output = made.accessor(made.view(values), kind, stop - start)
            samplers.append({"input": inputs[start, stop], "output": output})
            target = {"node": made.piece_nodes[piece], "path": path}
            channels.append({"sampler": len(samplers) - 1, "target": target})
    made.document["animations"] = [{"name": "blast", "samplers": samplers, "channels": channels}]


def _primitives(made: _Builder, mesh: PieceMesh, material: str) -> list[dict[str, Any]]:
    """A primitive for the outside of a mesh and one for its fracture surfaces, over the same vertices."""
    counts, corners = mesh.face_counts.astype(np.int64), mesh.face_indices.astype(np.int64)
    points = mesh.points[corners]
    faces = np.repeat(np.arange(len(counts)), counts)
    areas = area_vectors(mesh.points, counts, corners)
    normals = smooth_normals(areas, faces, corners, face_labels([mesh]))
    triangles, owners = triangulate(PolygonMesh(points.astype(np.float64), counts, np.arange(len(corners))))
    low, high = points.min(axis=0).tolist(), points.max(axis=0).tolist()
    place = made.accessor(made.view(points, _VERTICES), "VEC3", len(points), min=low, max=high)
    attributes = {
        "POSITION": place,
        "NORMAL": made.accessor(made.view(normals, _VERTICES), "VEC3", len(points)),
    }
    if mesh.uvs is not None:
        # glTF counts the second coordinate from the top.
        uvs = np.column_stack([mesh.uvs[:, 0], 1.0 - mesh.uvs[:, 1]]).astype(np.float32)
        attributes["TEXCOORD_0"] = made.accessor(made.view(uvs, _VERTICES), "VEC2", len(points))
    broken = (
        np.isin(owners, mesh.groups["broken"]) if "broken" in mesh.groups else np.zeros(len(owners), bool)
    )
    primitives = []
    for cut in (False, True):
        chosen = triangles[broken == cut].astype(np.uint32).reshape(-1)
        if len(chosen):
            indices = made.accessor(made.view(chosen, _INDICES), "SCALAR", len(chosen), componentType=_UINT)
            own = made.material(material, broken=cut)
            primitives.append({"attributes": attributes, "indices": indices, "material": own})
    return primitives


def _material(name: str, shown: Look, broken: bool) -> dict[str, Any]:
    colour = shown.broken if broken else shown.colour
    entry: dict[str, Any] = {
        "name": name,
        "pbrMetallicRoughness": {
            "baseColorFactor": [*colour, shown.opacity],
            "metallicFactor": shown.metallic,
            "roughnessFactor": 0.5 + shown.roughness / 2 if broken else shown.roughness,
        },
    }
    if shown.opacity < 1.0:
        entry |= {"alphaMode": "BLEND", "doubleSided": True}
    return entry
