"""Figure 4.3: the icosahedron around a charge, unfolded into the plane, with its pixels."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from brisance import _engine
from brisance.figures import style
from brisance.figures.figure import Figure, Table, whole
from brisance.figures.sphere_sheet import draw_faces, frame_sheet

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

RESOLUTION = 32


def compute() -> Table:
    """Corners of the pixels of all twenty faces on the sheet, in lengths of an icosahedron's edge."""
    pixels = _engine.unfolded_sphere(resolution=RESOLUTION)
    per_face = RESOLUTION**2
    return {
        "face": np.repeat(np.arange(20.0), per_face),
        "pixel": np.tile(np.arange(float(per_face)), 20),
        **{f"{axis}{corner}": pixels[:, corner, i] for corner in range(3) for i, axis in enumerate("xy")},
    }


def draw(picture: Picture, data: Table) -> None:
    from matplotlib.collections import PolyCollection

    axes = picture.subplots()
    corners = np.stack(
        [np.column_stack([data[f"x{corner}"], data[f"y{corner}"]]) for corner in range(3)], axis=1
    )
    axes.add_collection(
        PolyCollection(list(corners), facecolors="none", edgecolors=style.SKY, linewidths=0.12)
    )
    draw_faces(axes, style.INK)
    face = np.asarray(data["face"])
    for number in range(20):
        x, y = corners[face == number].mean(axis=(0, 1))
        axes.text(x, y, str(number), ha="center", va="center", fontsize=8.0, weight="bold")
    axes.set_title(f"20 faces of {RESOLUTION} pixels a side; up is the sky, the middle of the sheet is +z")
    frame_sheet(axes)


FIGURE = Figure(
    name="4.3",
    title="Figure 4.3  The sphere around the charge, unfolded",
    compute=compute,
    draw=draw,
    table=whole,
    size=(1500, 860),
)
