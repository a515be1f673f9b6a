"""Figure 3.7: a wall with more friction and a smaller charge: its top is thrown off, its foot stays."""

from __future__ import annotations

from typing import TYPE_CHECKING

from brisance.figures import wall
from brisance.figures.figure import Figure
from brisance.figures.painter import draw_frames
from brisance.render.camera import View

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

    from brisance.result import Result

VIEW = View(azimuth=24.0, elevation=14.0)


def compute() -> Result:
    """The wall that resists, simulated to its end."""
    return wall.result(wall.RESISTS)


def draw(picture: Picture, result: Result) -> None:
    last = len(result.times) - 1
    charge, friction = result.scene.charges[0], result.scene.objects[0].friction
    draw_frames(picture, result, [last], VIEW, rows=1, captions=False)
    picture.axes[0].set_title(
        f"{charge.mass:g} kg of TNT, friction {friction:g}, "
        f"{1e3 * result.times[last]:.0f} ms after the detonation"
    )


FIGURE = Figure(
    name="3.7",
    title="Figure 3.7  A wall that resists",
    compute=compute,
    draw=draw,
    size=(1100, 860),
)
