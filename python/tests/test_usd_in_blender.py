"""USD results, imported into Blender as an artist would: every piece in its place and in its material."""

from __future__ import annotations

import importlib.util
import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from synthetic import box_mesh, synthetic_result

from brisance.formats.usd import write_usd

pytestmark = pytest.mark.skipif(importlib.util.find_spec("bpy") is None, reason="needs brisance[render]")

FRAME = 12

# Blender brings its own USD, so it has a process of its own.
IMPORT = """
import json, sys
import bpy
path, frame = sys.argv[1], int(sys.argv[2])
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.wm.usd_import(filepath=path)
scene = bpy.context.scene
scene.frame_set(frame)
pieces = []
for item in bpy.context.evaluated_depsgraph_get().object_instances:
    if item.object.type == "MESH":
        mesh = item.object.data
        names = [material.name for material in mesh.materials]
        pieces.append({
            "pose": [list(row) for row in item.matrix_world],
            "faces": [names[face.material_index] for face in mesh.polygons],
            "corner_layers": [layer.name for layer in mesh.uv_layers],
        })
facts = {
    "pieces": pieces,
    "frames": [scene.frame_start, scene.frame_end],
    "objects": [found.name for found in bpy.data.objects],
}
print("FACTS " + json.dumps(facts))
"""

# Blender's axes have Z up: its importer turns the scene by a quarter about X.
BLENDER_FROM_WORLD = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])


def imported(path: Path) -> dict[str, Any]:
    """What Blender shows of a USD file at :data:`FRAME`."""
    run = subprocess.run(
        [sys.executable, "-c", IMPORT, str(path), str(FRAME)], capture_output=True, text=True, timeout=120
    )
    lines = [line for line in run.stdout.splitlines() if line.startswith("FACTS ")]
    assert lines, run.stderr
    facts: dict[str, Any] = json.loads(lines[0].removeprefix("FACTS "))
    return facts


# Blender's floats are single. Orientations of the compact layout are half floats, see test_usd.
@pytest.mark.parametrize(("layout", "turn_tolerance"), [("prims", 1e-5), ("instancer", 2e-3)])
def test_blender_shows_every_piece_where_it_was_recorded(
    layout: str, turn_tolerance: float, tmp_path: Path
) -> None:
    result = synthetic_result(
        frames=21,
        sources=[("wall", "brick", 4), ("pane", "glass", 2)],
        meshes=[box_mesh()] * 4 + [box_mesh((0.5, 0.4, 0.01), broken=[0, 1]) for _ in range(2)],
    )
    path = tmp_path / "result.usdc"
    write_usd(result, path, layout=layout)
    facts = imported(path)

    assert facts["frames"] == [0, 20]
    # Ground, charge and shock front are no business of an importing artist.
    assert not [
        name for name in facts["objects"] if name.startswith(("Ground", "charge", "shock", "Charges"))
    ]

    poses = np.array([piece["pose"] for piece in facts["pieces"]])
    places = result.positions[FRAME].astype(np.float64) @ BLENDER_FROM_WORLD.T
    turns = BLENDER_FROM_WORLD @ Rotation.from_quat(result.orientations[FRAME][:, [1, 2, 3, 0]]).as_matrix()
    gaps = np.linalg.norm(places[:, None] - poses[None, :, :3, 3], axis=2)
    order = gaps.argmin(axis=1)
    assert sorted(order) == list(range(6))
    assert gaps.min(axis=1).max() < 1e-4
    np.testing.assert_allclose(poses[order, :3, :3], turns, atol=turn_tolerance)

    dressed = [facts["pieces"][index] for index in order]
    assert [piece["faces"] for piece in dressed[:4]] == [["brick"] * 6] * 4
    assert [piece["faces"] for piece in dressed[4:]] == [["glass_broken"] * 2 + ["glass"] * 4] * 2
    assert all(piece["corner_layers"] == ["st"] for piece in dressed)
