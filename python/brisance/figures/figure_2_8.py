"""Figure 2.8: the pressure at a point as the wave passes: jump, decay, suction, and back to ambient."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from brisance.figures import example, style
from brisance.figures.figure import Figure, Table, whole

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Picture

ARROW = {"arrowstyle": "<->", "color": style.GREY, "linewidth": 0.9, "shrinkA": 0, "shrinkB": 0}


def compute() -> Table:
    """Overpressure [Pa], negative phase included, over time since the detonation."""
    at = example.point()
    jump = [at.arrival * (1.0 - 1e-12), at.arrival]
    times = np.sort(np.concatenate([np.linspace(0.0, at.arrival + 12.0 * at.duration, 4000), jump]))
    pressure = example.with_suction(at, times)
    over = times[np.nonzero(pressure)[0][-1]]
    shown = times <= 1.06 * over
    return {"time_s": times[shown], "overpressure_pa": pressure[shown]}


def draw(picture: Picture, data: Table) -> None:
    axes = picture.subplots()
    milliseconds = 1e3 * np.asarray(data["time_s"], dtype=float)
    kilopascals = np.asarray(data["overpressure_pa"], dtype=float) / 1e3
    axes.fill_between(
        milliseconds, kilopascals, where=kilopascals > 0.0, color=style.BLUE, alpha=0.12, linewidth=0
    )
    axes.fill_between(
        milliseconds, kilopascals, where=kilopascals < 0.0, color=style.ORANGE, alpha=0.15, linewidth=0
    )
    axes.axhline(0.0, color=style.GREY, linewidth=0.9)
    axes.plot(milliseconds, kilopascals, color=style.INK)
    annotate(axes, milliseconds, kilopascals)
    axes.set_title(example.WHAT)
    axes.set_xlabel("time since detonation [ms]")
    axes.set_ylabel("pressure above ambient [kPa]")
    axes.set_xlim(0.0, milliseconds[-1])
    axes.set_ylim(1.9 * kilopascals.min(), 1.12 * kilopascals.max())


def annotate(axes: Axes, milliseconds: NDArray[np.float64], kilopascals: NDArray[np.float64]) -> None:
    """Mark the peak, the arrival, the duration and the lowest pressure."""
    peak, lowest = int(np.argmax(kilopascals)), int(np.argmin(kilopascals))
    arrival, top = milliseconds[peak], kilopascals[peak]
    end = milliseconds[peak + int(np.argmax(kilopascals[peak:] <= 0.0))]
    low = 1.45 * kilopascals[lowest]
    for start, stop, label in ((0.0, arrival, "t$_a$"), (arrival, end, "T")):
        axes.annotate("", (start, low), xytext=(stop, low), arrowprops=ARROW)
        axes.text(0.5 * (start + stop), low, label, ha="center", va="center", backgroundcolor="white")
        axes.plot([stop, stop], [low * 1.1, 0.0], color=style.GREY, linewidth=0.8, linestyle=(0, (2, 2)))
    axes.annotate(f"p$_s$ = {top:.1f} kPa", (arrival, top), xytext=(8, -3), textcoords="offset points")
    axes.annotate(
        f"P$_{{min}}$ = −{-kilopascals[lowest]:.1f} kPa",
        (milliseconds[lowest], kilopascals[lowest]),
        xytext=(0, -15),
        textcoords="offset points",
        ha="center",
    )
    axes.text(milliseconds[0], 0.0, " ambient p$_0$", va="bottom", color=style.GREY)


FIGURE = Figure(
    name="2.8",
    title="Figure 2.8  Pressure as the wave passes",
    compute=compute,
    draw=draw,
    table=whole,
)
