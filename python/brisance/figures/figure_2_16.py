"""Figure 2.16: the pressure that moves a small object: reflection, cleared into drag."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from brisance.figures import example, style
from brisance.figures.figure import Figure, Table, whole

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

CLEARING_LENGTH = 0.5
"""From the middle of the object's front to its edge [m]."""
DRAG_COEFFICIENT = 1.05
"""Of a cube."""


def compute() -> Table:
    """Net overpressure [Pa] on the front of an engulfed object over time since the front's arrival."""
    at = example.point()
    clearing = np.linspace(0.0, 6.0 * CLEARING_LENGTH / at.front_velocity, 300)
    times = np.unique(np.concatenate([np.linspace(0.0, 1.02 * at.duration, 500), clearing]))
    pressure = example.face(
        "front",
        distance=at.distance,
        times=at.arrival + times,
        mode="translational",
        clearing_length=CLEARING_LENGTH,
        drag_coefficient=DRAG_COEFFICIENT,
    )
    return {"time_s": times, "overpressure_pa": pressure}


def draw(picture: Picture, data: Table) -> None:
    axes = picture.subplots()
    at = example.point()
    milliseconds = 1e3 * np.asarray(data["time_s"], dtype=float)
    kilopascals = np.asarray(data["overpressure_pa"], dtype=float) / 1e3
    cleared = 1e3 * 3.0 * CLEARING_LENGTH / at.front_velocity
    axes.fill_between(milliseconds, kilopascals, color=style.BLUE, alpha=0.12, linewidth=0)
    axes.plot(milliseconds, kilopascals, color=style.BLUE)
    axes.axvline(cleared, color=style.GREY, linewidth=0.9, linestyle=(0, (4, 3)))
    axes.annotate(
        "reflected pressure p$_r$",
        (milliseconds[0], kilopascals[0]),
        xytext=(10, -2),
        textcoords="offset points",
    )
    axes.text(
        cleared, 0.62 * kilopascals.max(), f"  cleared at t′ = 3S/U$_s$ = {cleared:.1f} ms", color=style.GREY
    )
    drag = int(np.searchsorted(milliseconds, 1.5 * cleared))
    axes.annotate(
        "drag C$_D$ q(t)",
        (milliseconds[drag], kilopascals[drag]),
        xytext=(24, 34),
        textcoords="offset points",
        arrowprops={"arrowstyle": "-", "color": style.GREY, "linewidth": 0.8},
    )
    axes.set_title(f"{example.WHAT}; S = {CLEARING_LENGTH:g} m, C$_D$ = {DRAG_COEFFICIENT:g}")
    axes.set_xlabel("time since arrival [ms]")
    axes.set_ylabel("net pressure [kPa]")
    axes.set_xlim(0.0, milliseconds[-1])
    axes.set_ylim(0.0, 1.08 * kilopascals.max())


FIGURE = Figure(
    name="2.16",
    title="Figure 2.16  The pressure that moves an object",
    compute=compute,
    draw=draw,
    table=whole,
)
