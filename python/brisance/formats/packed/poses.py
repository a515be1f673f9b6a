"""Poses in 12 bytes each, and only while a piece moves.

Word k of a pose (k = 0, 1, 2) holds, from the low end, 18 bits of coordinate k, 13 bits of a component of the
orientation, and a bit of the number of the component that is left out (none in word 2).

- **Position**: a coordinate is counted in steps from the low corner of the box that the piece's centre moves
  in; the box is 2^18 - 1 steps wide. The error is at most half a step: 0.2 mm for a flight of 100 m.
- **Orientation**: "smallest three". Of a unit quaternion the largest component is left out and made positive
  (q and -q are the same rotation); the others lie within ±1/√2 and are counted in 2^13 - 1 steps. Each errs
  by at most half a step, 8.6e-5; the component left out, at least 1/2, errs by at most three times that. So
  the rotation errs by less than :data:`WORST_TURN`: 0.03 degrees, 0.3 mm at half a metre from the centre.

A piece has poses from its last frame at rest to its first frame at its final pose; a viewer holds the first
and the last.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from brisance.errors import InputError

POSITION_STEPS = 2**18 - 1
TURN_STEPS = 2**13 - 1
WORST_TURN = 6e-4
"""Bound on the error of an orientation [rad]: twice the length √12 · 8.6e-5 of the quaternion's error."""

FARTHEST = 1e15
"""Distance [m] from the origin beyond which a place is an overflow and no flight."""

ROW = 1024
"""Poses in one row of the table, which is padded to whole rows: a texture's width."""
MOST_POSES = ROW * 8192
"""Frames times pieces beyond which the table would be higher than textures may be."""


@dataclass(frozen=True, eq=False)
class Poses:
    """The packed poses of B pieces."""

    table: NDArray[np.uint32]
    """(rows, ROW, 3) words, piece after piece; the end of the last row is padding."""
    offset: NDArray[np.int64]
    """(B,) number of the piece's first pose in the table."""
    first: NDArray[np.int64]
    """(B,) frame of its first pose."""
    count: NDArray[np.int64]
    """(B,) its poses, 1 or more."""
    low: NDArray[np.float32]
    """(B, 3) low corner of its box [m]."""
    size: NDArray[np.float32]
    """(B, 3) extent of its box [m]."""


def pack_poses(positions: NDArray[np.float32], orientations: NDArray[np.float32]) -> Poses:
    """Pack (F, B, 3) positions [m] and (F, B, 4) unit quaternions, F and B at least 1 and 0.

    Raises :class:`InputError` for pieces that are nowhere, as absurd masses and sizes make them.
    """
    if not (np.abs(positions) < FARTHEST).all() or not np.isfinite(orientations).all():
        raise InputError(
            "In this scene pieces fly farther than can be shown; look for a mass, size or position out of "
            "all proportion."
        )
    first, last = moving(positions, orientations)
    count = last - first + 1
    offset = np.cumsum(count) - count
    total = int(count.sum())
    piece = np.repeat(np.arange(len(count)), count)
    frame = np.arange(total) - np.repeat(offset - first, count)
    low, size = positions.min(axis=0), np.ptp(positions, axis=0)
    steps = np.divide(POSITION_STEPS, size, out=np.zeros(size.shape), where=size > 0)
    scaled = (positions[frame, piece].astype(np.float64) - low[piece]) * steps[piece]
    words = np.clip(np.rint(scaled), 0, POSITION_STEPS).astype(np.uint32)
    left_out, turns = smallest_three(orientations[frame, piece])
    words |= turns << np.uint32(18)
    words[:, 0] |= (left_out & np.uint32(1)) << np.uint32(31)
    words[:, 1] |= (left_out >> np.uint32(1)) << np.uint32(31)
    table = np.zeros((max(1, -(-total // ROW)) * ROW, 3), dtype=np.uint32)
    table[:total] = words
    return Poses(table.reshape(-1, ROW, 3), offset, first, count, low, size)


def unpack_poses(poses: Poses, frame: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """(B, 3) positions [m] and (B, 4) unit quaternions of a frame, as a viewer decodes them."""
    place = poses.offset + np.clip(frame - poses.first, 0, poses.count - 1)
    words = poses.table.reshape(-1, 3)[place]
    steps = (words & np.uint32(POSITION_STEPS)).astype(np.float64)
    positions = poses.low + steps / POSITION_STEPS * poses.size
    turns = ((words >> np.uint32(18)) & np.uint32(TURN_STEPS)).astype(np.float64)
    three = (turns / TURN_STEPS * 2.0 - 1.0) * np.sqrt(0.5)
    left_out = (words[:, 0] >> np.uint32(31)) + 2 * (words[:, 1] >> np.uint32(31))
    orientations = np.empty((len(words), 4))
    rest = np.sqrt(np.maximum(0.0, 1.0 - (three**2).sum(axis=1)))
    for number in range(4):
        chosen = left_out == number
        others = [component for component in range(4) if component != number]
        orientations[np.ix_(chosen, others)] = three[chosen]
        orientations[chosen, number] = rest[chosen]
    return positions, orientations


def moving(
    positions: NDArray[np.float32], orientations: NDArray[np.float32]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """(B,) last frame of each piece at its initial pose, and first frame at its final pose, both before any
    other; equal for a piece that never moves.
    """
    frames = len(positions)
    changed = (np.diff(positions, axis=0) != 0).any(axis=2) | (np.diff(orientations, axis=0) != 0).any(axis=2)
    moves = changed.any(axis=0)
    first = np.where(moves, changed.argmax(axis=0) if frames > 1 else 0, 0)
    last = np.where(moves, frames - 1 - changed[::-1].argmax(axis=0) if frames > 1 else 0, 0)
    return first.astype(np.int64), last.astype(np.int64)


def smallest_three(
    quaternions: NDArray[np.float32],
) -> tuple[NDArray[np.uint32], NDArray[np.uint32]]:
    """(n,) number of the component left out and (n, 3) the others in steps of :data:`TURN_STEPS`."""
    q = quaternions.astype(np.float64)
    q /= np.linalg.norm(q, axis=1, keepdims=True)
    left_out = np.abs(q).argmax(axis=1)
    rows = np.arange(len(q))
    q *= np.where(q[rows, left_out] < 0, -1.0, 1.0)[:, None]
    others = np.array([[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]])[left_out]
    three = np.take_along_axis(q, others, axis=1)
    steps = np.rint((three * np.sqrt(2.0) + 1.0) / 2.0 * TURN_STEPS)
    return left_out.astype(np.uint32), np.clip(steps, 0, TURN_STEPS).astype(np.uint32)
