"""What is known of each piece, of the pressure at its place and of the fronts, as plain arrays."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from brisance import _engine
from brisance.curve_table import curve_source
from brisance.formats.usd.materials import look

if TYPE_CHECKING:
    from brisance.result import Result

FACTS = (
    "mass_kg",
    "distance_m",
    "arrival_time_s",
    "peak_overpressure_pa",
    "peak_load_pa",
    "impulse_x_n_s",
    "impulse_y_n_s",
    "impulse_z_n_s",
    "attenuation",
    "launch_speed_m_s",
    "rest_time_s",
)
"""Columns of the facts, as in the report; what never happens is NaN."""

FRONT_TIMES = 256
"""Times at which a front's radius is given: closer together early on, while it is fast."""


def facts(result: Result) -> NDArray[np.float32]:
    """(B, facts) one row a piece."""
    bodies = result.bodies
    columns = []
    for name in FACTS:
        if name.startswith("impulse_"):
            columns.append(bodies.impulse_n_s[:, "xyz".index(name[8])])
        else:
            columns.append(getattr(bodies, name))
    table = np.stack([np.asarray(column, dtype=np.float64) for column in columns], axis=1)
    table[~np.isfinite(table)] = np.nan
    return table.astype(np.float32)


def pulses(result: Result) -> NDArray[np.float32]:
    """(charges, B, 4): the incident pulse that each charge sends past each piece's first place, in the open.

    Arrival [s of scene time], peak [Pa], duration of the positive phase [s] and Friedlander decay, in the
    shape that the scene asks for, with the charge's gain.
    """
    scene = result.scene
    table = np.zeros((len(scene.charges), len(result.bodies), 4), dtype=np.float32)
    for number, charge in enumerate(scene.charges):
        arms = result.positions[0].astype(np.float64) - np.array(charge.position)
        found = _engine.curves(
            mass=charge.mass,
            distance=np.maximum(np.linalg.norm(arms, axis=1), 1e-3),
            tnt_equivalence=charge.factor,
            burst=charge.burst,
            source=curve_source(charge.curves, base_folder=scene.base_folder),
            pressure=scene.air.pressure,
            temperature=scene.air.temperature,
        )
        peak, duration, impulse = (found[k] for k in ("overpressure_pa", "duration_s", "impulse_pa_s"))
        shape = scene.loading.pulse
        table[number, :, 0] = charge.time + found["arrival_time_s"]
        table[number, :, 1] = charge.gain * peak
        table[number, :, 2] = 2.0 * impulse / peak if shape == "triangle-impulse" else duration
        table[number, :, 3] = found["decay"] if shape == "friedlander" else 0.0
    return table


def front_table(result: Result) -> NDArray[np.float32]:
    """(charges, FRONT_TIMES, 2): time [s] and radius [m] of each charge's shock front."""
    scene = result.scene
    table = np.zeros((len(scene.charges), FRONT_TIMES, 2), dtype=np.float32)
    for number, charge in enumerate(scene.charges):
        left = max(0.0, float(result.times[-1]) - charge.time)
        since = left * np.linspace(0.0, 1.0, FRONT_TIMES) ** 3
        table[number, :, 0] = charge.time + since
        table[number, :, 1] = _engine.front_radius(
            mass=charge.mass,
            times=since,
            tnt_equivalence=charge.factor,
            burst=charge.burst,
            source=curve_source(charge.curves, base_folder=scene.base_folder),
            pressure=scene.air.pressure,
            temperature=scene.air.temperature,
        )
    return table


def look_numbers(materials: list[str]) -> tuple[list[dict[str, Any]], NDArray[np.int64]]:
    """The looks of materials, one a piece, each look once; and (N,) the number of each piece's."""
    distinct = {name: number for number, name in enumerate(dict.fromkeys(materials))}
    return [_look(name) for name in distinct], np.array([distinct[name] for name in materials], np.int64)


def _look(material: str) -> dict[str, Any]:
    shown = look(material)
    return {
        "name": material,
        "colour": list(shown.colour),
        "broken": list(shown.broken),
        "spread": shown.spread,
        "roughness": shown.roughness,
        "metallic": shown.metallic,
        "opacity": shown.opacity,
    }
