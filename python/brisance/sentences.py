"""From a validation error to one clear sentence that names the key, what is wrong and what would be right."""

from __future__ import annotations

import difflib
import math
from dataclasses import dataclass
from typing import Any, get_args

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails

_EXPECTED = {
    "float_type": "a number",
    "int_type": "a whole number",
    "int_from_float": "a whole number",
    "finite_number": "a finite number",
    "string_type": "text",
    "string_too_short": "text that is not empty",
    "string_too_long": "text of at most {max_length} characters",
    "string_pattern_mismatch": "text without slashes or control characters",
    "bool_type": "true or false",
    "greater_than": "greater than {gt:g}",
    "greater_than_equal": "{ge:g} or more",
    "less_than": "less than {lt:g}",
    "less_than_equal": "{le:g} or less",
    "literal_error": "{expected}",
    "tuple_type": "a list of three numbers",
    "too_long": "a list of three numbers",
    "model_type": "a table of keys",
    "model_attributes_type": "a table of keys",
    "list_type": "a list of tables",
    "is_instance_of": "a list of tables",
}


@dataclass(frozen=True)
class Problem:
    """One thing wrong with a scene: the key it concerns and the rest of the sentence."""

    key: tuple[str | int, ...]
    text: str

    def sentence(self, where: str) -> str:
        """The whole sentence, begun by ``where`` it was found: a file, a flag, a class."""
        path = on_one_line(".".join(str(part) for part in self.key))
        subject = (
            f"{where}: {path} " if path else f"{where} " if self.text.startswith("has ") else f"{where}: "
        )
        return f"{subject}{self.text}{'' if self.text.endswith('?') else '.'}"


def first_problem(error: ValidationError, model: type[BaseModel]) -> Problem:
    """The problem worth telling first: an unknown key, which may explain the others, else the first in
    order.
    """
    details = error.errors(include_url=False)
    unknown = [d for d in details if d["type"] == "extra_forbidden"]
    chosen = unknown[0] if unknown else details[0]
    key, owner = _locate(model, chosen)
    if chosen["type"] == "missing" and isinstance(key[-1], int):
        return Problem(key[:-1], f"must be a list of three numbers, not {value_text(chosen['input'])}")
    same = [d for d in details if d["type"] != "extra_forbidden" and _locate(model, d)[0] == key]
    return Problem(key, _text(chosen, key, owner, same))


def nearest(word: str, known: list[str]) -> str | None:
    """The known word that was probably meant, if any is near."""
    folded = {name.casefold().replace("-", "_"): name for name in known}
    plain = word.casefold().replace("-", "_")
    matches = difflib.get_close_matches(plain, folded, n=1, cutoff=0.6)
    begun = [name for name in folded if len(plain) > 1 and name.startswith(plain)]
    found = matches or (begun if len(begun) == 1 else [])
    return folded[found[0]] if found else None


def value_text(value: Any) -> str:
    """A value as the user wrote it, short enough for a sentence."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, dict):
        return "a table"
    text = f"{value:g}" if isinstance(value, float) else repr(value)
    return text if len(text) <= 40 else f"{text[:37]}..."


def on_one_line(text: str) -> str:
    """Text with what cannot be printed written as an escape: a key may hold line ends."""
    return "".join(letter if letter.isprintable() else repr(letter)[1:-1] for letter in text)


def _text(
    detail: ErrorDetails, key: tuple[str | int, ...], owner: type[BaseModel], same: list[ErrorDetails]
) -> str:
    kind, last = detail["type"], str(key[-1]) if key else ""
    if kind == "extra_forbidden":
        known = list(_keys(owner))
        guess = nearest(last, known)
        hint = f"did you mean {guess}?" if guess else f"known here: {', '.join(known)}"
        return f"is not a known key; {hint}"
    if kind == "missing" and last in _keys(owner):
        return f"is missing: {_first_clause(_keys(owner)[last].description)}"
    if kind == "value_error":
        return str(detail.get("ctx", {}).get("error", detail["msg"]))
    if isinstance(detail["input"], float) and not math.isfinite(detail["input"]):
        return f"must be a finite number, not {detail['input']}"
    expected = list(dict.fromkeys(_expected(d) for d in same))
    return f"must be {' or '.join(expected)}, not {value_text(detail['input'])}"


def _expected(detail: ErrorDetails) -> str:
    template = _EXPECTED.get(detail["type"])
    if template is None:
        return detail["msg"][:1].lower() + detail["msg"][1:]
    return template.format(**detail.get("ctx", {}))


def _first_clause(description: str | None) -> str:
    text = (description or "give it a value").split(". ")[0].rstrip(".")
    return f"give {text[:1].lower()}{text[1:]}"


def _locate(model: type[BaseModel], detail: ErrorDetails) -> tuple[tuple[str | int, ...], type[BaseModel]]:
    """The key an error is about, without pydantic's marks for members of a union, and the model that key
    is in.
    """
    key: list[str | int] = []
    owner, current = model, model
    for part in detail["loc"]:
        if isinstance(part, int):
            key.append(part)
        elif part in _keys(current):
            key.append(part)
            owner = current
            current = _model_in(_keys(current)[part].annotation) or current
    if detail["type"] == "extra_forbidden":
        key.append(detail["loc"][-1])
        owner = current
    return tuple(key), owner


def _keys(model: type[BaseModel]) -> dict[str, FieldInfo]:
    """The fields of a model by the keys that a user writes."""
    return {field.alias or name: field for name, field in model.model_fields.items()}


def _model_in(annotation: Any) -> type[BaseModel] | None:
    """The first model class mentioned in an annotation."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return annotation
    return next((found for arg in get_args(annotation) if (found := _model_in(arg))), None)
