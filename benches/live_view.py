"""How fast the live view is: the message, its parts, and the picture in a browser without a graphics card.

Run with ``python benches/live_view.py`` after ``make viewer chromium``. The first table is the server's: time
to simulate and to pack, bytes a piece and frame. The second drives Chromium, which draws in software here: a
graphics card is far faster, so read the triangles and draw calls, which are the same everywhere.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

import brisance as br
from brisance.formats.packed import pack, read
from brisance.result import Result

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "python" / "tests"))

from shattered import shattered_pane  # noqa: E402

REPEATS = 5
T = TypeVar("T")


def timed(work: Callable[[], T]) -> tuple[float, T]:
    """Shortest time of a few runs [ms], and what the last one gave."""
    best, given = float("inf"), None
    for _ in range(REPEATS):
        started = time.perf_counter()
        given = work()
        best = min(best, 1e3 * (time.perf_counter() - started))
    assert given is not None
    return best, given


def wall(rows: int, columns: int) -> br.Scene:
    """The brick wall of the example, larger."""
    scene = br.load(ROOT / "scenes" / "brick_wall.toml")
    large = scene.objects[0].model_copy(update={"rows": rows, "columns": columns})
    return scene.model_copy(update={"objects": (large,)})


def row(name: str, result: Result, simulated: float) -> str:
    """One line of the server's table."""
    packed, message = timed(lambda: pack(result))
    known = read(message)[0]["geometry"]
    again, shorter = timed(lambda: pack(result, known=known))
    _, arrays = read(message)
    frames, pieces = result.positions.shape[:2]
    a_pose = arrays["poses"].nbytes / pieces / frames
    return (
        f"{name:<22}{pieces:>8}{frames:>8}{simulated:>10.1f}{packed:>10.1f}{again:>10.1f}"
        f"{len(message) / 1e6:>10.2f}{len(shorter) / 1e6:>10.2f}{a_pose:>10.2f}"
    )


def main() -> None:
    """Print both tables."""
    print(f"{'server':<22}{'pieces':>8}{'frames':>8}{'simulate':>10}{'pack':>10}{'again':>10}", end="")
    print(f"{'MB':>10}{'MB again':>10}{'B a pose':>10}")
    for name, rows, columns in (("brick wall", 6, 4), ("1 000 bricks", 25, 40), ("10 000 bricks", 80, 125)):
        scene = wall(rows, columns)
        simulated, result = timed(lambda scene=scene: br.simulate(scene))  # type: ignore[misc]
        print(row(name, result, simulated))
    panes = {
        name: shattered_pane(pieces=pieces, frames=frames)
        for name, pieces, frames in (("1 000 shards", 1000, 61), ("10 000 shards", 10_000, 121))
    }
    for name, result in panes.items():
        print(row(name, result, float("nan")))
    print("\nbrowser, drawn in software, 1280 x 800")
    with tempfile.TemporaryDirectory() as folder:
        files = {"brick wall": br.simulate(wall(6, 4)), "10 000 bricks": br.simulate(wall(80, 125)), **panes}
        pages = []
        for name, result in files.items():
            page = Path(folder) / f"{name.replace(' ', '_')}.html"
            result.write(page)
            pages.append({"name": name, "file": str(page)})
        command = ["node", str(ROOT / "viewer" / "test" / "measure.mjs"), json.dumps(pages)]
        subprocess.run(command, check=True)


if __name__ == "__main__":
    main()
