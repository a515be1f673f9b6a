"""A brittle pane, in a frame or not."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BeforeValidator, Field, StrictBool, model_validator

from brisance.model.base import Material, NotNegative, Number, Positive, Vector
from brisance.model.objects import SceneObject
from brisance.model.pattern import Glass, WindowPattern

THINNEST = 7.62e-4
"""Thickness [m] at which (2.46), measured on real panes, ends."""
STRENGTHS = {"annealed": 45e6, "tempered": 120e6, "laminated": 45e6}
"""Tensile strength of glass in use [Pa]: design values of EN 572-1 and EN 12150-1."""
FACADE = 10.0
"""How far the wall around a framed pane goes on when nothing is said of it [m]: the front of a house. With it
the speeds of fragments come near those that were measured (docs/window.md).
"""

Point = Annotated[tuple[Number, Number], BeforeValidator(lambda v: v.tolist() if hasattr(v, "tolist") else v)]


class Window(SceneObject):
    """A pane of glass in its own XY plane, which the blast may break. `[[window]]`"""

    kind = "window"

    width: Positive | None = Field(default=None, description="Width of the pane [m], above 0.")
    height: Positive | None = Field(default=None, description="Height of the pane [m], above 0.")
    outline: str | list[Point] | None = Field(
        default=None,
        description="Outline of the pane in place of width and height: points x, y [m] in turn, or a file "
        "(.svg, .csv, .json) beside the scene file. Its middle is put at the position.",
    )
    thickness: Number = Field(
        default=0.006,
        gt=THINNEST,
        description="Thickness of the glass [m], above 0.000762 (the thinnest that was measured); default "
        "0.006. Thicker is stronger and heavier.",
    )
    position: Vector = Field(
        default=(0.0, 0.0, 0.0), description="Centre of the pane [m]; default the origin."
    )
    glass: Glass = Field(
        default="annealed",
        description="annealed: long shards (default); tempered: dice all over; laminated: it cracks and "
        "bulges, but the pieces stay on the interlayer.",
    )
    strength: Positive | None = Field(
        default=None,
        description="Tensile stress at which the pane fails [Pa], above 0; left out: 45e6 for annealed and "
        "laminated glass, 120e6 for tempered. More holds longer.",
    )
    release: Literal["as it cracks", "all at once"] = Field(
        default="as it cracks",
        description="as it cracks (default): the pane bends until it fails, and each piece is free when "
        "its outline has closed; all at once: it is in pieces before, as in the thesis, and every piece is "
        "free when the front comes.",
    )
    frame: StrictBool = Field(
        default=True, description="Whether a frame holds its border; default true. It is drawn as bars."
    )
    bite: NotNegative = Field(
        default=0.01,
        description="How deep the border lies in the frame [m], 0 or more, less than half the pane; default "
        "0.01. More holds more splinters back.",
    )
    frame_material: Material = Field(
        default="metal", description="What the frame looks like; default metal. No part in the physics."
    )
    facade: NotNegative | None = Field(
        default=None,
        description="How far the wall around the pane goes on from its border [m], 0 or more: the reflected "
        "pressure is relieved from there. Left out: 10 with a frame, 0 without. More throws harder. Not "
        "drawn.",
    )
    drag_coefficient: NotNegative = Field(
        default=1.17,
        description="Drag coefficient of its pieces, 0 or more; default 1.17, that of a plate across the "
        "wind.",
    )
    pattern: WindowPattern = Field(default_factory=WindowPattern, description="How it breaks.")

    @model_validator(mode="after")
    def _one_shape(self) -> Window:
        given = [key for key in ("width", "height") if getattr(self, key) is not None]
        if self.outline is not None and given:
            raise ValueError(f"has both outline and {given[0]}; keep one of them")
        if self.outline is None and len(given) < 2:
            missing = "width and height" if not given else "height" if given == ["width"] else "width"
            raise ValueError(f"has no {missing}; give the size of the pane in metres, or an outline")
        if isinstance(self.outline, list) and len(self.outline) < 3:
            raise ValueError("has an outline of fewer than three points; give three or more")
        if self.frame and self.size is not None and self.bite >= min(self.size) / 2:
            raise ValueError(
                f"has a bite of {self.bite:g} m, which leaves nothing of the pane; make it less than half "
                f"the smaller side, {min(self.size) / 2:g} m"
            )
        return self

    @property
    def size(self) -> tuple[float, float] | None:
        """Width and height of the pane [m]; None where a file says it."""
        if isinstance(self.outline, list):
            across, up = zip(*self.outline, strict=True)
            return max(across) - min(across), max(up) - min(up)
        return None if self.width is None or self.height is None else (self.width, self.height)

    @property
    def limit(self) -> float:
        """Stress at which it fails [Pa]."""
        return STRENGTHS[self.glass] if self.strength is None else self.strength

    @property
    def wall_around(self) -> float:
        """How far the wall around it goes on [m]."""
        if self.facade is not None:
            return self.facade
        return FACADE if self.frame else 0.0

    def encloses(self, point: tuple[float, float, float]) -> bool:  # type: ignore[override]
        x, y, z = self.to_own_frame(point)
        if self.size is None:
            # A file says where it ends.
            return False
        width, height = self.size
        return abs(z) <= self.thickness / 2 and abs(x) <= width / 2 and abs(y) <= height / 2
