"""Figure 6.2: where the load on a fragment is sampled."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from brisance.figures import fragment, style
from brisance.figures.figure import Figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture


def compute() -> fragment.Fragment:
    """The fragment of Fig. 6.1 and its panels."""
    return fragment.chosen()


def cells(shown: fragment.Fragment) -> NDArray[np.float64]:
    """Corners of the cells whose parts of the face are its panels, (6, 4 corners, 2) [m].

    Three columns along the long axis, to the right of it and then to the left.
    """
    far = 2.0 * float(np.linalg.norm(shown.outline, axis=1).max())
    columns = [(-far, -shown.middle), (-shown.middle, shown.middle), (shown.middle, far)]
    corners = [
        [(left, low), (right, low), (right, high), (left, high)]
        for low, high in ((-far, 0.0), (0.0, far))
        for left, right in columns
    ]
    return np.array(corners) @ shown.axes


def draw(picture: Picture, shown: fragment.Fragment) -> None:
    from matplotlib.patches import Polygon

    axes = picture.subplots()
    edge = Polygon(shown.outline, facecolor="none", edgecolor="none")
    axes.add_patch(edge)
    for cell, colour in zip(cells(shown), style.CYCLE, strict=True):
        part = Polygon(cell, facecolor=colour, alpha=0.22, edgecolor="none")
        axes.add_patch(part)
        part.set_clip_path(edge)
    fragment.draw_outline(axes, shown)
    for (x, y, _area), colour in zip(shown.panels, style.CYCLE, strict=True):
        axes.plot(x, y, "o", color=colour, markeredgecolor=style.INK, markersize=9.0)
    low, high = shown.outline.min(axis=0), shown.outline.max(axis=0)
    margin = 0.03 * float((high - low).max())
    axes.set_xlim(low[0] - margin, high[0] + margin)
    axes.set_ylim(low[1] - margin, high[1] + margin)
    axes.set_title(
        "dots: middles of its panels; colours: the parts of its face that they stand for", color=style.GREY
    )


FIGURE = Figure(
    name="6.2",
    title="Figure 6.2  Where the load on a fragment is sampled",
    compute=compute,
    draw=draw,
    size=(1400, 1300),
)
