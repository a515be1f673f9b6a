"""The scene: what an artist says, validated, in SI units (metres, kilograms, seconds, pascals, kelvins).

The same classes serve the scene file and Python. Each is frozen, refuses unknown keys, and takes numbers only
where it asks for numbers (no text, no true or false, no infinity). Axes are right-handed with Y up; angles
are in degrees, because a person types them here.

A value out of range raises :class:`brisance.errors.InputError` with one sentence.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal

from pydantic import (
    AfterValidator,
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    StrictBool,
    ValidationError,
    model_validator,
)

from brisance.errors import InputError
from brisance.rotation import quaternion_from_degrees, rotate
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


class Time(Model):
    """How long the scene lasts and how finely it is recorded. `[time]`"""

    duration: Positive = Field(
        default=1.0,
        description="Length of the simulation [s], above 0; default 1. Frames run from 0 to duration × "
        "frame_rate.",
    )
    frame_rate: Positive = Field(
        default=60.0,
        description="Frames recorded a second of scene time [1/s], above 0; default 60. Higher is slow "
        "motion; it does not change the physics.",
    )
    step: Positive | None = Field(
        default=None,
        description="Step of the integration [s], above 0; left out: chosen and reported. Smaller is slower "
        "and follows tumbling more closely; the impulse a piece receives does not depend on it.",
    )

    @property
    def frames(self) -> int:
        """Number of frames recorded, the initial one included."""
        return round(self.duration * self.frame_rate) + 1


class Air(Model):
    """The still air before the blast. `[air]`"""

    pressure: Positive = Field(
        default=101325.0,
        description="Ambient pressure [Pa], above 0; default 101325. Lower (at altitude) weakens and widens "
        "a blast.",
    )
    temperature: Positive = Field(
        default=288.15,
        description="Ambient temperature [K], above 0; default 288.15. Higher makes the front arrive sooner.",
    )


class Ground(Model):
    """A level plane that bodies rest on; without this table there is none. `[ground]`"""

    height: Number = Field(default=0.0, description="Height of the plane [m]; default 0.")
    friction: NotNegative = Field(
        default=0.6,
        description="Coefficient of friction with the ground, 0 or more; default 0.6. More holds bodies "
        "back.",
    )


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
    time: NotNegative = Field(default=0.0, description="Moment of detonation [s], 0 or later; default 0.")
    gain: NotNegative = Field(
        default=1.0, description="Art direction: multiplies every load of this charge, 0 or more; default 1."
    )
    curves: Annotated[str, Field(min_length=1)] = Field(
        default="kingery-bulmash",
        description="Where its pressures come from: kingery-bulmash (default), brode, henrych, "
        "kinney-graham, or a CSV file, looked for beside the scene file.",
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
    """Shelter behind other bodies. `[occlusion]`"""

    enabled: StrictBool = Field(
        default=False, description="Whether bodies shelter one another; default false."
    )
    resolution: Annotated[Count, Field(le=4096)] = Field(
        default=32,
        description="Pixels along an icosahedron edge, 1 to 4096; default 32. More resolves smaller bodies.",
    )
    per: Literal["body", "panel"] = Field(
        default="body",
        description="One shelter factor for each body (default) or one for each of its panels.",
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
        default=False, description="Whether pieces collide and pile up; default false."
    )


class SceneObject(Model):
    """What every object in a scene has in common."""

    kind: ClassVar[str]
    """Name of its table in a scene file."""

    name: Name | None = Field(
        default=None, description="Its name, unique in the scene; left out: its table and number."
    )
    position: Vector = Field(default=(0.0, 0.0, 0.0), description="Where it stands [m]; default the origin.")
    rotation: Vector = Field(
        default=(0.0, 0.0, 0.0),
        description="Degrees about X, then Y, then Z, each a fixed axis of the world (Blender's XYZ Euler); "
        "default 0.",
    )
    anchored: StrictBool = Field(default=False, description="true: nothing moves it; default false.")
    occludes: StrictBool = Field(
        default=True, description="Whether it may shelter what is behind it; default true."
    )
    can_rotate: StrictBool = Field(
        default=True, description="false: it flies without tumbling; default true."
    )
    friction: NotNegative = Field(
        default=0.6,
        description="Coefficient of friction with what it stands on, 0 or more; default 0.6. The blast must "
        "overcome it before the body slides; unrealistically high values hold a wall together.",
    )
    drag_coefficient: NotNegative = Field(
        default=1.05, description="Drag coefficient of its pieces, 0 or more; default 1.05, that of a cube."
    )
    lift_coefficient: NotNegative | None = Field(
        default=None, description="Lift coefficient for plate-like pieces, 0 or more; left out: no lift."
    )

    def orientation(self) -> tuple[float, float, float, float]:
        """Rotation from its own frame to the world, as a unit quaternion w, x, y, z."""
        w, x, y, z = quaternion_from_degrees(self.rotation).tolist()
        return w, x, y, z

    def to_own_frame(self, point: Sequence[float]) -> tuple[float, float, float]:
        """A point of the world [m] in the object's own frame, whose origin is its position."""
        w, x, y, z = self.orientation()
        offset = [p - o for p, o in zip(point, self.position, strict=True)]
        own_x, own_y, own_z = rotate((w, -x, -y, -z), offset).tolist()
        return own_x, own_y, own_z

    def encloses(self, point: Sequence[float]) -> bool:
        """Whether a point of the world [m] lies in its body or on its surface, where its keys alone can
        tell.
        """
        return False

    @property
    def piece_count(self) -> int:
        """Number of rigid bodies it is made of."""
        return 1


