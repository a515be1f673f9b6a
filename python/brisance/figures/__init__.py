"""The figures and tables of the thesis, recomputed through the engine.

``FIGURES`` holds them by the thesis's own number, in its order, and after them by name those that go on where
the thesis ends. Nothing that they show is typed in: the curves and cracks come from the engine, the bricks
and windows from the scenes in ``scenes/``.
"""

from __future__ import annotations

import difflib
from pathlib import Path
from typing import Any

from brisance.errors import InputError
from brisance.figures import (
    dispersal,
    figure_2_3,
    figure_2_4,
    figure_2_5,
    figure_2_6,
    figure_2_7,
    figure_2_8,
    figure_2_9,
    figure_2_10,
    figure_2_12,
    figure_2_13,
    figure_2_14,
    figure_2_15,
    figure_2_16,
    figure_3_1,
    figure_3_2,
    figure_3_3,
    figure_3_4,
    figure_3_5,
    figure_3_6,
    figure_3_7,
    figure_4_3,
    figure_4_4,
    figure_4_5,
    figure_4_6,
    figure_4_7,
    figure_4_8,
    figure_5_5,
    figure_5_10,
    figure_5_11,
    figure_5_12,
    figure_5_13,
    figure_5_14,
    figure_5_16,
    figure_6_1,
    figure_6_2,
    figure_6_3,
    figure_6_4,
    figure_6_5,
    figure_6_6,
    figure_window_fragments,
    figure_window_plume,
    table_2_1,
)
from brisance.figures.figure import Figure

_MODULES = (
    figure_2_3,
    figure_2_4,
    figure_2_5,
    figure_2_6,
    table_2_1,
    figure_2_7,
    figure_2_8,
    figure_2_9,
    figure_2_10,
    figure_2_12,
    figure_2_13,
    figure_2_14,
    figure_2_15,
    figure_2_16,
    figure_3_1,
    figure_3_2,
    figure_3_3,
    figure_3_4,
    figure_3_5,
    figure_3_6,
    figure_3_7,
    figure_4_3,
    figure_4_4,
    figure_4_5,
    figure_4_6,
    figure_4_7,
    figure_4_8,
    figure_5_5,
    figure_5_10,
    figure_5_11,
    figure_5_12,
    figure_5_13,
    figure_5_14,
    figure_5_16,
    figure_6_1,
    figure_6_2,
    figure_6_3,
    figure_6_4,
    figure_6_5,
    figure_6_6,
    figure_window_plume,
    figure_window_fragments,
    dispersal,
)

FIGURES: dict[str, Figure[Any]] = {module.FIGURE.name: module.FIGURE for module in _MODULES}
"""Every figure and table by the thesis's number, in the order of the thesis, then those by name."""


def build(name: str, folder: Path | str, *, size: tuple[int, int] | None = None) -> list[Path]:
    """Draw the figure called ``name`` into ``folder`` and return the paths written, the picture first.

    Raises :class:`InputError` for a name that is not in ``FIGURES``.
    """
    figure = FIGURES.get(name)
    if figure is None:
        near = difflib.get_close_matches(name, FIGURES, n=1, cutoff=0.5)
        hint = f"did you mean {near[0]}?" if near else f"there are {', '.join(FIGURES)}."
        raise InputError(f"There is no figure {name}: {hint}")
    return figure.build(folder, size=size)


__all__ = ["FIGURES", "Figure", "build"]
