"""The thesis's figures of cracks and fragments: what they show has the properties that the thesis states."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from brisance import _engine
from brisance.figures import FIGURES, cracks, figure_6_2, figure_6_3, fragment
from brisance.pane import Fracture

Array = NDArray[np.float64]


def shown(name: str) -> Fracture:
    """The pattern that a figure shows."""
    broken = FIGURES[name].compute()
    assert isinstance(broken, Fracture)
    return broken


def directions(broken: Fracture) -> Array:
    """Direction of every crack [degrees], 0 to 180, whichever way it ran; to a millionth."""
    ends = broken.engine.crack_ends
    angle = np.degrees(np.arctan2(ends[:, 3] - ends[:, 1], ends[:, 2] - ends[:, 0]))
    return np.round(angle % 180.0, 6) % 180.0


def turned(points: Array, corners: Array) -> NDArray[np.bool_]:
    """Which points lie inside a polygon: a ray to the right crosses its sides an odd number of times."""
    (ax, ay), (bx, by) = corners.T, np.roll(corners, -1, axis=0).T
    x, y = points[:, 0, None], points[:, 1, None]
    spans = (ay > y) != (by > y)
    with np.errstate(divide="ignore", invalid="ignore"):
        crosses = spans & (x < ax + (bx - ax) * (y - ay) / (by - ay))
    return np.asarray(crosses.sum(axis=1) % 2 == 1)


def shoelace(corners: Array) -> Array:
    x, y = np.moveaxis(corners - corners[..., :1, :], -1, 0)
    return np.asarray(0.5 * (x * np.roll(y, -1, axis=-1) - y * np.roll(x, -1, axis=-1)).sum(axis=-1))


def test_figure_5_5_g_meets_every_multiple_of_r_at_that_multiple_of_a_c_and_the_crack_forks_there() -> None:
    data = FIGURES["5.5"].compute()
    for multiple in (1.0, 2.0, 3.0, 4.0):
        released = np.interp(multiple * data.critical_length, data.length, data.released)
        # G is straight, so reading between its samples is exact to rounding.
        assert released == pytest.approx(multiple * data.resistance, rel=1e-12)
    ends = data.tree.engine.crack_ends / data.critical_length
    tips = [np.count_nonzero((ends[:, 0] < x) & (ends[:, 2] > x)) for x in (1.5, 1.97, 2.03, 2.95, 3.05, 3.9)]
    assert tips == [1, 1, 2, 2, 3, 3]


@pytest.mark.parametrize("name", ["5.10", "5.11", "5.12", "5.13", "5.14"])
def test_the_patterns_have_hundreds_of_fragments_that_fill_the_pane(name: str) -> None:
    broken = shown(name)
    assert 200 < len(broken.polygons) < 1000
    assert broken.solids.area_m2.sum() == pytest.approx(1.0, rel=1e-9)


def test_figure_5_10_runs_in_few_directions_and_5_12_in_many() -> None:
    base, varied = directions(shown("5.10")), directions(shown("5.12"))
    # Forks of 25° turn by 12.5° to either side: every direction is a multiple of that.
    off = [np.abs(angle / 12.5 - np.rint(angle / 12.5)) for angle in (base, 180.0 - base)]
    assert np.minimum(*off).max() < 1e-6
    assert len(np.unique(base)) <= 2 * 15
    assert len(np.unique(varied)) > 10 * len(np.unique(base))


def test_figure_5_11_has_rounder_fragments_than_5_10() -> None:
    narrow, wide = (np.median(shown(name).solids.aspect_ratio) for name in ("5.10", "5.11"))
    assert narrow > 1.2 * wide


def test_straight_cracks_leave_simple_fragments_and_wiggling_ones_do_not() -> None:
    for name in ("5.10", "5.11", "5.12"):
        broken = shown(name)
        # The thesis: "most fragments are defined by no more than six vertices". Where a neighbour's corner
        # meets a straight side there is a vertex, but not one that defines the fragment.
        defining = [np.count_nonzero(np.abs(bends(rings[0])) > 1e-6) for rings in broken.polygons]
        assert np.mean(np.array(defining) <= 6) > 0.5
    for name in ("5.13", "5.14"):
        assert np.median(cracks.vertices_per_fragment(shown(name))) > 40


def bends(ring: Array) -> Array:
    """By how much an outline turns at each corner [rad]."""
    step = np.roll(ring, -1, axis=0) - ring
    before = np.roll(step, 1, axis=0)
    cross = before[:, 0] * step[:, 1] - before[:, 1] * step[:, 0]
    return np.asarray(np.arctan2(cross, (before * step).sum(axis=1)))


def test_figure_5_14_has_the_thesis_s_counts() -> None:
    broken = shown("5.14")
    count, vertices = len(broken.polygons), cracks.vertices_per_fragment(broken)
    # A polygon of n corners makes n - 2 triangles: 21 459 vertices and 20 917 triangles are 271 fragments.
    assert count == pytest.approx(271, rel=0.05)
    assert vertices.sum() == pytest.approx(21_459, rel=0.05)
    assert cracks.branching_vertices(broken) == pytest.approx(1_447, rel=0.05)
    assert vertices.min() == 3
    assert 200 < vertices.max() < 350
    # Every vertex is a part of two or three fragments, the outside of the pane taken as one.
    assert set(np.unique(cracks.uses(broken))) == {2, 3}


def test_figure_5_14_has_a_wide_range_of_sizes_and_concave_fragments() -> None:
    broken = shown("5.14")
    area = np.sort(broken.solids.area_m2)
    assert area[-1] / np.median(area) > 20
    # Continuous: between the twentieth and the largest, each is at most three times the one before.
    assert np.max(area[20:-1] / area[19:-2]) < 3
    concave = [np.any(bends(rings[0]) < -1e-6) for rings in broken.polygons]
    assert np.mean(concave) > 0.5


def test_figure_5_16_leaves_the_pane_whole_and_ends_inside_it() -> None:
    broken = shown("5.16")
    assert len(broken.polygons) == 1
    assert broken.solids.area_m2[0] == pytest.approx(1.0, rel=1e-12)
    ends = broken.engine.crack_ends.reshape(-1, 2)
    assert ends.min() > 0.02
    assert ends.max() < 0.98
    assert np.ptp(ends[:, 0]) > 0.6
    # A directed pattern over a part of the surface: several branches, and longer one way than the other.
    assert len(np.unique(broken.engine.crack_tips)) >= 6
    assert np.ptp(ends[:, 0]) > 1.5 * np.ptp(ends[:, 1])


def test_figure_6_1_fills_the_fragment_with_triangles() -> None:
    one = FIGURES["6.1"].compute()
    areas = shoelace(one.triangles)
    assert areas.min() > 0.0
    # Rounding of some hundred sums.
    assert areas.sum() == pytest.approx(one.area, rel=1e-12)
    assert one.area == pytest.approx(float(shoelace(one.outline)), rel=1e-12)
    assert len(one.triangles) == len(one.outline) - 2
    assert np.sqrt(np.divide(*np.linalg.eigvalsh(one.moments)[::-1])) >= fragment.LONG


def test_figure_6_2_samples_both_sides_and_both_ends() -> None:
    one = FIGURES["6.2"].compute()
    areas = one.panels[:, 2]
    assert len(areas) >= 5
    assert areas.sum() == pytest.approx(one.area, rel=1e-12)
    along, across = one.axes @ one.panels[:, :2].T
    for part in (along, across):
        assert part.min() < 0.0 < part.max()


def test_figure_6_2_colours_the_part_that_each_panel_stands_for() -> None:
    one = FIGURES["6.2"].compute()
    low, high = one.outline.min(axis=0), one.outline.max(axis=0)
    points = low + (high - low) * (np.indices((600, 600)).reshape(2, -1).T + 0.5) / 600
    points = points[turned(points, one.outline)]
    each = float(np.prod((high - low) / 600))
    for cell, (x, y, area) in zip(figure_6_2.cells(one), one.panels, strict=True):
        inside = points[turned(points, cell)]
        # A grid of 600 by 600 misses at most the cells on the edge: about a hundredth of the smallest part.
        assert len(inside) * each == pytest.approx(area, rel=0.03)
        assert inside.mean(axis=0) == pytest.approx([x, y], abs=0.005 * float((high - low).max()))


def integrals(section: figure_6_3.Section) -> dict[str, float]:
    """The thesis's closed forms over one half: area, (6.9), (6.10), and as corrected the parts of (6.2)–(6.5)
    in the plane, for a density and thickness of one."""
    (mu, bu), (ml, bl) = section.upper, section.lower
    x1, x2, x3, x4 = ((section.right**n - section.left**n) / n for n in (1, 2, 3, 4))
    return {
        "area": (mu - ml) * x2 + (bu - bl) * x1,
        "x": (mu - ml) * x3 + (bu - bl) * x2,
        "y": 0.5 * ((mu**2 - ml**2) * x3 + 2 * (mu * bu - ml * bl) * x2 + (bu**2 - bl**2) * x1),
        "yy": (
            (mu**3 - ml**3) * x4
            + 3 * (mu**2 * bu - ml**2 * bl) * x3
            + 3 * (mu * bu**2 - ml * bl**2) * x2
            + (bu**3 - bl**3) * x1
        )
        / 3,
        "xx": (mu - ml) * x4 + (bu - bl) * x3,
        "xy": 0.5 * ((mu**2 - ml**2) * x4 + 2 * (mu * bu - ml * bl) * x3 + (bu**2 - bl**2) * x2),
    }


def test_figure_6_3_halves_give_the_triangle_s_inertia() -> None:
    data = FIGURES["6.3"].compute()
    left, right = data.sections
    assert left.left < left.right == right.left < right.right
    halves = [integrals(section) for section in data.sections]
    total = {key: halves[0][key] + halves[1][key] for key in halves[0]}
    corners = data.corners if shoelace(data.corners) > 0.0 else data.corners[::-1]
    thickness = 0.006
    vertices = np.array([(*p, z) for z in (0.5 * thickness, -0.5 * thickness) for p in corners])
    faces = [(0, 1, 2), (5, 4, 3)]
    for a, b in ((0, 1), (1, 2), (2, 0)):
        faces += [(a, a + 3, b), (b, a + 3, b + 3)]
    solid = _engine.mass_properties(vertices=vertices, triangles=np.array(faces))
    assert total["area"] == pytest.approx(solid["volume_m3"] / thickness, rel=1e-9)
    centre = np.array([total["x"], total["y"]]) / total["area"]
    assert centre == pytest.approx(data.corners.mean(axis=0), rel=1e-9)
    # The mesh's inertia is about its own centre and the closed forms about the fragment's: the difference of
    # large squares costs some five digits.
    area, through = total["area"], total["area"] * thickness**2 / 12
    expected = {
        (0, 0): total["yy"] - area * centre[1] ** 2 + through,
        (1, 1): total["xx"] - area * centre[0] ** 2 + through,
        (0, 1): -(total["xy"] - area * centre[0] * centre[1]),
    }
    inertia = np.asarray(solid["inertia_per_density"]) / thickness
    for (row, column), value in expected.items():
        assert inertia[row, column] == pytest.approx(value, rel=1e-6)


def test_a_triangle_with_a_vertical_side_has_one_half_without_width() -> None:
    data = figure_6_3.divide(np.array([[0.0, 0.0], [0.0, 2.0], [3.0, 1.0]]))
    assert sum(integrals(section)["area"] for section in data.sections) == pytest.approx(3.0, rel=1e-12)
