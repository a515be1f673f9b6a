"""USD results, reopened with USD's own readers: poses, keys, looks, physics, facts, rules and bytes."""

from __future__ import annotations

import zipfile
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from pxr import Gf, Usd, UsdGeom, UsdPhysics, UsdShade, UsdValidation
from scipy.spatial.transform import Rotation
from synthetic import FACTS, SyntheticResult, box_mesh, synthetic_result

import brisance
from brisance.errors import InputError
from brisance.formats.usd import MOST_PRIMS, build_layer, write_usd
from brisance.formats.usd.poses import carrying_frames, continuous, final_spins, final_velocities
from brisance.formats.usd_summary import summarise
from brisance.model import Charge

LAYOUTS = ("prims", "instancer")
POSITION_TOLERANCE = 1e-5
"""Positions are stored as recorded; what is left is the rounding of float32 coordinates below 32 m [m]."""
MATRIX_TOLERANCE = {"prims": 1e-5, "instancer": 2e-3}
"""Of an element of a rotation matrix. USD goes from float32 quaternions by way of angles. Rounded to half
floats each component is off by up to 2.5e-4, so the quaternion by up to 5e-4, in direction and in length, and
both count twice."""

ANGLE_TOLERANCE_DEG = {"prims": 1e-3, "instancer": 0.06}
"""Of a rotation by itself: twice the error of the quaternion [degrees]."""


def two_objects(frames: int = 21, *, broken: bool = True) -> SyntheticResult:
    """Four bricks, and two panes with two broken faces each."""
    panes = [box_mesh((0.5, 0.4, 0.01), broken=[0, 1] if broken else []) for _ in range(2)]
    return synthetic_result(
        frames=frames,
        sources=[("wall", "brick", 4), ("pane", "glass", 2)],
        meshes=[box_mesh()] * 4 + panes,
    )


def open_written(
    result: SyntheticResult, folder: Path, *, layout: str, name: str = "result.usdc"
) -> Usd.Stage:
    """Write a result and open what was written."""
    path = folder / name
    write_usd(result, path, layout=layout)
    return Usd.Stage.Open(str(path))


def world_matrices(stage: Usd.Stage, frame: float) -> NDArray[np.float64]:
    """(bodies, 4, 4) transforms of all pieces at a time code, row vectors, in the order of the bodies."""
    found = []
    for source in stage.GetDefaultPrim().GetChildren():
        if not source.HasAttribute("brisance:pieces"):
            continue
        if source.IsA(UsdGeom.PointInstancer):
            found += list(UsdGeom.PointInstancer(source).ComputeInstanceTransformsAtTime(frame, frame))
        else:
            cache = UsdGeom.XformCache(frame)
            found += [cache.GetLocalToWorldTransform(piece) for piece in source.GetChildren()]
    return np.array(found)


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("suffix", [".usdc", ".usda", ".usdz"])
def test_poses_come_back(layout: str, suffix: str, tmp_path: Path) -> None:
    result = two_objects()
    stage = open_written(result, tmp_path, layout=layout, name=f"result{suffix}")
    for frame in range(len(result.times)):
        seen = world_matrices(stage, frame)
        assert seen.shape == (6, 4, 4)
        np.testing.assert_allclose(seen[:, 3, :3], result.positions[frame], atol=POSITION_TOLERANCE)
        turns = Rotation.from_quat(result.orientations[frame][:, [1, 2, 3, 0]])
        columns = seen[:, :3, :3].transpose(0, 2, 1)
        np.testing.assert_allclose(columns, turns.as_matrix(), atol=MATRIX_TOLERANCE[layout])
        off = Rotation.from_matrix(columns) * turns.inv()
        assert np.degrees(off.magnitude()).max() < ANGLE_TOLERANCE_DEG[layout]


def test_a_single_piece_is_a_mesh_in_both_layouts(tmp_path: Path) -> None:
    result = synthetic_result(sources=[("crate", "wood", 1), ("wall", "brick", 3)])
    stage = open_written(result, tmp_path, layout="instancer")
    assert stage.GetPrimAtPath("/World/crate/crate_0").IsA(UsdGeom.Mesh)
    assert stage.GetPrimAtPath("/World/wall").IsA(UsdGeom.PointInstancer)


