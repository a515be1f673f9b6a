"""The explosion that the figures of single pulses show: the one that blows the thesis's brick wall apart."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from brisance import _engine

MASS = 100.0
"""Charge, TNT [kg]."""
DISTANCE = 15.0
"""From the charge [m]."""
Shape: TypeAlias = Literal["friedlander", "triangle-duration", "triangle-impulse"]
Face: TypeAlias = Literal["front", "side", "rear"]
WHAT = f"{MASS:.0f} kg of TNT in free air, {DISTANCE:.0f} m away"


@dataclass(frozen=True)
class Point:
    """The blast at one distance from the example's charge."""

    distance: float
    arrival: float
    """Of the front, after detonation [s]."""
    overpressure: float
    """Peak, static [Pa]."""
    duration: float
    """Of the positive phase [s]."""
    impulse: float
    """Of the positive phase, per area [Pa s]."""
    front_velocity: float
    """[m/s]"""


def point(distance: float = DISTANCE) -> Point:
    """What the Kingery–Bulmash curves say at ``distance`` [m]."""
    row = {key: value[0] for key, value in curves(np.array([distance])).items()}
    return Point(
        distance=distance,
        arrival=row["arrival_time_s"],
        overpressure=row["overpressure_pa"],
        duration=row["duration_s"],
        impulse=row["impulse_pa_s"],
        front_velocity=row["front_velocity_m_s"],
    )


def curves(distance: NDArray[np.float64]) -> dict[str, NDArray[np.float64]]:
    """All curves of the example's charge at ``distance`` [m]."""
    table = _engine.curves(mass=MASS, distance=distance)
    return {key: np.asarray(value) for key, value in table.items() if key != "derived"}


def incident(at: Point, times: NDArray[np.float64], *, shape: Shape = "friedlander") -> NDArray[np.float64]:
    """Overpressure [Pa] of the pulse's positive phase, ``times`` [s] after the front has come."""
    pulse = _engine.pulse(
        peak=at.overpressure, duration=at.duration, impulse=at.impulse, shape=shape, times=times
    )
    return np.asarray(pulse["pressure_pa"])


def with_suction(at: Point, times: NDArray[np.float64]) -> NDArray[np.float64]:
    """Overpressure [Pa] at ``times`` [s] since detonation, negative phase included."""
    return face("side", distance=at.distance, times=times, negative_phase=True)


def face(
    which: Face,
    *,
    distance: float,
    times: NDArray[np.float64],
    mode: Literal["translational", "surface"] = "surface",
    clearing_length: float = 1.0,
    drag_coefficient: float = 1.0,
    negative_phase: bool = False,
) -> NDArray[np.float64]:
    """Overpressure [Pa] on a face at ``distance`` [m], square to the wave's path, at ``times`` [s].

    Times count from the detonation; the wind acts as in the thesis, on a body that stands still.
    """
    return np.asarray(
        _engine.face_history(
            face=which,
            mode=mode,
            drag="thesis",
            mass=MASS,
            distance=distance,
            angle_deg=0.0,
            clearing_length=clearing_length,
            drag_coefficient=drag_coefficient,
            times=times,
            negative_phase=negative_phase,
        )
    )
