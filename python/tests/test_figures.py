"""The thesis's figures: each is drawn, and what it shows has the properties that the thesis states."""

from __future__ import annotations

import csv
import struct
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from brisance import _engine
from brisance.errors import InputError
from brisance.figures import FIGURES, build, example, figure_3_4, figure_4_4, painter, wall
from brisance.figures import raster as raster_module
from brisance.figures.raster import Raster
from brisance.result import Result

NAMES = ["2.3", "2.4", "2.5", "2.6", "table-2.1", "2.7", "2.8", "2.9", "2.10", "2.12", "2.13"]
NAMES += ["2.14", "2.15", "2.16"]
NAMES += ["3.1", "3.2", "3.3", "3.4", "3.5", "3.6", "3.7"]
NAMES += ["4.3", "4.4", "4.5", "4.6", "4.7", "4.8"]
BLOCKS = ("4.6", "4.7", "4.8")
"""Figures whose table has a row a block."""
NAMES += ["5.5", "5.10", "5.11", "5.12", "5.13", "5.14", "5.16", "6.1", "6.2", "6.3"]
NAMES += ["6.4", "6.5", "6.6"]
BEYOND = ["window-plume", "window-fragments", "dispersal"]
"""Figures that the thesis does not have."""
NAMES += BEYOND
SMALL = (420, 320)


def columns(name: str) -> dict[str, NDArray[np.float64]]:
    """The numbers that a figure plots, by column."""
    table = FIGURES[name].table(FIGURES[name].compute())
    return {key: np.asarray(values, dtype=float) for key, values in table.items()}


def test_the_registry_holds_every_figure_in_the_thesis_order() -> None:
    assert list(FIGURES) == NAMES
    for name, figure in FIGURES.items():
        assert figure.name == name
        assert name in BEYOND or name.removeprefix("table-") in figure.title


# Pictures as small as here have no room for nine panels and their captions.
@pytest.mark.filterwarnings("ignore:constrained_layout not applied")
@pytest.mark.parametrize("name", NAMES)
def test_every_figure_is_drawn(name: str, tmp_path: Path) -> None:
    paths = build(name, tmp_path / "figures", size=SMALL)
    assert sorted(paths) == sorted((tmp_path / "figures").iterdir())
    header = paths[0].read_bytes()[:24]
    assert header.startswith(b"\x89PNG")
    assert struct.unpack(">II", header[16:24]) == SMALL
    assert paths[0].stat().st_size > 5_000
    if FIGURES[name].table is not None:
        with paths[1].open(newline="") as file:
            rows = list(csv.reader(file))
        assert len(rows) > (9 if name not in BLOCKS else 2)
        assert {len(row) for row in rows} == {len(rows[0])}


def test_an_unknown_figure_is_one_sentence(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"no figure 3\.55: did you mean 3\.5\?"):
        build("3.55", tmp_path)


def test_a_file_in_place_of_the_folder_is_one_sentence(tmp_path: Path) -> None:
    (tmp_path / "figures").write_text("kept")
    with pytest.raises(InputError, match="give a folder"):
        build("2.9", tmp_path / "figures")
    assert (tmp_path / "figures").read_text() == "kept"


def test_table_2_1_has_ten_explosives_and_tnt_is_one() -> None:
    table = FIGURES["table-2.1"].compute()
    factors = dict(zip(table["explosive"], table["tnt_equivalence"], strict=True))
    assert len(factors) == 10
    assert next(factor for name, factor in factors.items() if name.startswith("TNT")) == 1.0


def test_figure_2_3_has_a_spike_a_zone_and_a_following_flow() -> None:
    data = columns("2.3")
    place, pressure, zone = data["x_m"], data["pressure_pa"], data["zone"]
    reacting, following = zone == 1.0, zone == 2.0
    assert np.all(np.diff(place) >= 0.0)
    # The spike of a strong detonation in an ideal gas is twice the Chapman–Jouguet pressure, 21.0 GPa of TNT.
    assert pressure[reacting].max() == pytest.approx(2.0 * pressure[reacting][0], rel=1e-6)
    assert pressure[reacting][0] == pytest.approx(21.0e9, rel=5e-3)
    assert pressure[following][-1] == pytest.approx(pressure[reacting][0], rel=1e-3)
    assert np.all(np.diff(pressure[following]) >= -1.0)
    # Half of the plane flow is at rest.
    assert data["velocity_m_s"][following][:150] == pytest.approx(0.0, abs=1.0)
    assert np.all(pressure[zone == 0.0] == 0.0)


