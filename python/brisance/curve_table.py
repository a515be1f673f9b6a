"""A user's own blast curves: a CSV file with a header row, read by name of column. Lines that begin with #
are remarks.

Columns: ``scaled_distance_m_kg13`` and ``overpressure_pa``, and any of ``reflected_pressure_pa``,
``dynamic_pressure_pa``, ``front_velocity_m_s``, ``duration_s_kg13``, ``impulse_pa_s_kg13``,
``reflected_impulse_pa_s_kg13``, ``arrival_time_s_kg13``. Times and impulses are divided by the cube root of
the charge's mass in kg of TNT. The engine reads between rows along straight lines in log-log.
"""

from __future__ import annotations

import csv
import math
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from brisance.errors import InputError
from brisance.sentences import nearest

BUILT_IN = ("kingery-bulmash", "brode", "henrych", "kinney-graham", "hydrocode")
REQUIRED = ("scaled_distance_m_kg13", "overpressure_pa")
COLUMNS = (
    *REQUIRED,
    "reflected_pressure_pa",
    "dynamic_pressure_pa",
    "front_velocity_m_s",
    "duration_s_kg13",
    "impulse_pa_s_kg13",
    "reflected_impulse_pa_s_kg13",
    "arrival_time_s_kg13",
)


def curve_source(name: str, *, base_folder: Path) -> str | dict[str, NDArray[np.float64]]:
    """What the engine takes as source of curves: a built-in name, or the columns of a CSV file in
    ``base_folder``.
    """
    if name in BUILT_IN:
        return name
    path = base_folder / name
    if path.suffix.lower() != ".csv" and not path.exists():
        guess = nearest(name, list(BUILT_IN))
        hint = f"did you mean {guess}?" if guess else f"choose {', '.join(BUILT_IN)} or a CSV file."
        raise InputError(f"curves {name!r} is not a known source; {hint}")
    return read_table(path)


def read_table(path: Path) -> dict[str, NDArray[np.float64]]:
    """The columns of a CSV curve table, checked: numbers above 0, distances that rise, two rows or more."""
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            lines = (line for line in file if not line.startswith("#"))
            rows = [row for row in csv.reader(lines) if any(cell.strip() for cell in row)]
    except FileNotFoundError:
        raise InputError(f"{path} does not exist; give a CSV file of curves.") from None
    except IsADirectoryError:
        raise InputError(f"{path} is a directory; give a CSV file of curves.") from None
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise InputError(f"{path} cannot be read as CSV: {error}.") from None
    header = [cell.strip() for cell in rows[0]] if rows else []
    _check_header(path, header)
    if len(rows) < 3:
        raise InputError(f"{path} has {max(len(rows) - 1, 0)} rows of numbers; a curve needs two or more.")
    values = np.array([_numbers(path, number, row, header) for number, row in enumerate(rows[1:], start=2)])
    if not np.all(np.diff(values[:, header.index(REQUIRED[0])]) > 0):
        raise InputError(f"{path}: {REQUIRED[0]} must rise from row to row.")
    return {name: np.ascontiguousarray(values[:, index]) for index, name in enumerate(header)}


def _check_header(path: Path, header: list[str]) -> None:
    for name in REQUIRED:
        if name not in header:
            raise InputError(f"{path} has no column {name}; its first row must name the columns.")
    for name in header:
        if name not in COLUMNS:
            guess = nearest(name, list(COLUMNS))
            hint = f"did you mean {guess}?" if guess else f"known columns: {', '.join(COLUMNS)}."
            raise InputError(f"{path}: {name!r} is not a known column; {hint}")
        if header.count(name) > 1:
            raise InputError(f"{path} has the column {name} more than once.")


def _numbers(path: Path, number: int, row: list[str], header: list[str]) -> list[float]:
    if len(row) != len(header):
        raise InputError(f"{path}, row {number}: has {len(row)} cells where the header has {len(header)}.")
    values = []
    for name, cell in zip(header, row, strict=True):
        try:
            value = float(cell)
        except ValueError:
            raise InputError(f"{path}, row {number}: {name} must be a number, not {cell!r}.") from None
        if not (math.isfinite(value) and value > 0):
            raise InputError(
                f"{path}, row {number}: {name} must be a finite number above 0, not {cell.strip()}."
            )
        values.append(value)
    return values
