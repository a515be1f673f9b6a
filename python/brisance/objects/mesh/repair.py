"""Any triangle soup made into one closed surface with faces outwards, and a word about everything done to it.

In order: corners that are not numbers, faces without area and doubled faces are dropped; gaps of rounding
size are closed; each connected part is given one winding, freed of fins and inner walls, and its holes are
filled; parts are turned outwards (a part inside another stays a cavity if it is wound as one); parts that
overlap or touch are united. A surface that still crosses itself is replaced by the outline of what it
encloses, a part that stays open by its convex hull. A sound mesh, concave or not, comes out with its own
triangles.
"""

from __future__ import annotations

from dataclasses import dataclass

import manifold3d
import numpy as np
from numpy.typing import NDArray

from brisance.errors import InputError
from brisance.objects.mesh.clean import clean, join_gaps
from brisance.objects.mesh.close import close
from brisance.objects.mesh.columns import Columns, outline
from brisance.objects.mesh.measure import areas, is_flat, mesh_contains, size, volume
from brisance.objects.mesh.polygons import Indices, Points
from brisance.objects.mesh.surface import NEW, Notes, Surface, joined
from brisance.objects.mesh.topology import Edges, is_closed, parts, solid_parts

_COLUMNS = 96
_CROSSED = 1e-3
"""Share of the volume that must be crossed before a surface is taken apart; less is a matter of rounding."""
_LARGEST = 1e7
"""Widest mesh taken [m]."""
_MANY_PARTS = 1000
"""More open parts than this (leaves) share one convex hull; more parts at all are not sorted into nests."""


@dataclass(frozen=True, eq=False)
class RepairedMesh:
    """A closed surface for the physics, and what became of the triangles it was made from."""

    points: Points
    """(n, 3) [m]."""
    triangles: Indices
    """(t, 3), counter-clockwise seen from outside; each edge is run through as often one way as the other."""
    kept: NDArray[np.bool_]
    """(t0,) triangles given that are worth showing: not those without area, doubled, or without a place."""
    turned: NDArray[np.bool_]
    """(t0,) triangles given that have to be turned to look outwards."""
    clauses: list[str]
    """What was done, in words, without the file's name; empty if nothing was."""


def repair(points: Points, triangles: Indices, *, label: str) -> RepairedMesh:
    """Closes and turns outwards what ``triangles`` (t0, 3) between ``points`` (n, 3) [m] bound.

    ``label`` names the mesh in errors. Raises :class:`InputError` for a mesh that is empty, flat or wider
    than 10⁷ m.
    """
    notes = Notes()
    surface = clean(points, triangles, notes)
    if not len(surface.triangles):
        if notes.not_numbers:
            raise InputError(
                f"{label} has no face that can be used: {notes.not_numbers} of its {len(triangles)} have a "
                "corner that is not a finite number; export it anew"
            )
        raise InputError(f"{label} is empty: it has no face with an area; give a mesh with faces")
    width = size(surface.points, surface.triangles)
    if width > _LARGEST:
        raise InputError(f"{label} is {width:.3g} m across, above the limit of 1e7 m; make its scale smaller")
    kept = np.zeros(len(triangles), bool)
    kept[surface.source] = True
    turned = np.zeros(len(triangles), bool)

    solids: list[Surface] = []
    for solid, shown in _solids(join_gaps(surface, notes), notes):
        _record_turned(turned, shown)
        solids += _apart(solid)
    notes.whole_hull = notes.hulls == len(solids) == 1
    solids, inverted = _outwards(solids)
    turned[inverted] ^= True
    _count_turned(turned, kept, notes)
    result = _free_of_crossings(_united(solids, notes), notes) if solids else None
    if result is None or not _is_body(result):
        result = surface.hull()
        notes = Notes(whole_hull=True, doubled=notes.doubled, not_numbers=notes.not_numbers)
        if not _is_body(result):
            raise InputError(f"{label} is flat: it encloses no volume; give a mesh with some thickness")
    notes.enclosed = volume(result.points, result.triangles)
    used, index = np.unique(result.triangles, return_inverse=True)
    return RepairedMesh(result.points[used], index.reshape(-1, 3), kept, turned, notes.clauses())


def _is_body(surface: Surface) -> bool:
    """Whether a closed surface encloses a volume worth the name, its faces outwards."""
    if not len(surface.triangles):
        return False
    enclosed = volume(surface.points, surface.triangles)
    return enclosed > 0.0 and not is_flat(enclosed, surface.points, surface.triangles)


def _solids(surface: Surface, notes: Notes) -> list[tuple[Surface, Surface]]:
    """For each connected part, a closed surface (no triangles if flat) and the part as wound for showing."""
    edges = Edges.of(surface.triangles)
    part = parts(surface.triangles, edges=edges)
    flawed = edges.unbalanced()[edges.edge].reshape(-1, 3).any(axis=1)
    is_open = np.bincount(part, weights=flawed) > 0
    order = np.argsort(part, kind="stable")
    members = np.split(order, np.flatnonzero(np.diff(part[order])) + 1)
    found: list[tuple[Surface, Surface]] = []
    if is_open.sum() > _MANY_PARTS:
        together = surface.select(is_open[part])
        notes.hulls += int(is_open.sum())
        found.append((together.hull(), together))
        members = [group for group, opened in zip(members, is_open, strict=True) if not opened]
        is_open = np.zeros(len(members), bool)
    for group, opened in zip(members, is_open, strict=True):
        solid = surface.select(group)
        found.append(close(solid, notes) if opened else (solid, solid))
    return found


