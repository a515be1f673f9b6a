"""A window: the bars of its frame, its pane, and the pieces that the blast leaves of it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from brisance import _engine
from brisance.errors import ArgumentError, InputError
from brisance.model import Window, WindowPattern
from brisance.objects.block import box_mesh
from brisance.outline import read_outline
from brisance.pane import DICE, MATERIAL, check_seeds, oriented, recipe, rectangle, ring_area
from brisance.piece import PieceMesh, PieceSet
from brisance.prisms import piece_meshes
from brisance.rotation import rotate

Array = NDArray[np.float64]

BAR_FACE = 0.04
"""Width of a frame's bars beside the glass [m]."""
BAR_DEPTH = 0.05
"""By how much the bars are deeper than the glass is thick [m]."""
BAR_DENSITY = 700.0
"""Density of the bars [kg/m³]; they never move."""
BEVEL = 0.002
"""Bevel of the bars' edges [m]."""
CELLS = 24
"""Cells of a whole pane's mesh along its longer side, enough to show how it bends."""


@dataclass(frozen=True, eq=False)
class Glazing:
    """A window ready for the engine."""

    window: Window
    rings: list[Array]
    """Rings (n, 2) of the pane about the middle of its bounding box [m]."""


def glazing(window: Window, *, base_folder: Path) -> Glazing:
    """Read the outline of a window and check what it says of its pane."""
    if window.outline is None:
        assert window.size is not None
        rings = rectangle(*window.size)
    else:
        rings = _outline(window, base_folder)
    low, high = rings[0].min(axis=0), rings[0].max(axis=0)
    middle = 0.5 * (low + high)
    rings = [ring - middle for ring in rings]
    if window.frame and window.bite >= 0.5 * float((high - low).min()):
        raise InputError(
            f"window {window.name!r}: bite must be less than half the smaller side of its outline, "
            f"{0.5 * float((high - low).min()):.3g} m, not {window.bite:g}."
        )
    try:
        check_seeds(window.pattern, rings, seeds(window.pattern, rings))
    except ArgumentError as error:
        raise InputError(f"window {window.name!r}: pattern.{error}") from None
    return Glazing(window, rings)


def _outline(window: Window, base_folder: Path) -> list[Array]:
    given = window.outline
    assert given is not None
    read: Sequence[ArrayLike] = (
        read_outline(base_folder / given) if isinstance(given, str) else [np.array(given)]
    )
    rings = oriented(read)
    if not sum(ring_area(ring) for ring in rings) > 0:
        raise InputError(f"window {window.name!r}: outline must enclose an area above 0.")
    for ring in rings:
        if (ring == np.roll(ring, 1, axis=0)).all(axis=1).any():
            raise InputError(f"window {window.name!r}: outline has a point twice in turn; keep it once.")
    return rings


def seeds(pattern: WindowPattern, rings: list[Array]) -> Array:
    """Where cracks start (n, 2) [m]."""
    low, high = rings[0].min(axis=0), rings[0].max(axis=0)
    return np.asarray(low + np.array(pattern.seeds, dtype=float).reshape(-1, 2) * (high - low))


def frame_pieces(glazed: Glazing, *, name: str, seed: int) -> PieceSet:
    """The bars of a window's frame, none without one; handing them over hands over its pane as well."""
    window = glazed.window
    bars = _bars(glazed) if window.frame else []
    turn = np.array(window.orientation())

    def add_to(engine: _engine.Scene) -> None:
        assembly = _add_bars(engine, window, bars, turn) if bars else None
        engine.add_window(
            outline=glazed.rings,
            thickness=window.thickness,
            position=window.position,
            orientation=window.orientation(),
            strength=window.limit,
            recipe=recipe(
                _fineness(glazed), glass=window.glass, seeds=seeds(window.pattern, glazed.rings), seed=seed
            ),
            release=window.release,
            bite=window.bite if window.frame else None,
            facade=window.wall_around,
            assembly=assembly,
            behaviour=window.behaviour(),
        )

    return PieceSet(
        name=f"{name}_frame",
        material=window.frame_material,
        names=[f"{name}_frame_{number}" for number in range(len(bars))],
        meshes=[box_mesh(bar.size, min(BEVEL, 0.1 * min(bar.size))) for bar in bars],
        add_to=add_to,
    )


def _fineness(glazed: Glazing) -> WindowPattern:
    """The pattern with the dice of tempered glass counted, where nothing is said of them."""
    window, pattern = glazed.window, glazed.window.pattern
    if window.glass != "tempered" or pattern.literal:
        return pattern
    if pattern.pieces is not None or pattern.critical_length is not None:
        return pattern
    area = sum(ring_area(ring) for ring in glazed.rings)
    return pattern.model_copy(update={"pieces": max(1, round(area / DICE**2))})


@dataclass(frozen=True)
class _Bar:
    """A bar of a frame in the window's frame."""

    size: tuple[float, float, float]
    centre: tuple[float, float, float]
    angle: float
    """Of its length from +x, about +z [rad]."""