def test_keys_only_while_a_piece_moves(tmp_path: Path) -> None:
    result = synthetic_result(bodies=3, frames=21)
    result.positions[:, 0] = result.positions[0, 0]
    result.orientations[:, 0] = result.orientations[0, 0]
    result.positions[10:, 1] = result.positions[10, 1]
    result.orientations[:, 1] = result.orientations[0, 1]
    stage = open_written(result, tmp_path, layout="prims")

    def keys(piece: int, op: str) -> list[float]:
        prim = stage.GetPrimAtPath(f"/World/wall/wall_{piece}")
        return list(prim.GetAttribute(f"xformOp:{op}").GetTimeSamples())

    assert keys(0, "translate") == []
    assert keys(0, "orient") == []
    # Still until frame 4 (a fifth of 21), flying until frame 10, still to the end.
    assert keys(1, "translate") == [0, *range(4, 11), 20]
    assert keys(1, "orient") == []
    assert keys(2, "translate") == [0, *range(4, 21)]
    assert keys(2, "orient") == [0, *range(4, 21)]


def test_an_instancer_at_rest_has_no_keys(tmp_path: Path) -> None:
    result = synthetic_result(frames=11)
    result.positions[:] = result.positions[0]
    result.orientations[:] = result.orientations[0]
    stage = open_written(result, tmp_path, layout="instancer")
    instancer = stage.GetPrimAtPath("/World/wall")
    for name in ("positions", "orientations", "extent"):
        assert instancer.GetAttribute(name).GetNumTimeSamples() == 0
    np.testing.assert_allclose(
        world_matrices(stage, 7)[:, 3, :3], result.positions[0], atol=POSITION_TOLERANCE
    )


@pytest.mark.parametrize("layout", LAYOUTS)
def test_quaternions_never_jump_to_the_other_sign(layout: str, tmp_path: Path) -> None:
    result = synthetic_result(bodies=4, frames=41)
    flips = np.random.default_rng(3).choice(np.array([-1, 1], dtype=np.float32), size=(41, 4, 1))
    result.orientations *= flips
    stage = open_written(result, tmp_path, layout=layout)
    if layout == "prims":
        attributes = [stage.GetAttributeAtPath(f"/World/wall/wall_{i}.xformOp:orient") for i in range(4)]
        seen = np.array([[as_wxyz(item.Get(frame)) for item in attributes] for frame in range(41)])
    else:
        orientations = stage.GetAttributeAtPath("/World/wall.orientations")
        seen = np.array([[as_wxyz(q) for q in orientations.Get(frame)] for frame in range(41)])
    assert (np.einsum("fbi,fbi->fb", seen[1:], seen[:-1]) > 0).all()
    between = world_matrices(stage, 20.5)[:, :3, :3]
    np.testing.assert_allclose(np.linalg.det(between), 1, atol=5e-3)


def as_wxyz(quaternion: Gf.Quatf | Gf.Quath) -> list[float]:
    """Components of a USD quaternion, real part first."""
    return [quaternion.GetReal(), *quaternion.GetImaginary()]


def test_continuous_keeps_frame_zero_and_the_rotations() -> None:
    rng = np.random.default_rng(5)
    quaternions = rng.normal(size=(30, 5, 4)).astype(np.float32)
    smooth = continuous(quaternions)
    np.testing.assert_array_equal(smooth[0], quaternions[0])
    np.testing.assert_array_equal(np.abs(smooth), np.abs(quaternions))
    assert (np.einsum("fbi,fbi->fb", smooth[1:], smooth[:-1]) >= 0).all()


def test_carrying_frames_reproduce_the_values() -> None:
    rng = np.random.default_rng(6)
    values = np.repeat(rng.integers(0, 3, size=(12, 4, 2)), 3, axis=0).astype(np.float32)
    values[:, 0] = 7
    kept = carrying_frames(values)
    assert not kept[:, 0].any()
    frames = np.arange(len(values))
    for body in range(1, 4):
        own = np.flatnonzero(kept[:, body])
        for component in range(2):
            again = np.interp(frames, own, values[own, body, component])
            np.testing.assert_array_equal(again, values[:, body, component])


