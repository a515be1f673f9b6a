"""Figure 2.14: resistance over displacement of a structure that yields, from its computed response."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from brisance import _engine
from brisance.figures import style
from brisance.figures.figure import Figure, Table, whole

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

STRUCTURE: dict[str, Any] = {"mass": 1000.0, "stiffness": 4e6, "yield_resistance": 1e5, "damping": 3000.0}
LOAD: dict[str, Any] = {"peak_force": 3e5, "duration": 0.02}
"""A mass of a tonne on a spring that yields at 25 mm, and a triangular pulse."""


def compute() -> Table:
    """Time [s], displacement [m] and resistance [N] of the response."""
    response = _engine.structure_response(**STRUCTURE, **LOAD, step=2e-5, end=0.3)
    every = slice(None, None, 10)
    keys = ("time_s", "displacement_m", "resistance_n")
    return {key: np.asarray(response[key])[every] for key in keys}


def draw(picture: Picture, data: Table) -> None:
    axes = picture.subplots()
    column = {key: np.asarray(values, dtype=float) for key, values in data.items()}
    millimetres, kilonewtons = 1e3 * column["displacement_m"], 1e-3 * column["resistance_n"]
    top = int(np.argmax(millimetres))
    axes.plot(millimetres[: top + 1], kilonewtons[: top + 1], color=style.BLUE, label="pushed out")
    axes.plot(millimetres[top:], kilonewtons[top:], color=style.ORANGE, label="springing back and swinging")
    strength = 1e-3 * STRUCTURE["yield_resistance"]
    elastic = 1e3 * STRUCTURE["yield_resistance"] / STRUCTURE["stiffness"]
    axes.fill_between(
        millimetres[: top + 1], kilonewtons[: top + 1], color=style.BLUE, alpha=0.08, linewidth=0
    )
    for x, label in ((elastic, "$x_{el}$"), (millimetres[top], "$x_{max}$")):
        axes.plot([x, x], [0.0, strength], color=style.GREY, linewidth=0.8, linestyle=(0, (4, 3)))
        axes.annotate(label, (x, 0.0), xytext=(5, -14), textcoords="offset points")
    axes.axhline(0.0, color=style.GREY, linewidth=0.8)
    axes.annotate("$R_{max}$", (0.0, strength), xytext=(4, 4), textcoords="offset points")
    axes.set_xlim(-0.05 * millimetres[top], 1.12 * millimetres[top])
    axes.set_title("1000 kg, 4 MN/m, yields at 100 kN; 300 kN falling to nothing in 20 ms")
    axes.set_xlabel("displacement [mm]")
    axes.set_ylabel("resistance [kN]")
    axes.legend(loc="lower right")


FIGURE = Figure(
    name="2.14",
    title="Figure 2.14  Resistance and displacement",
    compute=compute,
    draw=draw,
    table=whole,
)
