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
        rows = zip(places[ahead], nearness[ahead], colours[ahead], labels[ahead], strict=True)
        for place, near, colour, label in rows:
            self._fill(place, near, colour, label)

    def outline(self, strength: float) -> None:
        """Darken by ``strength``, 0 to 1, the pixels at which one piece ends and another, or none, begins."""
        edge = np.zeros(self.label.shape, dtype=bool)
        for axis in (0, 1):
            step = np.diff(self.label, axis=axis) != 0
            edge |= np.insert(step, 0, values=False, axis=axis) | np.insert(
                step, step.shape[axis], False, axis=axis
            )
        self.colour[edge & (self.label >= 0)] *= 1.0 - strength

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