def test_final_motion_of_a_turning_body() -> None:
    rate, spin = 100.0, 90.0
    angles = np.radians(spin) * np.arange(3) / rate
    orientations = np.zeros((3, 1, 4), dtype=np.float32)
    orientations[:, 0, 0], orientations[:, 0, 2] = np.cos(angles / 2), np.sin(angles / 2)
    positions = np.zeros((3, 1, 3), dtype=np.float32)
    positions[:, 0, 0] = np.arange(3) * 0.02
    # float32 quaternions: an angle of 0.9 degrees is resolved to about 1e-5 of itself.
    np.testing.assert_allclose(final_spins(orientations, rate), [[0, spin, 0]], atol=1e-2)
    np.testing.assert_allclose(final_velocities(positions, rate), [[2, 0, 0]], rtol=1e-5)


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("suffix", [".usdc", ".usda", ".usdz"])
def test_every_validator_of_usd_is_satisfied(layout: str, suffix: str, tmp_path: Path) -> None:
    stage = open_written(two_objects(), tmp_path, layout=layout, name=f"result{suffix}")
    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    assert len(validators) >= 20
    found = UsdValidation.ValidationContext(validators).Validate(stage)
    assert [error.GetErrorAsString() for error in found] == []


@pytest.mark.parametrize("layout", LAYOUTS)
def test_stage_metadata(layout: str, tmp_path: Path) -> None:
    stage = open_written(synthetic_result(frames=21, frame_rate=48.0), tmp_path, layout=layout)
    assert UsdGeom.GetStageUpAxis(stage) == "Y"
    assert UsdGeom.GetStageMetersPerUnit(stage) == 1.0
    assert UsdPhysics.GetStageKilogramsPerUnit(stage) == 1.0
    assert (stage.GetTimeCodesPerSecond(), stage.GetFramesPerSecond()) == (48.0, 48.0)
    assert (stage.GetStartTimeCode(), stage.GetEndTimeCode()) == (0.0, 20.0)
    assert stage.GetDefaultPrim().GetPath() == "/World"


def test_materials_and_broken_faces(tmp_path: Path) -> None:
    stage = open_written(two_objects(), tmp_path, layout="prims")
    assert bound_material(stage.GetPrimAtPath("/World/wall/wall_0")) == "brick"
    check_broken(stage.GetPrimAtPath("/World/pane/pane_4"))
    assert stage.GetPrimAtPath("/World/wall/wall_0").GetChildren() == []


def test_prototypes_carry_material_and_broken_faces(tmp_path: Path) -> None:
    stage = open_written(two_objects(), tmp_path, layout="instancer")
    for source, material in (("wall", "brick"), ("pane", "glass")):
        instancer = UsdGeom.PointInstancer(stage.GetPrimAtPath(f"/World/{source}"))
        targets = instancer.GetPrototypesRel().GetTargets()
        assert max(instancer.GetProtoIndicesAttr().Get()) == len(targets) - 1
        assert {bound_material(stage.GetPrimAtPath(path)) for path in targets} == {material}
    check_broken(stage.GetPrimAtPath("/World/pane/Prototypes/piece_0"))


def test_no_broken_look_where_nothing_is_broken(tmp_path: Path) -> None:
    stage = open_written(two_objects(broken=False), tmp_path, layout="prims")
    assert stage.GetPrimAtPath("/World/Materials/glass")
    assert not stage.GetPrimAtPath("/World/Materials/glass_broken")
    assert not [prim for prim in stage.Traverse() if prim.IsA(UsdGeom.Subset)]


def bound_material(prim: Usd.Prim) -> str:
    """Name of the material that a renderer finds for a prim, which must lead to a surface."""
    material, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()
    shader, _, _ = material.ComputeSurfaceSource()
    assert shader.GetIdAttr().Get() == "UsdPreviewSurface"
    return str(material.GetPrim().GetName())


def check_broken(pane: Usd.Prim) -> None:
    """A pane of two objects: faces 0 and 1 have the broken look, the other four that of glass."""
    faces = {
        subset.GetPrim().GetName(): list(subset.GetIndicesAttr().Get())
        for subset in UsdGeom.Subset.GetGeomSubsets(UsdGeom.Imageable(pane), "face", "materialBind")
    }
    assert faces == {"broken": [0, 1], "outside": [2, 3, 4, 5]}
    assert bound_material(pane) == "glass"
    assert bound_material(pane.GetChild("broken")) == "glass_broken"
    assert bound_material(pane.GetChild("outside")) == "glass"


