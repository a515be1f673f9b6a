"""Figure 4.7: a near and a far block, in the open and behind a wall."""

from __future__ import annotations

from typing import TYPE_CHECKING

from brisance.figures import shelter
from brisance.figures.figure import Figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

    from brisance.result import Result

FRAMES = [0, 12, 24]


def compute() -> dict[str, Result]:
    """A near and a far block without a wall before them, and with it."""
    return shelter.results(shelter.APART)


def draw(picture: Picture, both: dict[str, Result]) -> None:
    shelter.draw_rows(picture, both, FRAMES)


FIGURE = Figure(
    name="4.7",
    title="Figure 4.7  A near and a far block, in the open and behind a wall",
    compute=compute,
    draw=draw,
    table=shelter.table,
    size=(1700, 500),
)
