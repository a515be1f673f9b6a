"""Time and size of USD results of thrown boxes: the best of three writes, and its target.

Bricks share one mesh; of fragments each has a mesh of its own.

Run with ``.venv/bin/python benches/usd_write.py``. Exits with 1 where a target is missed. With ``--blender``,
Blender's own exporter then writes the first case, which it has imported: the yardstick of the targets.
"""

from __future__ import annotations

import argparse
import math
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python" / "tests"))

from synthetic import box_mesh, synthetic_result

from brisance.formats.usd import write_usd

ROUNDS = 3

# Blender brings its own USD, so it has a process of its own.
EXPORT = """
import sys, time
import bpy
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.wm.usd_import(filepath=sys.argv[1])
started = time.perf_counter()
bpy.ops.wm.usd_export(filepath=sys.argv[2], export_animation=True)
print("SECONDS", time.perf_counter() - started)
"""


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


def measure_blender(case: Case, folder: Path) -> tuple[float, float]:
    """Return the time [s] and the file size [MB] of Blender's exporter for the case, as it imported it."""
    ours, theirs = folder / "ours.usdc", folder / "blender.usdc"
    result = synthetic_result(bodies=case.pieces, frames=case.frames, frame_rate=60.0)
    write_usd(result, ours, layout=case.layout)
    run = subprocess.run(
        [sys.executable, "-c", EXPORT, str(ours), str(theirs)], capture_output=True, text=True, check=True
    )
    seconds = next(line.split()[1] for line in run.stdout.splitlines() if line.startswith("SECONDS "))
    return float(seconds), theirs.stat().st_size / 1e6


def main() -> int:
    """Print one line a case; return 1 where a target is missed."""
    parser = argparse.ArgumentParser(description="Time and size of USD results.")
    parser.add_argument(
        "--blender", action="store_true", help="measure Blender's own exporter too (needs bpy)"
    )
    options = parser.parse_args()
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
        if options.blender:
            seconds, megabytes = measure_blender(CASES[0], Path(folder))
            print(f"Blender's exporter, the first case: {seconds:.3f} s, {megabytes:.2f} MB")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
