"""A broken pane as a picture: the same drawing as the SVG, in pixels."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from brisance.errors import ArgumentError
from brisance.formats.atomic import replacing
from brisance.formats.pattern_picture import (
    BORDER,
    GLASS,
    ages,
    border_width,
    caption,
    chains,
    colours,
    line_width,
)

if TYPE_CHECKING:
    from brisance.pane import Fracture

LONGER_SIDE = 2400
"""Pixels of the pane's longer side where no size is given."""
LARGEST = 20_000
"""Pixels that a picture may have on a side."""
_DPI = 100.0
_THINNEST = 0.6
"""Lines are at least as wide as this [pixels]: thinner ones fade to grey."""


def write_pattern_png(fracture: Fracture, path: Path | str, *, size: tuple[int, int] | None = None) -> None:
    """Draw the cracks of a broken pane, coloured by when they were cut; ``size`` in pixels."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.collections import LineCollection
    from matplotlib.figure import Figure
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path as Outline

    if size is not None and not all(1 <= side <= LARGEST for side in size):
        raise ArgumentError("size", f"must be from 1 to {LARGEST} pixels a side, not {size[0]} by {size[1]}.")
    low, high = fracture.bounds
    longer = float((high - low).max())
    page_low, page_high = low - 0.03 * longer, high + 0.03 * longer
    page_low[1] -= 0.085 * longer
    page = page_high - page_low
    width, height = size or tuple(np.maximum(1, np.rint(LONGER_SIDE * page / longer)).astype(int).tolist())
    pixels_per_m = min(width / page[0], height / page[1])
    # What is left over goes to both sides alike.
    middle, half = 0.5 * (page_low + page_high), 0.5 * np.array([width, height]) / pixels_per_m

    figure = Figure(figsize=(width / _DPI, height / _DPI), dpi=_DPI)
    FigureCanvasAgg(figure)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set_axis_off()
    axes.set(xlim=(middle[0] - half[0], middle[0] + half[0]), ylim=(middle[1] - half[1], middle[1] + half[1]))
    points = 72.0 / _DPI
    line = max(_THINNEST, line_width(fracture) * pixels_per_m) * points
    border = border_width(fracture) * pixels_per_m * points
    corners = np.concatenate([np.vstack([ring, ring[:1]]) for ring in fracture.outline])
    codes = [
        code
        for ring in fracture.outline
        for code in (Outline.MOVETO, *[Outline.LINETO] * (len(ring) - 1), Outline.CLOSEPOLY)
    ]
    pane = Outline(corners, codes)
    axes.add_patch(PathPatch(pane, facecolor=GLASS, edgecolor=BORDER, linewidth=border, zorder=1))
    shades = colours()
    for age, cracks in chains(fracture):
        axes.add_collection(
            LineCollection(
                cracks, colors=shades[age], linewidths=line, capstyle="round", joinstyle="round", zorder=2
            ),
            autolim=False,
        )
    letters = 0.019 * longer * pixels_per_m * points
    top = low[1] - 0.018 * longer
    strip = 0.4 * (high[0] - low[0])
    axes.imshow(
        np.array([[[int(c[i : i + 2], 16) / 255 for i in (1, 3, 5)] for c in shades]]),
        extent=(low[0], low[0] + strip, top - 0.012 * longer, top),
        aspect="auto",
        interpolation="nearest",
    )
    axes.set(xlim=(middle[0] - half[0], middle[0] + half[0]), ylim=(middle[1] - half[1], middle[1] + half[1]))
    words = {"fontsize": letters, "color": BORDER, "va": "top"}
    for share, side, text in zip((0, 0.5, 1), ("left", "center", "right"), ages(fracture), strict=True):
        axes.text(low[0] + share * strip, top - 0.016 * longer, text, ha=side, **words)
    axes.text(low[0], top - 0.043 * longer, caption(fracture), ha="left", **words)
    with replacing(path) as temporary:
        figure.savefig(temporary, dpi=_DPI, metadata={"Software": None})
