"""Figure 3.6: the brick wall of Figure 3.5, seen from below."""

from __future__ import annotations

from typing import TYPE_CHECKING

from brisance.figures import wall
from brisance.figures.figure import Figure
from brisance.figures.painter import draw_frames, equally_spaced
from brisance.render.camera import View

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

    from brisance.result import Result

FRAMES = 6
VIEW = View(azimuth=0.0, elevation=-62.0)


def compute() -> Result:
    """The wall of 27 bricks, 15 m from 100 kg of TNT."""
    return wall.result(wall.BLOWN_APART)


def draw(picture: Picture, result: Result) -> None:
    draw_frames(picture, result, equally_spaced(len(result.times), FRAMES), VIEW, rows=2)


FIGURE = Figure(
    name="3.6",
    title="Figure 3.6  A brick wall blown apart, from below",
    compute=compute,
    draw=draw,
    size=(1500, 900),
)
