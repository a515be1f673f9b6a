"""Figure 2.5: the Hugoniot of a detonation, and the Rayleigh lines that miss, touch and cross it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from brisance import _engine
from brisance.figures import style
from brisance.figures.figure import Figure, Table, whole

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

FASTER = 7400.0
SLOWER = 6400.0
"""Front velocities [m/s] above and below that of Chapman and Jouguet."""


def compute() -> Table:
    """Pressure [Pa] of the Hugoniot of TNT's products and of three Rayleigh lines over particle velocity."""
    volume = np.linspace(0.55, 0.995, 300)
    curve = _engine.detonation_hugoniot(relative_volume=volume)
    velocity = np.asarray(curve["velocity_m_s"])[::-1]
    rest, point = curve["density_at_rest_kg_m3"], curve["chapman_jouguet"]
    fronts = {"slower": SLOWER, "touching": point["front_velocity_m_s"], "faster": FASTER}
    table = {
        "velocity_m_s": velocity,
        "pressure_pa:hugoniot": np.asarray(curve["pressure_pa"])[::-1],
    }
    for name, front in fronts.items():
        table[f"pressure_pa:{name}"] = rest * front * velocity
    return table


def states() -> dict[str, NDArray[np.float64]]:
    """Velocity [m/s] and pressure [Pa] of the Chapman–Jouguet point and of both crossings."""
    found = _engine.detonation_hugoniot(relative_volume=np.zeros(0), front_velocity=FASTER)
    names = {"CJ": "chapman_jouguet", "S": "strong", "W": "weak"}
    return {
        label: np.array([found[name]["velocity_m_s"], found[name]["pressure_pa"]])
        for label, name in names.items()
    }


def draw(picture: Picture, data: Table) -> None:
    axes = picture.subplots()
    column = {key: np.asarray(values, dtype=float) for key, values in data.items()}
    velocity = 1e-3 * column["velocity_m_s"]
    axes.plot(velocity, 1e-9 * column["pressure_pa:hugoniot"], color=style.BLUE, label="Hugoniot")
    looks = {
        "slower": (f"D = {1e-3 * SLOWER:.1f} km/s: no solution", style.GREY, (0, (1.2, 1.6))),
        "touching": ("D of Chapman and Jouguet", style.ORANGE, "-"),
        "faster": (f"D = {1e-3 * FASTER:.1f} km/s: strong and weak", style.GREEN, (0, (5, 2))),
    }
    start = np.concatenate([[0.0], velocity])
    for name, (label, colour, dashes) in looks.items():
        line = np.concatenate([[0.0], 1e-9 * column[f"pressure_pa:{name}"]])
        axes.plot(start, line, color=colour, linestyle=dashes, label=label, linewidth=1.3)
    for label, (u, p) in states().items():
        axes.plot([1e-3 * u], [1e-9 * p], "o", color=style.INK, markersize=5)
        axes.annotate(label, (1e-3 * u, 1e-9 * p), xytext=(-6, 6), textcoords="offset points", ha="right")
    axes.set_title("TNT with JWL products, 1630 kg/m³")
    axes.set_xlabel("particle velocity u [km/s]")
    axes.set_ylabel("pressure [GPa]")
    axes.set_xlim(0.0, velocity[-1])
    axes.set_ylim(bottom=0.0)
    axes.legend()


FIGURE = Figure(
    name="2.5",
    title="Figure 2.5  Hugoniot and Rayleigh lines of a detonation",
    compute=compute,
    draw=draw,
    table=whole,
)
