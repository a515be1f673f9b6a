"""Figure 4.6: three blocks at like distances, in the open and behind a wall."""

from __future__ import annotations

from typing import TYPE_CHECKING

from brisance.figures import shelter
from brisance.figures.figure import Figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

    from brisance.result import Result

FRAMES = [0, 12, 24]


def compute() -> dict[str, Result]:
    """Three blocks at like distances without a wall before them, and with it."""
    return shelter.results(shelter.ALIKE)


def draw(picture: Picture, both: dict[str, Result]) -> None:
    shelter.draw_rows(picture, both, FRAMES)


FIGURE = Figure(
    name="4.6",
    title="Figure 4.6  Blocks at like distances, in the open and behind a wall",
    compute=compute,
    draw=draw,
    table=shelter.table,
    size=(1700, 620),
)
