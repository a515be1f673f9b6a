"""What the crack figures share: the thesis's pane and rule of forking, and thin lines on white."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from brisance.figures import style
from brisance.figures.figure import Table
from brisance.model.pattern import Pattern
from brisance.pane import Fracture, fracture

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Picture

SIZE = (1400, 1480)
"""A square picture with a heading [pixels]."""
CRITICAL_LENGTH = 0.003
"""Critical length [m] on a pane one metre square. The thesis gives none; its counts of vertices and triangles
(6.1) make its Fig. 5.14 a pattern of 271 fragments, and this length comes close to that. As in the thesis, a
crack may also turn each time it has grown by this much."""
WIGGLE = 12.0
"""Full width of a crack's turns [degrees]. The thesis gives none."""
SEED = 51
"""The draw, of a few hundred, whose Fig. 5.14 comes nearest to the counts of the thesis."""


@cache
def pattern(fork_angle: float, fork_variance: float = 0.0, *, wiggle: bool = False) -> Fracture:
    """Break the pane by the thesis's own rule, from a short segment in the middle. Angles in degrees."""
    return fracture(
        Pattern(
            literal=True,
            shape="segment",
            critical_length=CRITICAL_LENGTH,
            fork_angle=fork_angle,
            fork_variance=fork_variance,
            wiggle_probability=1.0 if wiggle else 0.0,
            wiggle_variance=WIGGLE,
            wiggle_spacing=CRITICAL_LENGTH,
        ),
        seed=SEED,
    )


def wiggling_and_varied() -> Fracture:
    """The pattern of Fig. 5.14, from which chapter 6 takes its window."""
    return pattern(25.0, 34.5, wiggle=True)


def table(broken: Fracture) -> Table:
    """Ends of every crack [m] and when they were cut [s]."""
    ends, times = broken.engine.crack_ends, broken.crack_times
    columns = dict(zip(("x0_m", "y0_m", "x1_m", "y1_m"), ends.T, strict=True))
    return columns | {"start_s": times[:, 0], "end_s": times[:, 1]}


def draw_cracks(axes: Axes, broken: Fracture, *, width: float = 0.55) -> None:
    """Draw every crack and the pane's edge as lines of ``width`` points."""
    from matplotlib.collections import LineCollection

    axes.add_collection(
        LineCollection(list(broken.engine.crack_ends.reshape(-1, 2, 2)), colors=style.INK, linewidths=width)
    )
    for ring in broken.outline:
        axes.plot(*np.vstack([ring, ring[:1]]).T, color=style.INK, linewidth=1.6 * width)
    bare(axes)


def bare(axes: Axes) -> None:
    """Equal scales, and nothing but what is drawn."""
    axes.set_aspect("equal")
    axes.set_axis_off()
    axes.margins(0.01)


def draw(picture: Picture, broken: Fracture) -> None:
    """Draw a pattern and say how many fragments it has."""
    axes = picture.subplots()
    draw_cracks(axes, broken)
    axes.set_title(f"{len(broken.polygons)} fragments of a pane of 1 m", color=style.GREY)


def uses(broken: Fracture) -> NDArray[np.intp]:
    """How many fragments share each corner in ``ring_vertices``, the outside of the pane counted as one."""
    corners = broken.engine.ring_vertices
    count = np.bincount(corners)
    count[np.unique(corners[broken.engine.on_border])] += 1
    return np.asarray(count[corners])


def vertices_per_fragment(broken: Fracture) -> NDArray[np.intp]:
    """How many corners each fragment has."""
    return np.array([sum(len(ring) for ring in rings) for rings in broken.polygons])


def branching_vertices(broken: Fracture) -> int:
    """Corners at which cracks branch or meet, counted once for every fragment, as the thesis counts them."""
    return int(np.count_nonzero(uses(broken) >= 3))
