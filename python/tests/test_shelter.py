"""Shelter end to end: the thesis's two tests (Figs 4.6 and 4.7), its settings, its warnings, its map."""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import brisance as br
from brisance import _engine
from brisance.cli.main import main
from brisance.simulation import build

SCENES = Path(__file__).parents[2] / "scenes"


def facts(scene: str, *changes: str) -> dict[str, dict[str, Any]]:
    """The report's facts of each body, by name."""
    bodies = br.simulate(br.load(SCENES / scene, list(changes))).report()["bodies"]
    return {body["name"]: body for body in bodies}


def launch(bodies: dict[str, dict[str, Any]], *names: str) -> list[float]:
    return [bodies[name]["launch_speed_m_s"] for name in names]


def test_figure_4_6_the_nearest_leads_in_the_open_and_the_most_exposed_behind_the_wall() -> None:
    names = ("near", "middle", "edge")
    in_open = facts("shelter.toml", "occlusion.enabled=false")
    assert sorted(launch(in_open, *names), reverse=True) == launch(in_open, *names)
    assert all(in_open[name]["attenuation"] == 1.0 for name in names)
    behind = facts("shelter.toml")
    near, middle, edge = launch(behind, *names)
    assert near < 0.2 * middle
    assert middle < 0.6 * edge
    assert edge < launch(in_open, "edge")[0]
    shares = [behind[name]["attenuation"] for name in names]
    assert 0 < shares[0] < 0.1 < shares[1] < 0.5 < shares[2] < 0.9
    # Nothing stands before the wall itself.
    assert behind["wall"] == in_open["wall"]


def test_figure_4_7_the_near_block_passes_the_far_one_in_the_open_and_stays_behind_cover() -> None:
    in_open = facts("shelter_gap.toml", "occlusion.enabled=false")
    near, far = launch(in_open, "near", "far")
    assert near > 3 * far
    assert in_open["near"]["final_position_m"][2] > in_open["far"]["final_position_m"][2]
    behind = facts("shelter_gap.toml")
    near, far = launch(behind, "near", "far")
    assert 0 < near < 0.4 * far
    assert behind["near"]["attenuation"] < 0.2 * behind["far"]["attenuation"]
    ways = [b["final_position_m"][2] - z for b, z in ((behind["near"], 4.5), (behind["far"], 9.0))]
    assert 5 * ways[0] < ways[1]


def test_the_sheltered_are_reached_later_by_the_way_round_the_edge() -> None:
    in_open, behind = facts("shelter.toml", "occlusion.enabled=false"), facts("shelter.toml")
    late = [behind[n]["arrival_time_s"] - in_open[n]["arrival_time_s"] for n in ("near", "middle", "edge")]
    assert late[0] > late[1] > late[2] > 0
    scene = br.load(SCENES / "shelter.toml")
    detour = build(scene).engine.shelter(0)["detour_m"][1]
    front = _engine.curves(mass=60.0, distance=np.array([8.4]))["front_velocity_m_s"][0]
    # The front slows by a few per cent over the block's own depth.
    assert late[0] == pytest.approx(detour / front, rel=0.05)


def test_a_load_is_the_open_one_times_the_share() -> None:
    open_, behind = facts("shelter.toml", "occlusion.enabled=false"), facts("shelter.toml")
    for name in ("near", "middle", "edge"):
        share = behind[name]["attenuation"]
        assert behind[name]["peak_load_pa"] == pytest.approx(open_[name]["peak_load_pa"] * share, rel=1e-9)
        assert behind[name]["peak_overpressure_pa"] == open_[name]["peak_overpressure_pa"]


def test_a_block_that_does_not_occlude_shelters_nothing() -> None:
    assert facts("shelter.toml", "block.0.occludes=false") == facts("shelter.toml", "occlusion.enabled=false")


def test_lone_objects_and_walls_do_not_change() -> None:
    for scene in ("brick_wall.toml", "brick_wall_resists.toml"):
        with_it, without = br.load(SCENES / scene), br.load(SCENES / scene, ["occlusion.enabled=false"])
        np.testing.assert_array_equal(br.simulate(with_it).positions, br.simulate(without).positions)


def test_each_charge_has_a_shadow_of_its_own() -> None:
    """The block lies behind the wall from one charge and open to the other: the share lies between."""
    wall = br.Block(name="wall", size=(6, 4, 0.2), position=(0, 2, 3), density=2400, anchored=True)
    block = br.Block(name="block", size=(1, 1, 1), position=(0, 0.5, 6), mass=500)
    charges = [br.Charge(mass=5, position=(0, 0.5, 0)), br.Charge(mass=5, position=(0, 0.5, 12))]

    def share(*charges: br.Charge) -> float:
        scene = br.Scene(charges=charges, objects=[wall, block], time=br.Time(duration=0.05))
        return float(br.simulate(scene).bodies.attenuation[1])

    assert share(charges[0]) == 0.0
    assert share(charges[1]) == 1.0
    assert share(*charges) == pytest.approx(0.5, abs=0.02)


