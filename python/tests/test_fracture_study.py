"""docs/fracture.md shows what its script computes."""

from __future__ import annotations

import importlib
import re
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

import brisance as br

DOCS = Path(__file__).resolve().parents[2] / "docs"
PAGE = (DOCS / "fracture.md").read_text(encoding="utf-8")


@pytest.fixture
def measures(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    monkeypatch.syspath_prepend(str(DOCS / "study"))
    return importlib.import_module("fracture_measures")


def test_the_tables_of_the_page_are_those_that_the_script_prints(measures: ModuleType) -> None:
    for table in measures.tables():
        assert "\n".join(table) in PAGE


def test_the_pictures_of_the_page_exist_and_are_small() -> None:
    shown = re.findall(r"!\[[^]]*\]\(([^)]+)\)", PAGE)
    assert len(shown) == 6
    for name in shown:
        assert (DOCS / name).stat().st_size < 300_000


def test_a_square_of_dice_counts_whole_ones_and_half_of_those_across_its_edge(measures: ModuleType) -> None:
    class Mosaic:
        """Equal squares of 10 mm that start at the pane's corner."""

        polygons = tuple(
            [0.01 * np.array([(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)], dtype=float)]
            for i in range(50)
            for j in range(50)
        )

    counts = measures.dice_counts(Mosaic(), 0.5)
    # From 25 mm on, a square of 50 mm holds 4 by 4 whole and cuts 6 by 6 less those: 20.
    assert set(counts) == {16 + 0.5 * 20}


def test_fork_angles_are_read_off_a_pattern_as_they_were_asked_for(measures: ModuleType) -> None:
    pattern = br.Pattern(
        literal=True,
        shape="segment",
        critical_length=0.01,
        fork_angle=30,
        fork_variance=0,
        wiggle_probability=0,
    )
    angles = measures.fork_angles(br.fracture(pattern))
    assert len(angles) > 50
    assert np.allclose(angles, 30.0, atol=1e-6)


def test_the_slope_of_a_power_law_is_its_exponent(measures: ModuleType) -> None:
    share = (np.arange(100_000) + 0.5) / 100_000
    # Half of what is larger than a is larger than 4 a: slope -1/2, from the smallest area on.
    assert measures.slope(1e-3 * share**-2) == pytest.approx(-0.5, abs=0.01)
