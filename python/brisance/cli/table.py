"""Plain tables for a terminal: aligned columns that can also be piped."""

from __future__ import annotations

import math
from collections.abc import Sequence

Cell = str | int | float | None


def table(header: Sequence[str], rows: Sequence[Sequence[Cell]]) -> str:
    """Columns two spaces apart, numbers to the right, text to the left."""
    cells = [[cell_text(cell) for cell in row] for row in rows]
    lines = [list(header), *cells]
    widths = [max(len(line[index]) for line in lines) for index in range(len(header))]
    right = [any(isinstance(row[index], int | float) for row in rows) for index in range(len(header))]
    return "\n".join(
        "  ".join(
            text.rjust(width) if to_right else text.ljust(width)
            for text, width, to_right in zip(line, widths, right, strict=True)
        ).rstrip()
        for line in lines
    )


def cell_text(cell: Cell) -> str:
    """A cell as text: four significant digits, a dash for what does not exist."""
    if cell is None or (isinstance(cell, float) and not math.isfinite(cell)):
        return "-"
    if isinstance(cell, float):
        return f"{cell:,.0f}" if abs(cell) >= 1e4 else f"{cell:.4g}"
    return f"{cell:,}" if isinstance(cell, int) else cell


def count(number: int, noun: str) -> str:
    """A number with its noun: 1 piece, 27 pieces."""
    return f"{number:,} {noun}" if number == 1 else f"{number:,} {noun}s"
