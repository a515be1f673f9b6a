"""The example scenes, simulated for the figures that show them."""

from __future__ import annotations

from collections.abc import Sequence
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


def scene(name: str, changes: Sequence[str] = ()) -> Scene:
    """Load the example scene ``name``, with ``changes`` as of ``--set``.

    It is looked for in the ``scenes`` folder above this file or in the current folder.
    """
    for folder in (*Path(__file__).resolve().parents, Path.cwd()):
        path = folder / "scenes" / name
        if path.is_file():
            return brisance.load(path, list(changes))
    raise InputError(
        f"The scene {name} that this figure shows was not found; run from a checkout of the project."
    )


@cache
def result(name: str) -> Result:
    """Simulate the example scene ``name``."""
    return brisance.simulate(scene(name))