def test_shapes_are_the_pieces_shapes(tmp_path: Path) -> None:
    result = synthetic_result(bodies=1)
    stage = open_written(result, tmp_path, layout="prims")
    mesh = UsdGeom.Mesh(stage.GetPrimAtPath("/World/wall/wall_0"))
    shape = result.meshes[0]
    assert shape.uvs is not None
    np.testing.assert_array_equal(mesh.GetPointsAttr().Get(), shape.points)
    np.testing.assert_array_equal(mesh.GetFaceVertexCountsAttr().Get(), shape.face_counts)
    np.testing.assert_array_equal(mesh.GetFaceVertexIndicesAttr().Get(), shape.face_indices)
    texture = UsdGeom.PrimvarsAPI(mesh).GetPrimvar("st")
    assert texture.GetInterpolation() == "faceVarying"
    np.testing.assert_array_equal(texture.Get(), shape.uvs)
    # Faces -x, +x, -y, +y, -z, +z, each flat: their outward normals are the axes, exactly.
    assert mesh.GetNormalsInterpolation() == "uniform"
    outward = [(-1, 0, 0), (1, 0, 0), (0, -1, 0), (0, 1, 0), (0, 0, -1), (0, 0, 1)]
    np.testing.assert_array_equal(mesh.GetNormalsAttr().Get(), outward)
    assert mesh.GetSubdivisionSchemeAttr().Get() == "none"


def test_pieces_are_rigid_bodies(tmp_path: Path) -> None:
    result = synthetic_result(bodies=3)
    stage = open_written(result, tmp_path, layout="prims")
    step = (result.positions[-1].astype(np.float64) - result.positions[-2]) * result.frame_rate
    for body in range(3):
        prim = stage.GetPrimAtPath(f"/World/wall/wall_{body}")
        assert prim.HasAPI(UsdPhysics.CollisionAPI)
        assert prim.HasAPI(UsdPhysics.MeshCollisionAPI)
        rigid, mass = UsdPhysics.RigidBodyAPI(prim), UsdPhysics.MassAPI(prim)
        assert prim.HasAPI(UsdPhysics.RigidBodyAPI)
        assert prim.HasAPI(UsdPhysics.MassAPI)
        assert rigid.GetKinematicEnabledAttr().Get() is True
        assert mass.GetMassAttr().Get() == (10.0, 5.0)[body % 2]
        # float32 velocities of tens of metres a second
        np.testing.assert_allclose(rigid.GetVelocityAttr().Get(), step[body], atol=1e-5)


def test_prototypes_are_rigid_bodies_of_their_pieces_mass(tmp_path: Path) -> None:
    stage = open_written(synthetic_result(bodies=40), tmp_path, layout="instancer")
    instancer = UsdGeom.PointInstancer(stage.GetPrimAtPath("/World/wall"))
    prototypes = [stage.GetPrimAtPath(path) for path in instancer.GetPrototypesRel().GetTargets()]
    assert all(prim.HasAPI(UsdPhysics.RigidBodyAPI) for prim in prototypes)
    masses = [UsdPhysics.MassAPI(prim).GetMassAttr().Get() for prim in prototypes]
    assert [masses[index] for index in instancer.GetProtoIndicesAttr().Get()] == [10.0, 5.0] * 20
    assert len(prototypes) < 40


def test_physics_scene_and_ground(tmp_path: Path) -> None:
    stage = open_written(synthetic_result(), tmp_path, layout="prims")
    scene = UsdPhysics.Scene(stage.GetPrimAtPath("/World/PhysicsScene"))
    assert tuple(scene.GetGravityDirectionAttr().Get()) == (0, -1, 0)
    assert scene.GetGravityMagnitudeAttr().Get() == pytest.approx(9.80665, rel=1e-6)
    ground = stage.GetPrimAtPath("/World/Ground")
    assert ground.HasAPI(UsdPhysics.CollisionAPI)
    assert not ground.HasAPI(UsdPhysics.RigidBodyAPI)
    assert UsdGeom.Imageable(ground).ComputePurpose() == "proxy"


def test_no_ground_where_the_scene_has_none(tmp_path: Path) -> None:
    stage = open_written(synthetic_result(ground=False), tmp_path, layout="prims")
    assert not stage.GetPrimAtPath("/World/Ground")


def test_facts_on_every_mesh(tmp_path: Path) -> None:
    result = synthetic_result(bodies=4)
    stage = open_written(result, tmp_path, layout="prims")
    for body in range(4):
        prim = stage.GetPrimAtPath(f"/World/wall/wall_{body}")
        for name in FACTS:
            value = getattr(result.bodies, name)[body]
            attribute = prim.GetAttribute(f"brisance:{name}")
            assert bool(attribute) is not bool(np.isnan(value))
            assert not attribute or attribute.Get() == value
        for name in ("impulse_n_s", "final_position_m"):
            seen = prim.GetAttribute(f"brisance:{name}").Get()
            np.testing.assert_array_equal(seen, getattr(result.bodies, name)[body])


