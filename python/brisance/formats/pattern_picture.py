"""What drawings of a broken pane share: cracks cut up by age, colours, line widths and words."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from brisance.pane import Fracture

Array = NDArray[np.float64]

STEPS = 32
"""Colours from the first crack to the last."""
BORDER = "#1d2430"
GLASS = "#f3f7f6"
_COLOURS = np.array(
    [(0x14, 0x1B, 0x4D), (0x4B, 0x12, 0x84), (0x93, 0x1A, 0x80), (0xC9, 0x37, 0x5A), (0xE8, 0x74, 0x2B)],
    dtype=np.float64,
)
"""Dark to light by age, all of them dark enough for a thin line on white, in sRGB."""
_WIDEST, _SHARE = 0.0016, 0.045
"""A line is as wide as this share of the pane's longer side, or of a piece's size if that is less."""


def colours() -> list[str]:
    """The colour of each age, #rrggbb, the first crack's first."""
    place = np.linspace(0, len(_COLOURS) - 1, STEPS)
    channels = [np.interp(place, np.arange(len(_COLOURS)), channel) for channel in _COLOURS.T]
    return [f"#{r:02x}{g:02x}{b:02x}" for r, g, b in np.rint(np.stack(channels, axis=1)).astype(int).tolist()]


def line_width(fracture: Fracture) -> float:
    """Width of a crack's line [m]."""
    low, high = fracture.bounds
    piece = np.sqrt(float(fracture.solids.area_m2.mean()))
    return float(min(_WIDEST * (high - low).max(), _SHARE * piece))


def border_width(fracture: Fracture) -> float:
    """Width of the line round the pane [m]."""
    low, high = fracture.bounds
    return 2 * _WIDEST * float((high - low).max())


def scale_end(fracture: Fracture) -> float:
    """Time at which the last colour ends [s]: when 99 % of the length of all cracks is cut.

    The last few often come much later, and would leave the others hardly a colour of their own.
    """
    ends, times = fracture.engine.crack_ends, fracture.crack_times[:, 1]
    if len(ends) == 0:
        return 0.0
    order = np.argsort(times, kind="stable")
    cut = np.cumsum(np.hypot(*(ends[:, 2:] - ends[:, :2]).T)[order])
    return float(times[order][np.searchsorted(cut, 0.99 * cut[-1])])


def caption(fracture: Fracture) -> str:
    """The pattern in a few words."""
    pieces = len(fracture.engine)
    return (
        f"{fracture.pattern.glass} glass, {pieces:,} fragment{'' if pieces == 1 else 's'}, "
        f"critical length {1e3 * fracture.critical_length:.3g} mm, seed {fracture.seed}"
    )


def ages(fracture: Fracture) -> list[str]:
    """Words for the first, middle and last age."""
    last = 1e3 * scale_end(fracture)
    return ["0", f"{0.5 * last:.2g}", f"{last:.2g} ms +"]


def chains(fracture: Fracture) -> Iterator[tuple[int, list[Array]]]:
    """Of every age its cracks: (age, lines), each line the points (n, 2) [m] that one tip cut in that time.

    A crack that grows through several ages is cut where they change.
    """
    engine, last = fracture.engine, scale_end(fracture)
    ends, growth = engine.crack_ends, engine.crack_growth_m
    if last == 0 or len(ends) == 0:
        return
    edges = _growth_at(fracture, np.linspace(0.0, last, STEPS + 1))
    edges[-1] = np.inf
    first = np.clip(np.searchsorted(edges, growth[:, 0], side="right") - 1, 0, STEPS - 1)
    final = np.clip(np.searchsorted(edges, growth[:, 1], side="left") - 1, first, STEPS - 1)
    parts = final - first + 1
    crack = np.repeat(np.arange(len(ends)), parts)
    age = first[crack] + np.arange(len(crack)) - np.repeat(np.cumsum(parts) - parts, parts)
    start, length = growth[crack, 0], growth[crack, 1] - growth[crack, 0]
    share = np.stack([edges[age], np.minimum(edges[age + 1], growth[crack, 1])], axis=1) - start[:, None]
    share = np.divide(share, length[:, None], out=np.zeros_like(share), where=length[:, None] > 0)
    share[age == first[crack], 0], share[age == final[crack], 1] = 0.0, 1.0
    begin, along = ends[crack, :2], (ends[:, 2:] - ends[:, :2])[crack]
    heads, tails = begin + along * share[:, :1], begin + along * share[:, 1:]
    order = np.lexsort((crack, engine.crack_tips[crack], age))
    age, tip, heads, tails = age[order], engine.crack_tips[crack][order], heads[order], tails[order]
    near = 1e-9 * float((fracture.bounds[1] - fracture.bounds[0]).max())
    goes_on = (age[1:] == age[:-1]) & (tip[1:] == tip[:-1])
    goes_on &= (np.abs(heads[1:] - tails[:-1]) <= near).all(axis=1)
    breaks = np.flatnonzero(~goes_on) + 1
    lines = [
        np.concatenate([heads[a : a + 1], tails[a:b]])
        for a, b in zip([0, *breaks.tolist()], [*breaks.tolist(), len(tails)], strict=True)
    ]
    of_line = age[[0, *breaks]]
    for step in range(STEPS):
        low, high = np.searchsorted(of_line, [step, step + 1])
        if high > low:
            yield step, lines[low:high]


def _growth_at(fracture: Fracture, times: Array) -> Array:
    """How far the first cracks had grown at some times [m]: the clock of the cracks, turned over."""
    most = float(fracture.engine.crack_growth_m.max())
    growth = most * np.linspace(0.0, 1.0, 2001) ** 3
    found: Array = np.interp(times, fracture.time(growth), growth)
    return found
