"""The binary message of the live view: what is packed comes out again, within the error that is promised."""

from __future__ import annotations

import json
import struct
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from shattered import shattered_pane
from synthetic import box_mesh, synthetic_result

import brisance as br
from brisance import _engine
from brisance.errors import InputError
from brisance.formats.packed import MOST_PIECES, check_shown, pack, read
from brisance.formats.packed.poses import (
    POSITION_STEPS,
    WORST_TURN,
    Poses,
    moving,
    pack_poses,
    smallest_three,
    unpack_poses,
)
from brisance.piece import PieceMesh

SCENES = Path(__file__).parents[2] / "scenes"


def angle_between(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    """Angle [rad] of the rotation from one to the other, by the chord, exact for small angles too."""
    a = a / np.linalg.norm(a, axis=-1, keepdims=True)
    b = b / np.linalg.norm(b, axis=-1, keepdims=True)
    chord = np.minimum(np.linalg.norm(a - b, axis=-1), np.linalg.norm(a + b, axis=-1))
    return 4.0 * np.arcsin(np.minimum(1.0, chord / 2.0))


@settings(max_examples=60, deadline=None)
@given(
    seed=st.integers(0, 2**32 - 1),
    frames=st.integers(1, 12),
    bodies=st.integers(1, 8),
    reach=st.floats(1e-3, 2e3),
)
def test_poses_come_back_within_half_a_step(seed: int, frames: int, bodies: int, reach: float) -> None:
    random = np.random.default_rng(seed)
    positions = random.uniform(-reach, reach, (frames, bodies, 3)).astype(np.float32)
    orientations = random.normal(size=(frames, bodies, 4))
    orientations /= np.linalg.norm(orientations, axis=2, keepdims=True)
    packed = pack_poses(positions, orientations.astype(np.float32))
    half_step = np.ptp(positions, axis=0).astype(np.float64) / POSITION_STEPS / 2
    # The box is held in single precision, which may add one unit in the last place of its extent.
    allowed = half_step + 4e-7 * reach
    for frame in range(frames):
        found, turns = unpack_poses(packed, frame)
        assert (np.abs(found - positions[frame]) <= allowed).all()
        assert (angle_between(turns, orientations[frame].astype(np.float64)) <= WORST_TURN).all()


def test_the_bound_on_turns_is_nearly_reached() -> None:
    """The worst of many orientations is well above half the bound, which is therefore no idle one."""
    turns = np.random.default_rng(1).normal(size=(1, 200_000, 4)).astype(np.float32)
    turns /= np.linalg.norm(turns, axis=2, keepdims=True)
    packed = pack_poses(np.zeros((1, 200_000, 3), np.float32), turns)
    worst = angle_between(unpack_poses(packed, 0)[1], turns[0].astype(np.float64)).max()
    assert WORST_TURN / 2 < worst <= WORST_TURN


def test_every_component_can_be_the_one_left_out() -> None:
    left_out, _ = smallest_three(np.vstack([np.eye(4), -np.eye(4)]).astype(np.float32))
    assert left_out.tolist() == [0, 1, 2, 3] * 2


def test_a_piece_has_poses_only_while_it_moves() -> None:
    positions = np.zeros((6, 3, 3), np.float32)
    positions[:, 1, 0] = [0, 0, 1, 2, 2, 2]
    positions[:, 2, 1] = [0, 1, 0, 0, 1, 1]
    orientations = np.tile(np.array([1, 0, 0, 0], np.float32), (6, 3, 1))
    first, last = moving(positions, orientations)
    assert first.tolist() == [0, 1, 0]
    assert last.tolist() == [0, 3, 4]
    packed = pack_poses(positions, orientations)
    assert packed.count.tolist() == [1, 3, 5]
    for frame in range(6):
        assert np.allclose(unpack_poses(packed, frame)[0], positions[frame], atol=1e-5)


def test_the_message_of_a_scene_holds_what_the_report_says() -> None:
    result = br.simulate(br.load(SCENES / "brick_wall.toml"))
    header, arrays = read(pack(result))
    report = result.report()
    assert header["names"] == [body["name"] for body in report["bodies"]]
    for number, body in enumerate(report["bodies"]):
        row = dict(zip(header["facts"], arrays["facts"][number].tolist(), strict=True))
        for fact in ("mass_kg", "arrival_time_s", "peak_overpressure_pa", "attenuation", "launch_speed_m_s"):
            assert row[fact] == pytest.approx(body[fact], rel=1e-6)
        assert [row[f"impulse_{axis}_n_s"] for axis in "xyz"] == pytest.approx(body["impulse_n_s"], rel=1e-6)
        assert np.isnan(row["rest_time_s"]) == (body["rest_time_s"] is None)


def test_the_same_result_gives_the_same_bytes_and_arrays_are_aligned() -> None:
    result = br.simulate(br.load(SCENES / "crates.toml"))
    message = pack(result)
    assert message == pack(result)
    size = struct.unpack_from("<I", message, 8)[0]
    header = json.loads(message[16 : 16 + size])
    assert size % 16 == 0
    assert all(place["at"] % 16 == 0 for place in header["arrays"].values())


def test_pulses_are_those_of_the_engine() -> None:
    result = br.simulate(br.load(SCENES / "crates.toml"))
    _, arrays = read(pack(result))
    charge = result.scene.charges[1]
    apart = np.linalg.norm(result.positions[0, 2].astype(float) - charge.position)
    curves = _engine.curves(mass=charge.mass, distance=np.array([apart]), tnt_equivalence=charge.factor)
    arrival, peak, duration, decay = arrays["pulses"][1, 2].tolist()
    assert arrival == pytest.approx(charge.time + curves["arrival_time_s"][0], rel=1e-5)
    assert peak == pytest.approx(curves["overpressure_pa"][0], rel=1e-5)
    # The impulse of the pulse as drawn, by the midpoint rule, is the charge's.
    x = (np.arange(100_000) + 0.5) / 100_000
    impulse = peak * duration * ((1 - x) * np.exp(-decay * x)).mean()
    assert impulse == pytest.approx(curves["impulse_pa_s"][0], rel=1e-4)


def test_fronts_pass_the_pieces_when_they_arrive() -> None:
    """Read between its samples, the front's radius at a piece's arrival is the piece's distance."""
    result = br.simulate(br.load(SCENES / "slow_motion.toml"))
    _, arrays = read(pack(result))
    times, radii = arrays["fronts"][0, :, 0], arrays["fronts"][0, :, 1]
    for piece in range(4):
        apart = np.linalg.norm(result.positions[0, piece] - np.array(result.scene.charges[0].position))
        radius = np.interp(arrays["pulses"][0, piece, 0], times, radii)
        # Straight lines between 256 samples of a front that slows down: under a centimetre here.
        assert radius == pytest.approx(apart, abs=0.01)


def test_shapes_are_sent_once() -> None:
    result = br.simulate(br.load(SCENES / "brick_wall.toml"))
    whole, _ = read(pack(result))
    again, arrays = read(pack(result, known=whole["geometry"]))
    assert again["batches"] is None
    assert not any(name.startswith("position") for name in arrays)
    other, _ = read(pack(result, known="something else"))
    assert other["batches"] == whole["batches"]


def test_shared_meshes_are_instances_and_all_others_one_batch() -> None:
    bricks, shard = box_mesh(), [box_mesh((0.1 + i / 10, 0.2, 0.3), broken=[0, 1]) for i in range(3)]
    result = synthetic_result(
        sources=[("wall", "brick", 6), ("stones", "stone", 3), ("pane", "glass", 2)],
        meshes=[bricks] * 6 + shard + [box_mesh((1, 1, 0.01), broken=[2])] * 2,
    )
    header, arrays = read(pack(result))
    kinds = [(batch["instanced"], batch["transparent"]) for batch in header["batches"]]
    assert kinds == [(True, False), (False, False), (False, True)]
    assert arrays["piece_0"].tolist() == [0, 1, 2, 3, 4, 5]
    assert sorted(set(arrays["piece_1"].tolist())) == [6, 7, 8]
    assert sorted(set(arrays["piece_2"].tolist())) == [9, 10]
    assert [batch["triangles"] for batch in header["batches"]] == [6 * 12, 3 * 12, 2 * 12]
    # Two of six faces are fracture surfaces, four corners each.
    assert (arrays["normal_1"][:, 3] == 127).sum() == 3 * 2 * 4


@pytest.mark.parametrize("instanced", [True, False])
def test_batches_are_the_closed_surfaces_of_the_pieces(instanced: bool) -> None:
    """Each piece's triangles enclose its volume, looking outward, with normals that agree."""
    result = shattered_pane(pieces=60, frames=3)
    if instanced:
        result.meshes[:] = [box_mesh()] * len(result.meshes)
    _, arrays = read(pack(result))
    points = arrays["position_0"].astype(np.float64)[arrays["index_0"]]
    normals = arrays["normal_0"][arrays["index_0"]][..., :3] / 127.0
    faces = np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0])
    volume = np.einsum("ti,ti->t", points[:, 0], faces) / 6
    areas = np.linalg.norm(faces, axis=1)
    real = areas > 1e-9
    agree = np.einsum("ti,tci->tc", faces[real] / areas[real, None], normals[real])
    # A normal counted in 127ths errs by up to 0.5 √3/127 = 0.7 % of its length.
    assert (agree > 0.98).all()
    if instanced:
        assert volume.sum() == pytest.approx(0.32 * 0.16 * 0.10, rel=1e-5)
    else:
        owner = arrays["piece_0"][arrays["index_0"][:, 0]].astype(int)
        found = np.bincount(owner, volume)
        expected = [_engine_volume(mesh) for mesh in result.meshes]
        assert found == pytest.approx(expected, rel=1e-3)