def test_figure_2_4_hugoniot_and_line_meet_behind_the_front() -> None:
    data = columns("2.4")
    above = data["pressure_pa:rayleigh"] > data["pressure_pa:hugoniot"]
    velocity = data["velocity_m_s"]
    assert np.all(above[(velocity > 0.0) & (velocity < 1400.0)])
    assert not np.any(above[velocity > 1400.0])


def test_figure_2_5_lines_miss_touch_and_cross() -> None:
    data = columns("2.5")
    curve = data["pressure_pa:hugoniot"]
    assert np.all(data["pressure_pa:slower"] < curve)
    gap = 1.0 - data["pressure_pa:touching"] / curve
    assert np.all(gap >= 0.0) and gap.min() < 1e-4
    crossings = np.diff(np.sign(data["pressure_pa:faster"] - curve)) != 0
    assert crossings.sum() == 2


def test_figure_2_6_more_reaction_lies_to_the_left_and_higher() -> None:
    data = columns("2.6")
    parts = [data[f"pressure_pa:progress_{part}"] for part in ("0", "0.25", "0.5", "0.75", "1")]
    for less, more in pairwise(parts):
        assert np.all(more > less)
    touching = data["pressure_pa:touching"]
    assert np.all(touching <= parts[-1] * (1.0 + 1e-9)) and np.any(touching > 0.9999 * parts[-1])
    assert (np.diff(np.sign(data["pressure_pa:overdriven"] - parts[-1])) != 0).sum() == 2


def test_figure_2_7_shows_the_hydrocode_near_the_experiments() -> None:
    data = columns("2.7")
    scaled = data["scaled_distance_m_kg13"]
    ratio = data["overpressure_pa:hydrocode"] / data["overpressure_pa:kingery-bulmash"]
    middle = (scaled > 0.1) & (scaled < 10.0)
    assert np.abs(ratio[middle] - 1.0).max() < 0.13


def test_figure_2_14_rises_flows_and_unloads_at_the_first_slope() -> None:
    data = columns("2.14")
    x, resistance = data["displacement_m"], data["resistance_n"]
    assert resistance.max() == pytest.approx(1e5)
    top = int(np.argmax(x))
    assert resistance[: top + 1] == pytest.approx(np.minimum(4e6 * x[: top + 1], 1e5), abs=1.0)
    slope = np.diff(resistance[top + 1 : top + 100]) / np.diff(x[top + 1 : top + 100])
    assert slope == pytest.approx(4e6, rel=1e-6)


def test_figure_2_15_curves_approach_their_asymptotes_and_the_charge_crosses_them() -> None:
    data = columns("2.15")
    for name in ("elastic", "plastic"):
        impulse, pressure = data[f"impulse_pa_s:{name}"], data[f"pressure_pa:{name}"]
        assert impulse[0] == pytest.approx(data[f"impulse_asymptote_pa_s:{name}"][0], rel=0.01)
        assert pressure[-1] == pytest.approx(data[f"pressure_asymptote_pa:{name}"][0], rel=0.03)
    near, far = data["impulse_pa_s:charge"][0], np.nanmin(data["impulse_pa_s:charge"])
    assert near > data["impulse_asymptote_pa_s:plastic"][0]
    assert far < data["impulse_asymptote_pa_s:elastic"][0]


def test_figure_2_7_brode_fails_near_and_henrych_in_the_middle() -> None:
    data = columns("2.7")
    scaled, measured = data["scaled_distance_m_kg13"], data["overpressure_pa:kingery-bulmash"]
    brode = data["overpressure_pa:brode"] / measured
    henrych = data["overpressure_pa:henrych"] / measured
    near, middle, far = scaled < 0.3, (scaled > 0.4) & (scaled < 0.9), (scaled > 1.1) & (scaled < 9.0)
    assert np.nanmin(brode[near]) > 2.0
    assert np.nanmax(np.abs(brode[far] - 1.0)) < 0.25
    assert np.nanmax(np.abs(henrych[far] - 1.0)) < 0.2
    assert np.nanmin(henrych[middle]) < 0.8


