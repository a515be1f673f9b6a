"""What docs/fracture.md measures on broken panes, as numbers and as the tables of the page."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np
from numpy.typing import NDArray

import brisance as br
from brisance.figures import cracks

Array = NDArray[np.float64]

SEEDS = range(1, 11)
"""Every distribution is taken over the patterns of these seeds together."""
FIG_5_14 = br.Pattern(
    literal=True,
    shape="segment",
    critical_length=cracks.CRITICAL_LENGTH,
    wiggle_probability=1.0,
    wiggle_variance=cracks.WIGGLE,
    wiggle_spacing=cracks.CRITICAL_LENGTH,
)
"""The thesis's rule and settings."""
FORKING = {"rings": 0.0}
"""What the two rules of forking are compared with: the same star, and nothing but the cracks that fork."""


@dataclass(frozen=True)
class Case:
    """One way to break a pane."""

    name: str
    pattern: br.Pattern
    side: float = 1.0
    """Side of the square pane [m]."""

    @cached_property
    def panes(self) -> list[br.Fracture]:
        """The pane broken once for every seed."""
        return [br.fracture(self.pattern, width=self.side, height=self.side, seed=seed) for seed in SEEDS]

    @cached_property
    def relative_area(self) -> Array:
        """Area of every fragment over the mean of its pane."""
        return np.concatenate([pane.solids.area_m2 / pane.solids.area_m2.mean() for pane in self.panes])

    @cached_property
    def aspect(self) -> Array:
        """Length over width of every fragment."""
        return np.concatenate([pane.solids.aspect_ratio for pane in self.panes])

    @cached_property
    def vertices(self) -> NDArray[np.intp]:
        """Corners of every fragment."""
        return np.concatenate([cracks.vertices_per_fragment(pane) for pane in self.panes])

    @cached_property
    def fork_angles(self) -> Array:
        """Angle between the two branches of every fork [degrees]."""
        return np.concatenate([fork_angles(pane) for pane in self.panes])

    @cached_property
    def crowding(self) -> Array:
        """Fragments in the fullest of a pane's hundred equal squares, over the mean, for every pane.

        Squares within a fifth of the pane's side from the middle are left out: cracks start there.
        """
        return np.array([_fullest(pane, self.side) for pane in self.panes])


THESIS = Case("thesis, Fig. 5.14", FIG_5_14)
LITERAL = Case("literal", br.Pattern(literal=True, pieces=500, **FORKING))
DRIVEN = Case("driven", br.Pattern(pieces=500, **FORKING))
ANNEALED = Case("annealed, 500", br.Pattern(pieces=500))
FLAWS = Case("annealed, 5000", br.Pattern(pieces=5000))
TEMPERED = Case("tempered", br.Pattern(glass="tempered"), side=0.5)
CASES = (THESIS, ANNEALED, FLAWS, TEMPERED)


def fork_angles(pane: br.Fracture) -> Array:
    """Angle between the branches wherever a crack has two that start at its end [degrees]."""
    ends, parents = pane.engine.crack_ends, pane.engine.crack_parents
    goes_on = np.zeros(len(ends), dtype=bool)
    known = parents >= 0
    goes_on[known] = np.all(ends[known, :2] == ends[parents[known], 2:], axis=1)
    branches = np.flatnonzero(goes_on)
    branches = branches[np.argsort(parents[branches], kind="stable")]
    parent = parents[branches]
    first = np.flatnonzero(parent[1:] == parent[:-1])
    step = ends[:, 2:] - ends[:, :2]
    a, b = step[branches[first]], step[branches[first + 1]]
    return np.degrees(np.abs(np.arctan2(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0], (a * b).sum(axis=1))))


def _fullest(pane: br.Fracture, side: float) -> float:
    share = pane.solids.centroid_m / side
    cell = np.minimum((10 * share).astype(int), 9)[np.abs(share - 0.5).max(axis=1) > 0.2]
    return float(np.bincount(10 * cell[:, 0] + cell[:, 1]).max() / (len(share) / 100))


def survivors(values: Array) -> tuple[Array, Array]:
    """Values in order, and the share that is at least as large."""
    order = np.sort(values)
    return order, 1.0 - np.arange(len(order)) / len(order)


def slope(relative_area: Array) -> float:
    """Slope of cumulative number over area on log–log paper, from a hundredth of the mean area to it."""
    area, share = survivors(relative_area)
    between = (area > 0.01) & (area < 1.0)
    return float(np.polyfit(np.log(area[between]), np.log(share[between]), 1)[0])


