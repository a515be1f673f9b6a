"""Figure 2.9: the positive phase replaced by a triangle that keeps its duration (I) or its impulse (II)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from brisance.figures import example, style
from brisance.figures.figure import Figure, Table, whole

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

SHAPES: dict[example.Shape, tuple[str, str, Any]] = {
    "friedlander": ("the pulse", style.INK, "-"),
    "triangle-duration": ("triangle I: same duration", style.ORANGE, (0, (5, 2))),
    "triangle-impulse": ("triangle II: same impulse", style.BLUE, "-"),
}


def compute() -> Table:
    """Overpressure [Pa] of the three shapes over time since the front's arrival."""
    at = example.point()
    times = np.linspace(0.0, 1.08 * at.duration, 400)
    table = {"time_s": times}
    for shape in SHAPES:
        table[f"overpressure_pa:{shape}"] = example.incident(at, times, shape=shape)
    return table


def draw(picture: Picture, data: Table) -> None:
    axes = picture.subplots()
    milliseconds = 1e3 * np.asarray(data["time_s"], dtype=float)
    for shape, (label, colour, dashes) in SHAPES.items():
        kilopascals = np.asarray(data[f"overpressure_pa:{shape}"], dtype=float) / 1e3
        axes.plot(milliseconds, kilopascals, color=colour, linestyle=dashes, label=label)
        if shape == "friedlander":
            axes.fill_between(milliseconds, kilopascals, color=style.INK, alpha=0.08, linewidth=0)
    axes.set_title(example.WHAT)
    axes.set_xlabel("time since arrival [ms]")
    axes.set_ylabel("overpressure [kPa]")
    axes.set_xlim(0.0, milliseconds[-1])
    axes.set_ylim(bottom=0.0)
    axes.legend()


FIGURE = Figure(
    name="2.9",
    title="Figure 2.9  Two triangles for one pulse",
    compute=compute,
    draw=draw,
    table=whole,
)
