"""Figure 5.11: the base algorithm at 35°: rounder fragments."""

from __future__ import annotations

from brisance.figures import cracks
from brisance.figures.figure import Figure
from brisance.pane import Fracture


def compute() -> Fracture:
    """Straight cracks, every fork alike and wider."""
    return cracks.pattern(35.0)


FIGURE = Figure(
    name="5.11",
    title="Figure 5.11  Base algorithm, fork angle 35°",
    compute=compute,
    draw=cracks.draw,
    table=cracks.table,
    size=cracks.SIZE,
)