class _Weighed(SceneObject):
    """An object in one piece whose weight is given by density or by mass."""

    density: Positive | None = Field(default=None, description="Density [kg/m³], above 0; in place of mass.")
    mass: Positive | None = Field(
        default=None, description="Mass [kg], above 0; in place of density. More flies less far."
    )

    @model_validator(mode="after")
    def _one_weight(self) -> _Weighed:
        if (self.density is None) == (self.mass is None):
            both = "has both density and mass" if self.mass is not None else "has neither density nor mass"
            raise ValueError(f"{both}; give exactly one of them")
        return self


class Block(_Weighed):
    """A box. `[[block]]`"""

    kind = "block"

    size: Lengths = Field(description="Edge lengths along its own x, y and z [m], each above 0.")
    position: Vector = Field(default=(0.0, 0.0, 0.0), description="Its centre [m]; default the origin.")
    material: Material = Field(
        default="wood", description="What it looks like; default wood. No part in the physics."
    )

    @property
    def weight(self) -> float:
        """Mass of the block [kg]."""
        if self.mass is not None:
            return self.mass
        return (self.density or 0.0) * math.prod(self.size)

    def encloses(self, point: Sequence[float]) -> bool:
        return all(abs(c) <= s / 2 for c, s in zip(self.to_own_frame(point), self.size, strict=True))


class BrickWall(SceneObject):
    """A wall of bricks in running bond, in its own XY plane: every other course begins and ends with a half
    brick.

    `[[brick_wall]]`
    """

    kind = "brick_wall"

    rows: Count = Field(default=6, description="Number of courses, 1 or more; default 6.")
    columns: Count = Field(default=4, description="Whole bricks in a course, 1 or more; default 4.")
    brick_size: Lengths = Field(
        default=(0.32, 0.16, 0.10),
        description="Length, height and thickness of a whole brick [m]; default 0.32, 0.16, 0.10.",
    )
    brick_mass: Positive | None = Field(
        default=None, description="Mass of a whole brick [kg], above 0; in place of density."
    )
    density: Positive | None = Field(
        default=None, description="Density of the bricks [kg/m³], above 0; in place of brick_mass."
    )
    mortar_gap: NotNegative = Field(
        default=0.0,
        description="Width of the joints [m], 0 to less than a brick's length; default 0. They carry no "
        "load.",
    )
    position: Vector = Field(
        default=(0.0, 0.0, 0.0), description="Centre of the wall's foot [m]; default the origin."
    )
    material: Material = Field(
        default="brick", description="What it looks like; default brick. No part in the physics."
    )

    @model_validator(mode="after")
    def _consistent(self) -> BrickWall:
        if (self.density is None) == (self.brick_mass is None):
            both = (
                "has both density and brick_mass"
                if self.density is not None
                else "has neither density nor brick_mass"
            )
            raise ValueError(f"{both}; give exactly one of them")
        if self.mortar_gap >= self.brick_size[0]:
            raise ValueError(
                "has a mortar_gap as wide as a brick is long; make it smaller than the length of a brick"
            )
        return self

    @property
    def whole_mass(self) -> float:
        """Mass of a whole brick [kg]."""
        if self.brick_mass is not None:
            return self.brick_mass
        return (self.density or 0.0) * math.prod(self.brick_size)

    @property
    def size(self) -> tuple[float, float, float]:
        """Length, height and thickness of the wall [m]."""
        length, height, thickness = self.brick_size
        gap = self.mortar_gap
        return (
            self.columns * length + (self.columns - 1) * gap,
            self.rows * height + (self.rows - 1) * gap,
            thickness,
        )

    @property
    def piece_count(self) -> int:
        return self.rows * self.columns + self.rows // 2

    def encloses(self, point: Sequence[float]) -> bool:
        x, y, z = self.to_own_frame(point)
        length, height, thickness = self.size
        return abs(x) <= length / 2 and 0 <= y <= height and abs(z) <= thickness / 2


