"""The outline of a pane, read from a file: rings of points [m], the pane's first and then its holes'."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from brisance.errors import InputError

Array = NDArray[np.float64]

SUFFIXES = (".csv", ".json", ".svg")
"""Files that can be read: points x,y with an empty line between rings; a list of rings; a drawing."""


def read_outline(path: Path | str) -> list[Array]:
    """Read rings (n, 2) [m], the one with the largest area first.

    CSV and JSON hold metres; a drawing is read at its true size, with y turned up. Raises
    :class:`InputError` for a file that is missing, of another kind, or holds no ring.
    """
    path = Path(path)
    suffix = path.suffix.lower()
    if suffix not in SUFFIXES:
        raise InputError(f"{path} is of a kind that cannot be read as an outline; give .csv, .json or .svg.")
    if not path.is_file():
        problem = "is a directory" if path.is_dir() else "does not exist"
        raise InputError(f"{path} {problem}; give the file of an outline (.csv, .json or .svg).")
    try:
        text = path.read_text(encoding="utf-8-sig")
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise InputError(f"{path} cannot be read: {reason}.") from error
    except UnicodeDecodeError as error:
        raise InputError(f"{path} is not text in UTF-8; give an outline as .csv, .json or .svg.") from error
    rings = _read(text, suffix, path)
    if not rings:
        raise InputError(f"{path} holds no outline; give a ring of at least three points.")
    for ring in rings:
        if len(ring) < 3:
            raise InputError(f"{path} has a ring of fewer than three points; an outline needs three or more.")
        if not np.isfinite(ring).all():
            raise InputError(f"{path} has a point that is not finite; give numbers in metres.")
    return sorted(rings, key=lambda ring: -abs(_area(ring)))


def fit(rings: list[Array], *, width: float | None, height: float | None) -> list[Array]:
    """Rings scaled to a width and height [m]; one alone keeps the proportions, none keeps the size."""
    points = np.concatenate(rings)
    low, size = points.min(axis=0), np.ptp(points, axis=0)
    if (size == 0).any() or (width is None and height is None):
        return rings
    across = (width or 0) / size[0] if width is not None else (height or 0) / size[1]
    up = (height or 0) / size[1] if height is not None else across
    return [low + (ring - low) * np.array([across, up]) for ring in rings]


def _read(text: str, suffix: str, path: Path) -> list[Array]:
    if suffix == ".svg":
        from brisance.outline.svg import svg_rings

        return svg_rings(text, path)
    return _csv_rings(text, path) if suffix == ".csv" else _json_rings(text, path)


def _csv_rings(text: str, path: Path) -> list[Array]:
    """Rows of two numbers; a first row of words is a heading."""
    rings: list[list[list[float]]] = [[]]
    for number, row in enumerate(csv.reader(text.splitlines()), start=1):
        cells = [cell.strip() for cell in row]
        if not any(cells):
            rings.append([])
            continue
        try:
            x, y = (float(cell) for cell in cells)
        except ValueError:
            if number == 1 and len(cells) == 2:
                continue
            raise InputError(
                f"{path}, line {number}: {', '.join(cells)} is not a point; give two numbers x,y in metres."
            ) from None
        rings[-1].append([x, y])
    return [np.array(ring) for ring in rings if ring]


def _json_rings(text: str, path: Path) -> list[Array]:
    """A list of rings of points, or one ring alone."""
    wanted = f"{path} must hold a list of rings, each a list of points [x, y] in metres"
    try:
        data = json.loads(text)
    except ValueError as error:
        raise InputError(f"{wanted}; it is not valid JSON.") from error
    if not isinstance(data, list) or not data:
        raise InputError(f"{wanted}.")
    rings = [data] if isinstance(data[0], list) and data[0] and not isinstance(data[0][0], list) else data
    found = []
    for ring in rings:
        try:
            points = np.array(ring, dtype=np.float64)
        except (TypeError, ValueError) as error:
            raise InputError(f"{wanted}.") from error
        if points.ndim != 2 or points.shape[1] != 2:
            raise InputError(f"{wanted}.")
        found.append(points)
    return found


def _area(ring: Array) -> float:
    x, y = (ring - ring[0]).T
    return float(0.5 * (x @ np.roll(y, -1) - y @ np.roll(x, -1)))
