"""Figure 3.4: the pattern in which the wall's bricks are laid."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from brisance.figures import style, wall
from brisance.figures.figure import Figure, Table

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

    from brisance.result import Result


def compute() -> Result:
    """The wall before the blast: the first frame of its simulation."""
    return wall.result(wall.BLOWN_APART)


def bricks(result: Result) -> Table:
    """Name, lower left corner, size [m] and mass [kg] of each brick, seen from the front."""
    low = np.array([mesh.points.min(axis=0) for mesh in result.meshes], dtype=float)
    high = np.array([mesh.points.max(axis=0) for mesh in result.meshes], dtype=float)
    corner = np.asarray(result.positions[0], dtype=float) + low
    return {
        "name": list(result.bodies.names),
        "x_m": corner[:, 0],
        "y_m": corner[:, 1],
        "width_m": (high - low)[:, 0],
        "height_m": (high - low)[:, 1],
        "mass_kg": np.asarray(result.bodies.mass_kg),
    }


def draw(picture: Picture, result: Result) -> None:
    from matplotlib.patches import Rectangle

    axes = picture.subplots()
    table = bricks(result)
    columns = [
        np.asarray(table[key], dtype=float) for key in ("x_m", "y_m", "width_m", "height_m", "mass_kg")
    ]
    heaviest = columns[-1].max()
    for x, y, width, height, mass in zip(*columns, strict=True):
        colour = "#d98f78" if mass > 0.75 * heaviest else "#eec9bb"
        axes.add_patch(Rectangle((x, y), width, height, facecolor=colour, edgecolor=style.INK, linewidth=1.0))
        axes.text(x + 0.5 * width, y + 0.5 * height, f"{mass:g} kg", ha="center", va="center", fontsize=8.0)
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.margins(0.03)
    axes.grid(False)
    axes.set_title(f"{len(columns[0])} bricks, seen from the front")
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")


FIGURE = Figure(
    name="3.4",
    title="Figure 3.4  The brick pattern",
    compute=compute,
    draw=draw,
    table=bricks,
    size=(1100, 820),
)
