"""Where pieces lie when all has come to rest (thesis 7.1), seen from above: those of the example wall, of any
scene, or of any report.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from brisance.dispersal import SECTORS, dispersal
from brisance.errors import InputError
from brisance.figures import style, wall
from brisance.figures.figure import Figure, Table
from brisance.rotation import rotate
from brisance.scene_file import load, named_in_errors
from brisance.simulation import simulate

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Picture

    from brisance.result import Result

SCENE = "brick_wall_aftermath.toml"
DIRECTIONS = ("+x", "+x -z", "-z", "-x -z", "-x", "-x +z", "+z", "+x +z")

SMALL = 0.015
"""Pieces smaller than this share of the picture are drawn without an edge."""

Points = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Lying:
    """What the picture shows."""

    scene: str
    end: float
    """The last frame [s]."""
    still_moving: int
    origin: Points
    """(2,) x and z that distances are counted from [m]."""
    edges: Points
    """(rings + 1,) [m]."""
    count: NDArray[np.int64]
    """(rings, sectors) pieces."""
    mass: Points
    """(rings, sectors) [kg]."""
    farthest: float
    """[m]."""
    before: list[Points]
    """Outlines (n, 2) of the pieces that moved, before the blast, x and z [m]; a report knows none."""
    after: list[Points]
    """Outlines in the end, lower ones first; of a report, places (1, 2)."""
    moved: NDArray[np.bool_]
    """Which of the latter moved."""


def of_result(result: Result) -> Lying:
    """What is to be seen of a result."""
    found = dispersal(result)
    order = np.argsort(result.positions[-1, :, 1], kind="stable")
    return Lying(
        scene=result.scene.name,
        end=float(result.times[-1]),
        still_moving=found.still_moving,
        origin=found.origin,
        edges=found.edges,
        count=found.count,
        mass=found.mass,
        farthest=found.farthest,
        before=[_from_above(result, 0, index) for index in order if found.moved[index]],
        after=[_from_above(result, -1, index) for index in order],
        moved=found.moved[order],
    )


def of_report(path: Path) -> Lying:
    """What is to be seen of a report: of each piece its place, without its shape."""
    try:
        report: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
        found, rings = report["dispersal"], report["dispersal"]["rings"]
        places = np.array([body["final_position_m"] for body in report["bodies"]], dtype=float).reshape(-1, 3)
        # What never left its place rests from the beginning.
        moved = np.array([body["rest_time_s"] != 0 for body in report["bodies"]], dtype=bool)
        order = np.argsort(places[:, 1], kind="stable")
        return Lying(
            scene=report["scene"],
            end=(report["frames"] - 1) / report["frame_rate"],
            still_moving=found["still_moving"],
            origin=np.array(found["origin_m"], dtype=float),
            edges=np.array([0.0, *(ring["to_m"] for ring in rings)]),
            count=np.array([ring["count"] for ring in rings], dtype=np.int64).reshape(-1, SECTORS),
            mass=np.array([ring["mass_kg"] for ring in rings], dtype=float).reshape(-1, SECTORS),
            farthest=float(found["farthest_m"]),
            before=[],
            after=list(places[order][:, None, [0, 2]]),
            moved=moved[order],
        )
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise InputError(
            f"{path} is not a report of Brisance with a dispersal; write one with brisance run --report."
        ) from error


def figure_of(path: Path) -> Figure[Lying]:
    """The figure of a scene file, which is simulated, or of a report (.json) of a run.

    Raises :class:`InputError` where there is no such file, or it is neither.
    """

    def compute() -> Lying:
        if path.suffix.lower() == ".json":
            if not path.is_file():
                raise InputError(f"{path} does not exist; give a scene file (.toml) or a report (.json).")
            return of_report(path)
        scene = load(path)
        with named_in_errors(path):
            return of_result(simulate(scene))

    return Figure(
        name=f"dispersal-{path.stem}",
        title=f"The dispersal of {path.name}",
        compute=compute,
        draw=draw,
        table=table,
        size=FIGURE.size,
    )


def compute() -> Lying:
    """The wall's aftermath, simulated until all rests."""
    return of_result(wall.result(SCENE))


def draw(picture: Picture, lying: Lying) -> None:
    above, rings = picture.subplots(1, 2, width_ratios=(1.6, 1.0))
    _draw_from_above(above, lying)
    _draw_rings(rings, lying)
    moving = lying.still_moving
    state = f"{moving} pieces still moving" if moving else "at rest"
    picture.suptitle(f"{lying.scene}, {state} after {lying.end:.1f} s")


