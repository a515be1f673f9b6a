"""Outlines from files: every kind gives the same rings, and what is no outline is refused in one sentence."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from brisance.errors import InputError
from brisance.outline import fit, read_outline

SQUARE = [[0, 0], [2, 0], [2, 1], [0, 1]]
HOLE = [[0.5, 0.25], [1, 0.25], [1, 0.75]]
SVG = '<svg xmlns="http://www.w3.org/2000/svg" {}>{}</svg>'


def read(folder: Path, name: str, text: str) -> list[NDArray[np.float64]]:
    """Write a file and read it as an outline."""
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return read_outline(path)


def area(ring: NDArray[np.float64]) -> float:
    """Area of a ring, whichever way it runs."""
    x, y = ring.T
    return abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1))) / 2


def test_points_and_lists_hold_metres_and_the_largest_ring_is_first(tmp_path: Path) -> None:
    lines = [*(f"{x}, {y}" for x, y in HOLE), "", *(f"{x},{y}" for x, y in SQUARE)]
    rings = read(tmp_path, "a.csv", "\n".join(["x,y", *lines, ""]))
    np.testing.assert_array_equal(rings[0], SQUARE)
    np.testing.assert_array_equal(rings[1], HOLE)
    rings = read(tmp_path, "a.json", json.dumps([HOLE, SQUARE]))
    np.testing.assert_array_equal(rings[0], SQUARE)
    np.testing.assert_array_equal(rings[1], HOLE)
    (alone,) = read(tmp_path, "b.json", json.dumps(SQUARE))
    np.testing.assert_array_equal(alone, SQUARE)


@pytest.mark.parametrize(
    "shape",
    [
        '<polygon points="0,0 200,0 200,100 0,100"/>',
        '<rect width="200" height="100"/>',
        '<path d="M0 0h200v100H0z"/>',
        '<path d="m 0,0 200,0 0,100 -200,0 Z"/>',
        '<path d="M0 0 L200 0 L200 100 L0 100 L0 0"/>',
        '<g transform="translate(10 20)"><rect x="-10" y="-20" width="200" height="100"/></g>',
        '<rect width="20" height="10" transform="scale(10)"/>',
        '<rect width="100" height="200" transform="translate(0,100) rotate(-90)"/>',
        '<path d="M0 0C50 0 150 0 200 0V100H0Z"/>',
        '<line x1="0" y1="0" x2="9" y2="9"/><path d="M0 0L5 5"/><rect width="200" height="100"/>',
    ],
)
def test_drawings_are_read_at_their_size_with_y_up(shape: str, tmp_path: Path) -> None:
    (ring,) = read(tmp_path, "a.svg", SVG.format('width="500mm" viewBox="0 0 500 500"', shape))
    np.testing.assert_allclose(ring.min(axis=0), [0, -0.1], atol=1e-12)
    np.testing.assert_allclose(ring.max(axis=0), [0.2, 0], atol=1e-12)
    assert area(ring) == pytest.approx(0.02, rel=1e-12)


def test_a_unit_without_a_name_is_a_96th_of_an_inch(tmp_path: Path) -> None:
    (ring,) = read(tmp_path, "a.svg", SVG.format("", '<rect width="96" height="192"/>'))
    np.testing.assert_allclose(np.ptp(ring, axis=0), [0.0254, 0.0508], rtol=1e-12)


# Inscribed polygons: with steps of angle a their area falls short by a² / 6, relatively.
@pytest.mark.parametrize(
    ("shape", "truth"),
    [
        ('<circle cx="3" cy="4" r="10"/>', math.pi * 100),
        ('<ellipse rx="10" ry="5"/>', math.pi * 50),
        ('<path d="M0 0A10 10 0 0 1 20 0Z"/>', math.pi * 50),
        ('<path d="M0 0a10 10 0 0 1 20 0z"/>', math.pi * 50),
        # A quarter of a circle, the near one and the far one.
        ('<path d="M0 0A10 10 0 0 1 10 10Z"/>', math.pi * 25 - 50),
        ('<path d="M0 0A10 10 0 1 1 10 10Z"/>', math.pi * 75 + 50),
        ('<path d="M0 0A10 10 0 1010 10Z"/>', math.pi * 75 + 50),
        # Radii that do not reach are grown until they do: a half circle again.
        ('<path d="M0 0A1 1 0 0 0 20 0Z"/>', math.pi * 50),
        # Half an ellipse, its longer axis along the chord, tilted by 90 degrees.
        ('<path d="M0 0A5 10 90 0 1 20 0Z"/>', math.pi * 25),
        # Under a parabola: two thirds of the box. T mirrors it to the other side.
        ('<path d="M0 0Q10 20 20 0Z"/>', 20 * 10 * 2 / 3),
        ('<path d="M0 0Q10 20 20 0T40 0V-10H0Z"/>', 400.0),
        # A circle of four cubics, as drawing programs write it: 2.7e-4 more than π r² at most.
        (
            '<path d="M10 0C10 5.523 5.523 10 0 10S-10 5.523 -10 0S-5.523 -10 0 -10S10 -5.523 10 0Z"/>',
            math.pi * 100,
        ),
    ],
)
def test_curves_enclose_what_they_should(shape: str, truth: float, tmp_path: Path) -> None:
    (ring,) = read(tmp_path, "a.svg", SVG.format('width="1m" viewBox="0 0 1 1"', shape))
    assert area(ring) == pytest.approx(truth, rel=5e-3)


def test_a_size_scales_an_outline() -> None:
    ring = np.array(SQUARE, dtype=float) + 5
    for width, height, size in ((4, None, (4, 2)), (None, 3, (6, 3)), (1, 1, (1, 1)), (None, None, (2, 1))):
        (scaled,) = fit([ring], width=width, height=height)
        np.testing.assert_allclose(np.ptp(scaled, axis=0), size, rtol=1e-12)
        np.testing.assert_allclose(scaled.min(axis=0), [5, 5], rtol=1e-12)


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("a.dxf", "", "give .csv, .json or .svg"),
        ("a.csv", "", "holds no outline"),
        ("a.csv", "0,0\n1,0\n", "fewer than three points"),
        ("a.csv", "0,0\n1,0\n1,one\n", "line 3: 1, one is not a point"),
        ("a.csv", "0,0,0\n1,0,0\n", "line 1: 0, 0, 0 is not a point"),
        ("a.csv", "0,0\n1,0\nnan,1\n", "not finite"),
        ("a.json", "[[0, 0]", "not valid JSON"),
        ("a.json", "{}", "must hold a list of rings"),
        ("a.json", "[]", "must hold a list of rings"),
        ("a.json", '[[[0, 0], [1, "a"], [1, 1]]]', "must hold a list of rings"),
        ("a.json", "[[[0, 0], [1], [1, 1]]]", "must hold a list of rings"),
        ("a.json", "[1, 2]", "must hold a list of rings"),
        ("a.svg", "<svg", "not valid SVG"),
        ("a.svg", "<html/>", "not SVG"),
        ("a.svg", SVG.format("", '<path d="M0 0L1 1"/>'), "holds no outline"),
        ("a.svg", SVG.format("", '<path d="M0 0L1Z"/>'), "cannot be read"),
        ("a.svg", SVG.format("", '<path d="L1 1Z"/>'), "must begin with M"),
        ("a.svg", SVG.format("", '<rect width="10%" height="2"/>'), "cannot be read"),
        ("a.svg", SVG.format("", '<g transform="bend(3)"><rect width="1" height="2"/></g>'), "bend"),
    ],
)
def test_what_is_no_outline_is_refused(name: str, text: str, said: str, tmp_path: Path) -> None:
    with pytest.raises(InputError) as caught:
        read(tmp_path, name, text)
    sentence = str(caught.value)
    assert said in sentence and name in sentence
    assert "\n" not in sentence and sentence.endswith(".")


def test_a_file_that_cannot_be_read_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="does not exist"):
        read_outline(tmp_path / "none.csv")
    (tmp_path / "folder.csv").mkdir()
    with pytest.raises(InputError, match="is a directory"):
        read_outline(tmp_path / "folder.csv")
    (tmp_path / "binary.csv").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(InputError, match="not text"):
        read_outline(tmp_path / "binary.csv")
