"""One connected, open or tangled part of a mesh made into a closed surface."""

from __future__ import annotations

import numpy as np

from brisance.objects.mesh.measure import areas, is_flat, volume
from brisance.objects.mesh.polygons import Indices, triangulate_loop
from brisance.objects.mesh.surface import Notes, Surface, joined
from brisance.objects.mesh.topology import Edges, border_loops, inconsistent, is_closed, parts

_LARGEST_CAP = 0.6
"""Area of what fills the holes, as a share of the part's own, above which it is a sheet, not a body."""
_MANY_PATCHES = 200
"""Parts of more patches than this are not searched for fins and inner walls."""


def close(part: Surface, notes: Notes) -> tuple[Surface, Surface]:
    """A closed surface for the part (its hull if need be, no triangles if flat), and the part rewound."""
    part = part.turn(inconsistent(part.triangles))
    if is_closed(part.triangles):
        return part, part
    trimmed = _without_fins(part)
    trimmed = trimmed.turn(inconsistent(trimmed.triangles))
    filled, holes = _filled(trimmed)
    if filled is not None:
        notes.fins += len(part.triangles) - len(trimmed.triangles)
        notes.hole_areas += holes
        return filled, part
    hull = part.hull()
    if not len(hull.triangles) or is_flat(volume(hull.points, hull.triangles), hull.points, hull.triangles):
        notes.flat_parts += 1
        return part.select(np.empty(0, np.int64)), part
    notes.hulls += 1
    return hull, part


def _without_fins(part: Surface) -> Surface:
    """The part without the patches that make three faces meet at an edge, smallest first.

    A patch is what holds together across edges of two faces. It goes if fewer edges have an odd number of
    faces without it, and if it is less than half of what there is.
    """
    while True:
        edges = Edges.of(part.triangles)
        if not (edges.uses > 2).any():
            return part
        patch = parts(part.triangles, edges=edges, two_sided=True)
        area = np.bincount(patch, weights=areas(part.points, part.triangles))
        if not 1 < len(area) <= _MANY_PATCHES:
            return part
        odd = _odd_edges(part.triangles)
        for candidate in np.argsort(area, kind="stable"):
            rest = part.select(patch != candidate)
            if area[candidate] < 0.5 * area.sum() and _odd_edges(rest.triangles) < odd:
                part = rest
                break
        else:
            return part


def _odd_edges(triangles: Indices) -> int:
    return int((Edges.of(triangles).uses % 2).sum())


def _filled(part: Surface) -> tuple[Surface | None, list[float]]:
    """The part with its holes filled, and the area of each filling [m²]; None if that makes no body."""
    loops = border_loops(part.triangles)
    lids = [Surface.new(part.points, loop[triangulate_loop(part.points[loop])]) for loop in loops]
    holes = [float(areas(lid.points, lid.triangles).sum()) for lid in lids]
    whole = joined([part, *lids])
    closed = is_closed(whole.triangles)
    if not closed or sum(holes) > _LARGEST_CAP * float(areas(part.points, part.triangles).sum()):
        return None, []
    return whole, holes