def _from_above(result: Result, frame: int, index: int) -> Points:
    """The outline of a piece [m], (n, 2), seen from above."""
    from scipy.spatial import ConvexHull, QhullError

    turn = result.orientations[frame, index].astype(np.float64)
    points = rotate(turn, result.meshes[index].points.astype(np.float64)) + result.positions[frame, index]
    seen: Points = points[:, [0, 2]]
    try:
        outline: Points = seen[ConvexHull(seen).vertices]
    except QhullError:  # thinner than digits
        return seen
    return outline


def _draw_from_above(axes: Axes, lying: Lying) -> None:
    from matplotlib.collections import PolyCollection
    from matplotlib.patches import Circle

    axes.add_collection(
        PolyCollection(lying.before, facecolors="none", edgecolors=style.GREY, linewidths=0.6, zorder=1)
    )
    colours = [style.BLUE if moved else style.PALE for moved in lying.moved]
    # What lies on others is drawn over them.
    if lying.after and len(lying.after[0]) == 1:
        x, z = np.concatenate(lying.after).T
        axes.scatter(x, z, s=6, c=colours, edgecolors=style.GREY, linewidths=0.2, zorder=2)
    else:
        axes.add_collection(
            PolyCollection(
                lying.after, facecolors=colours, edgecolors=_edge_colours(lying), linewidths=0.4, zorder=2
            )
        )
    for radius in lying.edges[1:]:
        axes.add_patch(
            Circle(
                (float(lying.origin[0]), float(lying.origin[1])),
                float(radius),
                fill=False,
                linestyle=":",
                linewidth=0.8,
                edgecolor=style.GREY,
                zorder=3,
            )
        )
    low, high = _bounds(lying)
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(high[1], low[1])
    axes.set_aspect("equal")
    axes.set_xlabel("x [m]")
    axes.set_ylabel("z [m]")


def _edge_colours(lying: Lying) -> list[str]:
    """Of each piece in the end: white where it moved, so that heaps can be told apart, but not round one so
    small that nothing else would be seen of it.
    """
    small = SMALL * float(np.ptp(_bounds(lying), axis=0)[0])
    return [
        (style.BLUE if np.ptp(outline, axis=0).max() < small else "white") if moved else style.GREY
        for outline, moved in zip(lying.after, lying.moved, strict=True)
    ]


def _bounds(lying: Lying) -> Points:
    """The lowest and the highest x and z of a square about what moved [m], (2, 2), with some room."""
    ends = [outline for outline, moved in zip(lying.after, lying.moved, strict=True) if moved]
    points = np.concatenate([lying.origin[None], *lying.before, *ends])
    low, high = points.min(axis=0), points.max(axis=0)
    half = 0.55 * max(float((high - low).max()), 1.0)
    middle = 0.5 * (low + high)
    return np.array([middle - half, middle + half])


def _draw_rings(axes: Axes, lying: Lying) -> None:
    labels = [f"{low:g}-{high:g}" for low, high in zip(lying.edges[:-1], lying.edges[1:], strict=True)]
    places = np.arange(len(labels))
    axes.bar(places, lying.mass.sum(axis=1), color=style.BLUE)
    for place, mass, count in zip(places, lying.mass.sum(axis=1), lying.count.sum(axis=1), strict=True):
        axes.annotate(
            f"{count}", (place, mass), xytext=(0, 3), textcoords="offset points", ha="center", fontsize=9
        )
    axes.set_xticks(places, labels)
    axes.set_xlabel("distance from their middle before [m]")
    axes.set_ylabel("mass [kg]; the number of pieces above")


def table(lying: Lying) -> Table:
    """One row a ring and direction."""
    rings = np.repeat(np.arange(len(lying.edges) - 1), SECTORS)
    return {
        "from_m": lying.edges[:-1][rings],
        "to_m": lying.edges[1:][rings],
        "direction": [DIRECTIONS[sector] for sector in range(SECTORS)] * (len(lying.edges) - 1),
        "count": lying.count.ravel().astype(np.float64),
        "mass_kg": lying.mass.ravel(),
    }


FIGURE = Figure(
    name="dispersal",
    title="The dispersal of a wall: where its bricks come to rest, seen from above",
    compute=compute,
    draw=draw,
    table=table,
    size=(1400, 800),
)
