"""Two blast curves over scaled distance in one picture, each with its own axis, as in Figures 3.1 and 3.2."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from brisance import _engine
from brisance.figures.figure import Table

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

Curve = tuple[NDArray[np.float64], str, str]
"""Values, label of their axis, colour."""


def scaled_curves(columns: Mapping[str, str]) -> Table:
    """Read curves of one kilogram of TNT in free air, for which distance is scaled distance.

    ``columns`` maps the engine's name of a curve to the name of its column here. Only the range that the
    source itself covers is kept.
    """
    distance = np.geomspace(0.05, 40.0, 500)
    curves = _engine.curves(mass=1.0, distance=distance)
    inside = np.asarray(curves["extension"]) == 0
    table = {"scaled_distance_m_kg13": distance[inside]}
    for key, column in columns.items():
        table[column] = np.asarray(curves[key])[inside]
    return table


def draw_pair(picture: Picture, scaled: NDArray[np.float64], *, left: Curve, right: Curve) -> None:
    """Draw two curves log–log over scaled distance [m/kg^(1/3)], one with its axis on either side."""
    from matplotlib.ticker import LogLocator, NullFormatter

    axes = picture.subplots()
    other = axes.twinx()
    for where, (values, label, colour), dashes in ((axes, left, "-"), (other, right, (0, (5, 2)))):
        where.loglog(scaled, values, color=colour, linestyle=dashes)
        where.set_ylabel(label, color=colour)
        where.tick_params(axis="y", which="both", labelcolor=colour)
        where.margins(x=0.0)
        where.yaxis.set_major_locator(LogLocator(subs=_marks(values)))
        where.yaxis.set_minor_formatter(NullFormatter())
        where.yaxis.set_major_formatter("{x:g}")
    other.grid(False)
    other.spines["right"].set_visible(True)
    axes.grid(True, which="minor", axis="x", linewidth=0.3)
    axes.set_title("spherical charge of TNT in free air at sea level")
    axes.set_xlabel("scaled distance Z [m/kg$^{1/3}$]")
    axes.xaxis.set_major_formatter("{x:g}")


def _marks(values: NDArray[np.float64]) -> tuple[float, ...]:
    """Multiples of each power of ten that carry a tick: more of them, the fewer decades there are."""
    decades = np.log10(np.nanmax(values) / np.nanmin(values))
    return (1.0, 2.0, 5.0) if decades < 2.5 else (1.0,)
