"""The push of a charge's blast on a structure, as the commands on structures take it."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Any

import numpy as np

from brisance import _engine
from brisance.curve_table import curve_source
from brisance.errors import InputError


class Shape(StrEnum):
    """Shape of a pulse."""

    triangle = "triangle"
    friedlander = "friedlander"
    step = "step"


@dataclass(frozen=True)
class BlastLoad:
    """What a wall that faces a charge feels: a Friedlander pulse."""

    distance_m: float
    pressure_pa: float
    duration_s: float
    impulse_pa_s: float
    decay: float


def blast_loads(charge: float, distances: list[float], *, reflected: bool, source: str) -> list[BlastLoad]:
    """The pulses of ``charge`` kg of TNT at distances [m]: reflected head-on, or as the wave passes."""
    for flag, values in (("--charge", [charge]), ("--distance", distances)):
        for value in values:
            if not (np.isfinite(value) and value > 0):
                raise InputError(f"{flag} must be a finite number above 0, not {value:g}.")
    curves = _engine.curves(
        mass=charge,
        distance=np.array(distances, dtype=np.float64),
        source=curve_source(source, base_folder=Path()),
    )
    prefix = "reflected_" if reflected else ""
    peaks = curves["reflected_pressure_pa" if reflected else "overpressure_pa"]
    impulses = curves[f"{prefix}impulse_pa_s"]
    return [_load(*values) for values in zip(distances, peaks, curves["duration_s"], impulses, strict=True)]


def _load(distance: float, peak: Any, duration: Any, impulse: Any) -> BlastLoad:
    """Friedlander's pulse through peak, duration and impulse."""
    pulse = _engine.pulse(
        peak=float(peak), duration=float(duration), impulse=float(impulse), times=np.zeros(1)
    )
    return BlastLoad(
        distance_m=float(distance),
        pressure_pa=float(peak),
        duration_s=float(pulse["duration_s"]),
        impulse_pa_s=float(impulse),
        decay=float(pulse["decay"]),
    )