def _apart(closed: Surface) -> list[Surface]:
    """A closed surface as one for each solid it bounds."""
    if not (Edges.of(closed.triangles).uses > 2).any():
        return [closed] if len(closed.triangles) else []
    number = solid_parts(closed.points, closed.triangles)
    solids = [closed.select(number == n) for n in range(int(number.max()) + 1)]
    return solids if all(is_closed(solid.triangles) for solid in solids) else [closed]


def _outwards(solids: list[Surface]) -> tuple[list[Surface], Indices]:
    """The closed parts turned so that the outermost look outwards, and the file's triangles turned.

    A part inside another turns with the outermost one around it, so that a cavity stays a cavity.
    """
    enclosed = np.array([volume(solid.points, solid.triangles) for solid in solids])
    around = _containers(solids, enclosed)
    result: list[Surface] = []
    turned: list[Indices] = [np.empty(0, np.int64)]
    for number, solid in enumerate(solids):
        outermost = max(
            [*around[number], number], key=lambda other: (other in around[number], abs(enclosed[other]))
        )
        if enclosed[outermost] < 0.0:
            turned.append(solid.source[solid.source != NEW])
            solid = solid.turn_all()
        result.append(solid)
    return result, np.concatenate(turned)


def _containers(solids: list[Surface], enclosed: NDArray[np.float64]) -> list[list[int]]:
    """For each part, the larger parts that it lies in."""
    if len(solids) > _MANY_PARTS:
        return [[] for _ in solids]
    low = np.array([solid.points[solid.triangles].min(axis=(0, 1)) for solid in solids])
    high = np.array([solid.points[solid.triangles].max(axis=(0, 1)) for solid in solids])
    around: list[list[int]] = []
    for number, solid in enumerate(solids):
        wider = (low <= low[number]).all(axis=1) & (high >= high[number]).all(axis=1)
        wider &= np.abs(enclosed) > abs(enclosed[number])
        place = solid.points[solid.triangles[0]].mean(axis=0)
        around.append(
            [
                int(n)
                for n in np.flatnonzero(wider)
                if mesh_contains(solids[n].points, solids[n].triangles, place)
            ]
        )
    return around


def _united(solids: list[Surface], notes: Notes) -> Surface:
    """All parts as one surface; where they overlap or touch, that of their union, cavities taken out."""
    if len(solids) == 1 or not _boxes_meet(solids):
        return joined(solids)
    enclosed = np.array([volume(solid.points, solid.triangles) for solid in solids])
    depth = np.array([len(around) for around in _containers(solids, enclosed)])
    bodies = [solid.manifold() for solid in solids]
    if any(body.is_empty() for body in bodies):
        return joined(solids)
    union = manifold3d.Manifold()
    for level in np.unique(depth):
        for sign in (1.0, -1.0):
            chosen = [n for n in np.flatnonzero(depth == level) if sign * enclosed[n] > 0.0]
            parts_here = [bodies[n] if sign > 0.0 else solids[n].turn_all().manifold() for n in chosen]
            for body in _batched(parts_here):
                union = union + body if sign > 0.0 else union - body
    apart = joined(solids)
    area = float(areas(apart.points, apart.triangles).sum())
    unchanged = abs(union.volume() - enclosed.sum()) <= 1e-9 * abs(union.volume())
    if union.is_empty() or (unchanged and abs(union.surface_area() - area) <= 1e-9 * area):
        return apart
    notes.joined_parts = len(solids)
    return Surface.of_manifold(union)


def _free_of_crossings(surface: Surface, notes: Notes) -> Surface:
    """The surface itself if it bounds a solid, else the outline of all that it encloses."""
    extent = np.ptp(surface.points[np.unique(surface.triangles)], axis=0)
    if np.sort(extent)[1] <= 1e-9 * extent.max():
        return surface
    axes = np.roll(np.arange(3), 2 - int(np.argmin(extent)))
    columns = Columns.through(surface.points[:, axes], surface.triangles, cells=_COLUMNS)
    if columns.crossed_share <= _CROSSED:
        return surface
    points, triangles = outline(surface.points, surface.triangles)
    if not len(triangles):
        notes.crossed = True
        return surface
    notes.rebuilt = True
    return Surface.new(points, triangles)


def _batched(bodies: list[manifold3d.Manifold]) -> list[manifold3d.Manifold]:
    """The union of some solids, as a list of one; none of none."""
    return [manifold3d.Manifold.batch_boolean(bodies, manifold3d.OpType.Add)] if bodies else []


def _boxes_meet(solids: list[Surface]) -> bool:
    """Whether the bounding boxes of any two parts overlap or touch."""
    low = np.array([solid.points[solid.triangles].min(axis=(0, 1)) for solid in solids])
    high = np.array([solid.points[solid.triangles].max(axis=(0, 1)) for solid in solids])
    return any(
        bool(((low[n + 1 :] <= high[n]) & (high[n + 1 :] >= low[n])).all(axis=1).any())
        for n in range(len(solids) - 1)
    )


def _record_turned(turned: NDArray[np.bool_], shown: Surface) -> None:
    """Marks the file's triangles that a part shows the other way round."""
    own = shown.source != NEW
    turned[shown.source[own]] = shown.turned[own]


def _count_turned(turned: NDArray[np.bool_], kept: NDArray[np.bool_], notes: Notes) -> None:
    notes.turned = int((turned & kept).sum())
    notes.all_turned = notes.turned > 0 and bool(turned[kept].all())
