"""Triangles of a file without what is useless in them, and with near points joined."""

from __future__ import annotations

import numpy as np

from brisance.objects.mesh.measure import size
from brisance.objects.mesh.polygons import Indices, Points
from brisance.objects.mesh.surface import Notes, Surface
from brisance.objects.mesh.topology import Edges, is_closed, weld, weld_near

_GAPS = (1e-6, 1e-5, 1e-4)
"""Widths of gaps that are closed by moving points, as shares of the mesh's diagonal."""


def clean(points: Points, triangles: Indices, notes: Notes) -> Surface:
    """The triangles with equal points welded, without those that are useless or doubled."""
    sound = np.isfinite(points).all(axis=1)
    numbered = sound[triangles].all(axis=1)
    notes.not_numbers = int((~numbered).sum())
    points = np.where(sound[:, None], points, 0.0)
    everything = Surface(points, triangles, np.arange(len(triangles)), np.zeros(len(triangles), bool))
    finite = everything.select(numbered)
    welded = finite.with_vertices(weld(points)[finite.triangles])
    notes.without_area = len(finite.triangles) - len(welded.triangles)
    single = _without_doubles(welded)
    notes.doubled = len(welded.triangles) - len(single.triangles)
    return single


def _without_doubles(surface: Surface) -> Surface:
    """One triangle where several have the same corners.

    Two that face opposite ways are either a wall between two touching bodies, of which none is kept, or a
    surface modelled with two sides, of which one is kept; whether the rest is closed without them tells the
    cases apart.
    """
    triangles = surface.triangles
    if not len(triangles):
        return surface
    ranked = np.sort(triangles, axis=1)
    order = np.lexsort((ranked[:, 2], ranked[:, 1], ranked[:, 0]))
    fresh = np.ones(len(triangles), bool)
    fresh[1:] = (ranked[order][1:] != ranked[order][:-1]).any(axis=1)
    if fresh.all():
        return surface
    group = np.empty(len(triangles), np.int64)
    group[order] = np.cumsum(fresh) - 1
    a, b, c = triangles.T
    sense = np.where((a < b).astype(int) + (b < c) + (c < a) == 2, 1, -1)
    net = np.sign(np.bincount(group, weights=sense))
    agrees = (sense == net[group]) | (net[group] == 0)
    candidates = np.flatnonzero(agrees)
    _, first = np.unique(group[candidates], return_index=True)
    one_each = np.sort(candidates[first])
    without_walls = one_each[net[group[one_each]] != 0]
    if 0 < len(without_walls) < len(one_each) and is_closed(triangles[without_walls]):
        return surface.select(without_walls)
    return surface.select(one_each)


def join_gaps(surface: Surface, notes: Notes) -> Surface:
    """Points of the open border that nearly meet, joined where that leaves less of a border."""
    width = size(surface.points, surface.triangles)
    border, count = _border(surface.triangles)
    before = count
    for share in _GAPS:
        if not count:
            break
        target = weld_near(surface.points, border, share * width)
        closer = surface.with_vertices(target[surface.triangles])
        new_border, new_count = _border(closer.triangles)
        if new_count < count and len(closer.triangles):
            surface, border, count = closer, new_border, new_count
            notes.gap_width, notes.gaps = share * width, before - count
    return surface


def _border(triangles: Indices) -> tuple[Indices, int]:
    """Vertices of the edges that only one triangle has, and the number of those edges."""
    edges = Edges.of(triangles)
    single = np.flatnonzero(edges.uses[edges.edge] == 1)
    ends = np.concatenate([triangles.ravel()[single], np.roll(triangles, -1, axis=1).ravel()[single]])
    return np.unique(ends), len(single)
