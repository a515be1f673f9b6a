"""Figure 3.3: the chart of reflection coefficients, one curve a static overpressure."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from brisance import _engine
from brisance.figures.figure import Figure, Table, whole

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

BAR = 1e5
"""Pascals in the unit that the chart's curves are labelled with."""


def compute() -> Table:
    """Reflection coefficient over the angle of incidence, a column for each pressure of the chart."""
    chart = _engine.reflection_chart()
    table = {"angle_deg": np.asarray(chart["angle_deg"])}
    for pressure, row in zip(chart["overpressure_pa"], chart["coefficient"], strict=True):
        table[f"coefficient:{pressure / BAR:.3g}_bar"] = np.asarray(row)
    return table


def draw(picture: Picture, data: Table) -> None:
    import matplotlib

    axes = picture.subplots()
    angle = np.asarray(data["angle_deg"], dtype=float)
    curves = [(name.split(":")[1], np.asarray(data[name], dtype=float)) for name in data if ":" in name]
    colours = matplotlib.colormaps["viridis"](np.linspace(0.0, 0.8, len(curves)))
    for (_, coefficient), colour in zip(curves, colours, strict=True):
        axes.plot(angle, coefficient, color=colour, linewidth=1.3)
    starts = np.array([coefficient[0] for _, coefficient in curves])
    for (name, coefficient), colour, height in zip(curves, colours, spread(starts, 0.36), strict=True):
        axes.annotate(
            name.removesuffix("_bar"),
            (0.0, coefficient[0]),
            xytext=(-5.0, height),
            textcoords="data",
            color=colour,
            fontsize=7.5,
            va="center",
            ha="right",
            arrowprops={"arrowstyle": "-", "color": colour, "linewidth": 0.6, "shrinkA": 1, "shrinkB": 0},
        )
    axes.set_title("on each curve: the peak static overpressure [bar]")
    axes.set_xlabel("angle of incidence [°]   (0: head-on, 90: grazing)")
    axes.set_ylabel("reflection coefficient C$_R$")
    axes.set_xlim(-13.0, 90.0)
    axes.set_xticks(range(0, 91, 15))
    axes.set_ylim(0.0, 1.06 * starts.max())


def spread(heights: NDArray[np.float64], gap: float) -> NDArray[np.float64]:
    """Move rising ``heights`` apart to at least ``gap``, as little as that takes."""
    order = np.argsort(heights)
    placed = heights[order].astype(float)
    for _ in range(200):
        overlap = gap - np.diff(placed)
        if (overlap <= 1e-6).all():
            break
        push = 0.5 * np.clip(overlap, 0.0, None)
        placed[:-1] -= push
        placed[1:] += push
        placed += max(0.0, 0.25 - placed[0])
    result = np.empty_like(placed)
    result[order] = placed
    return result


FIGURE = Figure(
    name="3.3",
    title="Figure 3.3  Reflection coefficient",
    compute=compute,
    draw=draw,
    table=whole,
    size=(1200, 960),
)
