"""How a brittle pane breaks, as an artist says it."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal, Self

from pydantic import BeforeValidator, ConfigDict, Field, StrictBool, model_validator

from brisance.model.base import Count, Model, Number, Positive

Share = Annotated[Number, Field(ge=0, le=1)]
Angle = Annotated[Number, Field(ge=0, le=180)]
Place = Annotated[tuple[Share, Share], BeforeValidator(lambda v: v.tolist() if hasattr(v, "tolist") else v)]
Glass = Literal["annealed", "tempered", "laminated"]


class Cracks(Model):
    """How cracks start, run and fork. Angles in degrees; the same seed gives the same pattern everywhere."""

    pieces: Count | None = Field(
        default=None,
        description="About how many fragments, within 10 %, 1 or more; in place of critical_length.",
    )
    critical_length: Positive | None = Field(
        default=None,
        description="Critical length of cracks [m], above 0, at most the pane's longer side: a tree forks "
        "each time its cracks have grown by this much. Smaller gives more and finer pieces.",
    )
    seeds: list[Place] = Field(
        default_factory=list,
        description="Where cracks start, as shares of width and height from the lower left corner, 0 to 1; "
        "left out, in the middle.",
    )
    starts: Count | None = Field(
        default=None,
        description="In about how many places cracks start, seeds and flaws spread over the pane together, "
        "1 or more; left out, in the seeds alone up to 1 500 pieces each, and beyond at a flaw for every 15.",
    )
    shape: Literal["segment", "cross", "star"] = Field(
        default="star",
        description="How a crack starts: a short line (as in the thesis), an X, or a star of nine arms "
        "(default).",
    )
    literal: StrictBool = Field(
        default=False,
        description="Whether to fork by the thesis's own rule and nothing else: one fork each critical "
        "length, whatever is left to break. Default false.",
    )
    fork_angle: Annotated[Number, Field(gt=0, lt=180)] = Field(
        default=25.0,
        description="Angle between the branches of a fork [degrees], above 0 and below 180; default 25. "
        "Larger gives rounder pieces.",
    )
    fork_variance: Angle = Field(
        default=34.5,
        description="Full width of the range in which that angle varies [degrees], 0 to 180; default 34.5.",
    )
    wiggle_probability: Share = Field(
        default=0.5,
        description="Probability that a crack turns at each step, 0 to 1; default 0.5. 0 gives straight "
        "cracks.",
    )
    wiggle_variance: Angle = Field(
        default=20.0,
        description="Full width of the range of such turns [degrees], 0 to 180; default 20. More is rougher.",
    )
    wiggle_spacing: Positive | None = Field(
        default=None,
        description="Step at which a crack may turn [m], above 0; left out, a third of a mean piece. Smaller "
        "gives finer edges and more vertices.",
    )
    rings: Share = Field(
        default=0.6,
        description="Share of the wedges between radial cracks that rings cross, 0 to 1; default 0.6.",
    )
    reach: Positive | None = Field(
        default=None,
        description="How far cracks grow at most [m], above 0: a creep crack that does not cross the pane. "
        "Left out, to the border.",
    )
    toward: Number | None = Field(
        default=None,
        description="Direction that cracks bend to [degrees] counter-clockwise from the width; left out, "
        "outward.",
    )

    WAYS: ClassVar[tuple[str, ...]] = ("pieces", "critical_length")
    """Attributes that say how finely to break; at most one of them is given."""

    @model_validator(mode="after")
    def _one_fineness(self) -> Self:
        given = [way.rstrip("_") for way in self.WAYS if getattr(self, way) is not None]
        if len(given) > 1:
            raise ValueError(f"has both {given[0]} and {given[1]}; keep one of them")
        return self


class Pattern(Cracks):
    """A crack pattern of a pane on its own."""

    glass: Glass = Field(
        default="annealed",
        description="annealed: long shards (default); tempered: dice all over the pane; laminated: cracks "
        "like annealed glass, but the pieces stay on the interlayer.",
    )
    pieces: Count | None = Field(
        default=None,
        description="About how many fragments, within 10 %, 1 or more; in place of critical_length. Left out "
        "together with it: 500, or dice of 7 mm for tempered glass.",
    )
    stress: Positive | None = Field(
        default=None,
        description="Bending stress in the pane as it fails [Pa], above 0; in place of pieces: it gives the "
        "critical length, by thesis (5.5).",
    )
    pressure: Positive | None = Field(
        default=None,
        description="Peak pressure on the pane [Pa], above 0; in place of pieces: it gives their mean area, "
        "by thesis (2.45), 1 mm² or more.",
    )

    WAYS = ("pieces", "critical_length", "stress", "pressure")


class WindowPattern(Cracks):
    """How the pane of a window breaks. `[window.pattern]`"""

    model_config = ConfigDict(validate_by_name=True, validate_by_alias=True)

    from_: Literal["load"] | None = Field(
        default=None,
        alias="from",
        description="load: as many pieces as the peak pressure on the pane asks for, by thesis (2.45), 1 mm² "
        "or more each. The default where neither pieces nor critical_length is given; tempered glass then "
        "breaks into dice of 7 mm whatever the load.",
    )
    seeds: list[Place] = Field(
        default_factory=list,
        description="Where cracks start, as shares of width and height from the lower left corner, 0 to 1; "
        "left out, where the pane fails first.",
    )

    WAYS = ("pieces", "critical_length", "from_")
