"""Figure 4.5: attenuation over blocking factor and separation, as (4.1) has it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from brisance import _engine
from brisance.figures.figure import Figure, Table, whole
from brisance.model.settings import Occlusion

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

STEPS = 41


def compute() -> Table:
    """Attenuation on a grid of separations, 0 to 1, and blocking factors, 0 to 8 pixels."""
    separation, blocking = np.meshgrid(np.linspace(0.0, 1.0, STEPS), np.linspace(0.0, 8.0, STEPS))
    own = Occlusion()
    share = _engine.attenuation(
        blocking=blocking,
        separation=separation,
        offset=own.offset,
        slope=own.slope,
        exponent=own.exponent,
        power=own.power,
    )
    return {
        "separation": separation.ravel(),
        "blocking_px": blocking.ravel(),
        "attenuation": np.asarray(share).ravel(),
    }


def draw(picture: Picture, data: Table) -> None:
    axes = picture.add_subplot(projection="3d")
    k, b, f = (
        np.asarray(data[name], dtype=float).reshape(STEPS, STEPS)
        for name in ("separation", "blocking_px", "attenuation")
    )
    axes.plot_surface(k, b, f, cmap="viridis", rcount=STEPS, ccount=STEPS, linewidth=0.2, edgecolor="white")
    axes.set_xlabel("separation k")
    axes.set_ylabel("blocking factor b [px]")
    axes.set_zlabel("attenuation f")
    axes.view_init(elev=26.0, azim=-52.0)


FIGURE = Figure(
    name="4.5",
    title="Figure 4.5  Attenuation by blocking factor and separation",
    compute=compute,
    draw=draw,
    table=whole,
    size=(1100, 900),
)
