"""``brisance theory pressure-impulse``: which loads bring a structure to a limit."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import typer

from brisance.cli.theory.loads import Shape
from brisance.cli.theory.printing import (
    Format,
    FormatOption,
    PlotOption,
    columns,
    draw,
    input_errors,
    pairs,
    positive,
    print_results,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture


def pressure_impulse(
    mass: Annotated[float, typer.Option(metavar="KG", help="Mass that moves.")],
    stiffness: Annotated[float, typer.Option(metavar="N/M", help="Stiffness of the spring.")],
    limit: Annotated[float, typer.Option(metavar="M", help="Displacement that counts as damage.")],
    yield_resistance: Annotated[
        float | None, typer.Option(metavar="N", help="Resistance at which it flows; left out: never.")
    ] = None,
    damping: Annotated[float, typer.Option(metavar="NS/M", help="Damping.")] = 0.0,
    area: Annotated[float, typer.Option(metavar="M2", help="Area that the pressure acts on.")] = 1.0,
    pulse: Annotated[Shape, typer.Option(help="Shape of the loads.")] = Shape.triangle,
    decay: Annotated[float, typer.Option(help="Decay b of a friedlander pulse.")] = 1.0,
    points: Annotated[int, typer.Option(help="Points of the curve.")] = 41,
    charge: Annotated[
        float | None, typer.Option(metavar="KG", help="TNT to be placed on the diagram; with --distance.")
    ] = None,
    distance: Annotated[
        list[float] | None, typer.Option(metavar="M...", help="Its distances, one or more.")
    ] = None,
    incident: Annotated[
        bool, typer.Option("--incident", help="Take the passing wave, not the one reflected head-on.")
    ] = False,
    source: Annotated[
        str, typer.Option(metavar="NAME", help="Blast curves, as for brisance curves.")
    ] = "kingery-bulmash",
    form: FormatOption = Format.table,
    plot: PlotOption = None,
) -> None:
    """The pressure-impulse diagram of a structure, and where a charge falls on it.

    \b
    Example:
      brisance theory pressure-impulse --mass 1000 --stiffness 4e6 --limit 0.05 --yield-resistance 1e5
      brisance theory pressure-impulse --mass 1000 --stiffness 4e6 --limit 0.05 --charge 50 --distance 5 10 20
    """
    from brisance import _engine
    from brisance.cli.curves import check_picture
    from brisance.cli.theory.loads import blast_loads
    from brisance.errors import InputError

    if plot is not None:
        check_picture(plot)
    if (charge is None) != (not distance):
        raise InputError("--charge and --distance go together.")
    positive("--area", area)
    structure: dict[str, Any] = {
        "mass": mass,
        "stiffness": stiffness,
        "damping": damping,
        "yield_resistance": yield_resistance,
        "limit": limit,
    }
    if points < 2:
        raise InputError(f"--points must be 2 or more, not {points}.")
    with input_errors():
        drawn = _engine.pressure_impulse(pulse=pulse.value, decay=decay, points=points, **structure)
        loads = [
            {
                "distance_m": blast.distance_m,
                "pressure_pa": blast.pressure_pa,
                "impulse_pa_s": blast.impulse_pa_s,
                "reaches_limit": _engine.structure_reaches(
                    peak_force=blast.pressure_pa * area,
                    duration=blast.duration_s,
                    pulse="friedlander",
                    decay=blast.decay,
                    **structure,
                ),
            }
            for blast in blast_loads(charge or 1.0, distance or [], reflected=not incident, source=source)
        ]
    results = {
        "pressure_asymptote_pa": drawn["force_asymptote_n"] / area,
        "impulse_asymptote_pa_s": drawn["impulse_asymptote_n_s"] / area,
        "period_s": drawn["period_s"],
    }
    curve = [
        {"duration_s": float(t), "pressure_pa": float(f) / area, "impulse_pa_s": float(i) / area}
        for t, f, i in zip(drawn["duration_s"], drawn["force_n"], drawn["impulse_n_s"], strict=True)
    ]
    everything = {**results, "curve": curve, "loads": loads}
    print_results(everything, form, lambda: tables(results, curve, loads))
    draw(plot, lambda picture: paint(picture, everything))


def tables(results: dict[str, float], curve: list[dict[str, float]], loads: list[dict[str, Any]]) -> str:
    """Asymptotes, curve and loads, one under the other."""
    shown = [{**load, "reaches_limit": "yes" if load["reaches_limit"] else "no"} for load in loads]
    parts = [pairs(dict(results)), columns(curve)] + ([columns(shown)] if shown else [])
    return "\n\n".join(parts)


def paint(picture: Picture, results: dict[str, Any]) -> None:
    """The curve with its asymptotes, and the loads: filled where they do damage."""
    from brisance.figures import style

    axes = picture.subplots()
    curve = results["curve"]
    impulses, pressures = ([row[key] for row in curve] for key in ("impulse_pa_s", "pressure_pa"))
    axes.loglog(impulses, pressures, color=style.INK)
    axes.axhline(results["pressure_asymptote_pa"], color=style.BLUE, linestyle="--", label="quasi-static")
    axes.axvline(results["impulse_asymptote_pa_s"], color=style.ORANGE, linestyle="--", label="impulsive")
    for load in results["loads"]:
        face = style.PURPLE if load["reaches_limit"] else "white"
        axes.plot(load["impulse_pa_s"], load["pressure_pa"], "o", markerfacecolor=face, color=style.PURPLE)
        axes.annotate(f" {load['distance_m']:g} m", (load["impulse_pa_s"], load["pressure_pa"]), va="center")
    axes.set_xlabel("impulse [Pa s]")
    axes.set_ylabel("peak pressure [Pa]")
    axes.legend()
