"""Table 2.1: what mass of TNT a kilogram of another explosive is worth."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from brisance import _engine
from brisance.figures import style
from brisance.figures.figure import Figure, Table, whole

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture


def compute() -> Table:
    """The explosives that a scene may name, with their factors, in the table's order."""
    names, factors = zip(*_engine.explosives(), strict=True)
    return {"explosive": list(names), "tnt_equivalence": np.array(factors)}


def draw(picture: Picture, data: Table) -> None:
    axes = picture.subplots()
    names, factors = list(data["explosive"]), np.asarray(data["tnt_equivalence"], dtype=float)
    rows = np.arange(len(names))
    axes.barh(rows, factors, height=0.62, color=style.BLUE)
    for row, factor in zip(rows, factors, strict=True):
        axes.text(factor + 0.02, row, f"{factor:.3f}", va="center")
    axes.set_yticks(rows, names)
    axes.invert_yaxis()
    axes.axvline(1.0, color=style.GREY, linewidth=0.8, linestyle=(0, (4, 3)))
    axes.grid(False)
    axes.tick_params(axis="y", length=0)
    axes.set_xlim(0.0, 1.15 * factors.max())
    axes.set_xlabel("mass of TNT per mass of the explosive")


FIGURE = Figure(
    name="table-2.1",
    title="Table 2.1  TNT equivalence of explosives",
    compute=compute,
    draw=draw,
    table=whole,
    size=(1200, 660),
)
