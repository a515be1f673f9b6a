"""The example scenes of shelter, simulated with and without it, and seen from above."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

import brisance
from brisance.figures import style, wall
from brisance.rotation import matrix_from_quaternion

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Picture

    from brisance.figures.figure import Table
    from brisance.result import Result

ALIKE = "shelter.toml"
APART = "shelter_gap.toml"
COLOURS = (style.INK, style.BLUE, style.ORANGE)
OPEN, SHELTERED = "in the open", "behind the wall"


@cache
def results(name: str) -> dict[str, Result]:
    """The scene without its occluder's shadow and with it."""
    scene = wall.scene(name)
    in_open = scene.model_copy(update={"objects": tuple(obj for obj in scene.objects if obj.name != "wall")})
    return {OPEN: brisance.simulate(in_open), SHELTERED: brisance.simulate(scene)}


def table(both: dict[str, Result]) -> Table:
    """Distance [m], share of the load, launch speed [m/s] and way gone [m] of each small block, both ways."""
    rows: list[tuple[str, str, float, float, float, float]] = []
    for way, result in both.items():
        bodies = result.bodies
        for index, name in enumerate(bodies.names):
            if name == "wall":
                continue
            gone = float(np.linalg.norm(bodies.final_position_m[index] - result.positions[0, index]))
            share, speed = float(bodies.attenuation[index]), float(bodies.launch_speed_m_s[index])
            rows.append((way, name, float(bodies.distance_m[index]), share, speed, gone))
    columns = list(zip(*rows, strict=True))
    return {
        "scene": [str(value) for value in columns[0]],
        "block": [str(value) for value in columns[1]],
        "distance_m": np.array(columns[2], dtype=float),
        "attenuation": np.array(columns[3], dtype=float),
        "launch_speed_m_s": np.array(columns[4], dtype=float),
        "distance_travelled_m": np.array(columns[5], dtype=float),
    }


def draw_rows(picture: Picture, both: dict[str, Result], frames: list[int]) -> None:
    """Draw ``frames`` of each result in a row of its own, from above, all to one scale."""
    panels = picture.subplots(len(both), len(frames), squeeze=False, sharex=True, sharey=True)
    seen = [shape for result in both.values() for index in frames for shape in _small(result, index)]
    points = np.concatenate([*seen, np.zeros((1, 2))])
    low, high = points.min(axis=0) - 0.4, points.max(axis=0) + 0.4
    for row, (way, result) in enumerate(both.items()):
        for column, index in enumerate(frames):
            axes = panels[row, column]
            draw_from_above(axes, result, index)
            axes.set_xlim(low[0], high[0])
            axes.set_ylim(low[1] - 0.3, high[1])
            axes.set_aspect("equal")
            axes.set_title(f"{way}, {1e3 * result.times[index]:.0f} ms", loc="left")
            if row == len(both) - 1:
                axes.set_xlabel("z [m]")
            if column == 0:
                axes.set_ylabel("x [m]")


def draw_from_above(axes: Axes, result: Result, index: int) -> None:
    """Draw the charge as a black square, what is anchored in grey, and the rest in colours of their own."""
    from matplotlib.patches import Polygon, Rectangle

    axes.grid(False)
    axes.set_facecolor("#f6f5f2")
    charge = result.scene.charges[0].position
    axes.add_patch(Rectangle((charge[2] - 0.12, charge[0] - 0.12), 0.24, 0.24, facecolor="black", zorder=4))
    small = 0
    for body, obj in enumerate(result.scene.objects):
        shape = footprint(result, index, body)
        if obj.anchored:
            axes.add_patch(Polygon(shape, facecolor=style.GREY, edgecolor=style.INK, linewidth=0.8))
            continue
        colour = COLOURS[small % len(COLOURS)]
        small += 1
        axes.add_patch(Polygon(shape, facecolor=colour, edgecolor="white", linewidth=0.8, zorder=3))
        start = footprint(result, 0, body)
        axes.add_patch(Polygon(start, fill=False, edgecolor=colour, linewidth=0.8, linestyle=(0, (2, 2))))


def footprint(result: Result, index: int, body: int) -> NDArray[np.float64]:
    """Outline (n, 2) of a body seen from above, z to the right and x up [m]."""
    from scipy.spatial import ConvexHull

    turn = matrix_from_quaternion(result.orientations[index, body])
    points = result.meshes[body].points @ turn.T + result.positions[index, body]
    flat = np.asarray(points[:, [2, 0]], dtype=float)
    return np.asarray(flat[ConvexHull(flat).vertices])


def _small(result: Result, index: int) -> list[NDArray[np.float64]]:
    objects = enumerate(result.scene.objects)
    return [footprint(result, index, body) for body, obj in objects if not obj.anchored]
