"""What a figure is: numbers computed by the engine, a way to draw them, and the files that come of it."""

from __future__ import annotations

import csv
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from brisance.errors import InputError
from brisance.figures import style
from brisance.formats.atomic import replacing

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

Data = TypeVar("Data")
Table = Mapping[str, "NDArray[np.float64] | Sequence[str]"]
"""Columns of equal length by name; the name carries the unit. A number that does not exist is NaN."""


def whole(table: Table) -> Table:
    """Return the table itself: for figures whose data is the table they write."""
    return table


@dataclass(frozen=True)
class Figure(Generic[Data]):
    """A figure or table of the thesis, recomputed."""

    name: str
    """The thesis's own number, such as ``"2.7"`` or ``"table-2.1"``; a name where it has no such figure."""
    title: str
    """What it shows, in one line."""
    compute: Callable[[], Data]
    """Computes everything the picture shows, through the engine."""
    draw: Callable[[Picture, Data], None]
    """Draws the data into an empty picture."""
    table: Callable[[Data], Table] | None = None
    """The data as columns, written beside the picture; None where the picture is not a curve."""
    size: tuple[int, int] = (1200, 840)
    """Width and height of the picture [pixels]."""

    @property
    def stem(self) -> str:
        """File name of what :meth:`build` writes, without its ending."""
        return self.name if self.name.startswith("table") else f"figure-{self.name}"

    def build(self, folder: Path | str, *, size: tuple[int, int] | None = None) -> list[Path]:
        """Compute and draw, and write ``figure-<name>.png`` (and ``.csv``) into ``folder``.

        The folder is made if it is missing. ``size`` is the picture's width and height in pixels. Returns the
        paths written, the picture first.
        """
        folder = Path(folder)
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            reason = (error.strerror or str(error)).lower()
            raise InputError(f"{folder} cannot hold the figures: {reason}; give a folder.") from error
        data = self.compute()
        paths = [folder / f"{self.stem}.png"]
        self._write_picture(paths[0], data, size or self.size)
        if self.table is not None:
            paths.append(folder / f"{self.stem}.csv")
            write_csv(paths[1], self.table(data))
        return paths

    def _write_picture(self, path: Path, data: Data, size: tuple[int, int]) -> None:
        # Imported here: listing the figures should not wait for matplotlib.
        import matplotlib
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure as Picture

        settings: dict[Any, Any] = dict(style.SETTINGS)
        with matplotlib.rc_context(settings):
            inches = (size[0] / style.DPI, size[1] / style.DPI)
            picture = Picture(figsize=inches, dpi=style.DPI, layout="constrained")
            FigureCanvasAgg(picture)
            heading = picture.suptitle(self.title, x=0.012, ha="left")
            heading.set_wrap(True)
            self.draw(picture, data)
            with replacing(path) as temporary:
                picture.savefig(temporary, dpi=style.DPI, metadata={"Software": None})


def write_csv(path: Path, table: Table) -> None:
    """Write the columns of ``table`` with a header row. A NaN becomes an empty cell."""
    with replacing(path) as temporary, temporary.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(table)
        writer.writerows([_cell(value) for value in row] for row in zip(*table.values(), strict=True))


def _cell(value: object) -> str:
    if isinstance(value, str):
        return value
    number = float(value)  # type: ignore[arg-type]
    return "" if math.isnan(number) else f"{number:.9g}"
