"""``brisance theory``: the theory of chapter 2, one command a subject."""

from __future__ import annotations

import typer

from brisance.cli.theory.hugoniot import hugoniot
from brisance.cli.theory.hydrocode import hydrocode
from brisance.cli.theory.pressure_impulse import pressure_impulse
from brisance.cli.theory.sdof import sdof

app = typer.Typer(
    name="theory",
    help="Structures, detonations and a one-dimensional hydrocode: the theory behind the model.",
    rich_markup_mode=None,
)
app.command("sdof")(sdof)
app.command("pressure-impulse")(pressure_impulse)
app.command("hugoniot")(hugoniot)
app.command("hydrocode")(hydrocode)

__all__ = ["app"]