def test_figure_2_8_jumps_decays_sucks_and_ends() -> None:
    data = columns("2.8")
    at = example.point()
    times, pressure = data["time_s"], data["overpressure_pa"]
    assert np.all(pressure[times < at.arrival] == 0.0)
    assert pressure.max() == pytest.approx(at.overpressure, rel=1e-9)
    assert pressure.min() < -0.02 * at.overpressure
    assert pressure[-1] == 0.0
    positive = (times >= at.arrival) & (times <= at.arrival + at.duration)
    middles = 0.5 * (pressure[positive][1:] + pressure[positive][:-1])
    # Trapezoids of 800 samples over a curved pulse whose end falls between two: some parts in a thousand.
    assert middles @ np.diff(times[positive]) == pytest.approx(at.impulse, rel=3e-3)


def test_figure_2_9_triangle_i_keeps_the_duration_and_ii_the_impulse() -> None:
    data = columns("2.9")
    at = example.point()
    same_impulse = 2.0 * at.impulse / at.overpressure
    for shape, base in (("triangle-duration", at.duration), ("triangle-impulse", same_impulse)):
        pressure = data[f"overpressure_pa:{shape}"]
        slope = (pressure[0] - pressure[20]) / (data["time_s"][20] - data["time_s"][0])
        assert pressure[0] == pytest.approx(at.overpressure, rel=1e-12)
        assert pressure[0] / slope == pytest.approx(base, rel=1e-9)
    end = np.array([at.duration])
    pulse = {"peak": at.overpressure, "duration": at.duration, "impulse": at.impulse, "times": end}
    for shape in ("friedlander", "triangle-impulse"):
        assert _engine.pulse(**pulse, shape=shape)["impulse_pa_s"][0] == pytest.approx(at.impulse, rel=1e-9)


def test_figure_2_10_peaks_lie_on_the_front() -> None:
    data = columns("2.10")
    front = data.pop("overpressure_pa:front")
    pulses = [values for key, values in data.items() if key != "time_s"]
    peaks = [values.max() for values in pulses]
    assert peaks == sorted(peaks, reverse=True)
    for values in pulses:
        # The front is integrated from its velocity, the arrival read from its own curve: 3 % apart at most in
        # time, which the pressure, falling about as the inverse square of the distance, doubles.
        assert front[np.argmax(values)] == pytest.approx(values.max(), rel=0.06)


def test_figure_2_12_ends_at_one_and_starts_at_normal_reflection() -> None:
    data = columns("2.12")
    for key, coefficient in data.items():
        if key == "angle_deg":
            continue
        pressure = float(key.removeprefix("coefficient:").removesuffix("_pa"))
        reflected = _engine.rankine_hugoniot(overpressure=np.array([pressure]))["reflected_pressure_pa"][0]
        assert coefficient[-1] == pytest.approx(1.0, abs=1e-12)
        # The chart is read off a drawing of real-gas air: 10 % off the ideal gas at these pressures.
        assert coefficient[0] == pytest.approx(reflected / pressure, rel=0.1)
    assert data["coefficient:10000_pa"].max() > 1.2 * data["coefficient:10000_pa"][0]


def test_figure_2_13_front_side_and_rear_in_turn() -> None:
    data = columns("2.13")
    times = data["time_s"]
    front, side, rear = (data[f"overpressure_pa:{face}"] for face in ("front", "side", "rear"))
    at = example.point()
    start = [times[np.argmax(pressure > 0.0)] for pressure in (front, side, rear)]
    assert start == sorted(start)
    assert front.max() > 2.0 * side.max()
    assert side.max() >= rear.max() > 0.3 * side.max()
    cleared = (times > at.arrival + 3.0 * 0.5 / at.front_velocity) & (times < at.arrival + at.duration)
    incident = example.incident(at, times - at.arrival)
    # (2.30): stagnation is the static pressure plus the dynamic one, which is below a quarter of it here.
    assert np.all(front[cleared] >= incident[cleared] * (1.0 - 1e-9))
    assert np.all(front[cleared] <= 1.25 * incident[cleared] + 1.0)
    # The rear has no jump: it rises from nothing.
    assert rear[np.argmax(rear > 0.0)] < 0.1 * rear.max()


