"""Figure 6.6: the window of Figure 6.5 with a thousand times the air resistance.

The thesis's small pieces overtake its large ones. These do not: docs/window.md says why.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from brisance.figures import wall, window
from brisance.figures.figure import Figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

    from brisance.result import Result


def compute() -> Result:
    """The window of Fig. 6.5 with a damping factor of 1000."""
    return wall.result(window.OVERDAMPED)


def draw(picture: Picture, result: Result) -> None:
    window.draw_six(picture, result, window.SIDE, rows=1)


FIGURE = Figure(
    name="6.6",
    title="Figure 6.6  An overdamped shattering window, from the side: 1000 times the air resistance",
    compute=compute,
    draw=draw,
    table=window.sizes_and_travel,
    size=(1500, 900),
)