def _engine_volume(mesh: PieceMesh) -> float:
    faces = mesh.face_indices.reshape(-1, 3).astype(np.int64)
    found = _engine.mass_properties(vertices=mesh.points.astype(np.float64), triangles=faces)
    return float(found["volume_m3"])


def test_bytes_of_a_pose() -> None:
    """Twelve bytes a piece and frame, against 28 of single-precision numbers."""
    result = shattered_pane(pieces=500, frames=81)
    _, arrays = read(pack(result))
    moves = result.positions.shape[0] * result.positions.shape[1]
    padding = arrays["poses"].nbytes / arrays["poses"].shape[0]
    assert arrays["poses"].nbytes <= 12 * moves + padding


def test_a_result_without_pieces_has_a_message() -> None:
    header, arrays = read(pack(synthetic_result(sources=[("nothing", "stone", 0)], meshes=[], frames=3)))
    assert header["names"] == [] and header["batches"] == []
    assert arrays["poses"].size > 0


def test_what_is_no_message_is_refused() -> None:
    whole = pack(synthetic_result())
    for message in (b"", b"BRSV", whole[:-1], b"X" + whole[1:], whole + b"\0"):
        with pytest.raises(ValueError, match="message"):
            read(message)


def test_too_much_to_show_is_refused_beforehand() -> None:
    wall = br.BrickWall(rows=MOST_PIECES, columns=1, brick_mass=4)
    scene = br.Scene(charges=[br.Charge(mass=1, position=(0, 1, -9))], objects=[wall])
    with pytest.raises(InputError, match="pieces are more than the live view shows"):
        check_shown(scene)
    long = scene.model_copy(
        update={"objects": (br.BrickWall(rows=100, columns=9, brick_mass=4),), "time": br.Time(duration=1e4)}
    )
    with pytest.raises(InputError, match=r"frames of .* pieces are more than the live view shows"):
        check_shown(long)


