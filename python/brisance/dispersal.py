"""Where pieces end up: how many, and how much mass, against distance and direction, seen from above."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from brisance.result import Result

SECTORS = 8
"""Directions told apart, the first one about +x."""
MOVED = 0.01
"""A piece that ends nearer than this to where it began has not moved [m]."""


@dataclass(frozen=True, eq=False)
class Dispersal:
    """The pieces that moved, by how far and where they ended from the middle of where they began."""

    origin: NDArray[np.float64]
    """(2,) x and z of that middle [m]: the centre of mass of all pieces that moved, before the blast."""
    edges: NDArray[np.float64]
    """(rings + 1,) bounds of the rings of distance [m], from 0."""
    count: NDArray[np.int64]
    """(rings, sectors) pieces."""
    mass: NDArray[np.float64]
    """(rings, sectors) mass [kg]."""
    moved: NDArray[np.bool_]
    """(pieces,) whether a piece moved."""
    farthest: float
    """Distance of the farthest piece [m]; 0 if none moved."""
    half_mass: float
    """Half of the mass that moved ends within this distance [m]; 0 if none moved."""
    still_moving: int
    """How many of the pieces that moved had not come to rest in the last frame: they will end elsewhere."""


def dispersal(result: Result) -> Dispersal:
    """Count where the pieces of a result ended. Distances and directions are those seen from above."""
    start, end = (result.positions[i].astype(np.float64) for i in (0, -1))
    mass = result.bodies.mass_kg
    moved = np.linalg.norm(end - start, axis=1) > MOVED
    weights = mass[moved]
    origin = np.average(start[moved][:, [0, 2]], axis=0, weights=weights) if moved.any() else np.zeros(2)
    offset = end[moved][:, [0, 2]] - origin
    distance = np.hypot(offset[:, 0], offset[:, 1])
    farthest = float(distance.max(initial=0.0))
    edges = ring_edges(farthest)
    # Seen from above with x to the right, z points down: the angle grows from +x toward -z.
    angle = np.degrees(np.arctan2(-offset[:, 1], offset[:, 0]))
    ring = np.clip(np.searchsorted(edges, distance, side="right") - 1, 0, len(edges) - 2)
    sector = np.floor((angle + 180.0 / SECTORS) / (360.0 / SECTORS)).astype(int) % SECTORS
    count = np.zeros((len(edges) - 1, SECTORS), dtype=np.int64)
    masses = np.zeros(count.shape)
    np.add.at(count, (ring, sector), 1)
    np.add.at(masses, (ring, sector), weights)
    order = np.argsort(distance, kind="stable")
    total = np.cumsum(weights[order])
    half = float(distance[order][np.searchsorted(total, 0.5 * total[-1])]) if len(total) else 0.0
    still_moving = int(np.isnan(result.bodies.rest_time_s[moved]).sum())
    return Dispersal(origin, edges, count, masses, moved, farthest, half, still_moving)


def ring_edges(farthest: float) -> NDArray[np.float64]:
    """Bounds of rings in round numbers, 1, 2, 5, 10, ... times a power of ten, that hold ``farthest`` [m]."""
    edges = [0.0]
    step = 0.5
    while edges[-1] <= farthest or len(edges) < 3:
        edges.append(step)
        lead = round(step / 10.0 ** np.floor(np.log10(step)))
        step *= 2.5 if lead == 2 else 2.0
    return np.array(edges)


def summary(result: Result) -> dict[str, Any]:
    """The dispersal as the report has it."""
    found = dispersal(result)
    return {
        "origin_m": found.origin.tolist(),
        "moved": int(found.moved.sum()),
        "still_moving": found.still_moving,
        "moved_mass_kg": float(result.bodies.mass_kg[found.moved].sum()),
        "farthest_m": found.farthest,
        "half_mass_within_m": found.half_mass,
        "directions_deg": [360.0 / SECTORS * sector for sector in range(SECTORS)],
        "rings": [
            {
                "from_m": float(low),
                "to_m": float(high),
                "count": count.tolist(),
                "mass_kg": mass.tolist(),
            }
            for low, high, count, mass in zip(
                found.edges[:-1], found.edges[1:], found.count, found.mass, strict=True
            )
        ],
    }
