"""How triangles hang together: welding, edges, connected parts, winding, open borders.

All of it works on index arrays at once, so that a mesh of half a million faces takes about a second.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from brisance.objects.mesh.polygons import Indices, Points


def weld(points: Points) -> Indices:
    """For each point (n, 3), the index of the first point at exactly the same place."""
    clean = points + 0.0  # turns -0.0 into 0.0
    order = np.lexsort((clean[:, 2], clean[:, 1], clean[:, 0]))
    ranked = clean[order]
    fresh = np.ones(len(points), bool)
    fresh[1:] = (ranked[1:] != ranked[:-1]).any(axis=1)
    first = order[np.flatnonzero(fresh)]
    target = np.empty(len(points), np.int64)
    target[order] = first[np.cumsum(fresh) - 1]
    return target


def weld_near(points: Points, candidates: Indices, distance: float) -> Indices:
    """For each point (n, 3), a point it may be joined to: candidates nearer than ``distance`` [m] share one.

    Two points share a cell of at least one of four cubic grids, shifted along the diagonal by a quarter of a
    cell, whenever they are nearer than a quarter of a cell: each axis can part them in one of the grids only.
    """
    cell = 4.0 * distance
    chosen = points[candidates]
    links: list[tuple[Indices, Indices]] = []
    for shift in range(4):
        cells = np.floor(chosen / cell + 0.25 * shift)
        links.append((np.arange(len(candidates)), weld(cells)))
    label = connected(
        len(candidates), np.concatenate([a for a, _ in links]), np.concatenate([b for _, b in links])
    )
    target = np.arange(len(points))
    target[candidates] = candidates[label]
    return target


def connected(count: int, first: Indices, second: Indices) -> Indices:
    """For ``count`` things joined in pairs ``first``, ``second``, the lowest number in each one's group."""
    label = np.arange(count)
    while True:
        a, b = label[first], label[second]
        differ = a != b
        if not differ.any():
            return label
        np.minimum.at(label, np.maximum(a, b)[differ], np.minimum(a, b)[differ])
        while True:
            jump = label[label]
            if np.array_equal(jump, label):
                break
            label = jump


@dataclass(frozen=True, eq=False)
class Edges:
    """The edges of triangles (t, 3). Half-edge ``h`` is side ``h % 3`` of triangle ``h // 3``."""

    edge: Indices
    """(3 t,) the edge each half-edge lies on."""
    forward: NDArray[np.bool_]
    """(3 t,) whether the half-edge runs from the lower to the higher vertex."""
    uses: Indices
    """(e,) triangles on each edge."""

    @classmethod
    def of(cls, triangles: Indices) -> Edges:
        """Finds them; the triangles have three different corners each."""
        start, end = triangles.ravel(), np.roll(triangles, -1, axis=1).ravel()
        low, high = np.minimum(start, end), np.maximum(start, end)
        span = int(high.max(initial=0)) + 1
        _, edge, uses = np.unique(low * span + high, return_inverse=True, return_counts=True)
        return cls(edge.reshape(-1), start < end, uses)

    def unbalanced(self) -> NDArray[np.bool_]:
        """(e,) edges not run through as often one way as the other: a surface without any is closed."""
        turns = np.bincount(self.edge, weights=np.where(self.forward, 1.0, -1.0), minlength=len(self.uses))
        result: NDArray[np.bool_] = turns != 0.0
        return result

    def neighbours(self, *, two_sided: bool) -> tuple[Indices, Indices]:
        """Pairs of half-edges next to each other on an edge; ``two_sided``: on simple edges only."""
        order = np.argsort(self.edge, kind="stable")
        ranked = self.edge[order]
        same = ranked[1:] == ranked[:-1]
        if two_sided:
            same &= self.uses[ranked[1:]] == 2
        return order[:-1][same], order[1:][same]


def is_closed(triangles: Indices) -> bool:
    """Whether every edge is run through as often one way as the other."""
    return not bool(Edges.of(triangles).unbalanced().any())


