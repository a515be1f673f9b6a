"""A charge, and the explosives known by name."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from brisance.model.base import Model, NotNegative, Number, Positive, Vector


class Charge(Model):
    """One explosive charge. `[[charge]]`"""

    mass: Positive = Field(
        description="Mass of the named explosive [kg], above 0. Distances at which a pressure is felt grow "
        "with its cube root."
    )
    position: Vector = Field(
        description="Where it detonates [m], outside every body and not below the ground."
    )
    explosive: str | None = Field(
        default=None, description="One of the explosives of Table 2.1, such as TNT, RDX or PETN; default TNT."
    )
    tnt_equivalence: Positive | None = Field(
        default=None,
        description="Mass of TNT that does what 1 kg of this explosive does, above 0; in place of explosive.",
    )
    burst: Literal["air", "surface"] = Field(
        default="air",
        description="air: free in the air; surface: on the ground, which reflects its energy upward.",
    )
    time: Number = Field(
        default=0.0,
        description="Moment of detonation [s]; default 0. It may lie before the first frame, as long as its "
        "front has reached nothing by then.",
    )
    gain: NotNegative = Field(
        default=1.0,
        le=1000.0,
        description="Art direction: multiplies every load of this charge, 0 to 1000; default 1, the physical "
        "value.",
    )
    curves: Annotated[str, Field(min_length=1)] = Field(
        default="kingery-bulmash",
        description="Where its pressures come from: kingery-bulmash (default), brode, henrych, "
        "kinney-graham, hydrocode (computed by Brisance itself), or a CSV file, looked for beside the scene "
        "file.",
    )

    @model_validator(mode="after")
    def _known_explosive(self) -> Charge:
        if self.explosive is not None and self.tnt_equivalence is not None:
            raise ValueError("has both explosive and tnt_equivalence; keep one of them")
        if self.explosive is not None:
            explosive_factor(self.explosive)
        return self

    @property
    def factor(self) -> float:
        """TNT equivalence in use: the given one, else that of the named explosive, else 1."""
        if self.tnt_equivalence is not None:
            return self.tnt_equivalence
        return 1.0 if self.explosive is None else explosive_factor(self.explosive)


def explosive_factor(name: str) -> float:
    """TNT equivalence of an explosive of Table 2.1, upper or lower case; ValueError for another name."""
    from brisance import _engine

    table = {known.casefold(): factor for known, factor in _engine.explosives()}
    try:
        return table[name.casefold()]
    except KeyError:
        known = ", ".join(name for name, _ in _engine.explosives())
        raise ValueError(
            f"has an explosive {name!r} that is not known; choose {known}, or give tnt_equivalence"
        ) from None
