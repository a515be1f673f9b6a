"""Figure 2.12: the reflection coefficient over the angle of incidence, at three pressures."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from brisance import _engine
from brisance.figures import style
from brisance.figures.figure import Figure, Table, whole

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

PRESSURES = (10e3, 100e3, 1000e3)
"""Peak static overpressures [Pa]."""


def compute() -> Table:
    """Reflection coefficient at each pressure, over the angle between the wave's path and the normal."""
    angle = np.linspace(0.0, 90.0, 361)
    table = {"angle_deg": angle}
    for pressure in PRESSURES:
        coefficient = _engine.reflection_coefficient(
            angle_deg=angle, overpressure=np.full_like(angle, pressure)
        )
        table[f"coefficient:{pressure:g}_pa"] = np.asarray(coefficient)
    return table


def draw(picture: Picture, data: Table) -> None:
    axes = picture.subplots()
    angle = np.asarray(data["angle_deg"], dtype=float)
    for pressure, colour in zip(PRESSURES, style.CYCLE, strict=False):
        coefficient = np.asarray(data[f"coefficient:{pressure:g}_pa"], dtype=float)
        axes.plot(angle, coefficient, color=colour)
        axes.annotate(
            f"{pressure / 1e3:g} kPa",
            (0.0, coefficient[0]),
            xytext=(5, 5),
            textcoords="offset points",
            color=colour,
            weight="bold",
        )
    axes.axhline(1.0, color=style.GREY, linewidth=0.9, linestyle=(0, (4, 3)))
    axes.set_xlabel("angle of incidence [°]   (0: head-on, 90: grazing)")
    axes.set_ylabel("reflection coefficient C$_R$")
    axes.set_xlim(0.0, 90.0)
    axes.set_xticks(range(0, 91, 15))
    axes.set_ylim(
        0.0, 1.08 * max(float(np.asarray(data[name], dtype=float).max()) for name in data if ":" in name)
    )


FIGURE = Figure(
    name="2.12",
    title="Figure 2.12  Reflection depends on angle and pressure",
    compute=compute,
    draw=draw,
    table=whole,
)