def parts(triangles: Indices, *, edges: Edges | None = None, two_sided: bool = False) -> Indices:
    """(t,) number of the part of each triangle, joined across edges, in order of first triangles.

    With ``two_sided`` an edge that more than two triangles share joins nothing.
    """
    a, b = (edges or Edges.of(triangles)).neighbours(two_sided=two_sided)
    _, number = np.unique(connected(len(triangles), a // 3, b // 3), return_inverse=True)
    return number.reshape(-1)


def solid_parts(points: Points, triangles: Indices) -> Indices:
    """(t,) number of the solid each triangle of a closed surface bounds, in order of their first triangles.

    Where more than two triangles meet in an edge, those that bound the same wedge of solid belong together,
    so that bodies that only touch come apart.
    """
    edges = Edges.of(triangles)
    a, b = edges.neighbours(two_sided=True)
    pairs = [np.stack([a, b], axis=1), np.empty((0, 2), np.int64)]
    crowded = np.flatnonzero(edges.uses[edges.edge] > 2)
    crowded = crowded[np.argsort(edges.edge[crowded], kind="stable")]
    if len(crowded):
        angle = _angles_about_edges(points, triangles, edges, crowded)
        groups = np.split(np.arange(len(crowded)), np.flatnonzero(np.diff(edges.edge[crowded])) + 1)
        for group in groups:
            pairs += _wedges(crowded[group], angle[group], edges.forward[crowded[group]])
    joined = np.concatenate(pairs) // 3
    _, number = np.unique(connected(len(triangles), joined[:, 0], joined[:, 1]), return_inverse=True)
    return number.reshape(-1)


def _angles_about_edges(points: Points, triangles: Indices, edges: Edges, half: Indices) -> Points:
    """Angle [rad] about its edge, from lower to higher vertex, at which each half-edge's triangle lies.

    Angles less than a millionth apart come out equal, unless they lie at the ends of the range.
    """
    face, side = half // 3, half % 3
    start, end = triangles[face, side], triangles[face, (side + 1) % 3]
    low, high = np.where(edges.forward[half], start, end), np.where(edges.forward[half], end, start)
    along = points[high] - points[low]
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    across = np.cross(along, np.eye(3)[np.argmin(np.abs(along), axis=1)])
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    arm = points[triangles[face, (side + 2) % 3]] - points[low]
    angle = np.arctan2(
        np.einsum("hi,hi->h", arm, np.cross(along, across)), np.einsum("hi,hi->h", arm, across)
    )
    rounded: Points = np.round(angle, 6)
    return rounded


def _wedges(half: Indices, angle: Points, forward: NDArray[np.bool_]) -> list[Indices]:
    """Pairs (1, 2) of half-edges on one edge between whose triangles there is solid.

    Going round the edge, a triangle that runs backward along it opens a wedge of solid and one that runs
    forward closes one; where both lie at one angle, the closing one comes first.
    """
    order = np.lexsort((~forward, angle))
    depth = np.cumsum(np.where(forward[order], -1, 1))
    order = np.roll(order, -(int(np.argmin(depth)) + 1))
    opened: list[int] = []
    pairs: list[Indices] = []
    for number in order.tolist():
        if not forward[number]:
            opened.append(number)
        elif opened:
            pairs.append(half[[opened.pop(), number]].reshape(1, 2))
    return pairs


def inconsistent(triangles: Indices) -> NDArray[np.bool_]:
    """(t,) which triangles to turn so that neighbours agree on the outside; of each patch the smaller share.

    Patches end at edges of more than two triangles. A one-sided surface (Moebius) has no answer and is left
    as it is.
    """
    count = len(triangles)
    edges = Edges.of(triangles)
    a, b = edges.neighbours(two_sided=True)
    clash = edges.forward[a] == edges.forward[b]
    face_a, face_b = a // 3, b // 3
    # Each triangle stands twice, as it is and turned; neighbours join the copies that agree.
    label = connected(
        2 * count,
        np.concatenate([face_a, face_a + count]),
        np.concatenate([face_b + count * clash, face_b + count * ~clash]),
    )
    as_is, turned = label[:count], label[count:]
    patch = np.minimum(as_is, turned)
    turn = turned < as_is
    share = np.bincount(patch, weights=turn, minlength=count) / np.maximum(
        np.bincount(patch, minlength=count), 1
    )
    result: NDArray[np.bool_] = (turn ^ (share[patch] > 0.5)) & (as_is != turned)
    return result


def border_loops(triangles: Indices) -> list[Indices]:
    """Closed loops of vertices along the open border, wound so that a face over one continues the surface.

    A border that does not close (its surface has edges of three faces, or neighbours that disagree) gives no
    loop.
    """
    edges = Edges.of(triangles)
    open_half = np.flatnonzero(edges.uses[edges.edge] == 1)
    start = triangles.ravel()[open_half]
    end = np.roll(triangles, -1, axis=1).ravel()[open_half]
    onward: dict[int, list[int]] = {}
    for source, target in zip(end.tolist(), start.tolist(), strict=True):
        onward.setdefault(source, []).append(target)
    loops: list[Indices] = []
    for first in onward:
        path, place = [first], {first: 0}
        while onward.get(path[-1]):
            target = onward[path[-1]].pop()
            if target not in place:
                place[target] = len(path)
                path.append(target)
                continue
            at = place[target]
            if len(path) - at > 2:
                loops.append(np.array(path[at:], np.int64))
            for vertex in path[at + 1 :]:
                del place[vertex]
            del path[at + 1 :]
    return loops
