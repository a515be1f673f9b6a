"""The report: every fact about a run as JSON, units in the names."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import brisance
from brisance.dispersal import summary
from brisance.formats.atomic import write_text
from brisance.model import Charge

if TYPE_CHECKING:
    from brisance.result import Pane, Result

UNITS = {
    "length": "m",
    "mass": "kg",
    "time": "s",
    "pressure": "Pa",
    "temperature": "K",
    "impulse": "N s",
    "angle": "deg",
    "axes": "right-handed, Y up",
}
_PER_BODY = (
    "mass_kg",
    "frontal_area_m2",
    "distance_m",
    "arrival_time_s",
    "peak_overpressure_pa",
    "peak_load_pa",
    "impulse_n_s",
    "attenuation",
    "launch_speed_m_s",
    "free_time_s",
    "rest_time_s",
    "final_position_m",
)
SCALAR_FACTS = tuple(name for name in _PER_BODY if name not in ("impulse_n_s", "final_position_m"))
"""Facts of a body that are one number, in the report's order."""


def report(result: Result) -> dict[str, Any]:
    """The report of a result. What never happens (a rest, an arrival) is None."""
    from brisance.result import TIMINGS

    scene, bodies = result.scene, result.bodies
    columns = [[_plain(value) for value in getattr(bodies, name).tolist()] for name in _PER_BODY]
    return {
        "scene": scene.name,
        "seed": scene.seed,
        "version": brisance.__version__,
        "units": UNITS,
        "frames": len(result.times),
        "frame_rate": result.frame_rate,
        "step_s": result.step_s,
        "timing_s": {name: result.timing_s.get(name, 0.0) for name in TIMINGS},
        "warnings": list(result.warnings),
        "charges": [_charge(charge) for charge in scene.charges],
        "windows": [_window(pane) for pane in result.panes],
        "dispersal": summary(result),
        "settings": scene.model_dump(mode="json", exclude={"charges", "objects", "name", "seed"}),
        "bodies": [
            {"name": name, "source": source, **dict(zip(_PER_BODY, facts, strict=True))}
            for name, source, facts in zip(
                bodies.names, bodies.source, zip(*columns, strict=True), strict=True
            )
        ],
    }


def write_report(result: Result, path: Path | str) -> None:
    """Write the report of a result as JSON, one line a body."""
    whole = report(result)
    bodies = whole.pop("bodies")
    lines = ",\n".join(f"    {json.dumps(body, allow_nan=False)}" for body in bodies)
    head = json.dumps(whole, indent=2, allow_nan=False, ensure_ascii=False).removesuffix("\n}")
    write_text(path, f'{head},\n  "bodies": [\n{lines}\n  ]\n}}\n')


def _charge(charge: Charge) -> dict[str, Any]:
    return {
        "mass_kg": charge.mass,
        "explosive": charge.explosive or ("TNT" if charge.tnt_equivalence is None else None),
        "tnt_equivalence": charge.factor,
        "tnt_mass_kg": charge.mass * charge.factor,
        "position_m": list(charge.position),
        "burst": charge.burst,
        "time_s": charge.time,
        "gain": charge.gain,
        "curves": charge.curves,
    }


def _window(pane: Pane) -> dict[str, Any]:
    return {
        "name": pane.name,
        "fate": pane.fate,
        "failure_time_s": pane.failure_time_s,
        "failure_place_m": None if pane.failure_place_m is None else list(pane.failure_place_m),
        "peak_pressure_pa": pane.peak_pressure_pa,
        "peak_stress_pa": pane.peak_stress_pa,
        "strength_pa": pane.strength_pa,
        "pieces": pane.stop - pane.start,
        "staying": pane.staying,
        "mean_area_m2": pane.mean_area_m2,
        "frame_impulse_n_s": list(pane.frame_impulse_n_s),
    }


def _plain(value: Any) -> Any:
    """JSON knows no NaN and no infinity: None stands for both."""
    if isinstance(value, list):
        return [_plain(item) for item in value]
    return value if math.isfinite(value) else None
