"""A broken pane as SVG: at its true size in millimetres, cracks coloured by when they were cut.

.. code-block:: text

    #pane      the border, filled
    #cracks    one group an age, the earliest first; in it a path for what each tip cut in that time
    #legend    colours and their times

Each group is named after the time from which its cracks are (``from_0.12_ms``), so that showing one after the
other shows the pattern grow.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING
from xml.sax.saxutils import escape

import numpy as np
from numpy.typing import NDArray

from brisance.formats.atomic import write_text
from brisance.formats.pattern_picture import (
    BORDER,
    GLASS,
    STEPS,
    ages,
    border_width,
    caption,
    chains,
    colours,
    line_width,
    scale_end,
)

if TYPE_CHECKING:
    from brisance.pane import Fracture

MM = 1e3
_MARGIN, _BAND, _TEXT = 0.03, 0.085, 0.019
"""Margin, height of the legend and of its letters, as shares of the pane's longer side."""


def write_pattern_svg(fracture: Fracture, path: Path | str) -> None:
    """Write the cracks of a broken pane as SVG, whole or not at all."""
    write_text(path, pattern_svg(fracture))


def pattern_svg(fracture: Fracture) -> str:
    """The drawing as text."""
    low, high = fracture.bounds
    size = MM * (high - low)
    longer = float(size.max())
    margin = _MARGIN * longer
    width, height = size + 2 * margin + np.array([0.0, _BAND * longer])
    stroke = MM * line_width(fracture)
    # Coordinates to a millionth of the pane: far finer than any line.
    digits = max(0, 6 - int(np.floor(np.log10(longer))))
    place = _Place(low, margin=margin, height=float(size[1]) + margin, digits=digits)
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.6g}mm" height="{height:.6g}mm" '
        f'viewBox="0 0 {width:.6g} {height:.6g}">',
        f"<title>{escape(caption(fracture))}</title>",
        f'<path id="pane" d="{"".join(place.path(ring, closed=True) for ring in fracture.outline)}" '
        f'fill="{GLASS}" fill-rule="evenodd" stroke="{BORDER}" stroke-linejoin="round" '
        f'stroke-width="{MM * border_width(fracture):.4g}"/>',
        f'<g id="cracks" fill="none" stroke-width="{stroke:.4g}" stroke-linecap="round" '
        'stroke-linejoin="round">',
    ]
    shades, last = colours(), MM * scale_end(fracture)
    for age, cracks in chains(fracture):
        lines.append(f'<g id="from_{last * age / STEPS:.4g}_ms" stroke="{shades[age]}">')
        lines += [f'<path d="{place.path(points)}"/>' for points in cracks]
        lines.append("</g>")
    lines.append("</g>")
    top = float(size[1]) + 1.6 * margin
    lines += _legend(fracture, left=margin, top=top, width=float(size[0]), unit=longer)
    return "\n".join([*lines, "</svg>", ""])


class _Place:
    """From the pane to the page: millimetres, y downward."""

    def __init__(self, low: NDArray[np.float64], *, margin: float, height: float, digits: int) -> None:
        self._scale = np.array([MM, -MM])
        self._shift = np.array([margin, height]) - self._scale * low
        self._format = f"%.{digits}f"

    def path(self, points: NDArray[np.float64], *, closed: bool = False) -> str:
        """A polyline or polygon as the data of a path."""
        numbers = (points * self._scale + self._shift).ravel().tolist()
        form = self._format
        text = " ".join([form % number for number in numbers])
        return f"M{text}Z" if closed else f"M{text}"


def _legend(fracture: Fracture, *, left: float, top: float, width: float, unit: float) -> list[str]:
    """A strip of colours with the times of its ends and middle, and what the picture shows."""
    letters, thick, strip = _TEXT * unit, 0.012 * unit, 0.4 * width
    cell = strip / STEPS
    lines = [f'<g id="legend" font-family="sans-serif" font-size="{letters:.4g}" fill="{BORDER}">']
    # Each cell reaches to the end of the strip, or hairlines would show between them.
    lines += [
        f'<rect x="{left + age * cell:.6g}" y="{top:.6g}" width="{strip - age * cell:.6g}" '
        f'height="{thick:.4g}" fill="{shade}"/>'
        for age, shade in enumerate(colours())
    ]
    below = top + thick + 1.1 * letters
    for share, anchor, words in zip((0, 0.5, 1), ("start", "middle", "end"), ages(fracture), strict=True):
        lines.append(
            f'<text x="{left + share * strip:.6g}" y="{below:.6g}" text-anchor="{anchor}">{words}</text>'
        )
    lines.append(f'<text x="{left:.6g}" y="{below + 1.4 * letters:.6g}">{escape(caption(fracture))}</text>')
    return [*lines, "</g>"]
