"""Figure 5.5: a crack branches each time the energy it releases passes a multiple of what growth takes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from brisance import _engine
from brisance.figures import style
from brisance.figures.figure import Figure, Table
from brisance.model.pattern import Pattern
from brisance.pane import Fracture, fracture

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

MATERIAL = "glass"
STRESS = 50e6
"""Tensile stress [Pa]: about what breaks a window pane."""
LONGEST = 4.3
"""Where the curve ends, in critical lengths."""
TREE = 4.0
"""Length of the sketched tree, in critical lengths."""
FORK = 15.0
"""Angle between branches [degrees], as the thesis states it (5.2.7)."""


@dataclass(frozen=True)
class Branching:
    """Energy over length, and the tree that comes of it."""

    critical_length: float
    """a_c of the material at this stress [m]."""
    resistance: float
    """R, the energy that growth takes [J/m²]: K_c²/E, which (5.5) sets equal to G_c."""
    length: NDArray[np.float64]
    """Lengths of the crack [m]."""
    released: NDArray[np.float64]
    """G at each length [J/m²]."""
    tree: Fracture
    """A crack that starts a_c long at x = a_c and forks by the thesis's rule."""


def compute() -> Branching:
    """The curve of glass in tension, and a tree grown with its critical length."""
    critical = _engine.critical_length(material=MATERIAL, stress=STRESS)
    known = _engine.material(MATERIAL)
    toughness, stiffness = known["toughness_pa_m12"], known["young_modulus_pa"]
    assert toughness is not None and stiffness is not None
    resistance = toughness**2 / stiffness
    length = np.linspace(0.0, LONGEST * critical, 173)
    released = [
        _engine.energy_release(material=MATERIAL, stress=STRESS, length=a) if a else 0.0 for a in length
    ]
    return Branching(critical, resistance, length, np.array(released), _tree(critical))


def _tree(critical: float) -> Fracture:
    # The arm that grows towards the pane's near edge is cut short at once; the other one makes the tree.
    low, high = np.array([1.0, -2.0]) * critical, np.array([6.0, 2.0]) * critical
    pane = np.array([low, (high[0], low[1]), high, (low[0], high[1])])
    pattern = Pattern(
        literal=True,
        shape="segment",
        seeds=[(1e-4, 0.5)],
        critical_length=critical,
        fork_angle=FORK,
        fork_variance=0.0,
        wiggle_probability=0.0,
        reach=(TREE - 1.0) * critical,
    )
    return fracture(pattern, outline=[pane], seed=2)


def table(data: Branching) -> Table:
    return {
        "crack_length_m": data.length,
        "energy_release_j_m2": data.released,
        "multiple_of_resistance": data.released / data.resistance,
    }


def draw(picture: Picture, data: Branching) -> None:
    from matplotlib.collections import LineCollection

    curve, sketch = picture.subplots(2, 1, sharex=True, height_ratios=(3, 2))
    curve.plot(data.length / data.critical_length, data.released / data.resistance, color=style.BLUE)
    for multiple in (1, 2, 3, 4):
        name = "R" if multiple == 1 else f"{multiple} R"
        curve.plot([0.0, multiple, multiple], [multiple, multiple, 0.0], color=style.GREY, linewidth=0.9)
        curve.annotate(name, (0.0, multiple), (5, 3), textcoords="offset points", color=style.GREY)
        sketch.axvline(multiple, color=style.GREY, linewidth=0.9)
    curve.annotate("G", (3.45, 3.45), (-16, 4), textcoords="offset points", color=style.BLUE, weight="bold")
    curve.set_ylabel("energy over R = " + f"{data.resistance:.1f} J/m²")
    curve.set_xlim(0.0, LONGEST)
    curve.set_ylim(0.0, LONGEST)
    curve.set_title(
        f"{MATERIAL} under {STRESS / 1e6:g} MPa: a$_c$ = {1e6 * data.critical_length:.0f} µm, and G = R there"
    )
    ends = data.tree.engine.crack_ends.reshape(-1, 2, 2) / data.critical_length
    sketch.add_collection(LineCollection(list(ends), colors=style.INK, linewidths=1.6))
    sketch.plot([0.0, 1.0], [0.0, 0.0], color=style.ORANGE, linewidth=3.0)
    sketch.annotate(
        "first flaw", (0.5, 0.0), (0, 7), textcoords="offset points", ha="center", color=style.ORANGE
    )
    sketch.grid(False)
    sketch.spines["left"].set_visible(False)
    sketch.set_ylim(-0.9, 0.9)
    sketch.set_yticks([])
    sketch.set_xlabel("length of the crack over a$_c$")


FIGURE = Figure(
    name="5.5",
    title="Figure 5.5  A crack branches each time G passes a multiple of R",
    compute=compute,
    draw=draw,
    table=table,
    size=(1200, 1200),
)
