"""Figure 2.4: the Hugoniot of a shock in inert material, and the Rayleigh line of one front."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from brisance import _engine
from brisance.figures import style
from brisance.figures.figure import Figure, Table, whole

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

DENSITY = 8930.0
FASTEST = 2000.0
BEHIND = 1400.0
"""Copper's density [kg/m³], the end of the axis and the particle velocity behind the front shown [m/s]."""


def compute() -> Table:
    """Pressure [Pa] of both curves over particle velocity [m/s]."""
    velocity = np.linspace(0.0, FASTEST, 201)
    front = float(_engine.inert_hugoniot(velocity=BEHIND)["front_velocity_m_s"])
    return {
        "velocity_m_s": velocity,
        "pressure_pa:hugoniot": _engine.inert_hugoniot(velocity=velocity)["pressure_pa"],
        "pressure_pa:rayleigh": DENSITY * front * velocity,
    }


def draw(picture: Picture, data: Table) -> None:
    axes = picture.subplots()
    column = {key: np.asarray(values, dtype=float) for key, values in data.items()}
    velocity = 1e-3 * column["velocity_m_s"]
    hugoniot, line = 1e-9 * column["pressure_pa:hugoniot"], 1e-9 * column["pressure_pa:rayleigh"]
    axes.plot(velocity, hugoniot, color=style.BLUE, label="Hugoniot")
    axes.plot(velocity, line, color=style.ORANGE, label="Rayleigh line, slope ρ₀D")
    at = int(np.argmin(np.abs(velocity - 1e-3 * BEHIND)))
    axes.plot([velocity[at]], [hugoniot[at]], "o", color=style.INK, label="state behind the front")
    axes.set_title("copper, D = 3.940 km/s + 1.489 u")
    axes.set_xlabel("particle velocity u [km/s]")
    axes.set_ylabel("pressure [GPa]")
    axes.set_xlim(0.0, velocity[-1])
    axes.set_ylim(bottom=0.0)
    axes.legend()


FIGURE = Figure(
    name="2.4",
    title="Figure 2.4  Hugoniot and Rayleigh line of a shock",
    compute=compute,
    draw=draw,
    table=whole,
)
