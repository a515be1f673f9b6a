"""Figure 5.16: a crack that crept, and stopped before it had crossed the pane."""

from __future__ import annotations

from typing import TYPE_CHECKING

from brisance.figures import cracks, style
from brisance.figures.figure import Figure
from brisance.model.pattern import Pattern
from brisance.pane import Fracture, fracture

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

CREEP = Pattern(
    literal=True,
    shape="segment",
    critical_length=0.06,
    fork_angle=15.0,
    fork_variance=20.0,
    wiggle_probability=1.0,
    wiggle_variance=25.0,
    wiggle_spacing=0.006,
    reach=0.42,
)
"""The thesis's long first crack and fork angle of 15°; how long, how rough and how far it leaves open."""


def compute() -> Fracture:
    """A crack twenty times as long as those that shatter the pane, with a limit to its growth."""
    return fracture(CREEP, seed=16)


def draw(picture: Picture, broken: Fracture) -> None:
    axes = picture.subplots()
    cracks.draw_cracks(axes, broken, width=1.0)
    axes.set_title(
        f"a$_c$ = {CREEP.critical_length} m, fork angle {CREEP.fork_angle:g}°, cracks grow {CREEP.reach} m "
        "at most; the pane stays whole",
        color=style.GREY,
    )


FIGURE = Figure(
    name="5.16",
    title="Figure 5.16  A crack that crept",
    compute=compute,
    draw=draw,
    table=cracks.table,
    size=cracks.SIZE,
)
