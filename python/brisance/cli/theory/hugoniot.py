"""``brisance theory hugoniot``: the states that a shock or a detonation can reach."""

from __future__ import annotations

from enum import StrEnum
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
    print_results,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

POINTS = 25


class Products(StrEnum):
    """What TNT becomes."""

    jwl = "jwl"
    ideal = "ideal"


def hugoniot(
    products: Annotated[
        Products, typer.Option(help="TNT's products: measured JWL constants, or an ideal gas.")
    ] = Products.jwl,
    front_velocity: Annotated[
        float | None, typer.Option(metavar="M/S", help="Also the strong and weak solution for this front.")
    ] = None,
    inert: Annotated[bool, typer.Option("--inert", help="A shock in inert material instead.")] = False,
    density: Annotated[float, typer.Option(metavar="KG/M3", help="Of the inert material.")] = 8930.0,
    sound_speed: Annotated[float, typer.Option(metavar="M/S", help="c0 of D = c0 + s1 u + s2 u².")] = 3940.0,
    slope: Annotated[float, typer.Option(help="s1; the values left out are those of copper.")] = 1.489,
    curvature: Annotated[float, typer.Option(metavar="S/M", help="s2.")] = 0.0,
    form: FormatOption = Format.table,
    plot: PlotOption = None,
) -> None:
    """The Hugoniot of TNT's detonation with its Chapman-Jouguet point, or of a shock in inert material.

    \b
    Example:
      brisance theory hugoniot
      brisance theory hugoniot --front-velocity 8000 --plot hugoniot.png
      brisance theory hugoniot --inert --density 2703 --sound-speed 5350 --slope 1.34
    """
    from brisance.cli.curves import check_picture

    if plot is not None:
        check_picture(plot)
    with input_errors():
        results = (
            inert_results(density, sound_speed, slope, curvature)
            if inert
            else detonation_results(products.value, front_velocity)
        )
    print_results(results, form, lambda: tables(results))
    draw(plot, lambda picture: paint(picture, results))


def inert_results(density: float, sound_speed: float, slope: float, curvature: float) -> dict[str, Any]:
    """A Hugoniot in p–u up to a particle velocity of the speed of sound."""
    import numpy as np

    from brisance import _engine

    velocity = np.linspace(0.0, sound_speed, POINTS)
    curve = _engine.inert_hugoniot(
        velocity=velocity, density=density, sound_speed=sound_speed, slope=slope, curvature=curvature
    )
    return {
        "curve": [
            {
                "velocity_m_s": float(u),
                "front_velocity_m_s": float(d),
                "pressure_pa": float(p),
                "specific_volume_m3_kg": float(v),
            }
            for u, d, p, v in zip(
                velocity,
                curve["front_velocity_m_s"],
                curve["pressure_pa"],
                curve["specific_volume_m3_kg"],
                strict=True,
            )
        ]
    }


def detonation_results(products: str, front_velocity: float | None) -> dict[str, Any]:
    """The Chapman–Jouguet point, the curve around it, and the solutions asked for."""
    import numpy as np

    from brisance import _engine

    rest = _engine.detonation_hugoniot(relative_volume=np.zeros(0), products=products)
    point = rest["chapman_jouguet"]
    touching = rest["density_at_rest_kg_m3"] / point["density_kg_m3"]
    volume = np.linspace(0.8 * touching, 0.98, POINTS)
    found = _engine.detonation_hugoniot(
        relative_volume=volume, products=products, front_velocity=front_velocity
    )
    results: dict[str, Any] = {
        "cj_velocity_m_s": point["front_velocity_m_s"],
        "cj_pressure_pa": point["pressure_pa"],
        "cj_density_kg_m3": point["density_kg_m3"],
        "cj_particle_velocity_m_s": point["velocity_m_s"],
        "cj_sound_speed_m_s": point["sound_speed_m_s"],
        "density_at_rest_kg_m3": rest["density_at_rest_kg_m3"],
    }
    results |= {name: found[name] for name in ("strong", "weak") if name in found}
    results["curve"] = [
        {"velocity_m_s": float(u), "pressure_pa": float(p), "specific_volume_m3_kg": float(v)}
        for u, p, v in zip(
            found["velocity_m_s"], found["pressure_pa"], found["specific_volume_m3_kg"], strict=True
        )
    ]
    return results


def tables(results: dict[str, Any]) -> str:
    """Single numbers, states and the curve, one under the other."""
    numbers = {key: value for key, value in results.items() if isinstance(value, float)}
    states = [{"solution": name, **results[name]} for name in ("strong", "weak") if name in results]
    parts = [pairs(numbers)] if numbers else []
    parts += [columns(states)] if states else []
    return "\n\n".join([*parts, columns(results["curve"])])


def paint(picture: Picture, results: dict[str, Any]) -> None:
    """The Hugoniot in p–u and p–v, with the Rayleigh line through the Chapman–Jouguet point."""
    from brisance.figures import style

    left, right = picture.subplots(1, 2)
    curve = results["curve"]
    pressure = [1e-9 * row["pressure_pa"] for row in curve]
    left.plot([1e-3 * row["velocity_m_s"] for row in curve], pressure, color=style.BLUE)
    right.plot([1e3 * row["specific_volume_m3_kg"] for row in curve], pressure, color=style.BLUE)
    left.set_xlabel("particle velocity [km/s]")
    right.set_xlabel("specific volume [10⁻³ m³/kg]")
    left.set_ylabel("pressure [GPa]")
    if "cj_pressure_pa" in results:
        at = 1e-9 * results["cj_pressure_pa"]
        left.plot([0.0, 1e-3 * results["cj_particle_velocity_m_s"]], [0.0, at], color=style.ORANGE)
        right.plot(
            [1e3 / results["density_at_rest_kg_m3"], 1e3 / results["cj_density_kg_m3"]],
            [0.0, at],
            color=style.ORANGE,
        )
        left.plot([1e-3 * results["cj_particle_velocity_m_s"]], [at], "o", color=style.INK, label="CJ")
        left.legend()