def test_facts_on_the_instancer(tmp_path: Path) -> None:
    result = two_objects()
    stage = open_written(result, tmp_path, layout="instancer")
    for source in result.sources:
        prim = stage.GetPrimAtPath(f"/World/{source.name}")
        bodies = slice(source.start, source.stop)
        assert list(prim.GetAttribute("brisance:names").Get()) == list(result.bodies.names[bodies])
        for name in (*FACTS, "impulse_n_s", "final_position_m"):
            seen = np.array(prim.GetAttribute(f"brisance:{name}").Get())
            np.testing.assert_array_equal(seen, getattr(result.bodies, name)[bodies])


def test_facts_of_the_run(tmp_path: Path) -> None:
    result = synthetic_result()
    stage = open_written(result, tmp_path, layout="prims")
    world = stage.GetDefaultPrim()
    facts = {
        "version": brisance.__version__,
        "scene": "synthetic",
        "seed": 7,
        "layout": "prims",
        "frame_rate": 50.0,
        "step_s": 1e-4,
        "air_pressure_pa": result.scene.air.pressure,
        "air_temperature_k": result.scene.air.temperature,
    }
    assert {name: world.GetAttribute(f"brisance:{name}").Get() for name in facts} == facts
    assert list(world.GetAttribute("brisance:warnings").Get()) == result.warnings


def test_charge_and_shock_front_are_guides(tmp_path: Path) -> None:
    charges = [Charge(mass=100, position=(0, 0.3, -15)), Charge(mass=8, position=(3, 1, -9), time=0.1)]
    result = synthetic_result(charges=charges)
    stage = open_written(result, tmp_path, layout="prims")
    for number, charge in enumerate(charges):
        ball = UsdGeom.Sphere(stage.GetPrimAtPath(f"/World/Charges/charge_{number}"))
        front = UsdGeom.Sphere(stage.GetPrimAtPath(f"/World/Charges/shock_front_{number}"))
        for sphere in (ball, front):
            assert sphere.ComputePurpose() == "guide"
            place = sphere.GetLocalTransformation().ExtractTranslation()
            np.testing.assert_array_equal(place, charge.position)
        # the ball of cast TNT (1630 kg/m³) of that mass
        volume = 4 / 3 * np.pi * ball.GetRadiusAttr().Get() ** 3
        assert volume * 1630 == pytest.approx(charge.mass * charge.factor, rel=1e-9)
        radii = [front.GetRadiusAttr().Get(frame) for frame in range(len(result.times))]
        np.testing.assert_array_equal(radii, result.front_radius(number))
        for frame, radius in enumerate(radii):
            low, high = front.GetExtentAttr().Get(frame)
            np.testing.assert_allclose([*low, *high], [-radius] * 3 + [radius] * 3, rtol=1e-6)
            shown = front.ComputeVisibility(frame) != "invisible"
            assert shown is (radius > 0)


def test_names_are_made_valid_and_unique(tmp_path: Path) -> None:
    names = ["brick 1", "brick-1", "brick_1", "7th", "größe", "ok"]
    result = synthetic_result(sources=[("Materials", "brick", 4), ("my wall!", "stone", 2)], names=names)
    stage = open_written(result, tmp_path, layout="prims")
    objects = [prim for prim in stage.GetDefaultPrim().GetChildren() if prim.HasAttribute("brisance:pieces")]
    assert [prim.GetName() for prim in objects] == ["Materials_2", "my_wall_"]
    assert [prim.GetAttribute("brisance:name").Get() for prim in objects] == ["Materials", "my wall!"]
    pieces = [piece for prim in objects for piece in prim.GetChildren()]
    assert all(piece.GetName().isascii() and piece.GetName().isidentifier() for piece in pieces)
    assert len({piece.GetPath() for piece in pieces}) == 6
    kept = [piece.GetAttribute("brisance:name").Get() or piece.GetName() for piece in pieces]
    assert kept == names


