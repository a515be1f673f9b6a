"""What a charge sees: the sphere around it, unfolded, each body in a colour of its own, as a picture."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from brisance import _engine
from brisance.cli.table import count
from brisance.errors import InputError
from brisance.figures import style
from brisance.figures.sphere_sheet import HEIGHT, WIDTH, draw_faces, draw_pixels, frame_sheet
from brisance.formats.atomic import check_writable, replacing
from brisance.scene_file import load, named_in_errors
from brisance.simulation import Built, build

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from brisance.model import Scene

MOST_NAMED = 12
"""Objects that the picture names, those that fill most of it first."""


def draw_map(path: Path, changes: list[str], output: Path) -> str:
    """Draw the maps of all charges of a scene file into a PNG; return what it shows, as text."""
    if check_writable(output).suffix.lower() != ".png":
        raise InputError(f"{output}: the map is a picture; give a name that ends in .png.")
    scene = load(path, changes)
    with named_in_errors(path):
        built = build(scene)
    try:
        seen = [built.engine.seen_from(charge) for charge in range(len(scene.charges))]
        shares = [built.engine.shelter(charge)["attenuation"] for charge in range(len(scene.charges))]
    except ValueError as error:
        raise InputError(f"{path}: {error}") from error
    _write(output, scene, built, seen, shares)
    sheltered = sum(int((share < 1).sum()) for share in shares)
    pieces = count(sum(map(len, built.standing)), "piece")
    return (
        f"{output}: {count(len(scene.charges), 'charge')}, {pieces}, resolution "
        f"{scene.occlusion.resolution}; sheltered in part or in full: {sheltered}"
    )


def _write(
    output: Path,
    scene: Scene,
    built: Built,
    seen: list[tuple[NDArray[np.int64], NDArray[np.float64]]],
    shares: list[NDArray[np.float64]],
) -> None:
    import matplotlib
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure as Picture
    from matplotlib.patches import Patch

    settings: dict[Any, Any] = dict(style.SETTINGS)
    source = _source(built)
    with matplotlib.rc_context(settings):
        size = (1.9 * WIDTH, (1.7 * HEIGHT + 0.6) * len(seen) + 0.4)
        picture = Picture(figsize=size, dpi=style.DPI, layout="constrained")
        FigureCanvasAgg(picture)
        picture.suptitle(f"What the charge sees: {scene.name}", x=0.012, ha="left")
        for number, (axes, (bodies, distances), share) in enumerate(
            zip(picture.subplots(len(seen), 1, squeeze=False)[:, 0], seen, shares, strict=True)
        ):
            colours = _colours(bodies, distances, source)
            draw_pixels(axes, scene.occlusion.resolution, colours)
            draw_faces(axes)
            _mark_hidden(axes, scene, built, number, share)
            frame_sheet(axes)
            axes.set_title(f"charge {number}; near is dark, far is pale; rings mark what is sheltered")
            axes.legend(
                handles=[
                    Patch(color=style.CYCLE[group % len(style.CYCLE)], label=label)
                    for group, label in _labels(built, bodies, source, share)
                ],
                loc="center left",
                bbox_to_anchor=(1.0, 0.5),
                fontsize=7.5,
            )
        with replacing(output) as temporary:
            picture.savefig(temporary, dpi=style.DPI, metadata={"Software": None})


def _mark_hidden(axes: Axes, scene: Scene, built: Built, charge: int, share: NDArray[np.float64]) -> None:
    """A ring of its object's colour where the middle of each sheltered piece is."""
    hidden = np.flatnonzero(share < 1.0)
    if not len(hidden):
        return
    middles = built.engine.standing()["centre_m"] - np.asarray(scene.charges[charge].position)
    pixels = _engine.sphere_pixels(directions=middles[hidden], resolution=scene.occlusion.resolution)
    places = _engine.unfolded_sphere(resolution=scene.occlusion.resolution)[pixels].mean(axis=1)
    colours = [style.CYCLE[group % len(style.CYCLE)] for group in _source(built)[hidden]]
    axes.scatter(places[:, 0], places[:, 1], s=42, color="white", zorder=5)
    axes.scatter(places[:, 0], places[:, 1], s=24, facecolors="none", edgecolors=colours, zorder=6)


def _source(built: Built) -> NDArray[np.intp]:
    """Number of the object that each piece comes from."""
    return np.repeat(np.arange(len(built.standing)), [len(group) for group in built.standing])


def _colours(
    bodies: NDArray[np.int64], distances: NDArray[np.float64], source: NDArray[np.intp]
) -> NDArray[np.float64]:
    """A colour for each object, the paler the farther, and a slight change of it from piece to piece."""
    from matplotlib.colors import to_rgb

    colours = np.zeros((len(bodies), 4))
    met = bodies >= 0
    if not met.any():
        return colours
    cycle = np.array([to_rgb(colour) for colour in style.CYCLE])
    base = cycle[source[bodies[met]] % len(cycle)]
    far = np.log(distances[met])
    pale = 0.65 * (far - far.min()) / max(float(np.ptp(far)), 1e-9)
    tint = 1.0 + 0.12 * np.sin(2.4 * bodies[met])
    colours[met, :3] = np.clip((base * tint[:, None]) * (1 - pale[:, None]) + pale[:, None], 0.0, 1.0)
    colours[met, 3] = 1.0
    return colours


def _labels(
    built: Built, bodies: NDArray[np.int64], source: NDArray[np.intp], share: NDArray[np.float64]
) -> list[tuple[int, str]]:
    """The objects on most pixels first, each with the share of the load that comes through to it."""
    pixels = np.bincount(source[bodies[bodies >= 0]], minlength=len(built.standing))
    labels = []
    for group in np.argsort(-pixels, kind="stable")[:MOST_NAMED].tolist():
        own = share[source == group]
        if not len(own):
            continue
        through = f"{own.min():.2f}" if np.ptp(own) < 0.005 else f"{own.min():.2f} to {own.max():.2f}"
        labels.append((group, f"{built.standing[group].name}: f = {through}"))
    return labels