def _bars(glazed: Glazing) -> list[_Bar]:
    """A bar along each side of the outline.

    Round a rectangle each runs to the outside and the next butts on it.
    """
    window, ring = glazed.window, glazed.rings[0]
    beyond, depth = BAR_FACE, window.thickness + BAR_DEPTH
    bars = []
    for index, start in enumerate(ring):
        end = ring[(index + 1) % len(ring)]
        length = math.dist(start, end)
        along = (end - start) / length
        outward = np.array([along[1], -along[0]])
        first, last = -beyond, length - window.bite
        if not _is_rectangle(ring):
            # Elsewhere bars overlap a little at corners, so that no gap shows.
            first, last = -0.25 * beyond, length + 0.25 * beyond
        face = beyond + window.bite
        centre = start + along * (0.5 * (first + last)) + outward * (0.5 * face - window.bite)
        bars.append(
            _Bar(
                (float(last - first), face, depth),
                (float(centre[0]), float(centre[1]), 0.0),
                math.atan2(along[1], along[0]),
            )
        )
    return bars


def _is_rectangle(ring: Array) -> bool:
    """Whether a ring is an upright rectangle that starts at its lower left corner."""
    low, size = ring.min(axis=0), np.ptp(ring, axis=0)
    return len(ring) == 4 and np.allclose(ring, low + np.array([[0, 0], [1, 0], [1, 1], [0, 1]]) * size)


def _add_bars(engine: _engine.Scene, window: Window, bars: list[_Bar], turn: Array) -> int | None:
    """Hand over the bars; return the number of their assembly."""
    size = np.array([bar.size for bar in bars])
    return engine.add_boxes(
        size=size,
        position=rotate(turn, np.array([bar.centre for bar in bars])) + np.array(window.position),
        orientation=np.array([_turned(turn, bar.angle) for bar in bars]),
        mass=BAR_DENSITY * size.prod(axis=1),
        buried=np.zeros((len(bars), 6), dtype=np.bool_),
        assembly=True,
        behaviour={**window.behaviour(), "anchored": True, "can_rotate": False, "lift_coefficient": None},
    )


def _turned(turn: Array, angle: float) -> tuple[float, float, float, float]:
    """The quaternion of a turn about +z followed by ``turn``."""
    w, x, y, z = turn.tolist()
    c, s = math.cos(0.5 * angle), math.sin(0.5 * angle)
    return w * c - z * s, x * c + y * s, y * c - x * s, z * c + w * s


def pane_pieces(window: Window, pane: _engine.Pane, *, name: str) -> PieceSet:
    """The pieces of a window's pane after a run, all of it in one where it held.

    The engine has them already.
    """
    meshes = piece_meshes(pane.pattern, pane.pieces)
    return PieceSet(
        name=name,
        material=MATERIAL,
        names=[name] if len(meshes) == 1 else [f"{name}_{number}" for number in range(len(meshes))],
        meshes=meshes,
        warnings=[f"{name}: {warning}." for warning in pane.warnings],
    )


def whole_mesh(rings: list[Array], thickness: float) -> PieceMesh:
    """A closed mesh of a whole pane about its own origin [m], fine enough to bend."""
    corners, faces = _cells(rings)
    count = len(corners)
    border: dict[tuple[int, int], None] = {}
    for face in faces:
        for one, two in zip(face, [*face[1:], face[0]], strict=True):
            if (two, one) in border:
                del border[(two, one)]
            else:
                border[(one, two)] = None
    half = 0.5 * thickness
    points = np.concatenate([np.column_stack([corners, np.full(count, z)]) for z in (half, -half)])
    back = [[count + corner for corner in reversed(face)] for face in faces]
    sides = [[two, one, one + count, two + count] for one, two in border]
    whole = [*faces, *back, *sides]
    return PieceMesh(
        points=points.astype(np.float32),
        face_counts=np.array([len(face) for face in whole], dtype=np.int32),
        face_indices=np.array([corner for face in whole for corner in face], dtype=np.int32),
        uvs=np.concatenate([points[face, :2] - corners.min(axis=0) for face in whole]).astype(np.float32),
    )


def _cells(rings: list[Array]) -> tuple[Array, list[list[int]]]:
    """Corners (n, 2) [m] and counter-clockwise cells that fill a pane."""
    low, size = rings[0].min(axis=0), np.ptp(rings[0], axis=0)
    if len(rings) > 1 or not _is_rectangle(rings[0]):
        # Any partition will do; the dice of tempered glass are one of any outline.
        pattern = _engine.fracture(
            outline=rings,
            recipe=recipe(WindowPattern(pieces=200), glass="tempered", seeds=np.empty((0, 2)), seed=1),
        )
        ends = np.cumsum(pattern.ring_sizes)
        cells = np.split(pattern.ring_vertices.astype(int), ends[:-1])
        return pattern.vertices, [cell.tolist() for cell in cells]
    across, up = (max(2, round(CELLS * (side / size.max()))) for side in size)
    x, y = np.meshgrid(np.linspace(0, 1, across + 1), np.linspace(0, 1, up + 1))
    corners = low + np.column_stack([x.ravel(), y.ravel()]) * size
    first = [row * (across + 1) + column for row in range(up) for column in range(across)]
    return corners, [[c, c + 1, c + across + 2, c + across + 1] for c in first]
