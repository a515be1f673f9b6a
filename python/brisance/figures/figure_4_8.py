"""Figure 4.8: how the blocks of Fig. 4.7 go on behind their wall."""

from __future__ import annotations

from typing import TYPE_CHECKING

from brisance.figures import shelter
from brisance.figures.figure import Figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

    from brisance.result import Result

FRAMES = [36, 48]


def compute() -> dict[str, Result]:
    """A near and a far block behind a wall."""
    return {shelter.SHELTERED: shelter.results(shelter.APART)[shelter.SHELTERED]}


def draw(picture: Picture, both: dict[str, Result]) -> None:
    shelter.draw_rows(picture, both, FRAMES)


FIGURE = Figure(
    name="4.8",
    title="Figure 4.8  Two more frames of Figure 4.7",
    compute=compute,
    draw=draw,
    table=shelter.table,
    size=(1500, 340),
)
