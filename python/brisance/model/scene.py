"""A whole scene."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

from pydantic import AfterValidator, Field, model_validator

from brisance.model.anything import AnyObject, named
from brisance.model.charge import Charge
from brisance.model.settings import SceneSettings


class Scene(SceneSettings):
    """A whole scene: settings, charges, objects.

    ``objects`` come out with a name each. Files named in the scene are looked for in ``base_folder``.
    """

    charges: Annotated[Sequence[Charge], AfterValidator(tuple)] = Field(
        description="The charges, one or more."
    )
    objects: Annotated[Sequence[AnyObject], AfterValidator(tuple)] = Field(
        default=(), description="What the blast acts on: Block, BrickWall, MeshObject, Window."
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
        object.__setattr__(self, "objects", named(self.objects))
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
        """Number of rigid bodies in the scene, pieces of windows that the load decides on left out."""
        return sum(obj.piece_count for obj in self.objects)
