"""Break a pane: the cracks, when each was cut, and the solid pieces they leave.

>>> import brisance as br
>>> broken = br.fracture(br.Pattern(pieces=300), width=1.0, height=1.0, seed=4)
>>> len(broken.polygons)
>>> broken.write("pane.usdc")
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from brisance import _engine
from brisance.errors import ArgumentError, InputError
from brisance.memory import check_pieces_fit
from brisance.model.pattern import Cracks, Pattern
from brisance.piece import PieceMesh
from brisance.prisms import piece_meshes

Array = NDArray[np.float64]

DEFAULT_PIECES = 500
"""Pieces of annealed and laminated glass when nothing is said of them."""
DICE = 0.007
"""Size of the dice of tempered glass when nothing is said of them [m]: EN 12150-1 asks for at least 40
on the coarsest square of 50 mm, and dice are not all alike (docs/fracture.md)."""
MATERIAL = "glass"
CRACK_LENGTH = 2.7
"""Length of all cracks over the root of the pane's area times its pieces, at most about."""
NEAR = 1e-6
"""A start this near to the border, as a share of the pane's longer side, is on it."""
SUFFIXES = (".svg", ".png", ".json", ".usdc", ".usda", ".usd", ".usdz")
"""Endings of the files that a broken pane can be written to."""


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

    @cached_property
    def meshes(self) -> list[PieceMesh]:
        """Of every fragment its closed mesh about its centre of mass [m], the pane facing +z.

        Texture coordinates are the place in the pane in metres; the group ``"broken"`` holds the faces that
        cracks cut, not those of the pane's own border.
        """
        return piece_meshes(self.engine, self.solids)

    @property
    def bounds(self) -> tuple[Array, Array]:
        """Lower left and upper right corner of the pane [m]."""
        return self.outline[0].min(axis=0), self.outline[0].max(axis=0)

    @property
    def positions(self) -> Array:
        """(fragments, 3) centres of mass [m], of a pane about the origin in the plane z = 0."""
        low, high = self.bounds
        flat = self.solids.centroid_m - 0.5 * (low + high)
        return np.column_stack([flat, np.zeros(len(flat))])

    def time(self, growth: ArrayLike) -> Array:
        """When the first cracks had grown so far [s]: thesis (5.6), integrated."""
        speed = _engine.material(MATERIAL)["crack_speed_m_s"]
        assert speed is not None
        # Dice are cut by a front at full speed; their critical length only says how large they are.
        critical = 0.0 if is_dice(self.pattern) else self.critical_length
        return _engine.crack_time(growth, terminal_speed=speed, critical_length=critical)

    def write(self, path: Path | str, *, size: tuple[int, int] | None = None) -> None:
        """Write the broken pane; the suffix says what: .svg or .png the cracks coloured by when they were
        cut, .json polygons and cracks, .usdc, .usda, .usd or .usdz the solid pieces.

        ``size`` is the width and height of a .png [pixels]; left out, as large as suits the pane. The same
        pane gives the same bytes, but for the time that a .json says it took.
        """
        suffix = check_output(path).suffix.lower()
        if suffix == ".svg":
            from brisance.formats.pattern_svg import write_pattern_svg

            write_pattern_svg(self, path)
        elif suffix == ".png":
            from brisance.formats.pattern_png import write_pattern_png

            write_pattern_png(self, path, size=size)
        elif suffix == ".json":
            from brisance.formats.pattern_json import write_pattern_json

            write_pattern_json(self, path)
        else:
            from brisance.formats.usd.pattern import write_pattern_usd

            write_pattern_usd(self, path)


def check_output(path: Path | str) -> Path:
    """Return the path, or raise :class:`InputError` unless a broken pane can be written there."""
    from brisance.formats.atomic import check_writable

    path = check_writable(path)
    if path.suffix.lower() not in SUFFIXES:
        raise InputError(
            f"{path} has no suffix that names a format; end it in .svg or .png (cracks), .json (polygons and "
            "cracks) or .usdc, .usda, .usd or .usdz (solid pieces)."
        )
    return path


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
    rings = rectangle(width, height) if outline is None else oriented(outline)
    area = sum(ring_area(ring) for ring in rings)
    _check_positive("thickness", thickness)
    if not (math.isfinite(area) and area > 0):
        raise ArgumentError("outline", f"must enclose a finite area above 0, not {area:g} m².")
    if not 0 <= seed < 2**63:
        raise ArgumentError("seed", f"must be a whole number from 0 to 2⁶³ − 1, not {seed}.")
    pattern = _resolved(pattern, area)
    low, high = rings[0].min(axis=0), rings[0].max(axis=0)
    seeds = low + np.array(pattern.seeds, dtype=float).reshape(-1, 2) * (high - low)
    _check_size(pattern, area, longer_side=float((high - low).max()), pieces=pattern.pieces)
    check_seeds(pattern, rings, seeds)
    try:
        engine = _engine.fracture(
            outline=rings, recipe=recipe(pattern, glass=pattern.glass, seeds=seeds, seed=seed)
        )
    except InputError as error:
        sentence = str(error)
        if sentence.startswith("the outline "):
            raise ArgumentError("outline", f"{sentence.removeprefix('the outline ')}.") from error
        raise InputError(f"{sentence}.") from error
    return Fracture(pattern, rings, thickness, seed, engine)


