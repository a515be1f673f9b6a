"""Time and size of USD results of thrown boxes: the best of three writes, and its target.

Bricks share one mesh; of fragments each has a mesh of its own.

Run with ``.venv/bin/python benches/usd_write.py``. Exits with 1 where a target is missed.
"""

from __future__ import annotations

import math
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python" / "tests"))

from synthetic import box_mesh, synthetic_result

from brisance.formats.usd import write_usd

ROUNDS = 3


@dataclass(frozen=True)
class Case:
    """One result to write, and what that may take."""

    pieces: int
    frames: int
    layout: str
    fragments: bool = False
    most_seconds: float = math.inf
    most_megabytes: float = math.inf


CASES = (
    Case(1_000, 121, "prims", most_seconds=1.2),
    Case(1_000, 121, "prims", fragments=True, most_seconds=1.2),
    Case(1_000, 121, "instancer", most_seconds=0.15, most_megabytes=4.0),
    Case(1_000, 121, "instancer", fragments=True, most_megabytes=4.0),
    Case(10_000, 240, "instancer", most_seconds=3.0),
    Case(10_000, 240, "instancer", fragments=True, most_seconds=3.0),
)


def measure(case: Case, path: Path) -> tuple[float, float]:
    """Return the shortest time [s] and the file size [MB] of writing the case."""
    times = []
    for _ in range(ROUNDS):
        meshes = [box_mesh() for _ in range(case.pieces)] if case.fragments else None
        result = synthetic_result(bodies=case.pieces, frames=case.frames, frame_rate=60.0, meshes=meshes)
        started = time.perf_counter()
        write_usd(result, path, layout=case.layout)
        times.append(time.perf_counter() - started)
    return min(times), path.stat().st_size / 1e6


def at_most(limit: float) -> str:
    """Say a limit, or nothing where there is none."""
    return f" (at most {limit:g})" if math.isfinite(limit) else ""


def main() -> int:
    """Print one line a case; return 1 where a target is missed."""
    missed = 0
    with TemporaryDirectory() as folder:
        for case in CASES:
            seconds, megabytes = measure(case, Path(folder) / "result.usdc")
            met = seconds <= case.most_seconds and megabytes <= case.most_megabytes
            missed += not met
            kind = "fragments" if case.fragments else "bricks"
            print(
                f"{case.pieces:6d} {kind:9s} x {case.frames} frames, {case.layout:9s}: "
                f"{seconds:.3f} s{at_most(case.most_seconds)}, "
                f"{megabytes:.2f} MB{at_most(case.most_megabytes)}: {'met' if met else 'MISSED'}"
            )
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
