"""Figure 4.4: a shadow on the map with its distances from the edge.

The shape is the thesis's own, copied from the print; its distance values are computed and not copied.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from brisance import _engine
from brisance.figures import style
from brisance.figures.figure import Figure, Table, whole

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

SHAPE = (
    "....................",
    "........##..........",
    ".......####.........",
    "......#######.......",
    "......########......",
    ".....##########.....",
    ".....############...",
    "....##############..",
    "....#############...",
    "...#############....",
    "..##############....",
    "..############......",
    "....##########......",
    "......########......",
    "........######......",
    "..........###.......",
    "....................",
)
"""The printed shadow: # where the print has a number above 0."""


def compute() -> Table:
    """Column, row and distance value of every pixel, rows from the top."""
    shape = np.array([[mark == "#" for mark in row] for row in SHAPE])
    rows, columns = np.indices(shape.shape)
    return {
        "column": columns.ravel().astype(float),
        "row": rows.ravel().astype(float),
        "value": _engine.ring_values(shape=shape).ravel().astype(float),
    }


def draw(picture: Picture, data: Table) -> None:
    axes = picture.subplots()
    column, row, value = (np.asarray(data[name], dtype=float) for name in ("column", "row", "value"))
    image = value.reshape(len(SHAPE), len(SHAPE[0]))
    axes.imshow(np.where(image > 0, image, np.nan), cmap="Blues", vmin=-2.0, vmax=image.max() + 1.0)
    for x, y, number in zip(column, row, value, strict=True):
        colour = style.PALE if number == 0 else "white" if number > 4 else style.INK
        axes.text(x, y, f"{number:.0f}", ha="center", va="center", fontsize=8.0, color=colour)
    axes.axis("off")
    axes.set_title("steps to the nearest pixel outside the shadow")


FIGURE = Figure(
    name="4.4",
    title="Figure 4.4  A shadow and the distances from its edge",
    compute=compute,
    draw=draw,
    table=whole,
    size=(1000, 920),
)