def test_figure_2_16_reflection_clears_into_drag() -> None:
    data = columns("2.16")
    at = example.point()
    times, pressure = data["time_s"], data["overpressure_pa"]
    head_on = _engine.reflection_coefficient(angle_deg=np.zeros(1), overpressure=at.overpressure)[0]
    assert pressure.max() == pytest.approx(head_on * at.overpressure, rel=1e-6)
    assert np.all(np.diff(pressure) <= 1e-6 * at.overpressure)
    dynamic = example.curves(np.array([at.distance]))["dynamic_pressure_pa"][0]
    cleared = pressure[times > 3.0 * 0.5 / at.front_velocity]
    assert 0.0 < cleared.max() < 1.05 * dynamic
    assert cleared.min() >= 0.0


def test_figures_3_1_and_3_2_fall_outward() -> None:
    first, second = columns("3.1"), columns("3.2")
    assert np.all(np.diff(first["overpressure_pa"]) < 0.0)
    assert np.all(np.diff(second["front_velocity_m_s"]) < 0.0)
    assert np.all(np.diff(second["dynamic_pressure_pa"]) < 0.0)
    assert second["front_velocity_m_s"].min() > 340.0


def test_figure_3_3_has_every_curve_of_the_chart_and_all_end_at_one() -> None:
    data = columns("3.3")
    curves = [coefficient for key, coefficient in data.items() if key != "angle_deg"]
    assert len(curves) == 20
    assert all(coefficient[-1] == pytest.approx(1.0, abs=1e-12) for coefficient in curves)
    assert all(low[0] <= high[0] for low, high in pairwise(curves))


def test_figure_3_4_shows_27_bricks_that_fill_the_wall_without_overlap() -> None:
    bricks = figure_3_4.bricks(figure_3_4.compute())
    mass, width, height = (np.asarray(bricks[key], dtype=float) for key in ("mass_kg", "width_m", "height_m"))
    assert len(mass) == 27
    assert mass == pytest.approx(np.where(width > 0.2, 10.0, 5.0), rel=1e-6)
    low = np.stack([np.asarray(bricks[key], dtype=float) for key in ("x_m", "y_m")])
    high = low + np.stack([width, height])
    overlap = np.minimum(high[:, :, None], high[:, None, :]) - np.maximum(low[:, :, None], low[:, None, :])
    np.fill_diagonal(overlap[0], 0.0)
    assert np.minimum(overlap[0], overlap[1]).max() < 1e-6
    extent = high.max(axis=1) - low.min(axis=1)
    assert extent == pytest.approx([1.28, 0.96], rel=0.1)


def moved(result: Result) -> NDArray[np.float64]:
    """How far each piece is from its place at the end [m]."""
    return np.linalg.norm(result.positions[-1] - result.positions[0], axis=1)


def test_figure_3_5_scatters_the_wall() -> None:
    distance = moved(wall.result(wall.BLOWN_APART))
    # Every brick moves, and nine in ten by more than half the wall's thickness: off what carried them.
    assert distance.min() > 1e-3
    assert np.count_nonzero(distance > 0.05) >= 24


def test_figure_3_7_loses_its_top_and_keeps_its_foot() -> None:
    result = wall.result(wall.RESISTS)
    height, distance = result.positions[0, :, 1], moved(result)
    # The wall is 0.1 m thick: what has moved less is still in it.
    assert distance[height < height.min() + 0.05].max() < 0.1
    assert distance[height > height.max() - 0.05].max() > 0.3


def test_painted_frames_are_equally_spaced() -> None:
    assert painter.equally_spaced(41, 8) == [0, 5, 10, 15, 20, 25, 30, 35]
    assert painter.equally_spaced(41, 6) == [0, 8, 16, 24, 32, 40]
    assert painter.equally_spaced(3, 6) == [0, 1, 2, 2, 2, 2]


def test_the_painter_keeps_every_piece_in_the_picture_and_shows_what_is_nearest() -> None:
    result = wall.result(wall.BLOWN_APART)
    head_on = painter.View(azimuth=0.0, elevation=0.0)
    camera = painter.place_camera(result, [0], head_on, aspect=1.5)
    local, colours, pieces = painter.lit(result, painter.world_triangles(result, 0), camera)
    plane = local[:, :, :2] / -local[:, :, 2:]
    assert np.all(np.abs(plane) <= [camera.half_width, camera.half_height])
    raster = Raster(width=150, height=100, half_width=camera.half_width, half_height=camera.half_height)
    raster.draw(local, colours, pieces)
    # In the middle of the picture is the wall's front, half a brick nearer than its middle plane.
    assert 1.0 / raster.nearness[50, 75] == pytest.approx(camera.position[2] - 0.05, rel=0.01)
    assert raster.label[0, 0] == -1
    assert set(np.unique(raster.label)) == {-1, *range(27)}


