"""``brisance render``: a result as a picture, a sequence of pictures, or a video."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from brisance.interrupt import if_stopped, restore_terminal

if TYPE_CHECKING:
    from brisance.render import Progress


class Quality(StrEnum):
    """How finely a frame is rendered."""

    draft = "draft"
    final = "final"


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
    quality: Annotated[
        Quality | None,
        typer.Option(help="final takes about 8 times as long; left out: final for one frame, else draft."),
    ] = None,
    fps: Annotated[int, typer.Option(metavar="N", help="Frames a video shows a second.")] = 25,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing but errors.")] = False,
) -> None:
    """Render a result with Blender (needs brisance[render]; no display, no GPU).

    \b
    Example:
      brisance render wall.usdc -o wall.mp4 --size 640x360
      brisance render wall.usdc -o still.png --frame 20 --camera side
      brisance render wall.usdc -o frames/####.png --quality final
    """
    from brisance.render import render as render_result

    with shown(not quiet) as progress:
        written = render_result(
            result,
            output,
            frame=frame,
            camera=camera,
            size=parse_size(size),
            quality=None if quality is None else quality.value,
            fps=fps,
            progress=progress,
        )
    if not quiet:
        typer.echo(str(written[0] if len(written) == 1 else output))


@contextmanager
def shown(wanted: bool) -> Iterator[Progress | None]:
    """A bar on stderr that counts finished frames, or nothing where nobody watches."""
    from rich.console import Console
    from rich.progress import MofNCompleteColumn, Progress, TimeRemainingColumn

    console = Console(stderr=True)
    if not (wanted and console.is_terminal):
        yield None
        return
    columns = (*Progress.get_default_columns()[:2], MofNCompleteColumn(), TimeRemainingColumn())
    with if_stopped(restore_terminal), Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task("rendering", total=None)
        yield lambda done, total: bar.update(task, completed=done, total=total)


def parse_size(text: str) -> tuple[int, int]:
    """Width and height [pixels] from text such as 1280x720."""
    from brisance.errors import InputError

    width, cross, height = text.lower().partition("x")
    if not (cross and width.isdecimal() and height.isdecimal() and int(width) > 0 and int(height) > 0):
        raise InputError(f"--size {text} is not a size in pixels; give width x height, such as 1280x720.")
    return int(width), int(height)
