"""Meshes in a scene: where they stand, what is inside them, and how the engine flies them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from meshes import (
    CUBE_POINTS,
    CUBE_QUADS,
    CUBE_TRIANGLES,
    ROUNDING,
    body_of,
    body_of_faces,
    l_shape,
    shifted,
    solid,
)

from brisance import _engine
from brisance.errors import InputError
from brisance.model import Charge, Ground, MeshObject, Scene
from brisance.model.settings import Occlusion
from brisance.objects.mesh import mesh_contains
from brisance.rotation import quaternion_from_degrees, rotate
from brisance.simulation import build

SCENES = Path(__file__).resolve().parents[2] / "scenes"


def engine_scene() -> _engine.Scene:
    """Free air with 5 kg of TNT 5 m away from the origin along -z."""
    scene = _engine.Scene(
        pressure=101325.0,
        temperature=288.15,
        ground=None,
        duration=0.05,
        frame_rate=60.0,
        step=None,
        mode="translational",
        clearing="piece",
        drag="flow-relative",
        pulse="friedlander",
        negative_phase=False,
        occlusion=Occlusion(enabled=False).model_dump(),
        damping_factor=1.0,
        rotation_factor=1.0,
        contacts=False,
        until_rest=False,
    )
    scene.add_charge(
        mass=5.0,
        tnt_equivalence=1.0,
        position=(0.0, 0.0, -5.0),
        burst="air",
        time=0.0,
        gain=1.0,
        source="kingery-bulmash",
    )
    return scene


def test_place_of_a_mesh_object(tmp_path: Path) -> None:
    body = body_of_faces(
        tmp_path, shifted(0.0), CUBE_QUADS, position=(10.0, 0.0, 0.0), rotation=(0.0, 90.0, 0.0), scale=2.0
    )
    # A quarter turn about y takes the corner's diagonal (1, 1, 1) to (1, 1, -1).
    scene = engine_scene()
    body.add_to(scene)
    assert scene.simulate(threads=1).positions[0, 0] == pytest.approx(np.array([11.0, 1.0, -1.0]), rel=1e-6)
    assert scene.centres_of_mass()[0] == pytest.approx(body.centre, rel=ROUNDING)
    assert body.encloses((11.9, 0.1, -1.9))
    assert not body.encloses((11.9, 0.1, 0.1))
    assert body.mass == pytest.approx(8000.0, rel=ROUNDING)


def test_given_mass_wins(tmp_path: Path) -> None:
    assert body_of_faces(tmp_path, CUBE_POINTS, CUBE_QUADS, mass=12.5).mass == 12.5


ANGLES = st.tuples(*[st.floats(-360.0, 360.0)] * 3)
OFFSETS = st.tuples(*[st.floats(-50.0, 50.0)] * 3)


@settings(max_examples=25, deadline=None)
@given(angles=ANGLES, offset=OFFSETS)
def test_rigid_motion_changes_neither_volume_nor_inertia(
    tmp_path_factory: pytest.TempPathFactory, angles: tuple[float, ...], offset: tuple[float, ...]
) -> None:
    points, faces = l_shape(0.7)
    moved = rotate(quaternion_from_degrees(angles), points) + np.array(offset)
    folder = tmp_path_factory.mktemp("moved")
    still, placed = body_of_faces(folder, points, faces), body_of_faces(folder, moved, faces)
    volume, centre, inertia = solid(placed)
    assert placed.warnings == []
    # 50 m away from a body of 2 m, the coordinates have 1e-14 of their own in rounding.
    assert volume == pytest.approx(still.volume, rel=1e-9)
    assert centre == pytest.approx(
        rotate(quaternion_from_degrees(angles), still.centre) + np.array(offset), abs=1e-9
    )
    assert np.linalg.eigvalsh(inertia) == pytest.approx(np.linalg.eigvalsh(solid(still)[2]), rel=1e-8)


@settings(max_examples=60, deadline=None)
@given(point=st.tuples(*[st.floats(-0.5, 2.5)] * 3))
def test_inside_of_a_concave_mesh(point: tuple[float, float, float]) -> None:
    x, y, z = point
    if min(abs(c - edge) for c in point for edge in (0.0, 1.0, 2.0)) < 1e-6:
        return  # on the surface either answer may come
    points = np.concatenate([shifted(0.0, size=(2, 1, 1)), shifted((0, 1, 0))])
    both = np.concatenate([CUBE_TRIANGLES, np.array(CUBE_TRIANGLES) + 8])
    inside = 0 < z < 1 and ((0 < x < 2 and 0 < y < 1) or (0 < x < 1 and 0 < y < 2))
    assert mesh_contains(points, both, point) == inside


def test_engine_flies_a_mesh_like_the_box_it_is(tmp_path: Path) -> None:
    """A box as a mesh and as a box get the same impulse and mass, apart from their different panels."""
    size = np.array([0.4, 0.6, 0.5])
    body = body_of_faces(tmp_path, shifted(-size / 2, size=size), CUBE_QUADS, mass=30.0)
    scene = engine_scene()
    body.add_to(scene)
    scene.add_boxes(
        size=size[None],
        position=np.zeros((1, 3)),
        orientation=np.array([[1.0, 0.0, 0.0, 0.0]]),
        mass=np.array([30.0]),
        buried=np.zeros((1, 6), bool),
        assembly=False,
        behaviour=body.obj.behaviour(),
    )
    recording = scene.simulate(threads=1)
    mesh, box = recording.impulse_n_s
    assert recording.mass_kg == pytest.approx(np.array([30.0, 30.0]))
    assert mesh[2] > 0
    # Two triangles a face against the box's panels: the pulse is sampled at other points of the same face.
    assert mesh[2] == pytest.approx(box[2], rel=0.05)


def scene_with_can(*, charge: tuple[float, float, float], height: float) -> Scene:
    """The jerry can of the example scene, standing at a height [m] on a ground at 0."""
    return Scene(
        charges=[Charge(mass=1.0, position=charge)],
        objects=[MeshObject(file="jerry_can.obj", name="can", mass=20.0, position=(0.0, height, 0.0))],
        ground=Ground(),
        base_folder=SCENES / "meshes",
    )


def test_can_of_the_example_scene_is_sound_and_concave() -> None:
    body = body_of(SCENES / "meshes" / "jerry_can.obj")
    assert body.warnings == []
    assert 0.02 < body.volume < 0.026
    assert body.volume < 0.9 * trimesh.convex.convex_hull(body.vertices).volume


def test_mesh_that_stands_on_the_ground_gives_no_warning() -> None:
    assert build(scene_with_can(charge=(0, 1, -3), height=0.0)).warnings == []


def test_sunken_mesh_is_warned_of() -> None:
    (warning,) = build(scene_with_can(charge=(0, 1, -3), height=-0.1)).warnings
    assert warning.startswith("can begins 0.1 m below the ground")


def test_charge_inside_a_mesh_is_refused() -> None:
    with pytest.raises(InputError, match="is inside the mesh 'can'"):
        build(scene_with_can(charge=(0.0, 0.25, 0.0), height=0.0))


def test_charge_between_can_and_handle_is_outside() -> None:
    build(scene_with_can(charge=(0.03, 0.448, 0.0), height=0.0))
