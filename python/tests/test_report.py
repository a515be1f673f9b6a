"""The report: the keys it promises, facts that agree with each other and with the motion, and plain JSON."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import brisance as br
from brisance import _engine
from brisance.result import TIMINGS

SCENES = Path(__file__).parents[2] / "scenes"

KEYS = {"scene", "seed", "version", "units", "timing_s", "warnings", "charges", "bodies"}
BODY_KEYS = {
    "name",
    "source",
    "mass_kg",
    "frontal_area_m2",
    "distance_m",
    "arrival_time_s",
    "peak_overpressure_pa",
    "peak_load_pa",
    "impulse_n_s",
    "attenuation",
    "launch_speed_m_s",
    "free_time_s",
    "rest_time_s",
    "final_position_m",
}


@pytest.fixture(scope="module")
def wall() -> br.Result:
    return br.simulate(br.load(SCENES / "brick_wall.toml"))


@pytest.fixture(scope="module")
def facts(wall: br.Result) -> dict[str, Any]:
    return wall.report()


def test_it_has_the_promised_keys(facts: dict[str, Any]) -> None:
    assert facts.keys() >= KEYS
    assert set(facts["timing_s"]) == set(TIMINGS)
    assert facts["scene"] == "brick wall"
    assert facts["seed"] == 1
    assert facts["version"] == br.__version__
    assert len(facts["bodies"]) == 27
    for body in facts["bodies"]:
        assert body.keys() == BODY_KEYS


def test_the_file_holds_what_python_holds(tmp_path: Path, wall: br.Result) -> None:
    path = tmp_path / "wall.json"
    wall.write(path)
    from_file, own = json.loads(path.read_text(encoding="utf-8")), wall.report()
    # Writing the report takes time of its own, which the report cannot hold.
    assert {**from_file, "timing_s": 0} == {**own, "timing_s": 0}
    assert list(tmp_path.iterdir()) == [path]


def test_the_file_is_strict_json_where_nothing_comes_to_rest(tmp_path: Path) -> None:
    scene = br.Scene(
        name='a "name" in Ελληνικά',
        charges=[br.Charge(mass=100, position=(0, 0, -5))],
        objects=[br.Block(size=(1, 1, 1), mass=10)],
        time=br.Time(duration=0.1, frame_rate=10),
    )
    path = tmp_path / "block.json"
    br.simulate(scene).write(path)

    def refuse(constant: str) -> None:
        raise AssertionError(f"{constant} is not JSON")

    facts = json.loads(path.read_text(encoding="utf-8"), parse_constant=refuse)
    assert facts["scene"] == scene.name
    assert facts["bodies"][0]["rest_time_s"] is None
    assert facts["bodies"][0]["name"] == "block_0"


def test_facts_are_the_arrays_of_the_result(wall: br.Result, facts: dict[str, Any]) -> None:
    never = ("rest_time_s", "free_time_s")
    for name in BODY_KEYS - {"name", "source", *never}:
        column = np.array([body[name] for body in facts["bodies"]])
        np.testing.assert_array_equal(column, getattr(wall.bodies, name))
    for name in never:
        times = [math.nan if body[name] is None else body[name] for body in facts["bodies"]]
        np.testing.assert_array_equal(times, getattr(wall.bodies, name))
    assert [body["name"] for body in facts["bodies"]] == list(wall.bodies.names)
    assert {body["source"] for body in facts["bodies"]} == {"wall"}


def test_pressures_and_arrivals_are_those_of_the_curves(wall: br.Result) -> None:
    bodies, charge = wall.bodies, np.array([0, 0.3, -15])
    away = np.linalg.norm(wall.positions[0].astype(np.float64) - charge, axis=1)
    np.testing.assert_allclose(bodies.distance_m, away, rtol=1e-7)  # single precision
    at_centre = _engine.curves(mass=100.0, distance=bodies.distance_m)
    half = np.where(bodies.mass_kg[:, None] == 10.0, [0.16, 0.08, 0.05], [0.08, 0.08, 0.05])
    nearest = np.linalg.norm(np.maximum(np.abs(wall.positions[0] - charge) - half, 0), axis=1)
    at_face = _engine.curves(mass=100.0, distance=nearest * (1 - 1e-7))
    assert (bodies.arrival_time_s >= at_face["arrival_time_s"]).all()
    assert (bodies.arrival_time_s < at_centre["arrival_time_s"]).all()
    assert (bodies.peak_overpressure_pa >= at_centre["overpressure_pa"]).all()
    assert (bodies.peak_overpressure_pa <= at_face["overpressure_pa"]).all()
    assert (bodies.peak_load_pa <= at_face["reflected_pressure_pa"]).all()
    assert (bodies.peak_load_pa > bodies.peak_overpressure_pa).all()


def test_bricks_that_show_their_whole_face_show_its_area(wall: br.Result) -> None:
    whole = wall.bodies.mass_kg == 10.0
    np.testing.assert_allclose(wall.bodies.frontal_area_m2[whole], 0.32 * 0.16, rtol=1e-2)  # seen aslant
    np.testing.assert_allclose(wall.bodies.frontal_area_m2[~whole], 0.16 * 0.16, rtol=5e-2)
    np.testing.assert_array_equal(wall.bodies.attenuation, 1.0)


def test_impulse_sets_the_launch_speed_where_nothing_else_pushes() -> None:
    """Without ground, the speed at the end of loading is impulse over mass and the gravity of that time."""
    scene = br.Scene(
        charges=[br.Charge(mass=100, position=(0, 0, -15))],
        objects=[br.Block(size=(1, 1, 1), mass=5000, can_rotate=False, friction=0)],
        dynamics=br.Dynamics(damping_factor=0),
        time=br.Time(duration=0.2, frame_rate=1000),
    )
    bodies = br.simulate(scene).bodies
    thrown = np.linalg.norm(bodies.impulse_n_s[0]) / 5000
    # Loading lasts for some 10 to 30 ms after the arrival; falling adds its speed at right angles.
    fallen = 9.81 * (bodies.arrival_time_s[0] + 0.05)
    assert thrown * (1 - 1e-6) <= bodies.launch_speed_m_s[0] <= math.hypot(thrown, fallen)
    assert bodies.impulse_n_s[0, 2] > 0
    np.testing.assert_allclose(bodies.impulse_n_s[0, :2], 0, atol=1e-9 * bodies.impulse_n_s[0, 2])


def test_gain_scales_impulses_and_nothing_of_the_air(wall: br.Result) -> None:
    doubled = br.simulate(br.load(SCENES / "brick_wall.toml", ["charge.0.gain=2"])).bodies
    np.testing.assert_array_equal(doubled.arrival_time_s, wall.bodies.arrival_time_s)
    ratio = np.linalg.norm(doubled.impulse_n_s, axis=1) / np.linalg.norm(wall.bodies.impulse_n_s, axis=1)
    # Drag follows the air's speed relative to the brick, so a faster brick gains a little less than double.
    assert (ratio <= 2 + 1e-9).all()
    assert (ratio > 1.8).all()


def test_what_an_anchored_body_reports_leaves_it_where_it_is() -> None:
    scene = br.Scene(
        charges=[br.Charge(mass=100, position=(0, 0.5, -5))],
        objects=[br.Block(name="post", size=(1, 1, 1), position=(0, 0.5, 0), mass=10, anchored=True)],
        ground=br.Ground(),
    )
    result = br.simulate(scene)
    assert result.bodies.launch_speed_m_s[0] == 0
    assert result.bodies.peak_load_pa[0] > 0
    np.testing.assert_array_equal(result.positions, np.broadcast_to([[[0, 0.5, 0]]], result.positions.shape))


def test_units_stand_in_the_names(facts: dict[str, Any]) -> None:
    assert facts["units"]["pressure"] == "Pa"
    charge = facts["charges"][0]
    assert charge["mass_kg"] == 100
    assert charge["tnt_mass_kg"] == 100
    assert charge["position_m"] == [0, 0.3, -15]


def test_a_result_needs_a_suffix_it_knows(tmp_path: Path, wall: br.Result) -> None:
    with pytest.raises(br.InputError, match="no suffix that names a format"):
        wall.write(tmp_path / "wall.abc")
    assert list(tmp_path.iterdir()) == []


def test_writing_counts_in_the_time(tmp_path: Path) -> None:
    result = br.simulate(br.load(SCENES / "brick_wall.toml"))
    before = dict(result.timing_s)
    result.write(tmp_path / "wall.usdc")
    spent = result.timing_s["write"]
    assert spent > 0
    assert result.timing_s["total"] == pytest.approx(before["total"] + spent)