@pytest.mark.parametrize("layout", LAYOUTS)
def test_a_single_frame_is_a_still(layout: str, tmp_path: Path) -> None:
    result = synthetic_result(frames=1)
    stage = open_written(result, tmp_path, layout=layout)
    assert (stage.GetStartTimeCode(), stage.GetEndTimeCode()) == (0.0, 0.0)
    np.testing.assert_allclose(
        world_matrices(stage, 0)[:, 3, :3], result.positions[0], atol=POSITION_TOLERANCE
    )
    assert summarise(tmp_path / "result.usdc").moving == 0


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("suffix", [".usdc", ".usda", ".usdz"])
def test_the_same_result_gives_the_same_bytes(layout: str, suffix: str, tmp_path: Path) -> None:
    first, second = tmp_path / "a", tmp_path / "b"
    for folder in (first, second):
        folder.mkdir()
        write_usd(two_objects(), folder / f"result{suffix}", layout=layout)
    assert (first / f"result{suffix}").read_bytes() == (second / f"result{suffix}").read_bytes()


def test_a_package_does_not_state_when_it_was_written(tmp_path: Path) -> None:
    path = tmp_path / "result.usdz"
    write_usd(synthetic_result(frames=2), path)
    with zipfile.ZipFile(path) as package:
        assert [(entry.filename, entry.date_time[:3]) for entry in package.infolist()] == [
            ("result.usdc", (1980, 1, 2))
        ]


def test_auto_changes_layout_past_the_most_prims() -> None:
    def chosen(bodies: int) -> str:
        layer = build_layer(synthetic_result(bodies=bodies, frames=1))
        return str(layer.GetAttributeAtPath("/World.brisance:layout").default)

    assert chosen(MOST_PRIMS) == "prims"
    assert chosen(MOST_PRIMS + 1) == "instancer"


@pytest.mark.parametrize("layout", LAYOUTS)
def test_progress_ends_with_all_pieces(layout: str) -> None:
    calls: list[tuple[int, int]] = []
    build_layer(two_objects(), layout=layout, progress=lambda done, total: calls.append((done, total)))
    assert calls[-1] == (6, 6)
    assert calls == sorted(calls)


def test_an_interrupted_write_leaves_the_old_file(tmp_path: Path) -> None:
    path = tmp_path / "result.usdc"
    path.write_bytes(b"old")

    def interrupt(done: int, total: int) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write_usd(two_objects(), path, progress=interrupt)
    assert path.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [path]


def test_refusals_name_what_is_wrong(tmp_path: Path) -> None:
    result = synthetic_result(frames=1)
    with pytest.raises(InputError, match=r"wall\.abc does not name a USD file"):
        write_usd(result, tmp_path / "wall.abc")
    with pytest.raises(InputError, match="layout 'cubes' is unknown"):
        write_usd(result, tmp_path / "wall.usdc", layout="cubes")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("layout", LAYOUTS)
def test_summary(layout: str, tmp_path: Path) -> None:
    result = two_objects()
    path = tmp_path / "result.usdc"
    write_usd(result, path, layout=layout)
    summary = summarise(path)
    assert (summary.version, summary.scene, summary.seed) == (brisance.__version__, "synthetic", 7)
    assert (summary.layout, summary.frames, summary.frame_rate) == (layout, 21, 50.0)
    assert summary.duration_s == pytest.approx(0.4)
    assert summary.bytes == path.stat().st_size
    assert (summary.pieces, summary.moving, summary.mass_kg) == (6, 6, 45.0)
    assert [(item.name, item.material, item.pieces) for item in summary.objects] == [
        ("wall", "brick", 4),
        ("pane", "glass", 2),
    ]
    (charge,) = summary.charges
    assert (charge.mass_kg, charge.tnt_mass_kg, charge.position_m) == (100, 100, (0, 0.3, -15))
    assert summary.ground_height_m == 0
    assert summary.warnings == tuple(result.warnings)
    for name, (low, high) in summary.facts.items():
        values = getattr(result.bodies, name)
        assert (low, high) == (np.nanmin(values), np.nanmax(values))
    assert set(summary.facts) == set(FACTS)


def test_summary_of_what_is_no_result(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="does not exist"):
        summarise(tmp_path / "none.usdc")
    with pytest.raises(InputError, match="is a directory"):
        summarise(tmp_path)
    text = tmp_path / "text.usda"
    text.write_text("not USD", encoding="utf-8")
    with pytest.raises(InputError, match="cannot be read as USD"):
        summarise(text)
    foreign = tmp_path / "foreign.usda"
    Usd.Stage.CreateNew(str(foreign)).Save()
    with pytest.raises(InputError, match="not one that Brisance wrote"):
        summarise(foreign)
