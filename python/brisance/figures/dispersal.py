"""Where the bricks of the wall lie when all has come to rest (thesis 7.1), seen from above."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from brisance.dispersal import SECTORS, dispersal
from brisance.figures import style, wall
from brisance.figures.figure import Figure, Table
from brisance.rotation import rotate

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Picture

    from brisance.result import Result

SCENE = "brick_wall_aftermath.toml"
DIRECTIONS = ("+x", "+x -z", "-z", "-x -z", "-x", "-x +z", "+z", "+x +z")


def compute() -> Result:
    """The wall's aftermath, simulated until all rests."""
    return wall.result(SCENE)


def draw(picture: Picture, result: Result) -> None:
    above, rings = picture.subplots(1, 2, width_ratios=(1.6, 1.0))
    _draw_from_above(above, result)
    _draw_rings(rings, result)
    moving = dispersal(result).still_moving
    state = f"{moving} pieces still moving" if moving else "at rest"
    picture.suptitle(f"{result.scene.name}, {state} after {result.times[-1]:.1f} s")


def _draw_from_above(axes: Axes, result: Result) -> None:
    from matplotlib.patches import Circle, Polygon
    from scipy.spatial import ConvexHull

    found = dispersal(result)
    # What lies on others is drawn over them.
    for index in np.argsort(result.positions[-1, :, 1], kind="stable"):
        mesh = result.meshes[index]
        for frame, face, edge in ((0, "none", style.GREY), (-1, style.BLUE, "white")):
            turn = result.orientations[frame, index].astype(np.float64)
            points = rotate(turn, mesh.points.astype(np.float64)) + result.positions[frame, index]
            seen = points[:, [0, 2]]
            hull = seen[ConvexHull(seen).vertices]
            axes.add_patch(Polygon(hull.tolist(), facecolor=face, edgecolor=edge, linewidth=0.6))
    for radius in found.edges[1:]:
        axes.add_patch(
            Circle(
                (float(found.origin[0]), float(found.origin[1])),
                float(radius),
                fill=False,
                linestyle=":",
                linewidth=0.8,
                edgecolor=style.GREY,
            )
        )
    reach = 1.1 * max(found.farthest, 0.5)
    axes.set_xlim(found.origin[0] - reach, found.origin[0] + reach)
    axes.set_ylim(found.origin[1] + reach, found.origin[1] - reach)
    axes.set_aspect("equal")
    axes.set_xlabel("x [m]")
    axes.set_ylabel("z [m], away from the charge")


def _draw_rings(axes: Axes, result: Result) -> None:
    found = dispersal(result)
    labels = [f"{low:g}-{high:g}" for low, high in zip(found.edges[:-1], found.edges[1:], strict=True)]
    places = np.arange(len(labels))
    axes.bar(places, found.mass.sum(axis=1), color=style.BLUE)
    for place, mass, count in zip(places, found.mass.sum(axis=1), found.count.sum(axis=1), strict=True):
        axes.annotate(
            f"{count}", (place, mass), xytext=(0, 3), textcoords="offset points", ha="center", fontsize=9
        )
    axes.set_xticks(places, labels)
    axes.set_xlabel("distance from the middle of the wall [m]")
    axes.set_ylabel("mass [kg]; the number of pieces above")


def table(result: Result) -> Table:
    """One row a ring and direction."""
    found = dispersal(result)
    rings = np.repeat(np.arange(len(found.edges) - 1), SECTORS)
    return {
        "from_m": found.edges[:-1][rings],
        "to_m": found.edges[1:][rings],
        "direction": [DIRECTIONS[sector] for sector in range(SECTORS)] * (len(found.edges) - 1),
        "count": found.count.ravel().astype(np.float64),
        "mass_kg": found.mass.ravel(),
    }


FIGURE = Figure(
    name="dispersal",
    title="The dispersal of a wall: where its bricks come to rest, seen from above",
    compute=compute,
    draw=draw,
    table=table,
    size=(1400, 800),
)
