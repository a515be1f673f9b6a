"""Mean area and speed of a window's fragments over the pressure, beside the formulas (2.45) and (2.46)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from brisance.figures import style
from brisance.figures.broken_panes import Flight, Trial, fly, mean_area, mean_speed
from brisance.figures.figure import Figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Picture

    from brisance.figures.figure import Table

PRESSURES = (690.0, 2e3, 5e3, 1e4, 2e4, 5e4, 1e5)
"""Peak reflected pressures [Pa], from the least that was measured."""
THICKNESSES = (0.003, 0.006, 0.01)
"""Of the glass [m]."""
MASSES = {5.0: "5 kg", 500.0: "500 kg", 5e4: "50 t"}
"""Charges [kg of TNT]: pulses of some 10, 40 and 200 ms."""
COLOURS = dict(zip(MASSES, (style.GREEN, style.BLUE, style.ORANGE), strict=True))


def trials() -> list[Trial]:
    """Every pane that is broken."""
    return [Trial(mass, pressure, h) for h in THICKNESSES for pressure in PRESSURES for mass in MASSES]


def compute() -> dict[Trial, Flight]:
    """What each of them gave."""
    return {trial: fly(trial) for trial in trials()}


def draw(picture: Picture, flights: dict[Trial, Flight]) -> None:
    panels = picture.subplots(2, 2).ravel()
    _draw_areas(panels[0], flights)
    for axes, thickness in zip(panels[1:], THICKNESSES, strict=True):
        _draw_speeds(axes, flights, thickness)


def _draw_areas(axes: Axes, flights: dict[Trial, Flight]) -> None:
    pressures = np.geomspace(PRESSURES[0], PRESSURES[-1], 200)
    axes.plot(pressures, [1e6 * mean_area(p) for p in pressures], color=style.INK, label="(2.45)")
    for thickness, marker in zip(THICKNESSES, "ovs", strict=True):
        areas = [1e6 * flights[Trial(500.0, pressure, thickness)].mean_area for pressure in PRESSURES]
        label = f"{1e3 * thickness:.0f} mm glass"
        axes.plot(PRESSURES, areas, marker, markerfacecolor="none", color=style.BLUE, label=label)
    axes.set(xscale="log", yscale="log", xlabel="peak reflected pressure [Pa]", ylabel="mean area [mm²]")
    axes.set_title("area of fragments")
    axes.legend()


def _draw_speeds(axes: Axes, flights: dict[Trial, Flight], thickness: float) -> None:
    pressures = np.geomspace(PRESSURES[0], PRESSURES[-1], 200)
    axes.plot(pressures, [mean_speed(p, thickness) for p in pressures], color=style.INK, label="(2.46)")
    for mass, name in MASSES.items():
        these = [flights[Trial(mass, pressure, thickness)] for pressure in PRESSURES]
        axes.plot(PRESSURES, [f.speed for f in these], "o", color=COLOURS[mass], label=name)
        axes.plot(PRESSURES, [f.bound for f in these], "--", color=COLOURS[mass], linewidth=0.9)
    axes.set(xscale="log", yscale="log", xlabel="peak reflected pressure [Pa]", ylabel="mean speed [m/s]")
    axes.set_ylim(0.1, 1000.0)
    axes.plot([], [], "--", color=style.GREY, linewidth=0.9, label="all of the impulse")
    axes.set_title(f"speed of fragments, {1e3 * thickness:.0f} mm glass")
    axes.legend(loc="upper left", fontsize="small")


def table(flights: dict[Trial, Flight]) -> Table:
    """A row a pane."""
    rows = list(flights.items())
    columns = {
        "thickness_m": [trial.thickness for trial, _ in rows],
        "reflected_pressure_pa": [trial.pressure for trial, _ in rows],
        "charge_kg": [trial.mass for trial, _ in rows],
        "duration_s": [flight.duration for _, flight in rows],
        "mean_area_m2": [flight.mean_area for _, flight in rows],
        "mean_area_2_45_m2": [mean_area(trial.pressure) for trial, _ in rows],
        "mean_speed_m_s": [flight.speed for _, flight in rows],
        "mean_speed_2_46_m_s": [mean_speed(trial.pressure, trial.thickness) for trial, _ in rows],
        "bound_m_s": [flight.bound for _, flight in rows],
        "delivered_m_s": [flight.delivered for _, flight in rows],
    }
    return {name: np.array(values) for name, values in columns.items()}


FIGURE = Figure(
    name="window-fragments",
    title="Fragments of broken windows beside the formulas (2.45) and (2.46)",
    compute=compute,
    draw=draw,
    table=table,
    size=(1400, 1100),
)
