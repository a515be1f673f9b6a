"""Figure 5.14: cracks that wiggle, and fork angles that vary."""

from __future__ import annotations

from brisance.figures import cracks
from brisance.figures.figure import Figure
from brisance.pane import Fracture


def compute() -> Fracture:
    """Wiggling cracks whose forks vary."""
    return cracks.wiggling_and_varied()


FIGURE = Figure(
    name="5.14",
    title="Figure 5.14  Wiggling cracks and varied fork angles",
    compute=compute,
    draw=cracks.draw,
    table=cracks.table,
    size=cracks.SIZE,
)
