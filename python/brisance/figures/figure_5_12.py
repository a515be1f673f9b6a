"""Figure 5.12: fork angles that vary."""

from __future__ import annotations

from brisance.figures import cracks
from brisance.figures.figure import Figure
from brisance.pane import Fracture


def compute() -> Fracture:
    """Straight cracks whose forks vary by half of 34.5° to either side."""
    return cracks.pattern(25.0, 34.5)


FIGURE = Figure(
    name="5.12",
    title="Figure 5.12  Fork angle 25° that varies by ±17.25°",
    compute=compute,
    draw=cracks.draw,
    table=cracks.table,
    size=cracks.SIZE,
)
