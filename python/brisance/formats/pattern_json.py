"""A broken pane as JSON: its polygons and the tree of its cracks, for other programs."""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import brisance
from brisance.formats.atomic import replacing

if TYPE_CHECKING:
    from brisance.pane import Fracture


def write_pattern_json(fracture: Fracture, path: Path | str) -> None:
    """Write a broken pane as JSON, one line a fragment and one line a crack, whole or not at all.

    Lengths in metres in the pane's plane, angles in degrees, times in seconds from when the first crack
    starts. ``outline`` is a list of rings. It and each fragment's ``polygon`` run counter-clockwise, holes
    clockwise. ``parent`` is the number of the crack, from 0, that one goes on or branches from, null at a
    start.
    """
    head = {
        "parameters": _parameters(fracture),
        "outline": [ring.tolist() for ring in fracture.outline],
        "timing_s": {"fracture": fracture.engine.seconds, "solids": fracture.solids.seconds},
    }
    with replacing(path) as temporary, temporary.open("w", encoding="utf-8") as file:
        for key, value in head.items():
            file.write(f"{'{' if key == 'parameters' else ','}\n{json.dumps(key)}: ")
            file.write(json.dumps(value, allow_nan=False))
        for key, rows in (("fragments", _fragments(fracture)), ("cracks", _cracks(fracture))):
            file.write(f",\n{json.dumps(key)}: [\n")
            file.write(",\n".join(json.dumps(row, allow_nan=False) for row in rows))
            file.write("\n]")
        file.write("\n}\n")


def _parameters(fracture: Fracture) -> dict[str, Any]:
    low, high = fracture.bounds
    width, height = (high - low).tolist()
    return {
        "version": brisance.__version__,
        "width_m": width,
        "height_m": height,
        "thickness_m": fracture.thickness,
        "seed": fracture.seed,
        "critical_length_m": fracture.critical_length,
        "starts": fracture.engine.nuclei,
        "pattern": fracture.pattern.model_dump(mode="json"),
    }


def _fragments(fracture: Fracture) -> Iterable[dict[str, Any]]:
    for rings, area, closed in zip(
        fracture.polygons, fracture.solids.area_m2.tolist(), fracture.closed_at.tolist(), strict=True
    ):
        outer, *holes = (ring.tolist() for ring in rings)
        yield {"polygon": outer, "holes": holes, "area_m2": area, "closed_at_s": closed}


def _cracks(fracture: Fracture) -> Iterable[dict[str, Any]]:
    ends, times = fracture.engine.crack_ends.tolist(), fracture.crack_times.tolist()
    parents = fracture.engine.crack_parents.tolist()
    for (x0, y0, x1, y1), (start, end), parent in zip(ends, times, parents, strict=True):
        yield {
            "from": [x0, y0],
            "to": [x1, y1],
            "start_s": start,
            "end_s": end,
            "parent": None if parent < 0 else parent,
        }
