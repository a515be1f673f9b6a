"""Time of ``brisance run scenes/brick_wall.toml`` as a whole process: the best of five, and its target.

Run with ``.venv/bin/python benches/run_process.py``. Exits with 1 where the target is missed.
"""

from __future__ import annotations

import json
import subprocess
import sys
import time
from pathlib import Path
from tempfile import TemporaryDirectory

SCENE = Path(__file__).resolve().parent.parent / "scenes" / "brick_wall.toml"
ROUNDS = 5
MOST_SECONDS = 1.0


def run_once(folder: Path) -> tuple[float, dict[str, float]]:
    """Run the scene into a folder; return the process's wall time [s] and the timings of its report [s]."""
    report = folder / "wall.json"
    brisance = Path(sys.executable).parent / "brisance"
    started = time.perf_counter()
    subprocess.run(
        [brisance, "run", SCENE, "-o", folder / "wall.usdc", "--report", report, "--quiet"], check=True
    )
    spent = time.perf_counter() - started
    return spent, json.loads(report.read_text(encoding="utf-8"))["timing_s"]


def main() -> int:
    """Print the best run and its parts; return 1 where the target is missed."""
    with TemporaryDirectory() as folder:
        runs = [run_once(Path(folder)) for _ in range(ROUNDS)]
    seconds, timing = min(runs, key=lambda run: run[0])
    engine = min(timings["load"] + timings["dynamics"] for _, timings in runs)
    met = seconds <= MOST_SECONDS
    print(
        f"brisance run {SCENE.name}: {seconds:.3f} s (at most {MOST_SECONDS:g}): {'met' if met else 'MISSED'}"
    )
    print(f"best engine load + dynamics: {engine:.4f} s")
    print("of the best run: " + ", ".join(f"{name} {value:.4f} s" for name, value in timing.items()))
    return 0 if met else 1


if __name__ == "__main__":
    sys.exit(main())