def test_the_raster_draws_many_small_triangles_as_it_draws_each(monkeypatch: pytest.MonkeyPatch) -> None:
    random = np.random.default_rng(7)
    middle = random.uniform(-1.0, 1.0, (2000, 1, 3)) * [3.0, 2.0, 1.0] - [0.0, 0.0, 5.0]
    triangles = middle + 0.08 * random.normal(size=(2000, 3, 3))
    colours, labels = random.uniform(size=(2000, 3)), np.arange(2000)
    drawn = []
    for few in (raster_module.FEW, 0):
        monkeypatch.setattr(raster_module, "FEW", few)
        raster = Raster(width=160, height=100, half_width=0.8, half_height=0.5)
        raster.draw(triangles, colours, labels)
        drawn.append(raster)
    assert len(np.unique(drawn[0].label)) > 500
    for one, other in zip(vars(drawn[0]).values(), vars(drawn[1]).values(), strict=True):
        assert np.array_equal(one, other)


def test_the_raster_shows_the_nearer_of_two_triangles_whatever_their_order() -> None:
    far = np.array([[-1.0, -1.0, -2.0], [1.0, -1.0, -2.0], [0.0, 1.0, -2.0]])
    near = 0.5 * far
    for order in ([far, near], [near, far]):
        raster = Raster(width=40, height=40, half_width=1.0, half_height=1.0)
        raster.draw(np.array(order), np.zeros((2, 3)), np.array([int(-shape[0, 2]) for shape in order]))
        assert raster.label[20, 20] == 1
        # A triangle seen under the same angles covers the same pixels: an eighth of the picture's 1600.
        assert np.count_nonzero(raster.nearness) == pytest.approx(200, abs=30)
    behind = Raster(width=40, height=40, half_width=1.0, half_height=1.0)
    behind.draw(-far[None], np.zeros((1, 3)), np.zeros(1, dtype=int))
    assert not behind.nearness.any()


def test_figure_4_3_lays_out_twenty_faces_of_a_thousand_pixels() -> None:
    data = columns("4.3")
    assert len(data["face"]) == 20 * 32**2
    area = 0.5 * np.abs(
        (data["x1"] - data["x0"]) * (data["y2"] - data["y0"])
        - (data["x2"] - data["x0"]) * (data["y1"] - data["y0"])
    )
    np.testing.assert_allclose(area, np.sqrt(3) / 4 / 32**2, rtol=1e-9)


def test_figure_4_4_counts_the_printed_distances() -> None:
    """The highest value and the sum of the printed cells, added up by hand from the thesis."""
    data = columns("4.4")
    assert data["value"].max() == 7
    assert int((data["value"] > 0).sum()) == sum(row.count("#") for row in figure_4_4.SHAPE)
    eighth = data["value"][data["row"] == 8]
    assert eighth.tolist() == [int(digit) for digit in "00001234567654321000"]


def test_figure_4_5_is_one_at_the_edge_and_nothing_behind_the_line() -> None:
    data = columns("4.5")
    b, k, f = data["blocking_px"], data["separation"], data["attenuation"]
    assert (f[b == 0] == 1).all()
    assert (f[b >= 1 + 7 * k] == 0).all()
    assert (f[(b > 0) & (b < 1 + 7 * k)] < 1).all()


def test_figures_4_6_and_4_7_turn_the_order_round() -> None:
    for name in ("4.6", "4.7"):
        table = FIGURES[name].table(FIGURES[name].compute())
        speed = np.asarray(table["launch_speed_m_s"], dtype=float)
        count = len(speed) // 2
        assert list(np.argsort(-speed[:count])) == list(range(count))
        assert list(np.argsort(speed[count:])) == list(range(count))
    assert set(FIGURES["4.8"].table(FIGURES["4.8"].compute())["scene"]) == {"behind the wall"}
