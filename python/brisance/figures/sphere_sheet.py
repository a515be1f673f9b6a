"""The sphere around a charge, unfolded as in Fig. 4.3 and coloured by what the charge sees."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from brisance import _engine
from brisance.figures import style

if TYPE_CHECKING:
    from matplotlib.axes import Axes

WIDTH, HEIGHT = 5.5, 1.5 * 3**0.5
"""Size of the sheet in lengths of an icosahedron's edge."""


def draw_faces(axes: Axes, colour: str = style.GREY) -> None:
    """The edges of the twenty faces."""
    from matplotlib.collections import PolyCollection

    n = 4
    pixels = _engine.unfolded_sphere(resolution=n)
    # A face's corners are those of its first pixel, its last one, and the last one of its first strip.
    corners = pixels.reshape(20, n * n, 3, 2)
    faces = np.stack([corners[:, 0, 0], corners[:, -1, 1], corners[:, 2 * n - 2, 2]], axis=1)
    axes.add_collection(PolyCollection(list(faces), facecolors="none", edgecolors=colour, linewidths=0.9))


def draw_pixels(axes: Axes, resolution: int, colours: NDArray[np.float64]) -> None:
    """Every pixel in its colour, (pixels, 4) red, green, blue and opacity from 0 to 1."""
    from matplotlib.collections import PolyCollection

    shown = colours[:, 3] > 0
    pixels = _engine.unfolded_sphere(resolution=resolution)[shown]
    # Neighbours are drawn a hair larger than they are, so that no background shows between them.
    axes.add_collection(
        PolyCollection(list(pixels), facecolors=colours[shown], edgecolors=colours[shown], linewidths=0.25)
    )


def frame_sheet(axes: Axes) -> None:
    """The whole sheet, without axes."""
    axes.set_xlim(-0.05, WIDTH + 0.05)
    axes.set_ylim(-0.05, HEIGHT + 0.05)
    axes.set_aspect("equal")
    axes.axis("off")
