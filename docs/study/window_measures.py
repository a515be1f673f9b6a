"""What docs/window.md measures on windows, as numbers and as the tables of the page."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
from numpy.typing import NDArray

import brisance as br
from brisance import _engine
from brisance.figures import wall, window
from brisance.figures.broken_panes import Flight, Trial, breaking_pressure, fly, mean_area, mean_speed
from brisance.figures.figure_window_fragments import MASSES, PRESSURES, THICKNESSES
from brisance.figures.figure_window_plume import COUPLING
from brisance.plume import angular_speeds, free_pieces, plume, quantiles, travels
from brisance.result import Result

Array = NDArray[np.float64]

TRAVEL = 1.0
"""Plumes are compared where their pieces have come this far in the mean [m]."""
VARIANTS: dict[str, tuple[str, ...]] = {
    "as in the thesis": (),
    "relieved from the edge of the pane": ("loading.clearing=assembly",),
    "and breaking under its load": ("loading.clearing=assembly", "window.0.release=as it cracks"),
    "and in a frame": (*COUPLING, "window.0.facade=0"),
    "and in a wall of 10 m around": COUPLING,
}
"""From the thesis's window to a coupled and framed one of the same pattern and charge, a step at a time."""
DAMPING = 1000.0
EULER_STEPS = (1e-4, 2e-3, 4e-3)
"""Steps of the explicit scheme [s]."""
MOMENTS = (0.004, 0.02, 0.1, 0.28)
"""When the overdamped window is looked at, after the front has come [s]."""
FACADES = (3.0, 10.0, 30.0)
"""How far the wall goes on around a pane [m]."""
FEW = (690.0, 5e3, 2e4, 1e5)
"""Pressures [Pa] at which that is tried."""
CHARGES = {**MASSES, 5e6: "5 kt"}
REAL = 45e6
"""Strength of annealed glass [Pa]."""
SIDES = (0.5, 1.0)
"""Of panes whose breaking pressure is sought [m]."""


@cache
def variant(name: str) -> Result:
    """One of the ``VARIANTS``, run for long enough that its pieces come a metre."""
    return br.simulate(wall.scene(window.THESIS, VARIANTS[name]))


def fifths(result: Result) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Which pieces are the largest fifth by number, and which the smallest."""
    pane = result.panes[0]
    mass = result.bodies.mass_kg[pane.start : pane.stop]
    low, high = np.quantile(mass, (0.2, 0.8))
    return mass >= high, mass <= low


def rank_correlation(one: Array, two: Array) -> float:
    """Spearman's: 1 where the order by one is the order by the other."""
    ranks = [np.argsort(np.argsort(values)) for values in (one, two)]
    return float(np.corrcoef(*ranks)[0, 1])


def spin(result: Result) -> float:
    """Median by mass of the free pieces' angular speed from ``TRAVEL`` on [rad/s]."""
    pane = result.panes[0]
    since = int(np.searchsorted(result.times, plume(result, pane, travel=TRAVEL).time_s))
    speeds = angular_speeds(result, pane)[min(since, len(result.times) - 3) :].mean(axis=0)
    return float(quantiles(speeds, result.bodies.mass_kg[free_pieces(result, pane)], np.array([0.5]))[0])


def launch(result: Result) -> float:
    """Mean launch speed of the free pieces by mass [m/s]."""
    free = free_pieces(result, result.panes[0])
    return float(np.average(result.bodies.launch_speed_m_s[free], weights=result.bodies.mass_kg[free]))


def explicit_euler(speed: Array, *, drag: float, step: float, until: float) -> Array:
    """How far pieces of these speeds come by ``until`` [s] against a drag of ``drag`` v² [m].

    By the scheme of the thesis (3.5.2): the deceleration at the start of a step is held over it, and the
    place moves with the mean velocity.
    """
    way, now = np.zeros_like(speed), speed.copy()
    for _ in range(round(until / step)):
        after = now - drag * now * np.abs(now) * step
        way += 0.5 * (now + after) * step
        now = after
    return way


def face_on_drag(factor: float) -> float:
    """Deceleration over speed squared of any flat piece of the thesis's pane that flies face on [1/m]."""
    pane = wall.scene(window.THESIS).objects[0]
    assert isinstance(pane, br.Window)
    density = 101_325.0 / (287.05 * 288.15)
    glass = _engine.material("glass")["density_kg_m3"]
    assert glass is not None
    return factor * 0.5 * density * pane.drag_coefficient / (glass * pane.thickness)


@cache
def tables() -> tuple[tuple[str, ...], ...]:
    """The tables of the page, line by line."""
    return (_plumes(), _overdamped(), _areas(), _speeds(), _facades(), _breaking())


def _plumes() -> tuple[str, ...]:
    lines = [
        "| window | pieces that come free | mean launch speed | length | width "
        "| width of the same pieces, as in the thesis | median spin |",
        "|---|---|---|---|---|---|---|",
    ]
    thesis = variant("as in the thesis")
    for name in VARIANTS:
        result = variant(name)
        pane = result.panes[0]
        free, at = free_pieces(result, pane), plume(result, pane, travel=TRAVEL)
        same = free - pane.start + thesis.panes[0].start
        control = plume(thesis, thesis.panes[0], travel=TRAVEL, pieces=same)
        lines.append(
            f"| {name} | {len(free)} of {pane.stop - pane.start} | {launch(result):.1f} m/s "
            f"| {at.length_m:.2f} m | {at.width_m:.2f} m | {control.width_m:.2f} m "
            f"| {spin(result):.1f} rad/s |"
        )
    return tuple(lines)