class MeshObject(_Weighed):
    """Any mesh, from a file. `[[mesh]]`"""

    kind = "mesh"

    file: Annotated[str, Field(min_length=1)] = Field(
        description="OBJ, STL, PLY, GLB or USD file, looked for beside the scene file."
    )
    scale: Positive = Field(
        default=1.0, description="Metres a unit of the file, above 0; default 1, 0.01 for centimetres."
    )
    position: Vector = Field(
        default=(0.0, 0.0, 0.0), description="Where the file's origin is put [m]; default the origin."
    )
    material: Material = Field(
        default="stone", description="What it looks like; default stone. No part in the physics."
    )


AnyObject = Block | BrickWall | MeshObject


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


class Scene(SceneSettings):
    """A whole scene: settings, charges, objects.

    ``objects`` come out with a name each. Files named in the scene are looked for in ``base_folder``.
    """

    charges: Annotated[Sequence[Charge], AfterValidator(tuple)] = Field(
        description="The charges, one or more."
    )
    objects: Annotated[Sequence[AnyObject], AfterValidator(tuple)] = Field(
        default=(), description="What the blast acts on: Block, BrickWall, MeshObject."
    )
    base_folder: Path = Field(
        default=Path(), exclude=True, description="Folder that file names in the scene start from."
    )

    @model_validator(mode="after")
    def _whole(self) -> Scene:
        if not self.charges:
            raise ValueError(
                "the scene has no charge; add one with a mass and a position ([[charge]] in a scene file)"
            )
        # The model is frozen for its users; names are filled in before anyone sees it.
        object.__setattr__(self, "objects", _named(self.objects))
        for index, charge in enumerate(self.charges):
            self._check_place(f"charge.{index}", charge)
        return self

    def _check_place(self, key: str, charge: Charge) -> None:
        if self.ground is not None and charge.position[1] < self.ground.height:
            below = self.ground.height - charge.position[1]
            raise ValueError(
                f"{key}.position is {below:g} m below the ground; raise it to {self.ground.height:g} or more"
            )
        for obj in self.objects:
            if obj.encloses(charge.position):
                raise ValueError(f"{key}.position is inside the {obj.kind} {obj.name!r}; move one of them")

    @property
    def piece_count(self) -> int:
        """Number of rigid bodies in the scene."""
        return sum(obj.piece_count for obj in self.objects)


def object_keys(objects: Sequence[AnyObject]) -> list[str]:
    """The path of each object in a scene file, such as ``block.0``: its table and its number there."""
    seen: dict[str, int] = {}
    keys = []
    for obj in objects:
        number = seen.get(obj.kind, 0)
        seen[obj.kind] = number + 1
        keys.append(f"{obj.kind}.{number}")
    return keys


def _named(objects: Sequence[AnyObject]) -> tuple[AnyObject, ...]:
    """The objects, each with a name: its own, else its table and number."""
    keys = object_keys(objects)
    owner: dict[str, str] = {}
    for obj, key in zip(objects, keys, strict=True):
        if obj.name is None:
            continue
        if obj.name in owner:
            raise ValueError(
                f"{key}.name {obj.name!r} is already the name of {owner[obj.name]}; give each its own name"
            )
        owner[obj.name] = key
    named = []
    for obj, key in zip(objects, keys, strict=True):
        name = obj.name or key.replace(".", "_")
        while obj.name is None and name in owner:
            name += "_"
        owner.setdefault(name, key)
        named.append(obj if obj.name else obj.model_copy(update={"name": name}))
    return tuple(named)


def explosive_factor(name: str) -> float:
    """TNT equivalence of a named explosive of Table 2.1, in any case; ValueError for a name that is not
    there.
    """
    from brisance import _engine

    table = {known.casefold(): factor for known, factor in _engine.explosives()}
    try:
        return table[name.casefold()]
    except KeyError:
        known = ", ".join(name for name, _ in _engine.explosives())
        raise ValueError(
            f"has an explosive {name!r} that is not known; choose {known}, or give tnt_equivalence"
        ) from None
