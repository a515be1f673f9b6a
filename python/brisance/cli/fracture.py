"""``brisance fracture``: the cracks of a pane, as a drawing, as data, or as solid pieces."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from brisance.cli.flags import checked, named

if TYPE_CHECKING:
    from brisance.pane import Fracture

SQUARE = 1.0
"""Side of the pane where no size is given [m]."""
MANY = 50_000
"""Fragments from which on writing takes long enough to be announced."""


class Glass(StrEnum):
    """Kinds of glass."""

    annealed = "annealed"
    tempered = "tempered"
    laminated = "laminated"


class Shape(StrEnum):
    """How a crack starts."""

    segment = "segment"
    cross = "cross"
    star = "star"


def fracture(
    width: Annotated[
        float | None, typer.Option(metavar="M", help="Width of the pane (1), or that --outline is scaled to.")
    ] = None,
    height: Annotated[float | None, typer.Option(metavar="M", help="Its height, likewise.")] = None,
    outline: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Pane of any outline, with holes: .csv of x,y in metres, an empty line between rings; "
            ".json, a list of rings of [x, y]; .svg at its true size.",
        ),
    ] = None,
    pieces: Annotated[
        int | None, typer.Option(metavar="N", help="About how many fragments, within 10 % (500).")
    ] = None,
    critical_length: Annotated[
        float | None, typer.Option(metavar="M", help="Growth between forks, in place of --pieces.")
    ] = None,
    stress: Annotated[
        float | None,
        typer.Option(metavar="PA", help="Bending stress as it fails: gives the critical length (5.5)."),
    ] = None,
    pressure: Annotated[
        float | None, typer.Option(metavar="PA", help="Peak pressure on it: gives the mean area (2.45).")
    ] = None,
    starts: Annotated[
        int | None,
        typer.Option(metavar="N", help="In about how many places cracks start; left out: by the pieces."),
    ] = None,
    glass: Annotated[
        Glass, typer.Option(help="Long shards, dice, or shards that stay on an interlayer.")
    ] = Glass.annealed,
    seed_at: Annotated[
        list[float] | None,
        typer.Option(
            metavar="X Y",
            help="Where cracks start, as shares of width and height (0.5 0.5); may be repeated.",
        ),
    ] = None,
    shape: Annotated[Shape, typer.Option(help="How a crack starts.")] = Shape.star,
    fork_angle: Annotated[
        float,
        typer.Option(metavar="DEG", help="Between the branches of a fork; larger gives rounder pieces."),
    ] = 25.0,
    fork_variance: Annotated[
        float, typer.Option(metavar="DEG", help="Full width of the range in which that angle varies.")
    ] = 34.5,
    wiggle_probability: Annotated[
        float, typer.Option(metavar="P", help="That a crack turns at each step; 0 gives straight cracks.")
    ] = 0.5,
    wiggle_variance: Annotated[
        float, typer.Option(metavar="DEG", help="Full width of the range of such turns.")
    ] = 20.0,
    wiggle_spacing: Annotated[
        float | None, typer.Option(metavar="M", help="That step; left out: a third of a mean piece.")
    ] = None,
    rings: Annotated[
        float, typer.Option(metavar="P", help="Share of the wedges between cracks that rings cross.")
    ] = 0.6,
    reach: Annotated[
        float | None, typer.Option(metavar="M", help="How far cracks grow at most; left out: to the border.")
    ] = None,
    toward: Annotated[
        float | None, typer.Option(metavar="DEG", help="Direction that cracks bend to; left out: outward.")
    ] = None,
    literal: Annotated[
        bool, typer.Option("--literal", help="Fork by the thesis's own rule and nothing else.")
    ] = False,
    thickness: Annotated[float, typer.Option(metavar="M", help="Thickness of the pane.")] = 0.006,
    seed: Annotated[int, typer.Option(metavar="N", help="Every random draw comes from it.")] = 1,
    output: Annotated[
        list[Path] | None,
        typer.Option(
            "-o",
            "--output",
            metavar="OUT",
            help="Write .svg or .png (cracks by age), .json (polygons, cracks), .usdc (solids); may be "
            "repeated.",
        ),
    ] = None,
    size: Annotated[
        str | None, typer.Option(metavar="WxH", help="Pixels of a .png; left out: 2400 along the pane.")
    ] = None,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing but errors.")] = False,
) -> None:
    """Break a pane into fragments.

    \b
    Example:
      brisance fracture --width 1.2 --height 0.8 --pieces 300 -o pane.svg
      brisance fracture --glass tempered --seed-at 0.1 0.1 -o dice.usdc -o dice.png
    """
    from brisance.cli.render import parse_size
    from brisance.errors import InputError
    from brisance.model import Pattern
    from brisance.pane import check_output

    pixels = None if size is None else parse_size(size)
    for path in output or ():
        check_output(path)
    ways = {
        "--pieces": pieces,
        "--critical-length": critical_length,
        "--stress": stress,
        "--pressure": pressure,
    }
    given = [flag for flag, value in ways.items() if value is not None]
    if len(given) > 1:
        raise InputError(f"{given[0]} and {given[1]} both say how finely to break; give one of them.")
    pattern = checked(
        Pattern,
        flags=_FLAGS,
        glass=glass.value,
        pieces=pieces,
        critical_length=critical_length,
        stress=stress,
        pressure=pressure,
        starts=starts,
        seeds=pairs(seed_at or []),
        shape=shape.value,
        literal=literal,
        fork_angle=fork_angle,
        fork_variance=fork_variance,
        wiggle_probability=wiggle_probability,
        wiggle_variance=wiggle_variance,
        wiggle_spacing=wiggle_spacing,
        rings=rings,
        reach=reach,
        toward=toward,
    )
    flags = _FLAGS if outline is None else {**_FLAGS, "outline": f"--outline {outline}"}
    with named(flags):
        broken = break_pane(
            pattern, width=width, height=height, outline=outline, thickness=thickness, seed=seed
        )
    for path in output or ():
        if not quiet and len(broken.engine) >= MANY:
            typer.echo(f"writing {path}", err=True)
        with named():
            broken.write(path, size=pixels)
    if not quiet:
        typer.echo(summary(broken, output or []))


_FLAGS = {"seeds": "--seed-at"}


def pairs(values: list[float]) -> list[tuple[float, float]]:
    """Numbers two by two, as ``--seed-at`` gives them."""
    from brisance.errors import InputError

    if len(values) % 2:
        raise InputError(
            f"--seed-at takes two numbers X Y for each place, not {len(values)} in all; give 0.5 0.5, say."
        )
    for value in values:
        if not 0 <= value <= 1:
            raise InputError(f"--seed-at must be shares of width and height from 0 to 1, not {value:g}.")
    return list(zip(values[::2], values[1::2], strict=True))


def break_pane(
    pattern: Any,
    *,
    width: float | None,
    height: float | None,
    outline: Path | None,
    thickness: float,
    seed: int,
) -> Fracture:
    """Break a rectangle, or the outline in a file."""
    import math

    from brisance.errors import ArgumentError
    from brisance.outline import fit, read_outline
    from brisance.pane import fracture as fracture_pane

    if outline is None:
        return fracture_pane(
            pattern,
            width=SQUARE if width is None else width,
            height=SQUARE if height is None else height,
            thickness=thickness,
            seed=seed,
        )
    for name, value in (("width", width), ("height", height)):
        if value is not None and not (math.isfinite(value) and value > 0):
            raise ArgumentError(name, f"must be a finite number above 0, not {value:g}.")
    rings = fit(read_outline(outline), width=width, height=height)
    return fracture_pane(pattern, outline=rings, thickness=thickness, seed=seed)


def summary(broken: Fracture, output: list[Path]) -> str:
    """How many fragments, what gave them, how long the cracks took, and where it was written."""
    from brisance.cli.table import count

    last = 1e3 * float(broken.crack_times.max(initial=0.0))
    files = ", ".join(map(str, output)) or "nothing written; add -o pane.svg, .png, .json or .usdc"
    return (
        f"{count(len(broken.engine), 'fragment')} from a critical length of {broken.critical_length:.4g} m, "
        f"cracked in {last:.3g} ms: {files}"
    )