def _overdamped() -> tuple[str, ...]:
    heads = [f"{1e3 * moment:g} ms" for moment in MOMENTS]
    lines = [
        "| largest / smallest fifth have come | " + " | ".join(heads) + " |",
        "|---|" + "---|" * len(heads),
    ]
    damped = wall.result(window.OVERDAMPED)
    large, small = fifths(damped)
    pane = damped.panes[0]
    ways = travels(damped, pane, np.arange(pane.start, pane.stop))
    since = damped.times - damped.bodies.arrival_time_s[pane.start : pane.stop].min()
    now = np.array([[np.interp(moment, since, way) for way in ways.T] for moment in MOMENTS])
    lines.append(_row("scenes/window_overdamped.toml", [(way[large], way[small]) for way in now]))
    speed = variant("as in the thesis").bodies.launch_speed_m_s
    drag = face_on_drag(DAMPING)
    exact = [np.log1p(drag * speed * moment) / drag for moment in MOMENTS]
    lines.append(_row("face on, exact", [(way[large], way[small]) for way in exact]))
    for step in EULER_STEPS:
        reached = [explicit_euler(speed, drag=drag, step=step, until=moment) for moment in MOMENTS]
        name = f"face on, explicit Euler, {1e3 * step:g} ms"
        lines.append(_row(name, [(way[large], way[small]) for way in reached]))
    return tuple(lines)


def _row(name: str, pairs: list[tuple[Array, Array]]) -> str:
    cells = [f"{1e3 * one.mean():.0f} / {1e3 * two.mean():.0f} mm" for one, two in pairs]
    return f"| {name} | " + " | ".join(cells) + " |"


def _areas() -> tuple[str, ...]:
    lines = ["| reflected pressure | (2.45) | 3 mm | 6 mm | 10 mm |", "|---|---|---|---|---|"]
    for pressure in PRESSURES:
        cells = [f"{1e6 * fly(Trial(500.0, pressure, h)).mean_area:.1f} mm²" for h in THICKNESSES]
        lines.append(f"| {_pa(pressure)} | {1e6 * mean_area(pressure):.1f} mm² | " + " | ".join(cells) + " |")
    return tuple(lines)


def _speeds() -> tuple[str, ...]:
    heads = " | ".join(f"{name}: bound | start | / (2.46)" for name in MASSES.values())
    lines = [
        f"| glass | reflected pressure | (2.46) | {heads} |",
        "|---|---|---|" + "---|" * (3 * len(MASSES)),
    ]
    for thickness in THICKNESSES:
        for pressure in PRESSURES:
            formula = mean_speed(pressure, thickness)
            flights = [fly(Trial(mass, pressure, thickness)) for mass in MASSES]
            cells = " | ".join(
                f"{_m_s(f.bound)} | {_m_s(f.speed)} | {f.speed / formula:.2f}" for f in flights
            )
            lines.append(f"| {1e3 * thickness:g} mm | {_pa(pressure)} | {_m_s(formula)} | {cells} |")
    return tuple(lines)


def wide(mass: float, pressure: float, facade: float) -> Flight:
    """6 mm glass in a wall of some width [m]."""
    return fly(Trial(mass, pressure, 0.006, facade=facade))


def _facades() -> tuple[str, ...]:
    heads = " | ".join(_pa(pressure) for pressure in FEW)
    lines = [f"| charge | pulse | wall goes on for | {heads} |", "|---|---|---|" + "---|" * len(FEW)]
    for mass, name in CHARGES.items():
        if mass < 100.0:
            continue
        flights = {facade: [wide(mass, pressure, facade) for pressure in FEW] for facade in FACADES}
        lasts = [1e3 * flight.duration for flight in flights[FACADES[0]]]
        pulse = f"{lasts[-1]:.0f} to {lasts[0]:.0f} ms"
        for facade, row in flights.items():
            shares = [f.speed / mean_speed(p, 0.006) for f, p in zip(row, FEW, strict=True)]
            lines.append(
                f"| {name} | {pulse} | {facade:g} m | " + " | ".join(f"{s:.2f}" for s in shares) + " |"
            )
        bounds = [f.bound / mean_speed(p, 0.006) for f, p in zip(flights[FACADES[0]], FEW, strict=True)]
        lines.append(f"| {name} | {pulse} | bound | " + " | ".join(f"{b:.2f}" for b in bounds) + " |")
    return tuple(lines)


def _breaking() -> tuple[str, ...]:
    heads = " | ".join(MASSES.values())
    lines = [f"| pane | glass | {heads} |", "|---|---|" + "---|" * len(MASSES)]
    for side in SIDES:
        for thickness in THICKNESSES:
            cells = [f"{breaking_pressure(mass, thickness, side, REAL) / 1e3:.1f} kPa" for mass in MASSES]
            lines.append(f"| {side:g} m | {1e3 * thickness:g} mm | " + " | ".join(cells) + " |")
    return tuple(lines)


def _pa(pressure: float) -> str:
    return f"{pressure:.0f} Pa" if pressure < 1000.0 else f"{pressure / 1e3:g} kPa"


def _m_s(speed: float) -> str:
    digits = max(0, 1 - math.floor(math.log10(speed)))
    return f"{speed:.{min(digits, 2)}f} m/s"
