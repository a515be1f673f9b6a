"""``brisance render``: a result as a picture, a sequence of pictures, or a video."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def render(
    result: Annotated[Path, typer.Argument(metavar="RESULT", help="Result of brisance run (.usdc …).")],
    output: Annotated[
        Path,
        typer.Option(
            "-o", "--output", metavar="OUT", help="out.mp4, out.png (one frame) or frames/####.png."
        ),
    ],
    frame: Annotated[
        int | None, typer.Option(min=0, metavar="N", help="Only this frame, numbered from 0.")
    ] = None,
    camera: Annotated[
        str, typer.Option(metavar="VIEW", help="front, side, below, or the path of a camera in the file.")
    ] = "front",
    size: Annotated[str, typer.Option(metavar="WxH", help="Width and height in pixels.")] = "1280x720",
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing but errors.")] = False,
) -> None:
    """Render a result with Blender (needs brisance[render]; no display, no GPU).

    \b
    Example:
      brisance render wall.usdc -o wall.mp4 --size 640x360
      brisance render wall.usdc -o still.png --frame 20 --camera side
    """
    from brisance.render import render as render_result

    render_result(result, output, frame=frame, camera=camera, size=parse_size(size))
    if not quiet:
        typer.echo(str(output))


def parse_size(text: str) -> tuple[int, int]:
    """Width and height [pixels] from text such as 1280x720."""
    from brisance.errors import InputError

    width, cross, height = text.lower().partition("x")
    if not (cross and width.isdecimal() and height.isdecimal() and int(width) > 0 and int(height) > 0):
        raise InputError(f"--size {text} is not a size in pixels; give width x height, such as 1280x720.")
    return int(width), int(height)
