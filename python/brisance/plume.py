"""How the pieces of a broken pane fly, in a few numbers: the plume they make, and how fast they turn.

Seen from the side, the pieces of a window make a plume (thesis 6.6). Its **length** is the distance between
the 5th and the 95th percentile of how far they have come along the blast. Its **width** is twice the rms
distance from the plume's axis of the half that has come farthest. The axis runs along the blast through the
middle of that half, so that a plume that falls as a whole does not grow wider.

Pieces count by their mass. All have the pane's thickness, so that is by the area that is seen; by number, the
many splinters too small to be seen would decide. Pieces that never come free are no part of the plume.

Plumes are compared where they have come equally far in the mean, not at equal times: of two plumes alike but
for their speed, the faster one is longer at any time.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from brisance.errors import ArgumentError

if TYPE_CHECKING:
    from brisance.result import Pane, Result

Array = NDArray[np.float64]

FIRST, LAST = 0.05, 0.95
"""Shares of the mass between which the length is taken."""
FAR = 0.5
"""Share of the mass, that which has come farthest, over which the width is taken."""


@dataclass(frozen=True)
class Plume:
    """The pieces of a pane at one moment."""

    time_s: float
    """When [s]."""
    mean_travel_m: float
    """How far they have come along the blast in the mean [m]."""
    length_m: float
    """Distance along the blast between the 5th and the 95th percentile [m]."""
    width_m: float
    """Twice the rms distance from the axis of the half that has come farthest [m]."""


def free_pieces(result: Result, pane: Pane) -> NDArray[np.intp]:
    """Which bodies are pieces of a pane that have come free by the last frame."""
    until = result.bodies.free_time_s[pane.start : pane.stop]
    return pane.start + np.flatnonzero(until <= result.times[-1])


def blast_axis(result: Result, pane: Pane) -> Array:
    """Unit vector (3,) from the nearest charge to the middle of a pane."""
    away = np.asarray(pane.window.position) - np.array([charge.position for charge in result.scene.charges])
    nearest = away[np.argmin(np.linalg.norm(away, axis=1))]
    return np.asarray(nearest / np.linalg.norm(nearest))


def travels(result: Result, pane: Pane, pieces: NDArray[np.intp]) -> Array:
    """(F, n) how far pieces of a pane have come along the blast at each frame [m]."""
    moved = result.positions[:, pieces].astype(np.float64) - result.positions[0, pieces]
    return np.asarray(moved @ blast_axis(result, pane))


def plume(result: Result, pane: Pane, *, travel: float, pieces: NDArray[np.intp] | None = None) -> Plume:
    """The plume of a pane at the moment when its pieces have come ``travel`` [m] along the blast in the mean.

    ``pieces`` are the numbers of the bodies that make it, all that come free if left out. Between two frames
    they move evenly. Raises :class:`ArgumentError` where they never come so far, or where there are none.
    """
    chosen = free_pieces(result, pane) if pieces is None else pieces
    if not len(chosen):
        raise ArgumentError("pane", f"{pane.name} has no piece that comes free.")
    mass, moved = result.bodies.mass_kg[chosen], travels(result, pane, chosen)
    mean = np.average(moved, axis=1, weights=mass)
    after = int(np.argmax(mean >= travel))
    if not travel > 0.0 or mean[after] < travel:
        raise ArgumentError("travel", f"must be above 0 and at most {mean.max():.3g} m, not {travel:g}.")
    part = (travel - mean[after - 1]) / (mean[after] - mean[after - 1])

    def between(values: NDArray[np.floating[Any]]) -> Array:
        return np.asarray((1.0 - part) * values[after - 1] + part * values[after], dtype=np.float64)

    now = between(moved)
    return Plume(
        time_s=float(between(result.times)),
        mean_travel_m=travel,
        length_m=length(now, mass),
        width_m=width(between(result.positions[:, chosen]), now, mass, blast_axis(result, pane)),
    )


def length(travel: Array, mass: Array) -> float:
    """Distance between the 5th and the 95th percentile of ``travel`` (n,) [m], weighted by ``mass`` (n,)."""
    low, high = quantiles(travel, mass, np.array([FIRST, LAST]))
    return float(high - low)


def width(positions: Array, travel: Array, mass: Array, axis: Array) -> float:
    """Twice the rms distance of the far half from its own axis [m].

    ``positions`` (n, 3) [m], ``travel`` (n,) [m] how far each has come along the unit vector ``axis`` (3,).
    """
    far = travel >= quantiles(travel, mass, np.array([1.0 - FAR]))[0]
    off = positions[far] - np.average(positions[far], axis=0, weights=mass[far])
    across = (off**2).sum(axis=1) - (off @ axis) ** 2
    return float(2.0 * np.sqrt(np.average(np.maximum(across, 0.0), weights=mass[far])))


def quantiles(values: Array, weights: Array, shares: Array) -> Array:
    """The values (k,) below which ``shares`` (k,) of the weight lie.

    Each value counts as the middle of its own weight.
    """
    order = np.argsort(values, kind="stable")
    heights = np.cumsum(weights[order]) - 0.5 * weights[order]
    return np.asarray(np.interp(shares * weights.sum(), heights, values[order]))


def angular_speeds(result: Result, pane: Pane) -> Array:
    """(F - 1, n) mean angular speed of each free piece between frames [rad/s].

    Read off the orientations, so it is the true one only below half a turn a frame, π times the frame rate.
    """
    turned = result.orientations[:, free_pieces(result, pane)].astype(np.float64)
    # By the chord between unit quaternions, of which both signs are one rotation: the arc cosine of their
    # product would lose small turns to rounding.
    before, after = turned[:-1], turned[1:]
    chord = np.minimum(np.linalg.norm(after - before, axis=2), np.linalg.norm(after + before, axis=2))
    return np.asarray(4.0 * np.arcsin(np.minimum(0.5 * chord, 1.0)) * result.frame_rate)
