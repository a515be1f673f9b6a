"""Time until everything lies still: ten seconds of a brick wall, and a thousand shards of a window.

Run with ``.venv/bin/python benches/aftermath.py``: the best of three runs of each. Times are those of
``brisance.simulate``, loads and fracture included, writing left out. Exits with 1 where a target is missed or
something still moves in the end.
"""

from __future__ import annotations

import sys
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import brisance as br

SCENES = Path(__file__).resolve().parent.parent / "scenes"
ROUNDS = 3


@dataclass(frozen=True)
class Case:
    """A scene, what is changed in it, and what simulating it may take [s]."""

    scene: str
    changes: tuple[str, ...]
    most_seconds: float


CASES = (
    Case("brick_wall_aftermath.toml", ("time.duration=10",), 1.0),
    Case("brick_wall_aftermath.toml", (), 1.0),
    Case("car_park.toml", (), 1.0),
    Case("window_aftermath.toml", ("window.0.pattern.pieces=1000", "time.longest=60"), 10.0),
)


def main() -> int:
    """Print one line a case; return 1 where a target is missed."""
    missed = 0
    for case in CASES:
        times = []
        for _ in range(ROUNDS):
            scene = br.load(SCENES / case.scene, list(case.changes))
            started = time.perf_counter()
            result = br.simulate(scene)
            times.append(time.perf_counter() - started)
        rest = result.bodies.rest_time_s
        met = min(times) <= case.most_seconds and not np.isnan(rest).any()
        missed += not met
        name = " ".join((case.scene, *case.changes))
        print(
            f"{name}: {len(result.bodies)} pieces, {result.times[-1]:.2f} s of scene, "
            f"{np.isnan(rest).sum()} still moving, last at rest after {np.nanmax(rest):.2f} s: "
            f"{min(times):.3f} s (at most {case.most_seconds:g}): {'met' if met else 'MISSED'}",
            flush=True,
        )
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
