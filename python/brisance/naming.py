"""The engine numbers bodies and windows; who reads its sentences knows them by name."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from brisance.errors import InputError
from brisance.model import Window

_NUMBERED = re.compile(r"(body|window|a piece of window) (\d+): ")


@contextmanager
def naming(bodies: Sequence[str], windows: Sequence[Window]) -> Iterator[None]:
    """Put names in the place of numbers in what the engine refuses; ``bodies`` are those before all panes."""
    try:
        yield
    except InputError as error:
        found = _NUMBERED.match(str(error))
        if found is None:
            raise
        kind, number = found[1], int(found[2])
        sentence = str(error)[found.end() :]
        joint = " " if sentence.startswith("would ") else ": "
        whose = bodies[number] if kind == "body" else f"{kind}.{number} ({windows[number].name})"
        raise InputError(f"{whose}{joint}{sentence}.") from None