def dice_counts(pane: br.Fracture, side: float) -> Array:
    """Dice in squares of 50 mm as EN 12150-1 counts them: those across the edge of a square as halves.

    Squares stand side by side, and as in the standard none lies within 25 mm of the pane's edge or 100 mm of
    where the crack started.
    """
    square, counts = 0.05, []
    rings = [piece[0] for piece in pane.polygons]
    low, high = np.array([r.min(axis=0) for r in rings]), np.array([r.max(axis=0) for r in rings])
    for x in np.arange(0.025, side - 0.025 - square + 1e-9, square):
        for y in np.arange(0.025, side - 0.025 - square + 1e-9, square):
            corner, opposite = np.array([x, y]), np.array([x, y]) + square
            nearest = np.clip(0.5 * side, corner, opposite)
            if np.linalg.norm(nearest - 0.5 * side) < 0.1:
                continue
            inside = np.all((low >= corner) & (high <= opposite), axis=1)
            near = np.all((low < opposite) & (high > corner), axis=1) & ~inside
            across = [i for i in np.flatnonzero(near) if _reaches(rings[i], corner, opposite)]
            counts.append(np.count_nonzero(inside) + 0.5 * len(across))
    return np.array(counts)


def _reaches(ring: Array, low: Array, high: Array) -> bool:
    """Whether a polygon reaches into a box: what is left when it is cut by the box's four sides."""
    for axis, sign, limit in ((0, 1.0, low[0]), (0, -1.0, -high[0]), (1, 1.0, low[1]), (1, -1.0, -high[1])):
        depth = sign * ring[:, axis] - limit
        after = np.roll(depth, -1)
        pieces = []
        for point, follower, here, there in zip(ring, np.roll(ring, -1, axis=0), depth, after, strict=True):
            if here >= 0.0:
                pieces.append(point)
            if here * there < 0.0:
                pieces.append(point + (follower - point) * here / (here - there))
        if len(pieces) < 3:
            return False
        ring = np.array(pieces)
    return True


@cache
def tables() -> tuple[tuple[str, ...], ...]:
    """The tables of the page, line by line."""
    return (_counts(), _shapes(), _forking(), _dice(), _times())


def _counts() -> tuple[str, ...]:
    pane = cracks.wiggling_and_varied()
    vertices = cracks.vertices_per_fragment(pane)
    branching = _thousands(cracks.branching_vertices(pane))
    return (
        "| | thesis | ours |",
        "|---|---|---|",
        f"| fragments | 271 | {len(vertices)} |",
        f"| vertices, once for every fragment | 21 459 | {_thousands(vertices.sum())} |",
        f"| branching vertices, once for every fragment | 1 447 | {branching} |",
        f"| triangles of the front | 20 917 | {_thousands(pane.solids.counts[:, 1].sum())} |",
        f"| vertices of one fragment | 3 to 250 | {vertices.min()} to {vertices.max()} |",
    )


def _thousands(number: int) -> str:
    return f"{number:,}".replace(",", " ")


def _shapes() -> tuple[str, ...]:
    lines = [
        "| | fragments | largest / mean area | median / mean area | slope | aspect, median "
        "| aspect, 9 in 10 below | fork angle, middle half | vertices, median | vertices, most |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for case in CASES:
        angles = case.fork_angles
        # Dice do not fork.
        forks = "–" if len(angles) < 100 else "{:.0f}° to {:.0f}°".format(*np.quantile(angles, (0.25, 0.75)))
        fragments = np.mean([len(pane.polygons) for pane in case.panes])
        area = case.relative_area
        lines.append(
            f"| {case.name} | {fragments:.0f} | {area.max():.0f} | {np.median(area):.2f} | {slope(area):.2f} "
            f"| {np.median(case.aspect):.1f} | {np.quantile(case.aspect, 0.9):.1f} | {forks} "
            f"| {np.median(case.vertices):.0f} | {case.vertices.max()} |"
        )
    return tuple(lines)


def _forking() -> tuple[str, ...]:
    lines = [
        "| rule of forking | fragments | smaller than a hundredth of the mean | median / mean area "
        "| fullest square / mean square, median | worst of ten |",
        "|---|---|---|---|---|---|",
    ]
    for case in (LITERAL, DRIVEN):
        area, count = case.relative_area, np.mean([len(pane.polygons) for pane in case.panes])
        lines.append(
            f"| {case.name} | {count:.0f} | {100 * np.mean(area < 0.01):.0f} % | {np.median(area):.2f} "
            f"| {np.median(case.crowding):.1f} | {case.crowding.max():.1f} |"
        )
    return tuple(lines)


def _dice() -> tuple[str, ...]:
    counts = np.concatenate([dice_counts(pane, TEMPERED.side) for pane in TEMPERED.panes])
    return (
        "| dice on a square of 50 mm | least | median | most |",
        "|---|---|---|---|",
        f"| {len(counts)} squares | {counts.min():g} | {np.median(counts):g} | {counts.max():g} |",
    )


def _times() -> tuple[str, ...]:
    lines = ["| | last crack ends | half of the fragments closed |", "|---|---|---|"]
    for case in (THESIS, ANNEALED, FLAWS, TEMPERED):
        last = np.median([pane.crack_times.max() for pane in case.panes])
        half = np.median([np.median(pane.closed_at) for pane in case.panes])
        lines.append(f"| {case.name}, {case.side:g} m | {1e3 * last:.2f} ms | {1e3 * half:.2f} ms |")
    return tuple(lines)
