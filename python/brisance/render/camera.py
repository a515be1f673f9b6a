"""Where a camera has to stand so that the action stays in the picture: plain geometry, no renderer.

The pieces of a shot are spheres at every frame. A camera of known direction and lens sees a pyramid; moving
the camera moves the pyramid but does not turn it, so each of its four sides asks for one linear inequality a
sphere, and the nearest position that satisfies them all is found in closed form. Outliers are left out by
taking a quantile of each side's inequality instead of its extreme, which bounds the share of spheres left
outside.

Right-handed, Y up, metres. A camera looks along its own -Z with +Y upwards, as in USD and in Blender.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import tan

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

FIELD_OF_VIEW = np.radians(34.0)
"""Horizontal angle of the placed cameras [rad]: a longish lens, which keeps bricks upright."""

MARGIN = 0.04
"""Share of the picture's width and height that is kept free around the action."""


@dataclass(frozen=True, eq=False)
class CameraPose:
    """A camera standing still: where it is, how it is turned, and the half angles it sees."""

    world_from_camera: Array
    """(4, 4) rigid transform acting on column vectors: columns right, up, backwards, position [m]."""
    half_width: float
    """Tangent of half the horizontal angle of view."""
    half_height: float
    """Tangent of half the vertical angle of view."""

    @property
    def position(self) -> Array:
        """(3,) where it stands [m]."""
        return self.world_from_camera[:3, 3]

    def inside(self, centres: Array, radii: Array) -> NDArray[np.bool_]:
        """Which spheres (n, 3) of radii (n,) [m] lie wholly in the picture."""
        local = (centres - self.position) @ self.world_from_camera[:3, :3]
        depth = -local[:, 2]
        across = depth * self.half_width - np.abs(local[:, 0]) - radii * np.hypot(1.0, self.half_width)
        upwards = depth * self.half_height - np.abs(local[:, 1]) - radii * np.hypot(1.0, self.half_height)
        return np.asarray((np.minimum(across, upwards) >= -1e-9) & (depth > 0.0))


@dataclass(frozen=True)
class View:
    """A direction to look from, relative to the way the blast travels."""

    azimuth: float
    """Turn away from the blast's own direction, positive to the left of one who faces the charge
    [degrees]."""
    elevation: float
    """Height of the camera above the middle of the action, negative below it [degrees]."""


VIEWS = {"front": View(-22.0, 7.0), "side": View(78.0, 5.0), "below": View(-14.0, -42.0)}
"""The named cameras: debris comes towards ``front``, crosses ``side``, and passes over ``below``."""


def looking_from(view: View, away: Array) -> Array:
    """Unit vector from the action to the camera.

    ``away`` (3,) is the way the blast travels, of which only the horizontal part counts (+Z when it has
    none).
    """
    flat = np.array([away[0], 0.0, away[2]])
    length = float(np.linalg.norm(flat))
    forward = flat / length if length > 1e-9 else np.array([0.0, 0.0, 1.0])
    left = np.array([-forward[2], 0.0, forward[0]])
    turn, rise = np.radians(view.azimuth), np.radians(view.elevation)
    level = np.cos(turn) * forward + np.sin(turn) * left
    return np.asarray(np.cos(rise) * level + np.array([0.0, np.sin(rise), 0.0]))


def frame(
    centres: Array,
    radii: Array,
    direction: Array,
    *,
    aspect: float,
    fraction: float = 0.95,
    always: NDArray[np.bool_] | None = None,
    field_of_view: float = FIELD_OF_VIEW,
) -> CameraPose:
    """The nearest camera that has the spheres in view, looking from ``direction`` (unit vector towards it).

    ``centres`` (n, 3) and ``radii`` (n,) [m], n at least 1; ``aspect`` is width over height. At least
    ``fraction`` of the spheres end wholly inside the picture, and every one marked in ``always``. The picture
    is centred on them.
    """
    axes = _axes(direction)
    local = centres @ axes
    half_width = tan(field_of_view / 2.0)
    half_height = half_width / aspect
    left_out = (1.0 - fraction) / 4.0
    kept = np.zeros(len(centres), dtype=bool) if always is None else always
    clear = 1.0 - MARGIN
    x_axis = _fit(local[:, 0], local[:, 2], radii, clear * half_width, left_out, kept)
    y_axis = _fit(local[:, 1], local[:, 2], radii, clear * half_height, left_out, kept)
    pose = np.eye(4)
    pose[:3, :3] = axes
    pose[:3, 3] = axes @ np.array([x_axis[0], y_axis[0], max(x_axis[1], y_axis[1])])
    return CameraPose(pose, half_width, half_height)


def _axes(direction: Array) -> Array:
    """Columns right, up, backwards of a camera whose backwards is ``direction``; it never rolls."""
    backwards = direction / np.linalg.norm(direction)
    up = (
        np.array([0.0, 1.0, 0.0])
        if abs(backwards[1]) < 0.999
        else np.array([0.0, 0.0, -np.sign(backwards[1])])
    )
    right = np.cross(up, backwards)
    right /= np.linalg.norm(right)
    return np.column_stack([right, np.cross(backwards, right), backwards])


def _fit(
    across: Array, back: Array, radii: Array, half: float, left_out: float, kept: NDArray[np.bool_]
) -> tuple[float, float]:
    """Camera coordinates (across, back) at which two opposite sides of the pyramid hold the spheres.

    A camera at (a, b) has a sphere within its right side if (b - back) half - (across - a) >= radius / cos,
    which bounds b half + a from below; its left side bounds b half - a. Both bounds are met with equality.
    """
    margin = radii * np.hypot(1.0, half)
    right = back * half + across + margin
    left = back * half - across + margin
    need_right, need_left = (_bound(side, left_out, kept) for side in (right, left))
    return (need_right - need_left) / 2.0, (need_right + need_left) / (2.0 * half)


def _bound(values: Array, left_out: float, kept: NDArray[np.bool_]) -> float:
    """The value that all but a share ``left_out``, and all ``kept``, do not exceed."""
    ordered = np.sort(values)
    bound = float(ordered[len(ordered) - 1 - int(left_out * len(ordered))])
    return max(bound, float(values[kept].max())) if kept.any() else bound
