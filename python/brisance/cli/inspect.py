"""``brisance inspect``: what is in a scene or a result."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def inspect(
    file: Annotated[
        Path, typer.Argument(metavar="FILE", help="Scene (.toml), result (.usdc …) or report (.json).")
    ],
    changes: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="KEY=VALUE", help="Change a key of the scene first; may be repeated."),
    ] = None,
    occlusion: Annotated[
        bool, typer.Option("--occlusion", help="Draw what each charge of a scene sees, into -o map.png.")
    ] = False,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="MAP.png", help="Picture for --occlusion.")
    ] = None,
) -> None:
    """Tabulate a scene, a result or a report, or draw what a charge sees.

    \b
    Example:
      brisance inspect scenes/brick_wall.toml
      brisance inspect wall.usdc
      brisance inspect scenes/shelter.toml --occlusion -o map.png
    """
    from brisance.errors import InputError
    from brisance.result import USD_SUFFIXES

    suffix = file.suffix.lower()
    if occlusion or output is not None:
        if not occlusion or output is None:
            raise InputError("--occlusion and -o go together: brisance inspect SCENE --occlusion -o map.png.")
        if suffix in (*USD_SUFFIXES, ".json"):
            raise InputError(f"--occlusion draws a scene, and {file} is not one; give a scene file (.toml).")
        from brisance.cli.inspect_shelter import draw_map

        typer.echo(draw_map(file, changes or [], output))
        return
    if suffix not in (*USD_SUFFIXES, ".json"):
        from brisance.cli.inspect_scene import describe

        typer.echo(describe(file, changes or []))
        return
    if changes:
        raise InputError(f"--set changes a scene, and {file} is not one; give a scene file (.toml).")
    if not file.is_file():
        problem = "is a directory" if file.is_dir() else "does not exist"
        raise InputError(f"{file} {problem}; give a scene (.toml), a result (.usdc) or a report (.json).")
    from brisance.cli import inspect_result

    typer.echo(
        inspect_result.describe_report(file) if suffix == ".json" else inspect_result.describe_usd(file)
    )
