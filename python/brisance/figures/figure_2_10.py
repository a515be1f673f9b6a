"""Figure 2.10: the pulse at four distances, weaker, later and longer the farther out."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from brisance import _engine
from brisance.figures import example, style
from brisance.figures.figure import Figure, Table, whole

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

RADII = (10.0, 15.0, 20.0, 30.0)
"""Distances from the charge [m]."""


def compute() -> Table:
    """Overpressure [Pa] at each radius over time since the detonation, and that of the front itself."""
    points = [example.point(radius) for radius in RADII]
    end = max(at.arrival + at.duration for at in points)
    start = 0.9 * min(at.arrival for at in points)
    # Each arrival is sampled on both sides, so that the jump stays a jump.
    jumps = [at.arrival * side for at in points for side in (1.0 - 1e-12, 1.0)]
    times = np.sort(np.concatenate([np.linspace(start, 1.02 * end, 600), jumps]))
    table = {"time_s": times}
    for at in points:
        table[f"overpressure_pa:{at.distance:g}_m"] = example.incident(at, times - at.arrival)
    radius = np.asarray(_engine.front_radius(mass=example.MASS, times=times))
    table["overpressure_pa:front"] = example.curves(radius)["overpressure_pa"]
    return table


def draw(picture: Picture, data: Table) -> None:
    axes = picture.subplots()
    milliseconds = 1e3 * np.asarray(data["time_s"], dtype=float)
    front = np.asarray(data["overpressure_pa:front"], dtype=float) / 1e3
    axes.plot(milliseconds, front, color=style.GREY, linewidth=0.9, linestyle=(0, (4, 3)))
    for radius, colour in zip(RADII, style.CYCLE, strict=False):
        kilopascals = np.asarray(data[f"overpressure_pa:{radius:g}_m"], dtype=float) / 1e3
        peak = int(np.argmax(kilopascals))
        end = peak + int(np.argmin(kilopascals[peak:]))
        part = slice(peak - 1, end + 1)
        axes.plot(milliseconds[part], kilopascals[part], color=colour)
        axes.annotate(
            f"{radius:g} m",
            (milliseconds[peak], kilopascals[peak]),
            xytext=(5, 2),
            textcoords="offset points",
            color=colour,
            weight="bold",
        )
        if radius == RADII[0]:
            axes.set_ylim(0.0, 1.15 * kilopascals[peak])
    axes.set_title(f"{example.MASS:.0f} kg of TNT in free air; dashed: at the front as it runs outward")
    axes.set_xlabel("time since detonation [ms]")
    axes.set_ylabel("overpressure [kPa]")
    axes.set_xlim(0.0, milliseconds[-1])


FIGURE = Figure(
    name="2.10",
    title="Figure 2.10  The pulse at four distances",
    compute=compute,
    draw=draw,
    table=whole,
)
