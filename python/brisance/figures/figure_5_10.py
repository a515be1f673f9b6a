"""Figure 5.10: the base algorithm, straight cracks that fork at 25°."""

from __future__ import annotations

from brisance.figures import cracks
from brisance.figures.figure import Figure
from brisance.pane import Fracture


def compute() -> Fracture:
    """Straight cracks, every fork alike."""
    return cracks.pattern(25.0)


FIGURE = Figure(
    name="5.10",
    title="Figure 5.10  Base algorithm, fork angle 25°",
    compute=compute,
    draw=cracks.draw,
    table=cracks.table,
    size=cracks.SIZE,
)
