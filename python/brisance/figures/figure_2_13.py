"""Figure 2.13: the pressure on the front, the side and the rear of a box as the wave passes over it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from brisance.figures import example, style
from brisance.figures.figure import Figure, Table, whole

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

HALF_WIDTH = 0.5
"""From the middle of the front and the rear to their edges: the clearing length S [m]."""
DEPTH = 1.0
"""From front to rear [m]."""
FACES: dict[example.Face, tuple[float, str]] = {
    "front": (0.0, style.BLUE),
    "side": (0.5 * DEPTH, style.GREEN),
    "rear": (DEPTH, style.ORANGE),
}
"""Distance behind the front [m] and colour."""


def compute() -> Table:
    """Overpressure [Pa] in the middle of each face over time since the detonation."""
    at = example.point()
    start, end = at.arrival, at.arrival + at.duration
    clearing = np.linspace(0.0, 8.0 * HALF_WIDTH / at.front_velocity, 400)
    times = np.unique(np.concatenate([np.linspace(start - 1e-3, end + 4e-3, 500), start + clearing]))
    table = {"time_s": times}
    for face, (behind, _) in FACES.items():
        table[f"overpressure_pa:{face}"] = example.face(
            face, distance=at.distance + behind, times=times, clearing_length=HALF_WIDTH
        )
    return table


def draw(picture: Picture, data: Table) -> None:
    panels = picture.subplots(3, 1, sharex=True, sharey=True)
    milliseconds = 1e3 * np.asarray(data["time_s"], dtype=float)
    for axes, (face, (_, colour)) in zip(panels, FACES.items(), strict=True):
        kilopascals = np.asarray(data[f"overpressure_pa:{face}"], dtype=float) / 1e3
        axes.fill_between(milliseconds, kilopascals, color=colour, alpha=0.12, linewidth=0)
        axes.plot(milliseconds, kilopascals, color=colour)
        axes.text(0.985, 0.86, face, transform=axes.transAxes, ha="right", color=colour, weight="bold")
    panels[0].set_title(
        f"a box {DEPTH:g} m deep and {2.0 * HALF_WIDTH:g} m wide and high, "
        f"its front {example.DISTANCE:.0f} m from {example.MASS:.0f} kg of TNT in free air"
    )
    panels[0].set_ylim(bottom=0.0)
    panels[0].set_xlim(milliseconds[0], milliseconds[-1])
    panels[1].set_ylabel("overpressure [kPa]")
    panels[2].set_xlabel("time since detonation [ms]")


FIGURE = Figure(
    name="2.13",
    title="Figure 2.13  Loading of front, side and rear",
    compute=compute,
    draw=draw,
    table=whole,
    size=(1200, 1000),
)
