"""Figure 3.2: velocity of the front and dynamic pressure over scaled distance."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from brisance.figures import style
from brisance.figures.blast_curves import draw_pair, scaled_curves
from brisance.figures.figure import Figure, Table, whole

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture


def compute() -> Table:
    """Front velocity [m/s] and peak dynamic pressure [Pa] of TNT in free air."""
    return scaled_curves(
        {"front_velocity_m_s": "front_velocity_m_s", "dynamic_pressure_pa": "dynamic_pressure_pa"}
    )


def draw(picture: Picture, data: Table) -> None:
    draw_pair(
        picture,
        np.asarray(data["scaled_distance_m_kg13"], dtype=float),
        left=(np.asarray(data["front_velocity_m_s"], dtype=float), "front velocity U [m/s]", style.BLUE),
        right=(
            np.asarray(data["dynamic_pressure_pa"], dtype=float) / 1e3,
            "peak dynamic pressure q$_s$ [kPa]",
            style.ORANGE,
        ),
    )


FIGURE = Figure(
    name="3.2",
    title="Figure 3.2  Blast curves: front velocity and dynamic pressure",
    compute=compute,
    draw=draw,
    table=whole,
)
