"""glTF results: whole files, read back by two other programs, every piece in its place and material."""

from __future__ import annotations

import importlib.util
import json
import struct
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation
from synthetic import box_mesh, synthetic_result

import brisance as br
from brisance.errors import InputError
from brisance.formats.glb import glb
from brisance.result import Result

FRAME = 12
WALL = Path(__file__).parents[2] / "scenes" / "brick_wall.toml"

IMPORT = """
import json, sys
import bpy
path, frame, rate = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.context.scene.render.fps = rate
bpy.ops.import_scene.gltf(filepath=path)
bpy.context.scene.frame_set(frame)
found = bpy.context.evaluated_depsgraph_get()
pieces = {}
for item in bpy.data.objects:
    if item.type == "MESH":
        names = [material.name for material in item.data.materials]
        pieces[item.name] = {
            "pose": [list(row) for row in item.evaluated_get(found).matrix_world],
            "materials": sorted({names[face.material_index] for face in item.data.polygons}),
            "parent": item.parent.name,
        }
print("FACTS " + json.dumps(pieces))
"""

BLENDER_FROM_WORLD = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])


def scene_of_two() -> Result:
    return synthetic_result(
        sources=[("wall", "brick", 4), ("pane", "glass", 2)],
        meshes=[box_mesh()] * 4 + [box_mesh((0.4, 0.3, 0.01), broken=[0, 1])] * 2,
    )


def document(data: bytes) -> tuple[dict[str, Any], bytes]:
    """The JSON and the binary part of a file, whose structure is checked on the way."""
    magic, version, size, length, kind = struct.unpack_from("<4sIIII", data)
    assert (magic, version, size, kind) == (b"glTF", 2, len(data), 0x4E4F534A)
    rest, kind = struct.unpack_from("<II", data, 20 + length)
    assert kind == 0x004E4942 and 28 + length + rest == size and length % 4 == 0 and rest % 4 == 0
    return json.loads(data[20 : 20 + length]), data[28 + length :]


def numbers(whole: dict[str, Any], binary: bytes, number: int) -> NDArray[np.float32]:
    accessor = whole["accessors"][number]
    view = whole["bufferViews"][accessor["bufferView"]]
    width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[accessor["type"]]
    start = view["byteOffset"] + accessor.get("byteOffset", 0)
    kind = {5126: np.float32, 5125: np.uint32}[accessor["componentType"]]
    found = np.frombuffer(binary, kind, accessor["count"] * width, start)
    return found.reshape(-1, width)


def test_keys_are_the_recorded_poses_while_a_piece_moves() -> None:
    result = scene_of_two()
    whole, binary = document(glb(result))
    channels = whole["animations"][0]["channels"]
    assert len(channels) == 2 * len(result.bodies)
    for channel in channels:
        sampler = whole["animations"][0]["samplers"][channel["sampler"]]
        times = numbers(whole, binary, sampler["input"])[:, 0]
        values = numbers(whole, binary, sampler["output"])
        name = whole["nodes"][channel["target"]["node"]]["name"]
        piece = list(result.bodies.names).index(name)
        frames = np.rint(times * result.frame_rate).astype(int)
        # The synthetic pieces stand for a fifth of the frames.
        assert frames[0] == len(result.times) // 5 and frames[-1] == len(result.times) - 1
        if channel["target"]["path"] == "translation":
            assert np.array_equal(values, result.positions[frames, piece])
        else:
            assert np.array_equal(values, result.orientations[frames, piece][:, [1, 2, 3, 0]])
        bounds = whole["accessors"][sampler["input"]]
        assert bounds["min"] == [times[0]] and bounds["max"] == [times[-1]]


def test_shared_meshes_are_shared_and_fracture_surfaces_are_their_own_material() -> None:
    whole, _ = document(glb(scene_of_two()))
    assert len(whole["meshes"]) == 2
    names = [material["name"] for material in whole["materials"]]
    assert names == ["brick", "glass", "glass_broken"]
    assert whole["materials"][1]["alphaMode"] == "BLEND"
    triangles = [
        [whole["accessors"][primitive["indices"]]["count"] // 3 for primitive in mesh["primitives"]]
        for mesh in whole["meshes"]
    ]
    assert triangles == [[12], [8, 4]]


def test_trimesh_sees_the_wall_as_it_stands(tmp_path: Path) -> None:
    result = br.simulate(br.load(WALL))
    result.write(tmp_path / "wall.glb")
    loaded = trimesh.load(tmp_path / "wall.glb")
    assert len(loaded.graph.nodes_geometry) == 27
    # The wall of the scene file: 4 bricks of 0.32 m, 6 courses of 0.16 m, 0.10 m thick.
    assert loaded.bounds == pytest.approx(np.array([[-0.64, 0, -0.05], [0.64, 0.96, 0.05]]), abs=1e-6)
    volumes = [mesh.volume for mesh in loaded.geometry.values()]
    # The bevels take off a little.
    assert max(volumes) == pytest.approx(0.32 * 0.16 * 0.10, rel=0.01)


@pytest.mark.skipif(importlib.util.find_spec("bpy") is None, reason="needs brisance[render]")
def test_blender_shows_every_piece_where_it_was_recorded(tmp_path: Path) -> None:
    result = scene_of_two()
    path = tmp_path / "two.glb"
    result.write(path)
    command = [sys.executable, "-c", IMPORT, str(path), str(FRAME), str(int(result.frame_rate))]
    run = subprocess.run(command, capture_output=True, text=True, timeout=120)
    lines = [line for line in run.stdout.splitlines() if line.startswith("FACTS ")]
    assert lines, run.stderr
    pieces = json.loads(lines[0].removeprefix("FACTS "))
    assert sorted(pieces) == sorted(result.bodies.names)
    for index, name in enumerate(result.bodies.names):
        pose = np.array(pieces[name]["pose"])
        turn = Rotation.from_quat(result.orientations[FRAME, index, [1, 2, 3, 0]]).as_matrix()
        assert pose[:3, 3] == pytest.approx(BLENDER_FROM_WORLD @ result.positions[FRAME, index], abs=1e-5)
        assert pose[:3, :3] == pytest.approx(BLENDER_FROM_WORLD @ turn @ BLENDER_FROM_WORLD.T, abs=1e-5)
        glass = result.bodies.source[index] == "pane"
        assert pieces[name]["materials"] == (["glass", "glass_broken"] if glass else ["brick"])
        assert pieces[name]["parent"] == result.bodies.source[index]


def test_a_result_in_which_nothing_moves_has_no_animation() -> None:
    result = synthetic_result(frames=1)
    whole, _ = document(glb(result))
    assert "animations" not in whole and len(whole["nodes"]) == 7


def test_the_suffix_says_what_to_write(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"\.glb, \.html"):
        synthetic_result().write(tmp_path / "x.obj")
