"""Whether a recording will fit in memory, asked before any work is done."""

from __future__ import annotations

import os
import re
from pathlib import Path

from brisance.errors import ArgumentError, InputError

BYTES_A_POSE = 28
"""A position and a quaternion in single precision."""
BYTES_A_PIECE = 4096
"""Names, panels, loads and facts of one piece, rounded up."""
BYTES_A_TURN = 1024
"""The stretch of crack after a turn, and the corners that it gives the pieces on either side."""


def recording_bytes(frames: int, pieces: int) -> int:
    """Memory [bytes] that recording ``frames`` poses of ``pieces`` bodies needs."""
    return frames * (pieces * BYTES_A_POSE + 8) + pieces * BYTES_A_PIECE


def available_bytes() -> int | None:
    """Memory [bytes] this process may still take, as far as the system tells; None where it does not."""
    limits = [limit for limit in (_system_bytes(), _group_bytes()) if limit is not None]
    return min(limits, default=None)


def check_fits(frames: int, pieces: int) -> None:
    """Raise :class:`InputError`, saying how much is needed, unless a recording fits in memory."""
    needed, available = recording_bytes(frames, pieces), available_bytes()
    if available is not None and needed > available:
        noun = "piece" if pieces == 1 else "pieces"
        raise InputError(
            f"{frames:,} frames of {pieces:,} {noun} need {_amount(needed)} of memory and "
            f"{_amount(available)} are available; lower time.duration, "
            "time.frame_rate or the number of pieces, or give --frames."
        )


def most_pieces(frames: int, others: int) -> int | None:
    """How many pieces panes may break into, beside ``others``, so that ``frames`` of them fit in memory;
    None where the system does not tell.
    """
    available = available_bytes()
    if available is None:
        return None
    return max(0, (available - frames * 8) // (frames * BYTES_A_POSE + BYTES_A_PIECE) - others)


def check_pieces_fit(pieces: float, *, vertices: float = 0, asked_by: str) -> None:
    """Raise :class:`ArgumentError`, saying how much is needed, unless a broken pane fits in memory.

    ``vertices`` are those that random turns of the cracks add; ``asked_by`` is the argument to blame.
    """
    needed, available = pieces * BYTES_A_PIECE + vertices * BYTES_A_TURN, available_bytes()
    if available is not None and needed > available:
        turns = f" with {vertices:,.0f} turns in their cracks" if vertices else ""
        raise ArgumentError(
            asked_by,
            f"asks for about {pieces:,.0f} fragments{turns}, which need "
            f"{_amount(needed)} of memory, and {_amount(available)} are available; ask for fewer.",
        )


def _system_bytes() -> int | None:
    try:
        found = re.search(r"^MemAvailable:\s+(\d+) kB", Path("/proc/meminfo").read_text(), re.MULTILINE)
        if found:
            return int(found[1]) * 1024
    except OSError:
        pass
    try:
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, OSError, ValueError):
        return None


def _group_bytes() -> int | None:
    """What the control group (a container) leaves, if it sets a limit."""
    folder = Path("/sys/fs/cgroup")
    try:
        limit = (folder / "memory.max").read_text().strip()
        return int(limit) - int((folder / "memory.current").read_text()) if limit != "max" else None
    except (OSError, ValueError):
        return None


def _amount(size: float) -> str:
    for unit, scale in (("TB", 1e12), ("GB", 1e9), ("MB", 1e6)):
        if size >= scale:
            return f"{size / scale:,.1f} {unit}"
    return f"{size / 1e3:,.1f} kB"
