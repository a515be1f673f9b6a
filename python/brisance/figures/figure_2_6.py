"""Figure 2.6: Hugoniots of an explosive that has reacted in part, and the way of a particle through them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from brisance import _engine
from brisance.figures import style
from brisance.figures.figure import Figure, Table, whole

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

PROGRESS = (0.0, 0.25, 0.5, 0.75, 1.0)
OVERDRIVEN = 1.12
"""Front velocity of the upper line, over that of Chapman and Jouguet."""


def zone(front_velocity: float | None, velocity: NDArray[np.float64]) -> dict[str, Any]:
    """The reaction zone of TNT as an ideal gas behind a front [m/s]; None: Chapman and Jouguet's."""
    return _engine.reaction_zone(
        reaction_time=1e-7,
        velocity=velocity,
        progress=list(PROGRESS),
        front_velocity=front_velocity,
        points=100,
    )


def compute() -> Table:
    """Pressure [Pa] of the Hugoniots and of two Rayleigh lines over particle velocity [m/s]."""
    velocity = np.linspace(300.0, 5000.0, 300)
    found = zone(None, velocity)
    front = float(found["front_velocity_m_s"])
    spike = {key: float(found[key][0]) for key in ("pressure_pa", "velocity_m_s")}
    flux = spike["pressure_pa"] / spike["velocity_m_s"]
    table = {"velocity_m_s": velocity}
    for part, pressure in zip(PROGRESS, found["hugoniot_pressure_pa"], strict=True):
        table[f"pressure_pa:progress_{part:g}"] = pressure
    table["pressure_pa:touching"] = flux * velocity
    table["pressure_pa:overdriven"] = flux * OVERDRIVEN * velocity
    table["front_velocity_m_s"] = np.full(len(velocity), front)
    return table


def draw(picture: Picture, data: Table) -> None:
    axes = picture.subplots()
    column = {key: np.asarray(values, dtype=float) for key, values in data.items()}
    metres = column["velocity_m_s"]
    velocity = 1e-3 * metres
    colours = picture_colours(len(PROGRESS))
    for part, colour in zip(PROGRESS, colours, strict=True):
        label = f"λ = {part:g}"
        axes.plot(velocity, 1e-9 * column[f"pressure_pa:progress_{part:g}"], color=colour, label=label)
    start = np.concatenate([[0.0], velocity])
    front = float(column["front_velocity_m_s"][0])
    for name, speed, labels in (
        ("touching", None, ("N", "CJ")),
        ("overdriven", OVERDRIVEN * front, ("N", "S")),
    ):
        line = np.concatenate([[0.0], 1e-9 * column[f"pressure_pa:{name}"]])
        axes.plot(start, line, color=style.INK, linewidth=1.0, linestyle=(0, (5, 2)))
        way = zone(speed, metres)
        u, p = 1e-3 * way["velocity_m_s"], 1e-9 * way["pressure_pa"]
        axes.plot(u, p, color=style.ORANGE, linewidth=2.6)
        for at, label in zip((0, -1), labels, strict=True):
            axes.plot([u[at]], [p[at]], "o", color=style.INK, markersize=5, zorder=3)
            axes.annotate(label, (u[at], p[at]), xytext=(7, -9), textcoords="offset points")
    weak = crossing(metres, column["pressure_pa:overdriven"], column["pressure_pa:progress_1"])
    axes.plot([1e-3 * weak[0]], [1e-9 * weak[1]], "o", color=style.INK, markersize=5)
    axes.annotate("W", (1e-3 * weak[0], 1e-9 * weak[1]), xytext=(7, -9), textcoords="offset points")
    axes.plot([], [], color=style.ORANGE, linewidth=2.6, label="a particle's way")
    axes.set_title("TNT as an ideal gas; dashed: Rayleigh lines")
    axes.set_xlabel("particle velocity u [km/s]")
    axes.set_ylabel("pressure [GPa]")
    axes.set_xlim(0.0, velocity[-1])
    axes.set_ylim(0.0, 65.0)
    axes.legend()


def crossing(
    velocity: NDArray[np.float64], line: NDArray[np.float64], curve: NDArray[np.float64]
) -> tuple[float, float]:
    """The first place where a line from below meets a curve."""
    at = int(np.argmax(line > curve))
    before, after = curve[at - 1] - line[at - 1], curve[at] - line[at]
    part = before / (before - after)
    u = velocity[at - 1] + part * (velocity[at] - velocity[at - 1])
    return float(u), float(line[at - 1] + part * (line[at] - line[at - 1]))


def picture_colours(count: int) -> list[tuple[float, float, float, float]]:
    """Blues from light (unreacted) to dark (done)."""
    from matplotlib import colormaps

    return [colormaps["Blues"](0.35 + 0.6 * index / (count - 1)) for index in range(count)]


FIGURE = Figure(
    name="2.6",
    title="Figure 2.6  Hugoniots and Rayleigh lines as the reaction proceeds",
    compute=compute,
    draw=draw,
    table=whole,
)
