"""What the rendering process is told: one job, as JSON on its standard input."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass


@dataclass(frozen=True)
class Job:
    """One call of the renderer. Lengths in metres; vectors and matrices in Brisance's frame (Y up)."""

    usd: str
    """The file to render."""
    frames: list[int]
    """Which of its frames, in order."""
    folder: str
    """Where the pictures go, as 8-bit PNG called by the frame's number: 0000.png."""
    size: tuple[int, int]
    samples: int
    """Light paths a pixel."""
    motion_blur: bool
    """Half a frame of it."""
    cameras: list[list[list[float]]]
    """world_from_camera (4 rows of 4): one for all frames, or one a frame."""
    half_widths: list[float]
    """Tangent of half the horizontal angle of view, one a camera."""
    sun: tuple[float, float, float]
    """Unit vector towards the sun."""
    ground_prim: str | None
    """Path of the file's own ground, which is left out."""
    ground_height: float | None
    """Where the ground is [m], or None for a shot that has none."""
    focus: tuple[float, float, float]
    """Middle of the action [m]."""
    seed: int

    def to_json(self) -> str:
        """The job as one line."""
        return json.dumps(asdict(self))

    @staticmethod
    def from_json(text: str) -> Job:
        """The job from :meth:`to_json`."""
        return Job(**json.loads(text))
