"""``brisance theory sdof``: a structure as one mass on a spring that may yield."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from brisance.cli.theory.printing import (
    Format,
    FormatOption,
    PlotOption,
    draw,
    input_errors,
    pairs,
    print_results,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

KEYS = ("max_displacement_m", "time_of_max_s", "permanent_set_m", "period_s")


def sdof(
    mass: Annotated[float, typer.Option(metavar="KG", help="Mass that moves.")],
    stiffness: Annotated[float, typer.Option(metavar="N/M", help="Stiffness of the spring.")],
    damping: Annotated[float, typer.Option(metavar="NS/M", help="Damping.")] = 0.0,
    yield_resistance: Annotated[
        float | None, typer.Option(metavar="N", help="Resistance at which it flows; left out: never.")
    ] = None,
    peak_force: Annotated[float | None, typer.Option(metavar="N", help="Peak of the pulse.")] = None,
    duration: Annotated[
        float | None, typer.Option(metavar="S", help="Duration of the pulse; a step may do without.")
    ] = None,
    pulse: Annotated[str, typer.Option(help="triangle, friedlander or step.")] = "triangle",
    decay: Annotated[float, typer.Option(help="Decay b of a friedlander pulse.")] = 1.0,
    load: Annotated[
        Path | None,
        typer.Option(metavar="FILE.csv", help="A load of your own: columns time_s and force_n."),
    ] = None,
    charge: Annotated[
        float | None, typer.Option(metavar="KG", help="TNT whose blast is the load; with --distance, --area.")
    ] = None,
    distance: Annotated[
        list[float] | None, typer.Option(metavar="M", help="Distance of that charge.")
    ] = None,
    area: Annotated[float, typer.Option(metavar="M2", help="Area that faces it.")] = 1.0,
    step: Annotated[float | None, typer.Option(metavar="S", help="Time step; chosen if left out.")] = None,
    end: Annotated[
        float | None, typer.Option(metavar="S", help="Last moment; left out: two periods after the load.")
    ] = None,
    form: FormatOption = Format.table,
    plot: PlotOption = None,
) -> None:
    """How far a load pushes a structure, when, and what of it stays.

    \b
    Example:
      brisance theory sdof --mass 1000 --stiffness 4e6 --peak-force 2e5 --duration 0.02
      brisance theory sdof --mass 1000 --stiffness 4e6 --charge 50 --distance 15 --area 9
    """
    from brisance import _engine
    from brisance.cli.curves import check_picture

    if plot is not None:
        check_picture(plot)
    given = chosen_load(peak_force, duration, pulse, decay, load, charge, distance, area)
    with input_errors():
        response = _engine.structure_response(
            mass=mass,
            stiffness=stiffness,
            damping=damping,
            yield_resistance=yield_resistance,
            step=step,
            end=end,
            **given,
        )
    results = {key: response[key] for key in KEYS}
    print_results(results, form, lambda: pairs(results))
    draw(plot, lambda picture: paint(picture, response))


def chosen_load(
    peak_force: float | None,
    duration: float | None,
    pulse: str,
    decay: float,
    load: Path | None,
    charge: float | None,
    distance: list[float] | None,
    area: float,
) -> dict[str, Any]:
    """The one load that the flags describe, as the engine takes it."""
    from brisance.errors import InputError

    ways = [peak_force is not None, load is not None, charge is not None]
    if sum(ways) != 1:
        raise InputError("give the load in one way: --peak-force, --load or --charge.")
    if load is not None:
        from brisance.cli.theory.load_table import read_load

        return {"table": read_load(load)}
    if charge is not None:
        from brisance.cli.theory.loads import blast_loads
        from brisance.cli.theory.printing import positive

        if distance is None or len(distance) != 1:
            raise InputError("--charge needs --distance, one distance in metres.")
        (blast,) = blast_loads(charge, distance, reflected=True, source="kingery-bulmash")
        force = blast.pressure_pa * positive("--area", area)
        return {
            "peak_force": force,
            "duration": blast.duration_s,
            "pulse": "friedlander",
            "decay": blast.decay,
        }
    if duration is None and pulse != "step":
        raise InputError(f"--duration is missing: a {pulse} has one; only a step may last for ever.")
    lasting = math.inf if duration is None else duration
    return {"peak_force": peak_force, "duration": lasting, "pulse": pulse, "decay": decay}


def paint(picture: Picture, response: dict[str, Any]) -> None:
    """Displacement over time, and resistance over displacement."""
    from brisance.figures import style

    left, right = picture.subplots(1, 2)
    left.plot(1e3 * response["time_s"], 1e3 * response["displacement_m"], color=style.BLUE)
    left.set_xlabel("time [ms]")
    left.set_ylabel("displacement [mm]")
    right.plot(1e3 * response["displacement_m"], 1e-3 * response["resistance_n"], color=style.ORANGE)
    right.set_xlabel("displacement [mm]")
    right.set_ylabel("resistance [kN]")
