"""``brisance theory hydrocode``: a one-dimensional flow, computed."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

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

GAUGE_KEYS = (
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
PROFILE_KEYS = ("x_m", "density_kg_m3", "velocity_m_s", "pressure_pa")
SCALED = (0.5, 1.0, 2.0, 5.0, 10.0)
"""Scaled distances [m/kg^(1/3)] of the gauges when none are given."""


class Geometry(StrEnum):
    """Symmetry of the flow."""

    plane = "plane"
    cylindrical = "cylindrical"
    spherical = "spherical"


class Scheme(StrEnum):
    """How the flow is computed."""

    godunov = "godunov"
    viscosity = "viscosity"


class Case(StrEnum):
    """A well-known problem."""

    sod = "sod"
    shu_osher = "shu-osher"
    noh = "noh"
    sedov = "sedov"


class Start(StrEnum):
    """How the products of a charge are at first."""

    detonation = "detonation"
    constant_volume = "constant-volume"


def hydrocode(
    geometry: Annotated[
        Geometry | None, typer.Option(help="Left out: spherical for a charge, plane for a case.")
    ] = None,
    mass: Annotated[
        float | None, typer.Option(metavar="KG", help="Charge of TNT: kg, kg/m of a rod, kg/m² of a slab.")
    ] = None,
    case: Annotated[Case | None, typer.Option(help="A well-known problem instead of a charge.")] = None,
    distance: Annotated[
        list[float] | None, typer.Option(metavar="M...", help="Gauges; left out: at Z = 0.5 to 10.")
    ] = None,
    scheme: Annotated[
        Scheme, typer.Option(help="godunov, or viscosity: the historical scheme.")
    ] = Scheme.godunov,
    cells: Annotated[
        int | None, typer.Option(help="Cells of the mesh; of a charge a quarter lie in its products.")
    ] = None,
    courant: Annotated[float | None, typer.Option(help="Courant number, above 0 and up to 1.")] = None,
    end: Annotated[
        float | None,
        typer.Option(metavar="S", help="Time of the profile; a charge's gauges may ask for more."),
    ] = None,
    start: Annotated[Start, typer.Option(help="Products of the charge at first.")] = Start.detonation,
    quadratic: Annotated[float, typer.Option(help="Quadratic artificial viscosity, for a case.")] = 1.4,
    linear: Annotated[float, typer.Option(help="Linear artificial viscosity, for a case.")] = 0.2,
    curve_table: Annotated[
        Path | None,
        typer.Option(
            metavar="OUT.csv", help='Recompute the blast curves behind curves = "hydrocode" into a file.'
        ),
    ] = None,
    form: FormatOption = Format.table,
    plot: PlotOption = None,
) -> None:
    """A charge of TNT in air from its detonation outwards, or a well-known problem with its exact solution.

    \b
    Example:
      brisance theory hydrocode --mass 100 --distance 5 10 20
      brisance theory hydrocode --case sod --scheme viscosity --plot sod.png
      brisance theory hydrocode --curve-table curves.csv
    """
    from brisance.cli.curves import check_picture
    from brisance.errors import InputError

    if plot is not None:
        check_picture(plot)
    if [mass is not None, case is not None, curve_table is not None].count(True) != 1:
        raise InputError(
            "choose one: a charge (--mass), a problem (--case) or the blast curves (--curve-table)."
        )
    if end is not None:
        positive("--end", end)
    if cells is not None and cells < 10:
        raise InputError(f"--cells must be 10 or more, not {cells}.")
    if curve_table is not None:
        from brisance.hydrocode_curves import write

        write(curve_table)
        typer.echo(str(curve_table))
        return
    with input_errors():
        if case is not None:
            chosen = geometry or Geometry.plane
            results = case_results(case, chosen, scheme, cells, courant, end, (quadratic, linear), distance)
        else:
            chosen = geometry or Geometry.spherical
            results = charge_results(
                positive("--mass", mass or 0.0), chosen, scheme, cells, courant, end, start, distance
            )
    print_results(results, form, lambda: tables(results))
    draw(plot, lambda picture: paint(picture, results), wide=True)


def case_results(
    case: Case,
    geometry: Geometry,
    scheme: Scheme,
    cells: int | None,
    courant: float | None,
    end: float | None,
    viscosity: tuple[float, float],
    distance: list[float] | None,
) -> dict[str, Any]:
    """Profile of a problem, with the exact one where it exists."""
    from brisance import _engine
    from brisance.errors import InputError

    if distance:
        raise InputError("--distance is for the gauges of a charge; a case has a profile.")
    flow = _engine.hydrocode_case(
        case=case.value,
        geometry=geometry.value,
        scheme=scheme.value,
        cells=400 if cells is None else cells,
        courant=courant,
        end=end,
        viscosity=viscosity,
    )
    keys = [*PROFILE_KEYS, *(key for key in flow if key.startswith("exact_"))]
    return {
        "case": case.value,
        "geometry": geometry.value,
        "scheme": scheme.value,
        "time_s": flow["time_s"],
        "gauges": [],
        "profiles": {key: flow[key] for key in keys},
    }


def charge_results(
    mass: float,
    geometry: Geometry,
    scheme: Scheme,
    cells: int | None,
    courant: float | None,
    end: float | None,
    start: Start,
    distance: list[float] | None,
) -> dict[str, Any]:
    """Gauges around a charge, and the profile in the end."""
    import numpy as np

    from brisance import _engine

    scale = mass ** (1.0 / 3.0)
    places = np.array(distance or [z * scale for z in SCALED], dtype=np.float64)
    inner = None if cells is None else max(10, cells // 4)
    flow = _engine.hydrocode_charge(
        mass=mass,
        distance=places,
        geometry=geometry.value,
        scheme=scheme.value,
        product_cells=inner,
        air_cells=None if cells is None or inner is None else max(10, cells - inner),
        courant=courant,
        start=start.value,
        end=end or 0.0,
    )
    reflected = _engine.rankine_hugoniot(overpressure=flow["overpressure_pa"])["reflected_pressure_pa"]
    scaled = places / scale if geometry is Geometry.spherical else np.full(len(places), np.nan)
    known = {
        **flow,
        "scaled_distance_m_kg13": scaled,
        "reflected_pressure_pa": reflected,
        # A wall would have to be in the flow to reflect it.
        "reflected_impulse_pa_s": np.full(len(places), np.nan),
    }
    gauges = [{key: float(known[key][row]) for key in GAUGE_KEYS} for row in range(len(places))]
    return {
        "mass_kg": mass,
        "geometry": geometry.value,
        "scheme": scheme.value,
        "start": start.value,
        "charge_radius_m": flow["charge_radius_m"],
        "product_cells": flow["product_cells"],
        "air_cells": flow["air_cells"],
        "courant": flow["courant"],
        "time_s": flow["time_s"],
        "gauges": gauges,
        "histories": [
            {"time_s": times, "overpressure_pa": pressures} for times, pressures in flow["history"]
        ],
        "profiles": {key: flow[key] for key in PROFILE_KEYS},
    }


def tables(results: dict[str, Any]) -> str:
    """The gauges of a charge; of a case a few lines of its profile."""
    if results["gauges"]:
        return columns(results["gauges"])
    profile = results["profiles"]
    every = max(1, len(profile["x_m"]) // 20)
    rows = [
        {key: float(profile[key][row]) for key in profile} for row in range(0, len(profile["x_m"]), every)
    ]
    return "\n\n".join([pairs({"time_s": results["time_s"]}), columns(rows)])


def paint(picture: Picture, results: dict[str, Any]) -> None:
    """Density, velocity and pressure of the profile; of a charge the pressures at the gauges first."""
    from brisance.figures import style

    profile = results["profiles"]
    names = ["density_kg_m3", "velocity_m_s", "pressure_pa"]
    labels = ["density [kg/m³]", "velocity [m/s]", "pressure [Pa]"]
    if results["gauges"]:
        axes, *others = picture.subplots(1, 3)
        for gauge, history in zip(results["gauges"], results["histories"], strict=True):
            peak = gauge["overpressure_pa"]
            label = f"{gauge['distance_m']:g} m: {1e-3 * peak:,.3g} kPa"
            since = 1e3 * (history["time_s"] - gauge["arrival_time_s"])
            axes.plot(since, history["overpressure_pa"] / peak, label=label, linewidth=1.2)
        longest = max(gauge["duration_s"] for gauge in results["gauges"])
        axes.set_xlim(-0.1e3 * longest, 2.5e3 * longest)
        axes.set_ylim(-0.4, 1.1)
        axes.set_xlabel("time since arrival [ms]")
        axes.set_ylabel("overpressure / peak")
        axes.legend(fontsize=7)
        names, labels = names[::2], labels[::2]
    else:
        others = list(picture.subplots(1, 3))
    for axes, name, label in zip(others, names, labels, strict=True):
        if f"exact_{name}" in profile:
            axes.plot(profile["x_m"], profile[f"exact_{name}"], color=style.ORANGE, linewidth=1.0)
        axes.plot(profile["x_m"], profile[name], ".", color=style.BLUE, markersize=2.0)
        axes.set_xlabel("place [m]")
        axes.set_title(label)
        if results["gauges"]:
            axes.set_yscale("log")
