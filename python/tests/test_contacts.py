"""Bodies that touch, from the scene file to the report: piles, rest, dispersal."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest

import brisance as br
from brisance.dispersal import dispersal, ring_edges, summary
from brisance.errors import InputError

SCENES = Path(__file__).resolve().parents[2] / "scenes"
WALL = SCENES / "brick_wall_aftermath.toml"


@pytest.fixture(scope="module")
def wall() -> br.Result:
    return br.simulate(br.load(WALL))


def test_the_wall_lies_still_at_the_end(wall: br.Result) -> None:
    end = wall.times[-1]
    assert 1.0 < end < wall.scene.time.longest
    assert len(wall.times) == round(end * wall.frame_rate) + 1
    assert np.isfinite(wall.bodies.rest_time_s).all()
    assert (wall.bodies.rest_time_s <= end).all()
    last = int((end - 0.3) * wall.frame_rate)
    assert np.abs(wall.positions[-1] - wall.positions[last]).max() < 2e-3
    # No brick lies lower than on its flattest side.
    assert wall.bodies.final_position_m[:, 1].min() > 0.05 - 2e-3


def test_no_brick_is_inside_another(wall: br.Result) -> None:
    """Spheres in the bricks: two centres are never nearer than the thinnest edge, less 2 mm."""
    places = wall.positions[-1].astype(np.float64)
    apart = np.linalg.norm(places[:, None] - places[None], axis=2)
    assert apart[np.triu_indices(len(places), 1)].min() > 0.10 - 2e-3


def test_the_report_says_where_it_all_lies(wall: br.Result, tmp_path: Path) -> None:
    wall.write(tmp_path / "wall.json")
    found = json.loads((tmp_path / "wall.json").read_text())["dispersal"]
    assert found == summary(wall)
    counts = np.array([ring["count"] for ring in found["rings"]])
    masses = np.array([ring["mass_kg"] for ring in found["rings"]])
    assert counts.sum() == found["moved"] <= len(wall.bodies)
    assert math.isclose(masses.sum(), found["moved_mass_kg"])
    assert found["half_mass_within_m"] <= found["farthest_m"] <= found["rings"][-1]["to_m"]
    # The charge stands on -z: more comes down on +z, which is the sixth sector of eight.
    assert masses[:, 5:8].sum() > masses[:, 1:4].sum()


def test_directions_and_rings_are_those_of_the_ends(wall: br.Result) -> None:
    found = dispersal(wall)
    offset = wall.bodies.final_position_m[found.moved][:, [0, 2]] - found.origin
    distance = np.hypot(*offset.T)
    for ring, (low, high) in enumerate(zip(found.edges[:-1], found.edges[1:], strict=True)):
        assert found.count[ring].sum() == ((distance >= low) & (distance < high)).sum()
    angle = np.degrees(np.arctan2(-offset[:, 1], offset[:, 0])) % 360.0
    for sector in range(8):
        away = np.abs((angle - 45.0 * sector + 180.0) % 360.0 - 180.0)
        assert found.count[:, sector].sum() == (away < 22.5).sum()


@pytest.mark.parametrize(
    ("farthest", "last"), [(0.0, 1.0), (0.7, 1.0), (3.0, 5.0), (40.0, 50.0), (900.0, 1000.0)]
)
def test_rings_have_round_bounds(farthest: float, last: float) -> None:
    edges = ring_edges(farthest)
    assert edges[0] == 0.0
    assert edges[-1] == pytest.approx(last)


def test_threads_do_not_change_a_bit(wall: br.Result) -> None:
    again = br.simulate(br.load(WALL), threads=1)
    assert np.array_equal(again.positions, wall.positions)
    assert np.array_equal(again.orientations, wall.orientations)


def test_a_run_that_does_not_come_to_rest_says_so() -> None:
    result = br.simulate(br.load(WALL, ["time.longest=0.3"]))
    assert result.times[-1] == pytest.approx(0.3)
    assert any("still move" in warning for warning in result.warnings)


def test_free_flight_comes_to_rest_too() -> None:
    result = br.simulate(br.load(WALL, ["dynamics.contacts=false"]))
    assert result.times[-1] < result.scene.time.longest
    assert np.isfinite(result.bodies.rest_time_s).all()


def test_a_duration_is_a_number_or_rest() -> None:
    with pytest.raises(InputError, match=r"time\.duration must be a number or 'rest', not 'rst'"):
        br.load(WALL, ['time.duration="rst"'])
