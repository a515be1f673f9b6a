"""What a closed surface encloses, found along columns of parallel lines through it.

Along each line the surface is crossed inwards and outwards in turn if it bounds a solid: the winding number
is 1 inside and 0 outside. Any other number (2 where parts overlap, -1 where the surface is turned inside out)
shows a surface that crosses itself. From the same crossings a crossing-free surface around all that is
enclosed can be built.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import manifold3d
import numpy as np
from numpy.typing import NDArray

from brisance.objects.mesh.measure import centroid, volume
from brisance.objects.mesh.polygons import Indices, Points

_PAIRS_AT_ONCE = 2_000_000
_OFFSET = np.array([0.5 - 1.0 / 137.0, 0.5 + 1.0 / 173.0])
"""Place of a line in its cell, a little off the middle so that it misses the edges of regular meshes."""


@dataclass(frozen=True, eq=False)
class Columns:
    """The stretches, on lines along z, between crossings of a closed surface."""

    column: NDArray[np.int64]
    """(s, 2) cell of the line in x and y."""
    start: Points
    """(s,) where the stretch begins [m]."""
    end: Points
    """(s,) where it ends [m]."""
    winding: Indices
    """(s,) winding number along it, never 0."""
    cell: float
    """Distance between the lines [m]."""

    @classmethod
    def through(cls, points: Points, triangles: Indices, *, cells: int) -> Columns:
        """Lines through the surface's bounding box, ``cells`` of them along its longer side in x and y."""
        low = points[triangles].min(axis=(0, 1))
        extent = points[triangles].max(axis=(0, 1)) - low
        cell = float(extent[:2].max()) / cells
        shape = np.maximum(np.ceil(extent[:2] / cell), 1).astype(np.int64)
        found = list(_crossings(points, triangles, low[:2], cell, shape))
        line = np.concatenate([part[0] for part in found])
        height = np.concatenate([part[1] for part in found])
        turn = np.concatenate([part[2] for part in found])
        order = np.lexsort((height, line))
        line, height, turn = line[order], height[order], np.cumsum(turn[order])
        # Every line leaves a closed surface as often as it enters, so the sum is 0 again where a line ends.
        inside = (
            np.flatnonzero((line[:-1] == line[1:]) & (turn[:-1] != 0)) if len(line) else np.empty(0, np.int64)
        )
        column = np.stack([line[inside] // shape[1], line[inside] % shape[1]], axis=1)
        return cls(column, height[inside], height[inside + 1], turn[inside], cell)

    @property
    def volume(self) -> float:
        """What the surface encloses, each place counted once [m³], to about a cell's share of it."""
        return float((self.end - self.start).sum()) * self.cell**2

    @property
    def crossed_share(self) -> float:
        """Share of the enclosed volume where the winding number is not 1."""
        length = self.end - self.start
        total = float(length.sum())
        return float(length[self.winding != 1].sum()) / total if total > 0.0 else 0.0


def _crossings(
    points: Points, triangles: Indices, origin: Points, cell: float, shape: Indices
) -> Iterator[tuple[Indices, Points, Indices]]:
    """Line, height and sense (1 entering, -1 leaving, going up) of every crossing, in batches."""
    flat = (points[:, :2] - origin) / cell - _OFFSET
    corners = flat[triangles]
    low = np.maximum(np.ceil(corners.min(axis=1)), 0).astype(np.int64)
    high = np.minimum(np.floor(corners.max(axis=1)), shape - 1).astype(np.int64)
    span = np.maximum(high - low + 1, 0)
    count = span[:, 0] * span[:, 1]
    batch = np.cumsum(count) // _PAIRS_AT_ONCE
    for number in np.unique(batch):
        chosen = np.flatnonzero((batch == number) & (count > 0))
        owner = np.repeat(chosen, count[chosen])
        place = np.arange(len(owner)) - np.repeat(np.cumsum(count[chosen]) - count[chosen], count[chosen])
        cells = low[owner] + np.stack([place // span[owner, 1], place % span[owner, 1]], axis=1)
        weights = np.stack([_side(flat, triangles[owner], side, cells) for side in range(3)], axis=1)
        up = weights > 0.0
        hit = (up[:, 0] == up[:, 1]) & (up[:, 1] == up[:, 2])
        weights, cells, owner = weights[hit], cells[hit], owner[hit]
        # Side k lies opposite corner k + 2.
        total = weights.sum(axis=1)
        heights = points[triangles[owner], 2]
        height = (weights * np.roll(heights, 1, axis=1)).sum(axis=1) / np.where(total == 0.0, 1.0, total)
        yield cells[:, 0] * shape[1] + cells[:, 1], height, np.where(up[hit, 0], -1, 1)


def _side(flat: Points, corners: Indices, side: int, cells: Indices) -> Points:
    """Twice the signed area between one side of each triangle and the line, opposite for its neighbour.

    A line that meets the side is put on one and the same side of it for both triangles.
    """
    a, b = corners[:, side], corners[:, (side + 1) % 3]
    low, high = np.minimum(a, b), np.maximum(a, b)
    along, away = flat[high] - flat[low], cells - flat[low]
    area = along[:, 0] * away[:, 1] - along[:, 1] * away[:, 0]
    area = np.where(area == 0.0, np.finfo(float).tiny, area)
    return np.where(a < b, area, -area)


def outline(points: Points, triangles: Indices, *, cells: int = 48) -> tuple[Points, Indices]:
    """A surface that does not cross itself around all that a closed surface encloses, of the same volume.

    It follows the original to about half a cell, and edges sharper than that are rounded; a cubic body has
    ``cells`` of them along a side, a long one more along its length. Returns no triangles if much of
    it is thinner than a cell.
    """
    low = points[triangles].min(axis=(0, 1))
    extent = points[triangles].max(axis=(0, 1)) - low
    cell = max(float(np.cbrt(extent.prod())), float(extent.max()) / 4.0) / cells
    finer = 3
    lines = max(1, round(float(extent[:2].max()) / cell)) * finer
    columns = Columns.through(points, triangles, cells=lines)
    if columns.volume == 0.0:
        return np.empty((0, 3)), np.empty((0, 3), np.int64)
    width = columns.cell * finer
    field = _field(_filled_cells(columns, low, width, finer), low - width, width)
    bounds = [*(low - width), *(low + extent + width)]
    mesh = manifold3d.Manifold.level_set(field, bounds, width, 0.0).simplify(0.2 * width).to_mesh64()
    vertices, faces = np.array(mesh.vert_properties[:, :3]), np.array(mesh.tri_verts, np.int64)
    if not len(faces) or volume(vertices, faces) < 0.7 * columns.volume:
        return np.empty((0, 3)), np.empty((0, 3), np.int64)
    middle = centroid(vertices, faces)
    factor = np.cbrt(columns.volume / volume(vertices, faces))
    return middle + factor * (vertices - middle), faces


def _filled_cells(columns: Columns, low: Points, width: float, finer: int) -> Points:
    """Filled share of each cell of a grid that is one empty cell larger than the body on every side."""
    bottom = (columns.start - low[2]) / width + 1.0
    top = (columns.end - low[2]) / width + 1.0
    layers = int(np.ceil(top.max())) + 2
    cells = columns.column // finer + 1
    shape = (*(cells.max(axis=0) + 2), layers)
    filled = np.zeros(shape)
    share = 1.0 / finer**2
    for layer in range(layers):
        part = np.clip(np.minimum(top, layer + 1.0) - np.maximum(bottom, float(layer)), 0.0, 1.0)
        np.add.at(filled[:, :, layer], (cells[:, 0], cells[:, 1]), share * part)
    return filled


def _field(filled: Points, corner: Points, width: float) -> Callable[[float, float, float], float]:
    """Filled share at a point, less a half: linear between the cells' middles, negative off the grid."""
    values: list[float] = filled.ravel().tolist()
    nx, ny, nz = filled.shape
    x0, y0, z0 = (corner + 0.5 * width).tolist()

    def field(x: float, y: float, z: float) -> float:
        u, v, w = (x - x0) / width, (y - y0) / width, (z - z0) / width
        i, j, k = math.floor(u), math.floor(v), math.floor(w)
        if not (0 <= i < nx - 1 and 0 <= j < ny - 1 and 0 <= k < nz - 1):
            return -0.5
        u, v, w = u - i, v - j, w - k
        at = (i * ny + j) * nz + k
        left, right, far = at, at + ny * nz, at + nz
        far_right = right + nz
        share = (
            (1.0 - u) * (1.0 - v) * (values[left] * (1.0 - w) + values[left + 1] * w)
            + u * (1.0 - v) * (values[right] * (1.0 - w) + values[right + 1] * w)
            + (1.0 - u) * v * (values[far] * (1.0 - w) + values[far + 1] * w)
            + u * v * (values[far_right] * (1.0 - w) + values[far_right + 1] * w)
        )
        return float(share) - 0.5

    return field
