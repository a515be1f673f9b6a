"""Figure 2.15: a pressure–impulse diagram, with a charge at several distances placed on it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from brisance import _engine
from brisance.figures import style
from brisance.figures.figure import Figure, Table, whole

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

WALL: dict[str, float] = {"mass": 200.0, "stiffness": 4e5, "yield_resistance": 5e3}
"""A square metre of a wall: 200 kg, yielding at 5 kPa and 12.5 mm."""

LIMITS = {"elastic: 12.5 mm": 0.0125, "plastic: 100 mm": 0.1}
CHARGE = 100.0
DISTANCES = (10.0, 15.0, 20.0, 30.0, 50.0, 80.0, 120.0)


def compute() -> Table:
    """Peak pressure [Pa] and impulse [Pa s] of each threshold, and of the charge at each distance."""
    table: dict[str, Any] = {}
    for index, limit in enumerate(LIMITS.values()):
        drawn = _engine.pressure_impulse(
            **WALL, limit=limit, pulse="friedlander", decay=1.0, shortest=0.02, longest=200.0, points=61
        )
        name = ("elastic", "plastic")[index]
        table[f"impulse_pa_s:{name}"] = drawn["impulse_n_s"]
        table[f"pressure_pa:{name}"] = drawn["force_n"]
        table[f"pressure_asymptote_pa:{name}"] = np.full(61, drawn["force_asymptote_n"])
        table[f"impulse_asymptote_pa_s:{name}"] = np.full(61, drawn["impulse_asymptote_n_s"])
    charge = _engine.curves(mass=CHARGE, distance=np.array(DISTANCES))
    for key, name in (("reflected_impulse_pa_s", "impulse_pa_s"), ("reflected_pressure_pa", "pressure_pa")):
        table[f"{name}:charge"] = np.concatenate([charge[key], np.full(61 - len(DISTANCES), np.nan)])
    return table


def draw(picture: Picture, data: Table) -> None:
    axes = picture.subplots()
    column = {key: np.asarray(values, dtype=float) for key, values in data.items()}
    for name, label, colour in zip(("elastic", "plastic"), LIMITS, (style.BLUE, style.ORANGE), strict=True):
        impulse, pressure = column[f"impulse_pa_s:{name}"], 1e-3 * column[f"pressure_pa:{name}"]
        axes.loglog(impulse, pressure, color=colour, label=label)
        look: dict[str, Any] = {"color": colour, "linewidth": 0.9, "linestyle": (0, (4, 3))}
        axes.axvline(column[f"impulse_asymptote_pa_s:{name}"][0], **look)
        axes.axhline(1e-3 * column[f"pressure_asymptote_pa:{name}"][0], **look)
    impulse, pressure = column["impulse_pa_s:charge"], 1e-3 * column["pressure_pa:charge"]
    axes.plot(impulse, pressure, "o-", color=style.INK, linewidth=0.8, markersize=4,
              label=f"{CHARGE:g} kg of TNT, reflected")  # fmt: skip
    for distance, x, y in zip(DISTANCES, impulse, pressure, strict=False):
        axes.annotate(f"{distance:g} m", (x, y), xytext=(6, -9), textcoords="offset points", fontsize=8)
    axes.set_title("a square metre of wall: 200 kg, 5 kPa at 12.5 mm; above and right of a curve is damage")
    axes.set_xlabel("impulse [Pa s]")
    axes.set_ylabel("peak pressure [kPa]")
    axes.set_ylim(1.0, 3000.0)
    axes.set_xlim(30.0, 60_000.0)
    axes.xaxis.set_major_formatter("{x:g}")
    axes.yaxis.set_major_formatter("{x:g}")
    axes.legend()


FIGURE = Figure(
    name="2.15",
    title="Figure 2.15  Pressure and impulse that do damage",
    compute=compute,
    draw=draw,
    table=whole,
)
