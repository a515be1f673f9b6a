"""``brisance view``: a scene live in the browser."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def view(
    scene: Annotated[Path, typer.Argument(metavar="SCENE", help="Scene file (.toml) to begin with.")],
    folder: Annotated[
        Path | None,
        typer.Option(metavar="DIR", help="Folder of the scenes that may be opened; left out: that of SCENE."),
    ] = None,
    host: Annotated[
        str,
        typer.Option(metavar="ADDRESS", help="Address to listen at; others can reach any but 127.0.0.1."),
    ] = "127.0.0.1",
    port: Annotated[
        int | None,
        typer.Option(min=0, max=65535, metavar="N", help="Port to listen at; where it is taken, a free one."),
    ] = None,
    no_open: Annotated[bool, typer.Option("--no-open", help="Do not open the browser.")] = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing but errors.")] = False,
) -> None:
    """Open a scene in the browser: move the charge, turn the knobs, and see the new explosion at once.

    Runs until Ctrl-C.

    \b
    Example:
      brisance view scenes/brick_wall.toml
      brisance view scenes/brick_wall.toml --no-open --port 8000
    """
    from brisance.view.server import serve

    def told(address: str) -> None:
        if not quiet:
            print(address, flush=True)
            typer.echo("Ctrl-C ends it.", err=True)

    serve(scene, folder=folder, host=host, port=port, open_browser=not no_open, told=told)
