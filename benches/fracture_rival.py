"""Break the same pane into the same count of closed pieces as the fastest open rival does, in one run.

The rival makes Voronoi cells with voro++ (multivoro) and a closed mesh of each with Manifold. Its cells are
convex and know no cracks; ours are grown. Run with ``python benches/fracture_rival.py`` after
``pip install multivoro manifold3d``; without multivoro it measures ours alone.
"""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np

import brisance as br
from brisance import _engine

THICKNESS = 0.003
OUTLINE = [np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])]
REPEATS = 5


def best_of(work: Callable[[], object]) -> float:
    """Shortest wall-clock time of a few runs [s]."""
    times = []
    for _ in range(REPEATS):
        started = time.perf_counter()
        work()
        times.append(time.perf_counter() - started)
    return min(times)


def ours(count: int) -> tuple[int, dict[str, float]]:
    """Pieces and times of the stages [s] of straight cracks, without the search for their critical length."""
    started = time.perf_counter()
    engine = br.fracture(br.Pattern(pieces=count, wiggle_probability=0.0), thickness=THICKNESS).engine
    searched = time.perf_counter() - started
    print(f"{count} pieces as asked for, search for the critical length included: {1e3 * searched:.1f} ms")
    halves = [_engine.fracture_stages(OUTLINE, engine) for _ in range(REPEATS)]
    solids = [engine.pieces(thickness=THICKNESS, density=2500.0).seconds for _ in range(REPEATS)]
    return len(engine), {
        "grow cracks": min(grow for grow, _ in halves),
        "find fragments": min(find for _, find in halves),
        "solid pieces": min(solids),
    }


def rival(count: int) -> float | None:
    """Time of Voronoi cells and their closed meshes [s]; None where the packages are missing."""
    try:
        import manifold3d
        import multivoro
    except ImportError:
        return None
    points = np.random.default_rng(1).uniform(size=(count, 3))
    # All in the middle plane: every cell goes through the pane.
    points[:, 2] = 0.5 * THICKNESS
    limits = np.array([[0.0, 0.0, 0.0], [1.0, 1.0, THICKNESS]])
    blocks = np.array([round((count / 5) ** 0.5)] * 2 + [1])

    def work() -> list[object]:
        cells = multivoro.compute_voronoi(points, limits=limits, radii=np.zeros(count), blocks=blocks)
        return [manifold3d.Manifold.hull_points(np.asarray(cell.get_vertices())) for cell in cells]

    return best_of(work)


def main() -> None:
    for count in (1_000, 10_000):
        pieces, stages = ours(count)
        total = sum(stages.values())
        shares = ", ".join(f"{name} {time / total:.0%}" for name, time in stages.items())
        print(f"{pieces} pieces: ours {1e3 * total:.1f} ms ({shares})")
        other = rival(count)
        if other is None:
            print("  multivoro is not installed: pip install multivoro")
        else:
            print(
                f"  voro++ and Manifold, {count} pieces: {1e3 * other:.1f} ms, {other / total:.1f} times ours"
            )


if __name__ == "__main__":
    main()
