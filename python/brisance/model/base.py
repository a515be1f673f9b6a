"""What every part of a scene has in common: kinds of values, and errors as one sentence."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError

from brisance.errors import InputError
from brisance.sentences import first_problem


def _plain(value: Any) -> Any:
    """Numpy scalars and arrays as plain Python numbers and lists; anything else untouched."""
    return value.tolist() if hasattr(value, "tolist") else value


Number = Annotated[float, BeforeValidator(_plain), Field(strict=True, allow_inf_nan=False)]
Positive = Annotated[Number, Field(gt=0)]
NotNegative = Annotated[Number, Field(ge=0)]
Count = Annotated[int, BeforeValidator(_plain), Field(strict=True, ge=1)]
Vector = Annotated[tuple[Number, Number, Number], BeforeValidator(_plain)]
Lengths = Annotated[tuple[Positive, Positive, Positive], BeforeValidator(_plain)]
Name = Annotated[str, Field(min_length=1, max_length=100, pattern=r"^[^\x00-\x1f/\\]+$")]
Material = Literal["brick", "wood", "concrete", "metal", "stone", "plastic", "glass"]


class Model(BaseModel):
    """Base of every part of a scene: frozen, no unknown keys, errors as one sentence."""

    model_config = ConfigDict(frozen=True, extra="forbid", validate_default=False)

    def __init__(self, /, **data: Any) -> None:
        try:
            super().__init__(**data)
        except ValidationError as error:
            raise InputError(first_problem(error, type(self)).sentence(type(self).__name__)) from None

    # Nested models are then validated by pydantic itself, which keeps the whole path to a wrong key.
    __init__.__pydantic_base_init__ = True  # type: ignore[attr-defined]
