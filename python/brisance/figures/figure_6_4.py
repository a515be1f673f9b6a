"""Figure 6.4: a shattering window, seen from the front."""

from __future__ import annotations

from typing import TYPE_CHECKING

from brisance.figures import wall, window
from brisance.figures.figure import Figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

    from brisance.result import Result


def compute() -> Result:
    """The pattern of Fig. 5.14, 5 m from 10 kg of TNT."""
    return wall.result(window.THESIS)


def draw(picture: Picture, result: Result) -> None:
    window.draw_six(picture, result, window.FRONT, rows=2)


FIGURE = Figure(
    name="6.4",
    title="Figure 6.4  A shattering window, from the front",
    compute=compute,
    draw=draw,
    size=(1500, 1000),
)
