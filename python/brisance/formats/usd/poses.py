"""Recorded poses made ready for keys: continuous quaternions, and only the frames that carry motion."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def continuous(orientations: NDArray[np.float32]) -> NDArray[np.float32]:
    """Choose the sign of every quaternion so that interpolation between frames takes the short way.

    ``orientations`` is (frames, bodies, 4), w x y z. q and -q are the same rotation; the returned array has
    non-negative dot products from each frame to the next, and leaves frame 0 as it is.
    """
    dots = np.einsum("fbi,fbi->fb", orientations[1:], orientations[:-1])
    flips = dots < 0
    if not flips.any():
        return orientations
    signs = np.ones(orientations.shape[:2], dtype=np.float32)
    np.cumprod(np.where(flips, np.float32(-1), np.float32(1)), axis=0, out=signs[1:])
    return orientations * signs[:, :, None]


def carrying_frames(values: NDArray[np.generic]) -> NDArray[np.bool_]:
    """Which frames of which body are needed to reproduce the values by linear interpolation and holding.

    ``values`` is (frames, bodies, components); the answer is (frames, bodies). A body whose values never
    change needs no frame at all. Of one that moves, the first and last frame are kept, and of each constant
    stretch its two ends.
    """
    changed = np.zeros((len(values) - 1, values.shape[1]), dtype=np.bool_)
    for component in range(values.shape[2]):
        changed |= values[1:, :, component] != values[:-1, :, component]
    kept = np.zeros(values.shape[:2], dtype=np.bool_)
    kept[1:] = changed
    kept[:-1] |= changed
    moves = changed.any(axis=0)
    kept[0] |= moves
    kept[-1] |= moves
    return kept


def final_velocities(positions: NDArray[np.float32], frame_rate: float) -> NDArray[np.float32]:
    """Return (bodies, 3), the mean velocity over the last frame interval [m/s]; zero for a single frame."""
    if len(positions) < 2:
        return np.zeros(positions.shape[1:], dtype=np.float32)
    step = positions[-1].astype(np.float64) - positions[-2]
    velocities: NDArray[np.float32] = (step * frame_rate).astype(np.float32)
    return velocities


def final_spins(orientations: NDArray[np.float32], frame_rate: float) -> NDArray[np.float32]:
    """Return (bodies, 3), the mean angular velocity over the last frame interval in world axes [degrees/s].

    The rotation of a frame is taken the short way, so a body that turns by more than half a turn a frame is
    seen slower than it is.
    """
    if len(orientations) < 2:
        return np.zeros((orientations.shape[1], 3), dtype=np.float32)
    now, before = orientations[-1].astype(np.float64), orientations[-2].astype(np.float64)
    w, v = before[:, :1], -before[:, 1:]
    scalar = now[:, :1] * w - (now[:, 1:] * v).sum(axis=1, keepdims=True)
    vector = now[:, :1] * v + w * now[:, 1:] + np.cross(now[:, 1:], v)
    vector *= np.where(scalar < 0, -1.0, 1.0)
    sine = np.linalg.norm(vector, axis=1, keepdims=True)
    angle = 2 * np.arctan2(sine, np.abs(scalar))
    axis = np.divide(vector, sine, out=np.zeros_like(vector), where=sine > 0)
    spins: NDArray[np.float32] = np.degrees(axis * angle * frame_rate).astype(np.float32)
    return spins
