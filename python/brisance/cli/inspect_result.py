"""A result as tables, read back from its USD file or its report."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from brisance.cli.table import Cell, count, table
from brisance.errors import InputError
from brisance.formats.report import SCALAR_FACTS

"""Facts of a piece that are one number, by their names in the report."""

_CHARGES = ("charge", "mass kg", "TNT kg", "position m", "burst", "time s", "gain")


def describe_report(path: Path) -> str:
    """The report in a JSON file, as text."""
    try:
        report = json.loads(path.read_text(encoding="utf-8"))
        bodies: list[dict[str, Any]] = report["bodies"]
        groups: dict[str, list[float]] = {}
        for body in bodies:
            groups.setdefault(body["source"], []).append(float(body["mass_kg"]))
        return "\n".join(
            [
                f"{report['scene']}: {count(len(bodies), 'piece')}, {count(report['frames'], 'frame')} "
                f"at {report['frame_rate']:g} frames/s, seed {report['seed']}, Brisance {report['version']}",
                "",
                _charges([_charge(charge) for charge in report["charges"]]),
                "",
                table(
                    ("object", "pieces", "mass kg"),
                    [(name, len(masses), sum(masses)) for name, masses in groups.items()],
                ),
                "",
                _facts({name: _range([body[name] for body in bodies]) for name in SCALAR_FACTS}),
                *(f"warning: {warning}" for warning in report["warnings"]),
            ]
        )
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise InputError(
            f"{path} is not a report of Brisance; write one with brisance run --report."
        ) from error


def describe_usd(path: Path) -> str:
    """The result in a USD file, as text."""
    from brisance.formats.usd_summary import summarise

    found = summarise(path)
    ground = "no ground" if found.ground_height_m is None else f"ground at y = {found.ground_height_m:g} m"
    return "\n".join(
        [
            f"{found.scene}: {count(found.pieces, 'piece')}, {count(found.frames, 'frame')} "
            f"at {found.frame_rate:g} frames/s, seed {found.seed}, Brisance {found.version}",
            f"{found.duration_s:g} s; {ground}; layout {found.layout}; {found.bytes / 1e6:.3g} MB",
            "",
            _charges(
                [
                    (each.mass_kg, each.tnt_mass_kg, each.position_m, each.burst, each.time_s, each.gain)
                    for each in found.charges
                ]
            ),
            "",
            table(
                ("object", "material", "pieces", "moving", "mass kg"),
                [
                    (each.name, each.material, each.pieces, each.moving, each.mass_kg)
                    for each in found.objects
                ],
            ),
            "",
            _facts(found.facts),
            *(f"warning: {warning}" for warning in found.warnings),
        ]
    )


_Charge = tuple[float, float, Sequence[float], str, float, float]


def _charge(charge: Mapping[str, Any]) -> _Charge:
    names = ("mass_kg", "tnt_mass_kg", "position_m", "burst", "time_s", "gain")
    mass, tnt_mass, position, burst, time, gain = (charge[name] for name in names)
    return mass, tnt_mass, position, burst, time, gain


def _charges(charges: Sequence[_Charge]) -> str:
    rows: list[tuple[Cell, ...]] = [
        (f"charge.{number}", mass, tnt_mass, " ".join(f"{axis:g}" for axis in position), burst, time, gain)
        for number, (mass, tnt_mass, position, burst, time, gain) in enumerate(charges)
    ]
    return table(_CHARGES, rows)


def _facts(ranges: Mapping[str, tuple[float, float] | None]) -> str:
    """The smallest and the largest value of each fact over all pieces, without facts that no piece has."""
    rows = [(name, *both) for name in SCALAR_FACTS if (both := ranges.get(name)) is not None]
    return table(("of a piece", "smallest", "largest"), rows)


def _range(values: Sequence[float | None]) -> tuple[float, float] | None:
    known = [float(value) for value in values if value is not None and math.isfinite(value)]
    return (min(known), max(known)) if known else None
