"""``brisance curves``: what a blast does at a distance."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from brisance.cli.flags import checked

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

KEYS = (
    "distance_m",
    "scaled_distance_m_kg13",
    "overpressure_pa",
    "reflected_pressure_pa",
    "dynamic_pressure_pa",
    "front_velocity_m_s",
    "arrival_time_s",
    "duration_s",
    "impulse_pa_s",
    "reflected_impulse_pa_s",
)
COLUMNS = (
    "distance m",
    "Z m/kg^1/3",
    "overpressure Pa",
    "reflected Pa",
    "dynamic Pa",
    "front m/s",
    "arrival s",
    "duration s",
    "impulse Pa s",
    "reflected Pa s",
)
SCALED_RANGE = (0.2, 40.0)
"""Scaled distances [m/kg^(1/3)] shown when no distance is given."""


class Burst(StrEnum):
    """Where the charge goes off."""

    air = "air"
    surface = "surface"


class Format(StrEnum):
    """How numbers are printed."""

    table = "table"
    csv = "csv"
    json = "json"


def curves(
    mass: Annotated[float, typer.Option(metavar="KG", help="Mass of the charge.")],
    distance: Annotated[
        list[float] | None,
        typer.Option(metavar="M...", help="Distances, one or more; left out: a range of them."),
    ] = None,
    explosive: Annotated[
        str | None, typer.Option(metavar="NAME", help="Explosive of Table 2.1 (default TNT).")
    ] = None,
    tnt_equivalence: Annotated[
        float | None, typer.Option(metavar="FACTOR", help="kg of TNT that 1 kg of the explosive is worth.")
    ] = None,
    burst: Annotated[Burst, typer.Option(help="Free in the air or on the ground.")] = Burst.air,
    source: Annotated[
        str,
        typer.Option(
            metavar="NAME", help="kingery-bulmash, brode, henrych, kinney-graham, hydrocode or a CSV file."
        ),
    ] = "kingery-bulmash",
    pressure: Annotated[float, typer.Option(metavar="PA", help="Ambient pressure.")] = 101325.0,
    temperature: Annotated[float, typer.Option(metavar="K", help="Ambient temperature.")] = 288.15,
    plot: Annotated[
        Path | None, typer.Option(metavar="OUT.png", help="Draw the curves (.png, .svg or .pdf).")
    ] = None,
    form: Annotated[Format, typer.Option("--format", help="How the numbers are printed.")] = Format.table,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print no notes beside the numbers.")] = False,
) -> None:
    """Print or draw the blast of a charge against distance. Times count from detonation.

    \b
    Example:
      brisance curves --mass 100 --distance 5 10 20
      brisance curves --mass 100 --explosive RDX --burst surface --plot rdx.png
    """
    import numpy as np

    from brisance import _engine
    from brisance.curve_table import curve_source
    from brisance.errors import InputError
    from brisance.model import Air, Charge

    charge = checked(
        Charge,
        whole="the charge",
        mass=mass,
        position=(0, 0, 0),
        explosive=explosive,
        tnt_equivalence=tnt_equivalence,
        curves=source,
    )
    air = checked(Air, pressure=pressure, temperature=temperature)
    if plot is not None:
        check_picture(plot)
    distances = chosen_distances(distance, charge.mass * charge.factor, fine=plot is not None)
    try:
        columns = _engine.curves(
            mass=charge.mass,
            distance=distances,
            tnt_equivalence=charge.factor,
            burst=burst.value,
            source=curve_source(source, base_folder=Path()),
            pressure=air.pressure,
            temperature=air.temperature,
        )
    except ValueError as error:
        raise InputError(str(error)) from error
    if plot is not None:
        draw(columns, plot, title=f"{mass:g} kg of {explosive or 'explosive'}, {burst.value} burst, {source}")
    if plot is None or distance:
        typer.echo(printed(columns, form))
    if quiet:
        return
    for note in notes(np.asarray(columns["extension"]), list(columns.get("derived", [])), source):
        typer.echo(note, err=True)
    if plot is not None:
        typer.echo(f"plot: {plot}", err=bool(distance))


def chosen_distances(given: list[float] | None, tnt_mass: float, *, fine: bool) -> NDArray[np.float64]:
    """The distances [m] asked for, or a range of them that suits the charge."""
    import math

    import numpy as np

    from brisance.errors import InputError

    for value in given or ():
        if not (math.isfinite(value) and value > 0):
            raise InputError(f"--distance must be a finite number above 0, not {value:g}.")
    if given:
        return np.array(given, dtype=np.float64)
    low, high = (z * tnt_mass ** (1 / 3) for z in SCALED_RANGE)
    return np.geomspace(low, high, 200 if fine else 16)


def printed(columns: dict[str, Any], form: Format) -> str:
    """The numbers as a table, CSV or JSON; what does not exist is a dash, nothing, or null."""
    import json
    import math

    from brisance.cli.table import table

    rows = list(zip(*([float(value) for value in columns[key]] for key in KEYS), strict=True))
    if form is Format.json:
        plain = [[value if math.isfinite(value) else None for value in row] for row in rows]
        return json.dumps([dict(zip(KEYS, row, strict=True)) for row in plain], indent=2)
    if form is Format.csv:
        lines = [",".join(f"{value:.9g}" if math.isfinite(value) else "" for value in row) for row in rows]
        return "\n".join([",".join(KEYS), *lines])
    derived = columns.get("derived", [])
    header = [f"{name}*" if key in derived else name for name, key in zip(COLUMNS, KEYS, strict=True)]
    return table(header, rows)


def notes(extension: NDArray[np.int8], derived: list[str], source: str) -> list[str]:
    """What the reader should know about the numbers."""
    found = []
    named = [name for name, key in zip(COLUMNS, KEYS, strict=True) if key in derived]
    if named:
        found.append(
            f"note: {source} itself does not give {', '.join(named)} (*); pressures and front come from its "
            "overpressure by the shock relations, arrivals from the front, the rest from kingery-bulmash."
        )
    for sign, what in ((-1, "nearer"), (1, "farther")):
        number = int((extension == sign).sum())
        if number:
            verb = "distance lies" if number == 1 else "distances lie"
            found.append(f"note: {number} {verb} {what} than {source} reaches; an extension is used there.")
    return found


def check_picture(path: Path) -> None:
    """Raise InputError unless a picture can be written to ``path``."""
    from brisance.errors import InputError
    from brisance.formats.atomic import check_writable

    if check_writable(path).suffix.lower() not in (".png", ".svg", ".pdf"):
        raise InputError(f"--plot {path}: give a name that ends in .png, .svg or .pdf.")


def draw(columns: dict[str, Any], path: Path, *, title: str) -> None:
    """Draw pressures, times and impulses against distance, log-log."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    from brisance.formats.atomic import replacing

    figure = Figure(figsize=(11, 5), layout="constrained")
    FigureCanvasAgg(figure)
    figure.suptitle(title)
    panels = (
        ("pressure [Pa]", ("overpressure_pa", "reflected_pressure_pa", "dynamic_pressure_pa")),
        ("time [s]", ("arrival_time_s", "duration_s")),
        ("impulse [Pa s]", ("impulse_pa_s", "reflected_impulse_pa_s")),
    )
    for axes, (label, keys) in zip(figure.subplots(1, 3), panels, strict=True):
        for key in keys:
            axes.loglog(columns["distance_m"], columns[key], label=key.rsplit("_pa", 1)[0].rsplit("_s", 1)[0])
        axes.set_xlabel("distance [m]")
        axes.set_ylabel(label)
        axes.grid(True, which="both", alpha=0.25)
        axes.legend()
    with replacing(path) as temporary:
        figure.savefig(temporary, dpi=110)
