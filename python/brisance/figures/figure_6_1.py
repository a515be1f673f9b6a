"""Figure 6.1: a fragment cut into triangles."""

from __future__ import annotations

from typing import TYPE_CHECKING

from brisance.figures import fragment, style
from brisance.figures.figure import Figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture


def compute() -> fragment.Fragment:
    """A long, bent fragment of Fig. 5.14 and its triangles."""
    return fragment.chosen()


def draw(picture: Picture, shown: fragment.Fragment) -> None:
    from matplotlib.collections import PolyCollection

    axes = picture.subplots()
    axes.add_collection(
        PolyCollection(list(shown.triangles), facecolors="#eef4f8", edgecolors=style.BLUE, linewidths=0.5)
    )
    fragment.draw_outline(axes, shown)
    axes.set_title(
        f"{len(shown.outline)} corners, {len(shown.triangles)} triangles: the most bent of the long ones",
        color=style.GREY,
    )


FIGURE = Figure(
    name="6.1",
    title="Figure 6.1  A fragment cut into triangles",
    compute=compute,
    draw=draw,
    size=(1400, 1300),
)
