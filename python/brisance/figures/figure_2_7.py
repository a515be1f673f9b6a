"""Figure 2.7: three closed formulas for the peak overpressure, and our hydrocode, against the curves fitted
to experiments.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from brisance import _engine
from brisance.figures import style
from brisance.figures.figure import Figure, Table, whole

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

MEASURED = "kingery-bulmash"
FORMULAS = {
    "brode": ("Brode", style.ORANGE, "-"),
    "henrych": ("Henrych", style.BLUE, (0, (5, 2))),
    "kinney-graham": ("Kinney–Graham", style.GREEN, (0, (1.2, 1.6))),
    "hydrocode": ("our hydrocode", style.PURPLE, "-"),
}


def compute() -> Table:
    """Overpressure [Pa] of each source over scaled distance, empty where the source itself does not reach."""
    scaled = np.geomspace(0.05, 40.0, 400)
    table = {"scaled_distance_m_kg13": scaled}
    for source in (MEASURED, *FORMULAS):
        curve = _engine.curves(mass=1.0, distance=scaled, source=source)
        inside = np.asarray(curve["extension"]) == 0
        table[f"overpressure_pa:{source}"] = np.where(inside, curve["overpressure_pa"], np.nan)
    return table


def draw(picture: Picture, data: Table) -> None:
    above, below = picture.subplots(2, 1, sharex=True, height_ratios=(2.4, 1.0))
    scaled = np.asarray(data["scaled_distance_m_kg13"], dtype=float)
    measured = np.asarray(data[f"overpressure_pa:{MEASURED}"], dtype=float)
    above.loglog(scaled, measured / 1e3, color=style.INK, linewidth=3.2, alpha=0.35)
    above.plot([], [], color=style.INK, linewidth=3.2, alpha=0.35, label="experiments (Kingery–Bulmash)")
    below.axhline(1.0, color=style.INK, linewidth=3.2, alpha=0.35)
    for source, (label, colour, dashes) in FORMULAS.items():
        overpressure = np.asarray(data[f"overpressure_pa:{source}"], dtype=float)
        look = {"color": colour, "linestyle": dashes}
        above.loglog(scaled, overpressure / 1e3, label=label, **look)
        below.semilogx(scaled, overpressure / measured, **look)
    above.set_ylabel("peak overpressure [kPa]")
    above.legend()
    below.set_ylabel("over experiment")
    below.set_ylim(0.4, 2.1)
    below.set_xlabel("scaled distance Z [m/kg$^{1/3}$]")
    below.set_xlim(0.05, 40.0)
    below.xaxis.set_major_formatter("{x:g}")


FIGURE = Figure(
    name="2.7",
    title="Figure 2.7  Formulas for the peak overpressure",
    compute=compute,
    draw=draw,
    table=whole,
)
