"""``brisance figure``: the thesis's figures and tables, recomputed."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def figure(
    names: Annotated[
        list[str],
        typer.Argument(metavar="NAME...", help="Figures such as 3.5; or list, or all.", show_default=False),
    ],
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="DIR", help="Folder for the pictures; made if missing.")
    ] = Path("figures"),
    of: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="For dispersal: the scene (.toml) or report (.json) to draw, in place of the example wall.",
        ),
    ] = None,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing but errors.")] = False,
) -> None:
    """Recompute figures and tables of the thesis.

    \b
    Example:
      brisance figure list
      brisance figure 2.7 3.5 -o figures
      brisance figure dispersal --of scenes/car_park.toml -o figures
    """
    from brisance import figures

    if "list" in names:
        from brisance.cli.table import table

        typer.echo(table(("name", "shows"), [(name, fig.title) for name, fig in figures.FIGURES.items()]))
        return
    if of is not None:
        from brisance.errors import InputError

        if names != ["dispersal"]:
            raise InputError(f"--of is for the figure dispersal alone: brisance figure dispersal --of {of}.")
        for path in figures.dispersal.figure_of(of).build(output):
            if not quiet:
                typer.echo(str(path))
        return
    for name in figures.FIGURES if "all" in names else names:
        for path in figures.build(name, output):
            if not quiet:
                typer.echo(str(path))
