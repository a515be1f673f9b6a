"""A user's own load on a structure: a CSV file with the columns ``time_s`` and ``force_n``."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from brisance.errors import InputError

COLUMNS = ["time_s", "force_n"]


def read_load(path: Path) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Times [s] and forces [N] of a CSV file; the engine checks that the times rise from 0 on."""
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            rows = [row for row in csv.reader(file) if any(cell.strip() for cell in row)]
    except FileNotFoundError:
        raise InputError(f"{path} does not exist; give a CSV file of times and forces.") from None
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise InputError(f"{path} cannot be read as CSV: {error}.") from None
    header = [cell.strip() for cell in rows[0]] if rows else []
    if header != COLUMNS:
        raise InputError(f"{path}: its first row must be {','.join(COLUMNS)}, not {','.join(header)!r}.")
    try:
        table = np.array([[float(cell) for cell in row] for row in rows[1:]], dtype=np.float64)
    except ValueError as error:
        raise InputError(f"{path}: every cell must be a number: {error}.") from None
    if table.ndim != 2 or table.shape[1] != len(COLUMNS):
        raise InputError(f"{path}: every row must have two numbers, a time and a force.")
    return table[:, 0].copy(), table[:, 1].copy()
