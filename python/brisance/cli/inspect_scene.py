"""A scene as tables: its charges, its objects, and what each charge does to each object."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from brisance import _engine
from brisance.cli.table import Cell, count, table
from brisance.curve_table import curve_source
from brisance.model import Charge, Scene
from brisance.piece import PieceMesh
from brisance.rotation import rotate
from brisance.scene_file import load, named_in_errors
from brisance.simulation import Built, build

_OBJECTS = ("object", "kind", "pieces", "mass kg", "centre m", "anchored")
_BLAST = ("object", "charge", "nearest m", "Z m/kg^1/3", "arrival ms", "overpressure kPa", "reflected kPa")


def describe(path: Path, changes: list[str]) -> str:
    """The scene in a file, as text."""
    scene = load(path, changes)
    with named_in_errors(path):
        built = build(scene)
    start = built.engine.standing()
    centres, orientations = start["centre_m"], start["orientation"]
    count_now = sum(len(group) for group in built.standing)
    time, ground = scene.time, scene.ground
    lasting = f"until all rests, at most {time.longest:g} s" if time.until_rest else f"{time.end:g} s"
    parts = [
        f"{scene.name}: {count(len(scene.charges), 'charge')}, {count(len(scene.objects), 'object')}, "
        f"{count(count_now, 'piece')}{' before panes break' if built.windows else ''}",
        f"{count(time.frames, 'frame')}: {lasting} at {time.frame_rate:g} frames/s; "
        + (f"ground at y = {ground.height:g} m" if ground else "no ground")
        + f"; {scene.loading.mode} loading, clearing {scene.loading.clearing}, seed {scene.seed}",
        "",
        _charges(scene),
        "",
        _objects(scene, built, centres, start["mass_kg"]),
        "",
        _blast(scene, built, centres, orientations),
    ]
    parts += [f"warning: {warning}" for warning in built.warnings]
    return "\n".join(parts)


def _charges(scene: Scene) -> str:
    header = ("charge", "explosive", "mass kg", "TNT kg", "position m", "burst", "time s", "gain", "curves")
    rows = [
        (
            f"charge.{number}",
            charge.explosive or (f"{charge.tnt_equivalence:g} x TNT" if charge.tnt_equivalence else "TNT"),
            charge.mass,
            charge.mass * charge.factor,
            _point(charge.position),
            charge.burst,
            charge.time,
            charge.gain,
            charge.curves,
        )
        for number, charge in enumerate(scene.charges)
    ]
    return table(header, rows)


def _objects(scene: Scene, built: Built, centres: NDArray[np.float64], mass: NDArray[np.float64]) -> str:
    rows: list[tuple[Cell, ...]] = []
    start = 0
    for obj, group in zip([*scene.objects, *built.windows], built.standing, strict=True):
        own = slice(start, start := start + len(group))
        if not len(group):
            continue
        middle = np.average(centres[own], axis=0, weights=mass[own])
        frame = group.name != obj.name
        anchored = "yes" if obj.anchored or frame else "no"
        kind = "frame" if frame else obj.kind
        rows.append((group.name, kind, len(group), float(mass[own].sum()), _point(middle.tolist()), anchored))
    return table(_OBJECTS, rows)


def _blast(
    scene: Scene, built: Built, centres: NDArray[np.float64], orientations: NDArray[np.float64]
) -> str:
    rows: list[tuple[Cell, ...]] = []
    start = 0
    meshes = [mesh for group in built.standing for mesh in group.meshes]
    for group in built.standing:
        own = range(start, start := start + len(group))
        if not len(group):
            continue
        for number, charge in enumerate(scene.charges):
            distance = min(_distance(charge, meshes[body], centres[body], orientations[body]) for body in own)
            at = _blast_at(scene, charge, distance)
            rows.append(
                (
                    group.name,
                    f"charge.{number}",
                    distance,
                    at["scaled_distance_m_kg13"],
                    1e3 * (charge.time + at["arrival_time_s"]),
                    at["overpressure_pa"] / 1e3,
                    at["reflected_pressure_pa"] / 1e3,
                )
            )
    return table(_BLAST, rows)


def _distance(
    charge: Charge, mesh: PieceMesh, centre: NDArray[np.float64], orientation: NDArray[np.float64]
) -> float:
    """From a charge to the box around a body [m]; bricks and blocks are that box."""
    w, x, y, z = orientation
    own = rotate((w, -x, -y, -z), np.asarray(charge.position) - centre)
    points = mesh.points
    return float(np.linalg.norm(own - np.clip(own, points.min(axis=0), points.max(axis=0))))


def _blast_at(scene: Scene, charge: Charge, distance: float) -> dict[str, float]:
    columns = _engine.curves(
        mass=charge.mass,
        distance=np.array([max(distance, 1e-6)]),
        tnt_equivalence=charge.factor,
        burst=charge.burst,
        source=curve_source(charge.curves, base_folder=scene.base_folder),
        pressure=scene.air.pressure,
        temperature=scene.air.temperature,
    )
    keys = ("scaled_distance_m_kg13", "arrival_time_s", "overpressure_pa", "reflected_pressure_pa")
    return {key: float(columns[key][0]) for key in keys}


def _point(point: tuple[float, ...] | list[float]) -> str:
    return " ".join(f"{round(value, 4) + 0.0:g}" for value in point)
