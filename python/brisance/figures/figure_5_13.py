"""Figure 5.13: cracks that wiggle."""

from __future__ import annotations

from brisance.figures import cracks
from brisance.figures.figure import Figure
from brisance.pane import Fracture


def compute() -> Fracture:
    """Wiggling cracks, every fork alike."""
    return cracks.pattern(25.0, wiggle=True)


FIGURE = Figure(
    name="5.13",
    title="Figure 5.13  Wiggling cracks, fork angle 25°",
    compute=compute,
    draw=cracks.draw,
    table=cracks.table,
    size=cracks.SIZE,
)
