"""What the figures of shattering windows share: scenes, views, and how far each piece has come."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from brisance.figures.painter import draw_frames, equally_spaced
from brisance.plume import travels
from brisance.render.camera import View

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

    from brisance.figures.figure import Table
    from brisance.result import Result

THESIS = "window_thesis.toml"
OVERDAMPED = "window_overdamped.toml"
COUPLED = "window.toml"
FRONT = View(azimuth=0.0, elevation=4.0)
SIDE = View(azimuth=90.0, elevation=3.0)
FRAMES = 6


def shown(result: Result) -> list[int]:
    """The six equally spaced frames of a result, from the first to the last."""
    return equally_spaced(len(result.times), FRAMES)


def draw_six(picture: Picture, result: Result, view: View, *, rows: int) -> None:
    """Draw six equally spaced frames of a result."""
    draw_frames(picture, result, shown(result), view, rows=rows, close=True)


def sizes_and_travel(result: Result) -> Table:
    """A row a piece: its area [m²], and how far it has come along the blast at each of the six frames [m]."""
    pane = result.panes[0]
    pieces = np.arange(pane.start, pane.stop)
    moved = travels(result, pane, pieces)
    columns = {f"travel_m_{1e3 * result.times[index]:.0f}_ms": moved[index] for index in shown(result)}
    return {"area_m2": result.bodies.frontal_area_m2[pieces]} | columns
