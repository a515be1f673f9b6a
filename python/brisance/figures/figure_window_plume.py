"""The thesis's window beside one that is coupled to the load and framed, seen from the side (thesis 6.6).

Three windows at moments when their pieces have come equally far in the mean: as in the thesis; the same
pattern and charge, but in a frame, and breaking under the load; and the window of scenes/window.toml.
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

import numpy as np

import brisance
from brisance.figures import style, wall, window
from brisance.figures.figure import Figure
from brisance.figures.painter import paint
from brisance.plume import Plume, plume
from brisance.render.camera import CameraPose, frame, looking_from

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

    from brisance.figures.figure import Table
    from brisance.result import Result

TRAVELS = (0.25, 0.75, 1.5)
"""How far the pieces have come in the mean [m]."""
IN_VIEW = 0.98
"""Share of the pieces that the camera has to show."""
COUPLING = ("window.0.release=as it cracks", "window.0.frame=true", "loading.clearing=assembly")
"""What makes the thesis's window one that breaks under its load in a frame and in a wall."""


@cache
def coupled() -> Result:
    """The thesis's pattern and charge, coupled and framed."""
    return brisance.simulate(wall.scene(window.THESIS, COUPLING))


@cache
def street() -> Result:
    """The window of scenes/window.toml by itself: what stands beside it would hide half the plume."""
    scene = wall.scene(window.COUPLED)
    windows = [thing for thing in scene.objects if isinstance(thing, brisance.Window)]
    return brisance.simulate(scene.model_copy(update={"objects": windows}))


def compute() -> dict[str, Result]:
    """The three windows by what they are."""
    return {
        "as in the thesis": wall.result(window.THESIS),
        "same pattern and charge,\ncoupled and framed": coupled(),
        "scenes/window.toml": street(),
    }


def plumes(result: Result) -> list[Plume]:
    """The plume of a window at each of the ``TRAVELS``."""
    return [plume(result, result.panes[0], travel=travel) for travel in TRAVELS]


def shown(result: Result, at: Plume) -> int:
    """The frame nearest to a plume."""
    return int(np.argmin(np.abs(result.times - at.time_s)))


def draw(picture: Picture, results: dict[str, Result]) -> None:
    width, height = picture.get_size_inches() * picture.dpi
    size = (int(width / len(TRAVELS)), int(0.85 * height / len(results)))
    rows = picture.subplots(len(results), len(TRAVELS), squeeze=False)
    camera = place(results, aspect=size[0] / size[1])
    for row, (name, result) in zip(rows, results.items(), strict=True):
        for axes, at in zip(row, plumes(result), strict=True):
            axes.imshow(paint(result, shown(result, at), camera, size=size), interpolation="antialiased")
            axes.grid(False)
            axes.set_xticks([])
            axes.set_yticks([])
            for spine in axes.spines.values():
                spine.set_color(style.PALE)
            axes.set_title(
                f"{1e3 * at.time_s:.0f} ms: {at.length_m:.2f} m long, {at.width_m:.2f} m wide",
                loc="center",
                y=-0.02,
                va="top",
            )
        row[0].set_ylabel(name, fontsize="small")
    for axes, travel in zip(rows[0], TRAVELS, strict=True):
        axes.text(0.5, 1.02, f"{travel:g} m in the mean", transform=axes.transAxes, ha="center", va="bottom")


def place(results: dict[str, Result], *, aspect: float) -> CameraPose:
    """One camera for all, from the side."""
    centres, radii = [], []
    for result in results.values():
        pieces = slice(result.panes[0].start, result.panes[0].stop)
        reach = [np.linalg.norm(mesh.points, axis=1).max() for mesh in result.meshes[pieces]]
        for at in plumes(result):
            centres.append(result.positions[shown(result, at), pieces])
            radii.append(reach)
    return frame(
        np.concatenate(centres).astype(float),
        np.concatenate(radii).astype(float),
        looking_from(window.SIDE, np.array([0.0, 0.0, 1.0])),
        aspect=aspect,
        fraction=IN_VIEW,
    )


def table(results: dict[str, Result]) -> Table:
    """A row a plume."""
    rows = [(name, at) for name, result in results.items() for at in plumes(result)]
    return {
        "window": [name.replace("\n", " ") for name, _ in rows],
        "mean_travel_m": np.array([at.mean_travel_m for _, at in rows]),
        "time_s": np.array([at.time_s for _, at in rows]),
        "length_m": np.array([at.length_m for _, at in rows]),
        "width_m": np.array([at.width_m for _, at in rows]),
    }


FIGURE = Figure(
    name="window-plume",
    title="Plumes of windows from the side, where their pieces have come equally far",
    compute=compute,
    draw=draw,
    table=table,
    size=(1500, 1150),
)
