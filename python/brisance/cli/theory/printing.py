"""How the commands of ``brisance theory`` say their results: JSON, a table, or a picture."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture


class Format(StrEnum):
    """How results are printed."""

    table = "table"
    json = "json"


FormatOption = Annotated[Format, typer.Option("--format", help="How the results are printed.")]
PlotOption = Annotated[
    Path | None, typer.Option("--plot", metavar="OUT.png", help="Draw them too (.png, .svg or .pdf).")
]


@contextmanager
def input_errors() -> Iterator[None]:
    """Turn the engine's refusals of a value into InputError."""
    from brisance.errors import InputError

    try:
        yield
    except (ValueError, OverflowError) as error:
        raise InputError(str(error)) from error


def positive(flag: str, value: float) -> float:
    """``value``, or InputError if it is not a finite number above 0."""
    from brisance.errors import InputError

    if not (math.isfinite(value) and value > 0):
        raise InputError(f"{flag} must be a finite number above 0, not {value:g}.")
    return value


def plain(value: Any) -> Any:
    """``value`` as JSON can hold it: arrays as lists, what does not exist as null."""
    if isinstance(value, Mapping):
        return {key: plain(item) for key, item in value.items()}
    if hasattr(value, "tolist"):
        return plain(value.tolist())
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def print_results(results: Mapping[str, Any], form: Format, table: Callable[[], str]) -> None:
    """Print ``results`` as JSON, or what ``table`` makes of them."""
    typer.echo(json.dumps(plain(results), indent=2) if form is Format.json else table())


def pairs(results: Mapping[str, float | None]) -> str:
    """A table of names and numbers."""
    from brisance.cli.table import table

    return table(("quantity", "value"), list(results.items()))


def columns(rows: list[dict[str, Any]]) -> str:
    """A table with a column for each key of the rows."""
    from brisance.cli.table import table

    keys = list(rows[0])
    return table(keys, [[row[key] for key in keys] for row in rows])


def draw(path: Path | None, paint: Callable[[Picture], None], *, wide: bool = False) -> None:
    """Let ``paint`` fill a picture and write it to ``path``, if there is one."""
    if path is None:
        return
    from matplotlib import rc_context
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    from brisance.figures import style
    from brisance.formats.atomic import replacing

    settings: dict[Any, Any] = dict(style.SETTINGS)
    with rc_context(settings):
        picture = Figure(figsize=(11 if wide else 7.5, 5), layout="constrained")
        FigureCanvasAgg(picture)
        paint(picture)
        with replacing(path) as temporary:
            picture.savefig(temporary, dpi=style.DPI)
    typer.echo(f"plot: {path}", err=True)
