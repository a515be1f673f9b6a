"""A result as tables, read back from its USD file or its report."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from brisance.cli.table import Cell, count, table
from brisance.errors import InputError

_HEADER = ("object", "pieces", "mass kg", "first reached ms", "peak load kPa", "fastest m/s", "impulse N s")
_FACTS = ("mass_kg", "arrival_time_s", "peak_load_pa", "launch_speed_m_s", "impulse_n_s")
_OBJECTS = ("Xform", "Mesh", "PointInstancer")


def describe_report(path: Path) -> str:
    """The report in a JSON file, as text."""
    try:
        report = json.loads(path.read_text(encoding="utf-8"))
        groups: dict[str, list[dict[str, Any]]] = {}
        for body in report["bodies"]:
            groups.setdefault(body["source"], []).append({name: body[name] for name in _FACTS})
        head = [
            f"{report['scene']}: {count(len(report['bodies']), 'piece')}, {count(report['frames'], 'frame')} "
            f"at {report['frame_rate']:g} frames/s, seed {report['seed']}, Brisance {report['version']}"
        ]
        warnings = list(report["warnings"])
    except (ValueError, KeyError, TypeError) as error:
        raise InputError(
            f"{path} is not a report of Brisance; write one with brisance run --report."
        ) from error
    return _text(head, groups, warnings)


def describe_usd(path: Path) -> str:
    """The result in a USD file, as text."""
    from pxr import Sdf, Tf

    try:
        layer = Sdf.Layer.FindOrOpen(str(path))
    except Tf.ErrorException:
        layer = None
    if layer is None:
        raise InputError(f"{path} is not a USD file that can be opened.")
    world = layer.GetPrimAtPath("/World")
    if world is None or "brisance:version" not in world.attributes:
        raise InputError(
            f"{path} is a USD file, but not a result of Brisance; write one with brisance run -o."
        )
    facts = {
        name: world.attributes[f"brisance:{name}"].default for name in ("scene", "seed", "version", "layout")
    }
    frames = round(layer.endTimeCode - layer.startTimeCode) + 1
    groups = {
        prim.name: list(_pieces(prim))
        for prim in world.nameChildren
        if prim.typeName in _OBJECTS and _holds_pieces(prim)
    }
    head = [
        f"{facts['scene']}: {count(sum(map(len, groups.values())), 'piece')}, {count(frames, 'frame')} at "
        f"{layer.timeCodesPerSecond:g} frames/s, seed {facts['seed']}, Brisance {facts['version']}",
        f"up axis {layer.pseudoRoot.GetInfo('upAxis')}, "
        f"{layer.pseudoRoot.GetInfo('metersPerUnit'):g} m a unit, "
        f"frames {layer.startTimeCode:g} to {layer.endTimeCode:g}, layout {facts['layout']}",
    ]
    return _text(head, groups, list(world.attributes["brisance:warnings"].default or ()))


def _holds_pieces(prim: Any) -> bool:
    return any("brisance:mass_kg" in each.attributes for each in (prim, *prim.nameChildren))


def _pieces(prim: Any) -> Iterator[dict[str, Any]]:
    """The facts of each piece of an object: attributes of its meshes, or one array a fact on its
    instancer.
    """
    if prim.typeName == "PointInstancer":
        columns = [prim.attributes[f"brisance:{name}"].default for name in _FACTS]
        yield from (dict(zip(_FACTS, facts, strict=True)) for facts in zip(*columns, strict=True))
        return
    for each in (prim, *prim.nameChildren):
        if "brisance:mass_kg" in each.attributes:
            found = ((name, each.attributes.get(f"brisance:{name}")) for name in _FACTS)
            yield {name: None if attribute is None else attribute.default for name, attribute in found}


def _text(head: list[str], groups: dict[str, list[dict[str, Any]]], warnings: list[str]) -> str:
    rows = [_row(name, pieces) for name, pieces in groups.items()]
    return "\n".join([*head, "", table(_HEADER, rows), *(f"warning: {warning}" for warning in warnings)])


def _row(name: str, pieces: list[dict[str, Any]]) -> tuple[Cell, ...]:
    arrivals = _known(pieces, "arrival_time_s")
    loads, speeds = _known(pieces, "peak_load_pa"), _known(pieces, "launch_speed_m_s")
    impulses = [list(piece["impulse_n_s"]) for piece in pieces if piece["impulse_n_s"] is not None]
    return (
        name,
        len(pieces),
        sum(_known(pieces, "mass_kg")),
        1e3 * min(arrivals) if arrivals else None,
        max(loads) / 1e3 if loads else None,
        max(speeds, default=None),
        math.hypot(*(sum(axis) for axis in zip(*impulses, strict=True))) if impulses else None,
    )


def _known(pieces: Sequence[dict[str, Any]], name: str) -> list[float]:
    return [float(piece[name]) for piece in pieces if piece[name] is not None and math.isfinite(piece[name])]
