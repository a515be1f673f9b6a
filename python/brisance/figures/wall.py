"""The brick walls of the example scenes, simulated for the figures that show them."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

import brisance
from brisance.errors import InputError

if TYPE_CHECKING:
    from brisance.model import Scene
    from brisance.result import Result

BLOWN_APART = "brick_wall.toml"
RESISTS = "brick_wall_resists.toml"


def scene(name: str) -> Scene:
    """Load the example scene ``name`` from the ``scenes`` folder above this file or in the current folder."""
    for folder in (*Path(__file__).resolve().parents, Path.cwd()):
        path = folder / "scenes" / name
        if path.is_file():
            return brisance.load(path)
    raise InputError(
        f"The scene {name} that this figure shows was not found; run from a checkout of the project."
    )


@cache
def result(name: str) -> Result:
    """Simulate the example scene ``name``."""
    return brisance.simulate(scene(name))
