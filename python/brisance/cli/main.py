"""The command itself: its subcommands, and how every way of ending becomes one sentence and an exit code.

Exit codes: 0 done, 2 the user's input is wrong, 130 stopped by Ctrl-C, 1 anything else. The environment
variable ``BRISANCE_TRACEBACK=1`` shows where an unexpected error came from.
"""

from __future__ import annotations

import os
import sys
import traceback
from collections.abc import Sequence
from typing import Annotated, cast

import typer

from brisance.cli.curves import curves
from brisance.cli.figure import figure
from brisance.cli.fracture import fracture
from brisance.cli.inspect import inspect
from brisance.cli.render import render
from brisance.cli.run import run
from brisance.cli.theory import app as theory
from brisance.cli.view import view
from brisance.errors import BrisanceError

SPREAD = ("--distance", "--seed-at")
"""Options that take every number that follows."""

# Typer keeps the base of its usage errors private; BadParameter derives from it directly.
_UsageError = cast(type[Exception], typer.BadParameter.__mro__[1])

app = typer.Typer(name="brisance", add_completion=False, rich_markup_mode=None)
for command in (run, view, inspect, curves, fracture, render, figure):
    app.command()(command)
app.add_typer(theory)


def _show_version(wanted: bool) -> None:
    if wanted:
        import brisance

        typer.echo(f"brisance {brisance.__version__}")
        raise typer.Exit


@app.callback()
def _brisance(
    version: Annotated[
        bool,
        typer.Option("--version", callback=_show_version, is_eager=True, help="Show the version and exit."),
    ] = False,
) -> None:
    """Explosions for animation: physically based blast, from a scene file to the flight of every piece.

    \b
    Example:
      brisance run scenes/brick_wall.toml -o wall.usdc
      brisance view scenes/brick_wall.toml
      brisance render wall.usdc -o wall.mp4
    """


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command with ``arguments`` (those of the process by default) and return its exit code."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    try:
        code = app(args=spread(given) or ["--help"], prog_name="brisance", standalone_mode=False)
        sys.stdout.flush()
    except BrisanceError as error:
        return _fail(str(error), error.exit_code)
    except _UsageError as error:
        return _usage(error)
    except (KeyboardInterrupt, typer.Abort):
        code = 130
    except MemoryError:
        return _fail("there is not enough memory for this; lower the number of frames or pieces.", 1)
    except BrokenPipeError:
        _silence_output()
        return 1
    except OSError as error:
        if error.filename is None:
            _silence_output()
        return _fail(f"{error.filename or 'the output'}: {(error.strerror or str(error)).lower()}.", 1)
    except Exception as error:
        return _unexpected(error)
    if code == 130:
        return _fail("stopped.", 130)
    return code if isinstance(code, int) else 0


def _silence_output() -> None:
    """Nothing more can be said to whoever reads our output: not even what is still buffered, at exit."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def spread(arguments: Sequence[str]) -> list[str]:
    """Repeat a flag before each of its values: ``--distance 5 10`` as ``--distance 5 --distance 10``."""
    result: list[str] = []
    flag = ""
    for argument in arguments:
        if argument.startswith("-") and not _is_number(argument):
            flag = argument if argument in SPREAD else ""
            result.append(argument)
        elif flag and result[-1] != flag and _is_number(argument):
            result += [flag, argument]
        else:
            result.append(argument)
    return result


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _usage(error: Exception) -> int:
    message = " ".join(str(getattr(error, "format_message", lambda: error)()).split())
    context = getattr(error, "ctx", None)
    command = context.command_path if context is not None else "brisance"
    return _fail(f"{message.rstrip('.')}; see {command} --help.", 2)


def _unexpected(error: Exception) -> int:
    if os.environ.get("BRISANCE_TRACEBACK"):
        traceback.print_exception(error)
        return 1
    what = " ".join(f"{type(error).__name__}: {error}".split())
    return _fail(f"unexpected error, {what} (set BRISANCE_TRACEBACK=1 to see where).", 1)


def _fail(sentence: str, code: int) -> int:
    """Print one sentence, ended as a sentence is, and return the exit code."""
    ended = sentence if sentence.endswith((".", "?")) else f"{sentence}."
    print(f"brisance: {ended}", file=sys.stderr)
    return code
