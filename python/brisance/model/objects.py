"""What the blast acts on: blocks, brick walls, meshes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Annotated, ClassVar

from pydantic import Field, StrictBool, model_validator

from brisance.model.base import Count, Lengths, Material, Model, Name, NotNegative, Positive, Vector
from brisance.rotation import quaternion_from_degrees, rotate

LEAST_DENSITY = 0.1
"""Density [kg/m³] below which a body is refused. It is a twelfth of air's: such a body would float, which is
not modelled.
"""


def check_weight(mass: float, volume: float) -> None:
    """Raise ValueError for a body of ``mass`` [kg] next to nothing for its ``volume`` [m³]."""
    least = LEAST_DENSITY * volume
    if mass < least:
        raise ValueError(
            f"has a mass of {mass:.3g} kg, far less than the air in its place; give it {least:.2g} kg or "
            f"more, which is a density of {LEAST_DENSITY:g}"
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
        default=None,
        description="Lift coefficient, 0 or more; left out: the drag coefficient for plates, none for chunky "
        "pieces.",
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

    def behaviour(self) -> dict[str, bool | float | None]:
        """How its pieces behave, as the engine takes it: by the keys that every object has."""
        return {
            "anchored": self.anchored,
            "occludes": self.occludes,
            "can_rotate": self.can_rotate,
            "friction": self.friction,
            "drag_coefficient": self.drag_coefficient,
            "lift_coefficient": self.lift_coefficient,
        }

    def encloses(self, point: Sequence[float]) -> bool:
        """Whether a point of the world [m] lies in or on its body, where its keys alone can tell."""
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

    @model_validator(mode="after")
    def _heavier_than_air(self) -> Block:
        check_weight(self.weight, math.prod(self.size))
        return self

    @property
    def weight(self) -> float:
        """Mass of the block [kg]."""
        if self.mass is not None:
            return self.mass
        return (self.density or 0.0) * math.prod(self.size)

    def encloses(self, point: Sequence[float]) -> bool:
        return all(abs(c) <= s / 2 for c, s in zip(self.to_own_frame(point), self.size, strict=True))


class BrickWall(SceneObject):
    """A wall of bricks in its own XY plane, in running bond: half bricks end every other course.

    `[[brick_wall]]`
    """

    kind = "brick_wall"

    rows: Count = Field(default=6, le=1_000_000, description="Number of courses, 1 to a million; default 6.")
    columns: Count = Field(
        default=4, le=1_000_000, description="Whole bricks in a course, 1 to a million; default 4."
    )
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
    mortar_tensile: NotNegative = Field(
        default=0.0,
        description="Strength of the joints against being pulled apart or bent [Pa], 0 or more; default 0. "
        "Lime mortar has some 1e5, cement mortar 2e5 to 1e6. It needs dynamics.contacts.",
    )
    mortar_shear: NotNegative = Field(
        default=0.0,
        description="Strength of the joints against being sheared [Pa], 0 or more; default 0: no mortar "
        "where both are 0. Mortar has some 1e5 to 4e5.",
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
        check_weight(self.whole_mass, math.prod(self.brick_size))
        if self.mortar_gap >= self.brick_size[0]:
            raise ValueError(
                "has a mortar_gap as wide as a brick is long; make it smaller than the length of a brick"
            )
        return self

    @property
    def mortar(self) -> tuple[float, float, float] | None:
        """Tensile and shear strength of the joints [Pa] and their width [m]; None where nothing binds."""
        if self.mortar_tensile == 0 and self.mortar_shear == 0:
            return None
        return self.mortar_tensile, self.mortar_shear, self.mortar_gap

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