def recipe(cracks: Cracks, *, glass: str, seeds: Array, seed: int) -> dict[str, Any]:
    """How a pane breaks, as the engine is told; ``seeds`` (n, 2) are in the pane's plane [m]."""
    return {
        "glass": glass,
        "pieces": cracks.pieces,
        "critical_length": cracks.critical_length,
        "seeds": seeds,
        "starts": cracks.starts,
        "shape": cracks.shape,
        "literal": cracks.literal,
        "fork_angle": math.radians(cracks.fork_angle),
        "fork_variance": math.radians(cracks.fork_variance),
        "wiggle_probability": cracks.wiggle_probability,
        "wiggle_variance": math.radians(cracks.wiggle_variance),
        "wiggle_spacing": cracks.wiggle_spacing,
        "rings": cracks.rings,
        "reach": cracks.reach,
        "toward": None if cracks.toward is None else math.radians(cracks.toward),
        "seed": seed,
    }


def is_dice(pattern: Pattern) -> bool:
    """Whether a pane breaks into dice all over, as tempered glass does."""
    return pattern.glass == "tempered" and not pattern.literal


def _resolved(pattern: Pattern, area: float) -> Pattern:
    """The pattern with pieces or critical_length set, whichever way it says how finely to break."""
    if pattern.stress is not None:
        length = _engine.critical_length(material=MATERIAL, stress=pattern.stress)
        return pattern.model_copy(update={"stress": None, "critical_length": length})
    if pattern.critical_length is not None or pattern.pieces is not None:
        return pattern
    pieces = DEFAULT_PIECES
    if pattern.pressure is not None:
        pieces = round(area / _engine.mean_fragment_area(pressure=pattern.pressure)[0])
    elif is_dice(pattern):
        pieces = round(area / DICE**2)
    return pattern.model_copy(update={"pressure": None, "pieces": max(1, pieces)})


def rectangle(width: float, height: float) -> list[Array]:
    """The ring of a pane of ``width`` by ``height`` [m], its lower left corner at the origin."""
    _check_positive("width", width)
    _check_positive("height", height)
    return [np.array([[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]])]


def oriented(outline: Sequence[ArrayLike]) -> list[Array]:
    """Rings as arrays: the first counter-clockwise, others clockwise, a repeated last point dropped."""
    rings = []
    for index, ring in enumerate(outline):
        try:
            points = np.asarray(ring, dtype=float)
        except (TypeError, ValueError):
            points = np.empty(0)
        if points.ndim != 2 or points.shape[1] != 2 or len(points) < 3:
            raise ArgumentError("outline", "must be rings of three or more points x, y.")
        if np.array_equal(points[0], points[-1]):
            points = points[:-1]
        turned = (ring_area(points) > 0) == (index == 0)
        rings.append(np.ascontiguousarray(points if turned else points[::-1]))
    if not rings:
        raise ArgumentError("outline", "must have at least one ring of points.")
    return rings


def ring_area(ring: Array) -> float:
    x, y = (ring - ring[0]).T
    return float(0.5 * (x @ np.roll(y, -1) - y @ np.roll(x, -1)))


def _check_positive(argument: str, value: float) -> None:
    if not (math.isfinite(value) and value > 0):
        raise ArgumentError(argument, f"must be a finite number above 0, not {value:g}.")


def _check_size(pattern: Pattern, area: float, *, longer_side: float, pieces: int | None) -> None:
    """Refuse cracks longer than the pane, and more pieces or turns than memory holds."""
    length = pattern.critical_length
    if length is not None and length > longer_side:
        raise ArgumentError(
            "critical_length",
            f"must be at most the longer side of the pane, {longer_side:g} m, not {length:g}.",
        )
    count, asked_by = float(pieces or 0), "pieces"
    if length is not None:
        count, asked_by = max(1, len(pattern.seeds)) * math.sqrt(area) / length, "critical_length"
        if is_dice(pattern):
            count = area / length**2
    check_pieces_fit(count, asked_by=asked_by)
    check_pieces_fit(float(pattern.starts or 0), asked_by="starts")
    if pattern.wiggle_spacing is not None and not is_dice(pattern):
        # Cracks are about as long as the sides of so many squares, and a third more.
        turns = CRACK_LENGTH * math.sqrt(area * count) / pattern.wiggle_spacing
        check_pieces_fit(count, vertices=turns, asked_by="wiggle_spacing")


def check_seeds(pattern: Cracks, rings: list[Array], seeds: Array) -> None:
    """Refuse a start on the border, or in a notch or hole: an odd number of sides must lie to its right."""
    begin = np.concatenate(rings)
    side = np.concatenate([np.roll(ring, -1, axis=0) for ring in rings]) - begin
    near = NEAR * float(np.ptp(begin, axis=0).max())
    for share, seed in zip(pattern.seeds, seeds, strict=True):
        x, y = (seed - begin).T
        straddles = (y < 0) != (y < side[:, 1])
        right = side[:, 0] * y / np.where(straddles, side[:, 1], 1.0) > x
        length = np.maximum((side**2).sum(axis=1), np.finfo(float).tiny)
        foot = np.clip((x * side[:, 0] + y * side[:, 1]) / length, 0.0, 1.0)
        gap = np.hypot(x - foot * side[:, 0], y - foot * side[:, 1]).min()
        if (straddles & right).sum() % 2 == 0 or gap < near:
            raise ArgumentError(
                "seeds",
                f"{share[0]:g} {share[1]:g} lies outside the pane or on its border; give shares of width and "
                "height that lie inside it.",
            )
