"""A small picture of flat-coloured triangles with a depth buffer: exact occlusion without a renderer.

Triangles are given in camera axes: x right, y up, the camera looking along −z, lengths in metres. A triangle
that reaches nearer than ``NEAR`` is left out.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

NEAR = 0.05
"""Least distance in front of the camera at which anything is drawn [m]."""
FEW = 12
"""Triangles at most so many pixels wide and high are drawn all at once, pixel by pixel of their boxes."""


class Raster:
    """A picture being drawn. Rows run from top to bottom."""

    def __init__(self, *, width: int, height: int, half_width: float, half_height: float) -> None:
        """A white picture of a size in pixels; the halves are the tangents of the camera's half angles."""
        self.colour: Array = np.ones((height, width, 3))
        self.nearness: Array = np.zeros((height, width))
        """One over the depth of what is seen, 0 where there is nothing [1/m]."""
        self.label: NDArray[np.intp] = np.full((height, width), -1)
        """Which piece is seen, −1 where there is none."""
        self._centre = np.array([0.5 * width, 0.5 * height])
        self._pixels = np.array([0.5 * width / half_width, -0.5 * height / half_height])

    def fill_below(self, slope: float, colour: Array) -> None:
        """Colour all that lies below a level line at ``slope``, height over distance."""
        row = self._centre[1] + self._pixels[1] * slope
        self.colour[max(0, round(row)) :] = colour

    def draw(self, triangles: Array, colours: Array, labels: NDArray[np.intp]) -> None:
        """Draw triangles (n, 3 corners, 3) in their colours (n, 3), each 0 to 1, nearest on top.

        ``labels`` (n,) says which piece each belongs to. Those labelled −1 lie on what is drawn already and
        leave no trace in depth, as shadows do.
        """
        ahead = (triangles[:, :, 2] < -NEAR).all(axis=1)
        nearness = -1.0 / np.where(ahead[:, None], triangles[:, :, 2], -1.0)
        places = self._centre + self._pixels * triangles[:, :, :2] * nearness[:, :, None]
        places, nearness, colours, labels = places[ahead], nearness[ahead], colours[ahead], labels[ahead]
        low, high = self._boxes(places)
        few = (high - low <= FEW).all(axis=1)
        self._fill_many(places[few], nearness[few], colours[few], labels[few])
        for row in np.flatnonzero(~few):
            self._fill(places[row], nearness[row], colours[row], labels[row])

    def outline(self, strength: float) -> None:
        """Darken by ``strength``, 0 to 1, the pixels at which one piece ends and another, or none, begins."""
        edge = np.zeros(self.label.shape, dtype=bool)
        for axis in (0, 1):
            step = np.diff(self.label, axis=axis) != 0
            edge |= np.insert(step, 0, values=False, axis=axis) | np.insert(
                step, step.shape[axis], False, axis=axis
            )
        self.colour[edge & (self.label >= 0)] *= 1.0 - strength

    def _boxes(self, places: Array) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """First pixels (n, 2) of the boxes around triangles (n, 3, 2), and those after their last."""
        size = np.array(self.nearness.shape[::-1])
        low = np.clip(np.floor(places.min(axis=1)), 0, size).astype(np.intp)
        return low, np.clip(np.ceil(places.max(axis=1)), 0, size).astype(np.intp)

    def _fill_many(self, places: Array, near: Array, colours: Array, labels: NDArray[np.intp]) -> None:
        """Draw triangles of a few pixels each: the first pixel of all boxes, then the second, and so on."""
        low, high = self._boxes(places)
        wide, tall = (high - low).T
        (ax, bx, cx), (ay, by, cy) = places.transpose(2, 1, 0)
        area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        for right in range(FEW):
            for down in range(FEW):
                i = np.flatnonzero((wide > right) & (tall > down) & (area != 0.0))
                x, y = low[i, 0] + right + 0.5, low[i, 1] + down + 0.5
                second = ((x - ax[i]) * (cy[i] - ay[i]) - (y - ay[i]) * (cx[i] - ax[i])) / area[i]
                third = ((bx[i] - ax[i]) * (y - ay[i]) - (by[i] - ay[i]) * (x - ax[i])) / area[i]
                first = 1.0 - second - third
                depth = first * near[i, 0] + second * near[i, 1] + third * near[i, 2]
                column, row = low[i, 0] + right, low[i, 1] + down
                seen = (first >= 0.0) & (second >= 0.0) & (third >= 0.0)
                seen &= depth > self.nearness[row, column]
                # Where several cover a pixel, the last one written stays: the nearest.
                order = np.flatnonzero(seen)[np.argsort(depth[seen], kind="stable")]
                i, depth, row, column = i[order], depth[order], row[order], column[order]
                self.colour[row, column] = colours[i]
                solid = labels[i] >= 0
                self.nearness[row[solid], column[solid]] = depth[solid]
                self.label[row[solid], column[solid]] = labels[i[solid]]

    def _fill(self, place: Array, near: Array, colour: Array, label: int) -> None:
        size = np.array(self.nearness.shape[::-1])
        low = np.clip(np.floor(place.min(axis=0)), 0, size).astype(int)
        high = np.clip(np.ceil(place.max(axis=0)), 0, size).astype(int)
        (ax, ay), (bx, by), (cx, cy) = place
        area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        if area == 0.0 or (low >= high).any():
            return
        x = np.arange(low[0], high[0]) + 0.5
        y = (np.arange(low[1], high[1]) + 0.5)[:, None]
        second = ((x - ax) * (cy - ay) - (y - ay) * (cx - ax)) / area
        third = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / area
        first = 1.0 - second - third
        window = (slice(low[1], high[1]), slice(low[0], high[0]))
        depth = first * near[0] + second * near[1] + third * near[2]
        seen = (first >= 0.0) & (second >= 0.0) & (third >= 0.0) & (depth > self.nearness[window])
        self.colour[window][seen] = colour
        if label >= 0:
            self.nearness[window][seen] = depth[seen]
            self.label[window][seen] = label
