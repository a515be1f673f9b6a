"""Break a pane: the cracks, when each was cut, and the solid pieces they leave.

>>> import brisance as br
>>> broken = br.fracture(br.Pattern(pieces=300), width=1.0, height=1.0, seed=4)
>>> len(broken.polygons)
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from brisance import _engine
from brisance.errors import InputError
from brisance.memory import check_pieces_fit
from brisance.model.pattern import Pattern

Array = NDArray[np.float64]

DEFAULT_PIECES = 500
"""Pieces of annealed and laminated glass when nothing is said of them."""
DICE = 0.007
"""Size of the dice of tempered glass when nothing is said of them [m]: EN 12150-1 asks for at least 40
on the coarsest square of 50 mm, and dice are not all alike (docs/fracture.md)."""
MATERIAL = "glass"


@dataclass(frozen=True, eq=False)
class Fracture:
    """A broken pane. Lengths [m] in the pane's plane, times [s] from when the first crack starts."""

    pattern: Pattern
    """What was asked for."""
    outline: list[Array]
    """Rings (n, 2) of the pane: the outer one counter-clockwise, holes clockwise."""
    thickness: float
    """Thickness of the pane [m]."""
    seed: int
    """Where the random draws came from."""
    engine: _engine.FracturePattern
    """The engine's own pattern."""

    @property
    def critical_length(self) -> float:
        """Critical length of the cracks [m]: the one asked for, or the one that gave the pieces asked for."""
        return self.engine.critical_length_m

    @cached_property
    def polygons(self) -> list[list[Array]]:
        """Of every fragment its rings (n, 2), the outline counter-clockwise and then holes clockwise [m]."""
        points = self.engine.vertices[self.engine.ring_vertices]
        rings = np.split(points, np.cumsum(self.engine.ring_sizes)[:-1])
        ends = np.cumsum(self.engine.rings_per_fragment)
        return [
            rings[end - count : end] for end, count in zip(ends, self.engine.rings_per_fragment, strict=True)
        ]

    @cached_property
    def closed_at(self) -> Array:
        """When the outline of every fragment was complete [s], (fragments,)."""
        return self.time(self.engine.closed_at_m)

    @cached_property
    def crack_times(self) -> Array:
        """When each end of every crack was cut [s], (cracks, 2)."""
        return self.time(self.engine.crack_growth_m)

    @cached_property
    def solids(self) -> _engine.Pieces:
        """Closed meshes, masses and panels of all fragments."""
        density = _engine.material(MATERIAL)["density_kg_m3"]
        assert density is not None
        return self.engine.pieces(thickness=self.thickness, density=density)

    def time(self, growth: ArrayLike) -> Array:
        """When the first cracks had grown so far [s]: thesis (5.6), integrated."""
        speed = _engine.material(MATERIAL)["crack_speed_m_s"]
        assert speed is not None
        # Dice are cut by a front at full speed; their critical length only says how large they are.
        critical = 0.0 if self.pattern.glass == "tempered" else self.critical_length
        return _engine.crack_time(growth, terminal_speed=speed, critical_length=critical)


def fracture(
    pattern: Pattern | None = None,
    *,
    width: float = 1.0,
    height: float = 1.0,
    outline: Sequence[ArrayLike] | None = None,
    thickness: float = 0.006,
    seed: int = 1,
) -> Fracture:
    """Break a pane of ``width`` by ``height`` [m], or of any ``outline``.

    ``outline`` is a list of rings (n, 2) [m], whichever way they run: the pane's and then those of its
    holes. The same arguments give the same bytes. Raises :class:`InputError` for what cannot be broken.
    """
    pattern = pattern or Pattern()
    rings = _rectangle(width, height) if outline is None else _rings(outline)
    area = sum(_area(ring) for ring in rings)
    for name, value in (("thickness", thickness), ("area of the pane", area)):
        if not (math.isfinite(value) and value > 0):
            raise InputError(f"{name} must be a finite number above 0, not {value:g}.")
    pieces = pattern.pieces
    if pieces is None and pattern.critical_length is None:
        pieces = max(1, round(area / DICE**2)) if pattern.glass == "tempered" else DEFAULT_PIECES
    check_pieces_fit(pieces or _expected_pieces(pattern, rings, area))
    low, high = rings[0].min(axis=0), rings[0].max(axis=0)
    shares = np.array(pattern.seeds, dtype=float).reshape(-1, 2)
    try:
        engine = _engine.fracture(
            outline=rings,
            glass=pattern.glass,
            pieces=pieces,
            critical_length=pattern.critical_length,
            seeds=low + shares * (high - low),
            shape=pattern.shape,
            literal=pattern.literal,
            fork_angle=math.radians(pattern.fork_angle),
            fork_variance=math.radians(pattern.fork_variance),
            wiggle_probability=pattern.wiggle_probability,
            wiggle_variance=math.radians(pattern.wiggle_variance),
            wiggle_spacing=pattern.wiggle_spacing,
            rings=pattern.rings,
            reach=pattern.reach,
            toward=None if pattern.toward is None else math.radians(pattern.toward),
            seed=seed,
        )
    except ValueError as error:
        raise InputError(f"{error}.") from error
    return Fracture(pattern, rings, thickness, seed, engine)


def _rectangle(width: float, height: float) -> list[Array]:
    for name, value in (("width", width), ("height", height)):
        if not (math.isfinite(value) and value > 0):
            raise InputError(f"{name} must be a finite number above 0, not {value:g}.")
    return [np.array([[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]])]


def _rings(outline: Sequence[ArrayLike]) -> list[Array]:
    """Rings as arrays: the first counter-clockwise, others clockwise, a repeated last point dropped."""
    rings = []
    for index, ring in enumerate(outline):
        points = np.asarray(ring, dtype=float)
        if points.ndim != 2 or points.shape[1] != 2 or len(points) < 3:
            raise InputError("outline must be rings of three or more points x, y.")
        if np.array_equal(points[0], points[-1]):
            points = points[:-1]
        turned = (_area(points) > 0) == (index == 0)
        rings.append(np.ascontiguousarray(points if turned else points[::-1]))
    if not rings:
        raise InputError("outline must have at least one ring of points.")
    return rings


def _area(ring: Array) -> float:
    x, y = (ring - ring[0]).T
    return float(0.5 * (x @ np.roll(y, -1) - y @ np.roll(x, -1)))


def _expected_pieces(pattern: Pattern, rings: list[Array], area: float) -> int:
    """About how many pieces a critical length gives, to see beforehand whether they fit in memory."""
    assert pattern.critical_length is not None
    if pattern.glass == "tempered" and not pattern.literal:
        return int(min(area / pattern.critical_length**2, 1e18))
    return int(min(max(1, len(pattern.seeds)) * math.sqrt(area) / pattern.critical_length, 1e18))