def test_shelter_per_panel_turns_a_body_that_is_half_covered() -> None:
    wall = br.Block(name="wall", size=(3, 4, 0.2), position=(-1.5, 2, 3), density=2400, anchored=True)
    block = br.Block(name="block", size=(1, 1, 0.3), position=(0, 0.5, 6), mass=100, friction=0)
    turned = []
    for per in ("body", "panel"):
        scene = br.Scene(
            charges=[br.Charge(mass=5, position=(0, 0.5, 0))],
            objects=[wall, block],
            time=br.Time(duration=0.3, frame_rate=100),
            occlusion=br.Occlusion(per=per, resolution=64),
        )
        result = br.simulate(scene)
        assert 0.2 < result.bodies.attenuation[1] < 1
        turned.append(float(np.abs(result.orientations[-1, 1, 2])))
    assert turned[0] < 1e-6
    assert turned[1] > 1e-3


def test_a_closed_room_is_warned_of() -> None:
    walls = [
        br.Block(
            name=f"side {axis} {side}",
            size=tuple(0.2 if i == axis else 8.0 for i in range(3)),
            position=tuple(side * 4.0 if i == axis else 4.0 * (i == 1) for i in range(3)),
            density=2400,
            anchored=True,
        )
        for axis in (0, 2)
        for side in (-1, 1)
    ]
    roof = br.Block(name="roof", size=(8, 0.2, 8), position=(0, 8, 0), density=2400, anchored=True)

    def warnings(*objects: br.Block) -> list[str]:
        scene = br.Scene(
            charges=[br.Charge(mass=1, position=(0, 1, 0))],
            objects=objects,
            ground=br.Ground(),
            time=br.Time(duration=0.01, frame_rate=100),
        )
        return [warning for warning in br.simulate(scene).warnings if "enclosed" in warning]

    assert len(warnings(*walls, roof)) == 1
    assert "reflections are not modelled" in warnings(*walls, roof)[0]
    assert warnings(*walls[:2], roof) == []


def test_the_parameters_of_the_attenuation_reach_the_engine() -> None:
    assert facts("shelter.toml", "occlusion.offset=100")["near"]["attenuation"] > 0.9
    assert facts("shelter.toml", "occlusion.slope=0")["edge"]["attenuation"] == 0
    edge = facts("shelter.toml")["edge"]["attenuation"]
    assert facts("shelter.toml", "occlusion.power=4")["edge"]["attenuation"] == pytest.approx(edge**2)
    assert facts("shelter.toml", "occlusion.exponent=3")["edge"]["attenuation"] > edge


def test_behind_a_long_wall_shelter_falls_with_distance_and_with_the_charge_s() -> None:
    """What is known of blast walls (docs/shelter.md): best close behind, best with the charge close by."""

    def share(stand_off: float, behind: float) -> float:
        wall = br.Block(size=(40, 2, 0.2), position=(0, 1, 0), density=2400, anchored=True)
        block = br.Block(size=(0.5, 0.5, 0.5), position=(0, 0.25, behind), mass=50)
        scene = br.Scene(
            charges=[br.Charge(mass=10, position=(0, 0.5, -stand_off))],
            objects=[wall, block],
            ground=br.Ground(),
        )
        return float(build(scene).engine.shelter(0)["attenuation"][1])

    far = [share(16, behind) for behind in (2, 8, 16, 32, 64)]
    assert far == sorted(far)
    assert far[0] == 0
    assert far[-1] > 0.2
    near = [share(stand_off, 40) for stand_off in (2, 8, 16, 32)]
    assert near == sorted(near)


def test_the_attenuation_is_the_formula_of_the_thesis() -> None:
    b, k = np.linspace(0, 4, 9), np.linspace(0, 0.8, 9)
    x = np.minimum(b / (1 + 7 * k), 1)
    found = _engine.attenuation(blocking=b, separation=k, offset=1, slope=7, exponent=1.5, power=2)
    np.testing.assert_allclose(found, x**3 - 2 * x**1.5 + 1, atol=1e-12)


def test_the_report_times_occlusion_and_keeps_its_settings(tmp_path: Path) -> None:
    path = tmp_path / "shelter.json"
    assert main(["run", str(SCENES / "shelter.toml"), "--report", str(path), "--quiet"]) == 0
    report = json.loads(path.read_text())
    assert report["timing_s"]["occlusion"] > 0
    assert report["settings"]["occlusion"]["slope"] == 7


def test_inspect_draws_the_map(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "map.png"
    assert main(["inspect", str(SCENES / "shelter.toml"), "--occlusion", "-o", str(path)]) == 0
    header = path.read_bytes()[:24]
    width, height = struct.unpack(">II", header[16:24])
    assert header.startswith(b"\x89PNG")
    assert width > 800
    assert height > 400
    assert "sheltered in part or in full: 3" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--occlusion"], "go together"),
        (["-o", "map.png"], "go together"),
        (["--occlusion", "-o", "map.jpg"], "ends in .png"),
        (["--occlusion", "-o", "no/such/folder/map.png"], "no/such/folder"),
    ],
)
def test_a_map_that_cannot_be_is_one_sentence(
    arguments: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["inspect", str(SCENES / "shelter.toml"), *arguments]) == 2
    error = capsys.readouterr().err
    assert said in error
    assert "Traceback" not in error


def test_the_map_shows_the_wall_where_it_is() -> None:
    scene = br.load(SCENES / "shelter.toml")
    bodies, distances = build(scene).engine.seen_from(0)
    assert set(np.unique(bodies)) == {-1, 0}
    assert np.nanmin(distances) == pytest.approx(2.2, abs=0.01)
    ahead = _engine.sphere_pixels(directions=np.array([[0.0, 0.1, 1.0], [1.0, 0.0, 0.0]]), resolution=32)
    assert bodies[ahead].tolist() == [0, -1]
