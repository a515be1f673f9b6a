"""Panes broken at a given reflected pressure: how large their pieces are and how fast they start.

They stand beside (2.45) and (2.46). A charge of any mass is as far off, in free air and square to the middle
of the pane, as gives the pressure. The pane is so weak that every pressure breaks it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

import brisance
from brisance import _engine
from brisance.plume import free_pieces, travels
from brisance.result import Result

DENSITY = float(_engine.material("glass")["density_kg_m3"] or math.nan)
"""Of glass [kg/m³]."""
SIDE = 0.5
"""Side of the square pane [m]."""
MOST_PIECES = 2000
"""Where (2.45) asks for more pieces, the pane is smaller."""
WEAK = 1e5
"""Strength of panes that are to break under any pressure [Pa]; real glass is some 450 times stronger."""
FACADE = 3.0
"""How far the wall goes on around the pane [m]: the default of a window in a frame."""
NEAR = 3.0
"""A piece's speed is looked at while it has come no farther than this [m]: about a room."""
LEAD, AFTER = 0.002, 0.05
"""How long before the front the scene begins, and how long after the pulse it ends [s]."""
FRAMES = 60


@dataclass(frozen=True)
class Trial:
    """A pane, and the blast that comes to it."""

    mass: float
    """Of the charge [kg of TNT]."""
    pressure: float
    """Peak reflected pressure on the middle of the pane [Pa]."""
    thickness: float
    """Of the pane [m]."""
    facade: float = FACADE
    """How far the wall goes on around it [m]."""
    strength: float = WEAK
    """Of the glass [Pa]."""
    side: float | None = None
    """Of the pane [m]; left out: ``SIDE``, less where that would break into too many pieces."""


@dataclass(frozen=True)
class Flight:
    """What a trial gave. Means are over the pieces by number, as one counts fragments."""

    mean_area: float
    """Of all pieces [m²]."""
    speed: float
    """Mean greatest speed along the blast of the pieces that come free [m/s]; NaN if the pane holds."""
    bound: float
    """Speed that the whole reflected impulse gives the bare pane: impulse over mass per area [m/s]."""
    delivered: float
    """Impulse that reached the pane over its mass [m/s]: what relief from the edges leaves of the bound."""
    duration: float
    """Of the pulse [s]."""
    peak_stress: float
    """Greatest in the pane until it failed [Pa]."""


def distance(mass: float, pressure: float) -> float:
    """How far a charge [kg of TNT] in free air is from where its reflected pressure is ``pressure`` [Pa]."""
    near, far = 0.3 * mass ** (1 / 3), 3000.0 * mass ** (1 / 3)
    # Reflected pressure falls all the way.
    for _ in range(60):
        middle = math.sqrt(near * far)
        if curves(mass, middle)["reflected_pressure_pa"] > pressure:
            near = middle
        else:
            far = middle
    return math.sqrt(near * far)


def curves(mass: float, distance: float) -> dict[str, float]:
    """What the curves of a charge [kg of TNT] say at a distance [m]."""
    table = _engine.curves(mass=mass, distance=np.array([distance]))
    return {key: float(np.asarray(value)[0]) for key, value in table.items() if key != "derived"}


def mean_area(pressure: float) -> float:
    """Mean area of fragments by (2.45) [m²]."""
    return _engine.mean_fragment_area(pressure=pressure)[0]


def mean_speed(pressure: float, thickness: float) -> float:
    """Mean speed of fragments by (2.46) [m/s]."""
    return _engine.mean_fragment_velocity(pressure=pressure, thickness=thickness)


@cache
def fly(trial: Trial) -> Flight:
    """Break the pane of a trial."""
    away = distance(trial.mass, trial.pressure)
    blast = curves(trial.mass, away)
    result = brisance.simulate(scene(trial, away=away, arrival=blast["arrival_time_s"]))
    pane = result.panes[0]
    pieces = slice(pane.start, pane.stop)
    mass = result.bodies.mass_kg[pieces].sum()
    return Flight(
        mean_area=pane.mean_area_m2,
        speed=_speed(result),
        bound=blast["reflected_impulse_pa_s"] / (DENSITY * trial.thickness),
        delivered=float(result.bodies.impulse_n_s[pieces, 2].sum() / mass),
        duration=blast["duration_s"],
        peak_stress=pane.peak_stress_pa,
    )


def scene(trial: Trial, *, away: float, arrival: float) -> brisance.Scene:
    """The scene of a trial: the charge ``away`` [m] from the pane, its front ``arrival`` [s] on its way."""
    side = trial.side or min(SIDE, math.sqrt(MOST_PIECES * mean_area(trial.pressure)))
    duration = LEAD + curves(trial.mass, away)["duration_s"] + AFTER
    pane = brisance.Window(
        name="pane",
        width=side,
        height=side,
        thickness=trial.thickness,
        strength=trial.strength,
        facade=trial.facade,
    )
    charge = brisance.Charge(mass=trial.mass, position=(0.0, 0.0, -away), time=LEAD - arrival)
    time = brisance.Time(duration=duration, frame_rate=FRAMES / duration)
    return brisance.Scene(charges=[charge], objects=[pane], time=time)


def _speed(result: Result) -> float:
    """Mean of the free pieces' greatest speeds along the blast in the first ``NEAR`` metres [m/s]."""
    pane = result.panes[0]
    pieces = free_pieces(result, pane)
    if pane.fate == "holds" or not len(pieces):
        return math.nan
    way = travels(result, pane, pieces)
    speed: NDArray[np.float64] = np.diff(way, axis=0) * result.frame_rate
    return float(np.where(way[:-1] < NEAR, speed, 0.0).max(axis=0).mean())


def breaking_pressure(mass: float, thickness: float, side: float, strength: float) -> float:
    """Least reflected pressure [Pa] of a charge at which a framed pane of real ``strength`` [Pa] breaks."""
    pressure = 1000.0
    # The stress is all but proportional to the pressure; it is the pulse's length that changes with distance.
    for _ in range(12):
        held = fly(Trial(mass, pressure, thickness, strength=1e12, side=side))
        change = strength / held.peak_stress
        pressure *= change
        if abs(change - 1.0) < 1e-3:
            break
    return pressure
