"""Figure 6.3: the triangle over which the inertia is integrated, divided at its middle corner."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from brisance.figures import cracks, fragment, style
from brisance.figures.figure import Figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Picture

Array = NDArray[np.float64]

BEHIND = np.array([0.24, 0.16])
"""Where the back of the prism is drawn, in widths of the triangle."""
COLOURS = ((style.BLUE, "#cfe3f0"), (style.ORANGE, "#f8dfcf"))
"""Line and face of either half."""


@dataclass(frozen=True)
class Section:
    """One half: between two verticals and two sloped lines y = m x + b."""

    left: float
    right: float
    upper: tuple[float, float]
    """m [-] and b [m] of the line above."""
    lower: tuple[float, float]
    """m [-] and b [m] of the line below."""


@dataclass(frozen=True)
class Divided:
    """A triangle and its two halves."""

    corners: Array
    """Corners from left to right (3, 2) [m]."""
    sections: tuple[Section, Section]


def compute() -> Divided:
    """The largest triangle of the fragment of Fig. 6.1, about the fragment's centroid as in (6.2)–(6.5)."""
    triangles = fragment.chosen().triangles
    a, b = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    return divide(triangles[np.argmax(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])])


def divide(triangle: Array) -> Divided:
    """Divide a triangle by the vertical through its middle corner."""
    corners = triangle[np.argsort(triangle[:, 0])]
    first, middle, last = corners
    across = _line(first, last)
    sections = []
    for start, end in ((first, middle), (middle, last)):
        side = _line(start, end)
        above = middle[1] > across[0] * middle[0] + across[1]
        upper, lower = (side, across) if above else (across, side)
        sections.append(Section(float(start[0]), float(end[0]), upper, lower))
    return Divided(corners, (sections[0], sections[1]))


def _line(p: Array, q: Array) -> tuple[float, float]:
    """m and b of the line through two points. A vertical one bounds a half of no width: level then."""
    slope = (q[1] - p[1]) / (q[0] - p[0]) if q[0] != p[0] else 0.0
    return float(slope), float(p[1] - slope * p[0])


def draw(picture: Picture, data: Divided) -> None:
    axes = picture.subplots()
    corners = 1e3 * data.corners
    away = float(corners[2, 0] - corners[0, 0]) * BEHIND
    for one, other in ((0, 1), (1, 2), (0, 2)):
        side = np.array([corners[one], corners[other], corners[other] + away, corners[one] + away])
        axes.fill(*side.T, facecolor="#f3f3f3", edgecolor=style.GREY, linewidth=0.9)
    for section, (colour, pale) in zip(data.sections, COLOURS, strict=True):
        _draw_half(axes, section, colour, pale)
    cracks.bare(axes)
    axes.margins(0.2, 0.14)
    for section, (colour, _), height in zip(data.sections, COLOURS, (0.07, 0.02), strict=True):
        numbers = axes.text(
            0.5, height, _numbers(section), transform=axes.transAxes, ha="center", color=colour
        )
        numbers.set_in_layout(False)


def _draw_half(axes: Axes, section: Section, colour: str, pale: str) -> None:
    """Draw one half, the names of its lines and limits beside them."""
    x = 1e3 * np.array([section.left, section.right])
    lines = {"u": section.upper, "l": section.lower}
    y = {name: m * x + 1e3 * b for name, (m, b) in lines.items()}
    axes.fill_between(x, y["l"], y["u"], facecolor=pale, edgecolor=style.INK, linewidth=1.2, zorder=2)
    for name, sign in (("u", 1.0), ("l", -1.0)):
        axes.plot(x, y[name], color=colour, linewidth=2.6, zorder=3)
        normal = sign * np.array([-lines[name][0], 1.0]) / np.hypot(lines[name][0], 1.0)
        axes.annotate(
            f"y = m$_{name}$x + b$_{name}$",
            (x.mean(), y[name].mean()),
            (22.0 if name == "l" else 14.0) * normal,
            textcoords="offset points",
            ha="left" if normal[0] > 0.3 else "right" if normal[0] < -0.3 else "center",
            va="center",
            color=colour,
            weight="bold",
            zorder=4,
        )


def _numbers(section: Section) -> str:
    lines = "   ".join(
        f"m$_{name}$ = {m:.3f}   b$_{name}$ = {1e3 * b:.2f} mm"
        for name, (m, b) in (("u", section.upper), ("l", section.lower))
    )
    return f"x$_l$ = {1e3 * section.left:.2f} mm   x$_r$ = {1e3 * section.right:.2f} mm   {lines}"


FIGURE = Figure(
    name="6.3",
    title="Figure 6.3  A triangular prism, divided at its middle corner",
    compute=compute,
    draw=draw,
    size=(1300, 1200),
)
