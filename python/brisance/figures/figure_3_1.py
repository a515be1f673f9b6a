"""Figure 3.1: static overpressure and scaled duration of the positive phase over scaled distance."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from brisance.figures import style
from brisance.figures.blast_curves import draw_pair, scaled_curves
from brisance.figures.figure import Figure, Table, whole

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture


def compute() -> Table:
    """Overpressure [Pa] and duration [s/kg^(1/3)] of TNT in free air."""
    return scaled_curves({"overpressure_pa": "overpressure_pa", "duration_s": "duration_s_kg13"})


def draw(picture: Picture, data: Table) -> None:
    draw_pair(
        picture,
        np.asarray(data["scaled_distance_m_kg13"], dtype=float),
        left=(
            np.asarray(data["overpressure_pa"], dtype=float) / 1e3,
            "peak overpressure p$_s$ [kPa]",
            style.BLUE,
        ),
        right=(
            1e3 * np.asarray(data["duration_s_kg13"], dtype=float),
            "scaled duration T/W$^{1/3}$ [ms/kg$^{1/3}$]",
            style.ORANGE,
        ),
    )


FIGURE = Figure(
    name="3.1",
    title="Figure 3.1  Blast curves: overpressure and duration",
    compute=compute,
    draw=draw,
    table=whole,
)