def test_a_pane_is_whole_until_it_breaks_and_in_pieces_from_then_on() -> None:
    """The whole pane stands after the pieces, where its window is, and the two are never seen at once."""
    result = shattered_pane(pieces=40, frames=5)
    window = br.Block(size=(1, 1, 1), mass=1, position=(3, 1, 0), rotation=(0, 90, 0))
    whole = SimpleNamespace(
        mesh=box_mesh((1.6, 1.2, 0.006)), window=window, start=0, stop=len(result.meshes), broken_at_s=0.0125
    )
    result.panes = [whole]  # type: ignore[attr-defined]
    header, arrays = read(pack(result))
    pieces = len(header["names"])
    assert pieces == len(result.meshes)
    table = arrays["pieces"].reshape(-1, 16)
    assert table[:pieces, 12] == pytest.approx(0.0125) and (table[:pieces, 13] >= 1e30).all()
    assert table[pieces, 12] <= -1e30 and table[pieces, 13] == pytest.approx(0.0125)
    # It never moves: one pose, at its window's place and turned with it.
    assert table[pieces, 0:3].tolist() == [3, 1, 0] and table[pieces, 9] == 1
    offset, first, count = table[:, 7:10].astype(np.int64).T
    poses = Poses(arrays["poses"], offset, first, count, low=table[:, 0:3], size=table[:, 4:7])
    turn = unpack_poses(poses, 2)[1][pieces]
    assert angle_between(turn, np.array(window.orientation())) < WORST_TURN
    assert pieces in arrays["piece_0"]


def test_the_key_of_shapes_knows_every_part_of_them() -> None:
    def key(meshes: list[PieceMesh], material: str = "brick") -> str:
        result = synthetic_result(sources=[("wall", material, len(meshes))], meshes=meshes, frames=3)
        return str(read(pack(result))[0]["geometry"])

    brick = box_mesh()
    keys = [
        key([brick] * 6),
        key([brick] * 5),
        key([brick] * 5 + [box_mesh()]),
        key([brick] * 6, "glass"),
        key([box_mesh((0.32, 0.16, 0.11))] * 6),
        key([box_mesh(broken=[1])] * 6),
        key([box_mesh(broken=[2])] * 6),
    ]
    assert len(set(keys)) == len(keys)
    assert key([box_mesh()] * 6) == keys[0]
