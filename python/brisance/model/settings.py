"""What a scene says apart from its charges and objects, a class a table."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, StrictBool, model_validator

from brisance.model.base import Count, Model, Name, NotNegative, Number, Positive


class Time(Model):
    """How long the scene lasts and how finely it is recorded. `[time]`"""

    duration: Annotated[Positive, Field(le=1e9)] | Literal["rest"] = Field(
        default=1.0,
        description="Length of the simulation [s], above 0 to 1e9; default 1. Frames run from 0 to "
        'duration times frame_rate. Or "rest": it ends when all loads are over and every piece rests.',
    )
    longest: Positive = Field(
        default=30.0,
        le=1e9,
        description='When a run with duration = "rest" ends at the latest [s], above 0 to 1e9; default 30. '
        "Only beside that.",
    )
    frame_rate: Positive = Field(
        default=60.0,
        le=1e9,
        description="Frames recorded a second of scene time [1/s], above 0 to 1e9; default 60. Higher is "
        "slow motion; it does not change the physics.",
    )
    step: Positive | None = Field(
        default=None,
        description="Step of the integration [s], above 0; left out: chosen and reported. Smaller is slower "
        "and follows tumbling more closely; the impulse a piece receives does not depend on it. With "
        "contacts it counts while loads act.",
    )

    @model_validator(mode="after")
    def _longest_of_a_rest(self) -> Time:
        if "longest" in self.model_fields_set and isinstance(self.duration, float):
            raise ValueError(
                f"has a longest of {self.longest:g} s beside a duration of {self.duration:g} s; take one of "
                'them out: longest is for duration = "rest"'
            )
        return self

    @property
    def frames(self) -> int:
        """Most frames recorded, the initial one included."""
        return round(self.end * self.frame_rate) + 1

    @property
    def until_rest(self) -> bool:
        """Whether the run ends when all rests."""
        return self.duration == "rest"

    @property
    def end(self) -> float:
        """When the run ends at the latest [s]."""
        return self.longest if isinstance(self.duration, str) else self.duration


class Air(Model):
    """The still air before the blast. `[air]`"""

    pressure: Number = Field(
        default=101325.0,
        ge=100.0,
        le=1e7,
        description="Ambient pressure [Pa], 100 to 1e7; default 101325. Lower (at altitude) weakens and "
        "widens a blast.",
    )
    temperature: Number = Field(
        default=288.15,
        ge=100.0,
        le=1000.0,
        description="Ambient temperature [K], 100 to 1000; default 288.15. Higher makes the front arrive "
        "sooner.",
    )


class Ground(Model):
    """A level plane that bodies rest on; without this table there is none. `[ground]`"""

    height: Number = Field(default=0.0, description="Height of the plane [m]; default 0.")
    friction: NotNegative = Field(
        default=0.6,
        description="Coefficient of friction with the ground, 0 or more; default 0.6. More holds bodies "
        "back.",
    )


class Loading(Model):
    """How the blast pushes on bodies. `[loading]`"""

    mode: Literal["translational", "surface"] = Field(
        default="translational",
        description="translational: only faces toward the charge are pushed, static pressure cancels; "
        "surface: every face has its own history and the push is their sum.",
    )
    clearing: Literal["assembly", "piece"] | Positive = Field(
        default="assembly",
        description="From which edge the reflected pressure is relieved: that of the whole assembly "
        "(default), of each piece, or a length [m] above 0. Longer keeps the pressure up and throws harder.",
    )
    drag: Literal["flow-relative", "thesis"] = Field(
        default="flow-relative",
        description="flow-relative: drag follows the air's speed relative to the body; thesis: the "
        "undisturbed dynamic pressure, which over-drives small fast pieces.",
    )
    pulse: Literal["friedlander", "triangle-duration", "triangle-impulse"] = Field(
        default="friedlander",
        description="Shape of the pressure in time: friedlander (default), or a triangle that keeps the "
        "duration or the impulse.",
    )
    negative_phase: StrictBool = Field(
        default=False,
        description="Whether the suction that follows the pulse also loads bodies; default false.",
    )


class Occlusion(Model):
    """Shelter behind other bodies. `[occlusion]`

    A body receives the share ``(1 - x^exponent)^power`` of its load, with x its blocking factor over
    ``offset + slope k`` and k its separation; nothing where x is 1 or more. The defaults are the thesis's.
    """

    enabled: StrictBool = Field(default=True, description="Whether bodies shelter one another; default true.")
    resolution: Annotated[Count, Field(ge=4, le=512)] = Field(
        default=32,
        description="Pixels along an icosahedron edge, 4 to 512; default 32, about 2 degrees each. More "
        "resolves smaller bodies, at a cost that grows with its square.",
    )
    per: Literal["body", "panel"] = Field(
        default="body",
        description="One shelter factor for each body (default) or one for each of its panels, so that one "
        "side is loaded more than another.",
    )
    offset: Positive = Field(
        default=1.0,
        description="Blocking factor, in pixels of 2 degrees, that keeps everything off a body close behind "
        "its shelter, above 0; default 1. More shelters less.",
    )
    slope: NotNegative = Field(
        default=7.0,
        description="By how much that blocking factor grows with the separation, 0 or more; default 7. More "
        "lets the wave close sooner behind a shelter.",
    )
    exponent: Positive = Field(
        default=1.5,
        description="Exponent of the blocking factor, above 0; default 1.5. More shelters less near a "
        "shelter's edge.",
    )
    power: Positive = Field(
        default=2.0, description="Exponent of the whole, above 0; default 2. More shelters more."
    )


class Dynamics(Model):
    """How bodies move once pushed. `[dynamics]`"""

    damping_factor: NotNegative = Field(
        default=1.0,
        description="Multiplies air resistance, 0 or more; default 1. More slows small pieces sooner.",
    )
    rotation_factor: NotNegative = Field(
        default=1.0,
        description="Multiplies the torque that makes pieces tumble, 0 or more; default 1, 0 for no "
        "tumbling.",
    )
    contacts: StrictBool = Field(
        default=False,
        description="Whether pieces collide with each other, pile up and come to rest; default false: each "
        "meets the ground alone.",
    )


class SceneSettings(Model):
    """What a scene says apart from its charges and objects."""

    name: Name = Field(default="scene", description="Name of the scene, for titles and reports.")
    seed: Annotated[int, Field(strict=True, ge=0, lt=2**63)] = Field(
        default=1, description="Every random draw comes from it; 0 or more, default 1."
    )
    time: Time = Field(default_factory=Time, description="How long, how finely recorded.")
    air: Air = Field(default_factory=Air, description="The still air before the blast.")
    ground: Ground | None = Field(default=None, description="The plane bodies rest on; left out: none.")
    loading: Loading = Field(default_factory=Loading, description="How the blast pushes on bodies.")
    occlusion: Occlusion = Field(default_factory=Occlusion, description="Shelter behind other bodies.")
    dynamics: Dynamics = Field(default_factory=Dynamics, description="How bodies move once pushed.")
