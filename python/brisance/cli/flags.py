"""Flags checked by the models that they fill: an error names the flag that the user typed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from brisance.model import Model

Part = TypeVar("Part", bound="Model")


def checked(
    model: type[Part], /, *, flags: Mapping[str, str] | None = None, whole: str = "", **values: Any
) -> Part:
    """A model made of flags. ``flags`` names those that are called otherwise than their key, and ``whole``
    what is wrong where no single flag is.
    """
    from pydantic import ValidationError

    from brisance.errors import InputError
    from brisance.sentences import first_problem

    try:
        return model.model_validate(values)
    except ValidationError as error:
        problem = first_problem(error, model)
        name = flag(str(problem.key[0]), flags) if problem.key else whole
        raise InputError(f"{name} {problem.text}.") from None


@contextmanager
def named(flags: Mapping[str, str] | None = None) -> Iterator[None]:
    """Errors about an argument of the Python interface, told of the flag that set it."""
    from brisance.errors import ArgumentError, InputError

    try:
        yield
    except ArgumentError as error:
        raise InputError(f"{flag(error.argument, flags)} {error.text}") from error


def flag(key: str, flags: Mapping[str, str] | None = None) -> str:
    """The flag of a key."""
    return (flags or {}).get(key, f"--{key.replace('_', '-')}")
