"""From the facts of a file to a job: which motion counts, where to look from, where the sun stands."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from brisance.errors import InputError
from brisance.render.camera import VIEWS, Array, CameraPose, View, frame, looking_from
from brisance.render.job import Job
from brisance.render.stage import Stage, camera_poses

SUN = View(48.0, 35.0)
"""Where the sun stands: across the front view from its left, behind the back of the side view."""

MOVED = 0.05
"""A piece belongs to the action when it travels farther than this share of its own radius."""

REACH = 5.0
"""Debris counts up to this many times the object's own size away from where the object stood."""

FRACTION = 0.985
"""Share of the action that is always in the picture."""


def prepare(
    stage: Stage,
    *,
    frames: list[int],
    folder: Path,
    camera: str,
    size: tuple[int, int],
    samples: int,
    motion_blur: bool,
) -> Job:
    """Everything the renderer has to be told to take the shot; :class:`InputError` for an unknown camera."""
    aspect = size[0] / size[1]
    if camera in VIEWS:
        poses = [place(stage, camera, aspect)]
    elif camera.startswith("/"):
        poses = camera_poses(stage.path, camera, frames, aspect)
    else:
        raise InputError(
            f"camera: {camera} is not known; give {', '.join(VIEWS)} or the path of a camera in "
            f"{stage.path}, such as /World/Camera."
        )
    under = stage.ground is not None and poses[0].position[1] < stage.ground[1]
    middle = action(stage.centres, stage.radii, floor=_floor(stage))[0].mean(axis=0)
    sun = looking_from(SUN, blast_direction(stage))
    return Job(
        usd=str(stage.path),
        frames=frames,
        folder=str(folder),
        size=size,
        samples=samples,
        motion_blur=motion_blur,
        cameras=[pose.world_from_camera.tolist() for pose in poses],
        half_widths=[pose.half_width for pose in poses],
        sun=(float(sun[0]), float(sun[1]), float(sun[2])),
        ground_prim=stage.ground[0] if stage.ground else None,
        ground_height=stage.ground[1] if stage.ground and not under else None,
        focus=(float(middle[0]), float(middle[1]), float(middle[2])),
        seed=0,
    )


def place(stage: Stage, view: str, aspect: float) -> CameraPose:
    """The camera of one of the named views (``VIEWS``) for a picture of the given width over height."""
    centres, radii, always = action(stage.centres, stage.radii, floor=_floor(stage))
    direction = looking_from(VIEWS[view], blast_direction(stage))
    pose = frame(centres, radii, direction, aspect=aspect, fraction=FRACTION, always=always)
    if stage.ground is not None and VIEWS[view].elevation > 0.0:
        lowest = stage.ground[1] + 0.1 * float(
            np.median(np.linalg.norm(centres - centres.mean(axis=0), axis=1))
        )
        pose.world_from_camera[1, 3] = max(pose.position[1], lowest)
    return pose


def blast_direction(stage: Stage) -> Array:
    """(3,) the way from the charges to the pieces; +Z in a file without charges."""
    if not len(stage.charges):
        return np.array([0.0, 0.0, 1.0])
    return np.asarray(np.median(stage.centres[0], axis=0) - stage.charges.mean(axis=0))


def _floor(stage: Stage) -> float:
    """Height below which nothing is seen [m]."""
    return stage.ground[1] if stage.ground else -np.inf


def action(centres: Array, radii: Array, *, floor: float) -> tuple[Array, Array, NDArray[np.bool_]]:
    """The spheres a camera should frame, from (frames, pieces, 3) centres and (pieces,) radii [m].

    They are the pieces that move, and those that stand among them, at every frame that finds them within
    ``REACH`` of where they stood and not sunk below ``floor`` [m]. The third array marks the spheres of the
    first frame: the object before the blast.
    """
    start = centres[0]
    moving = np.linalg.norm(centres - start, axis=2).max(axis=0) > MOVED * radii
    if not moving.any():
        moving = np.ones(len(radii), dtype=np.bool_)
    middle = np.median(start[moving], axis=0)
    size = float(np.quantile(np.linalg.norm(start[moving] - middle, axis=1) + radii[moving], 0.95))
    standing = np.linalg.norm(start - middle, axis=1)
    involved = (moving & (standing < REACH * size)) | (standing < 1.5 * size)
    near = np.linalg.norm(centres[:, involved] - middle, axis=2) < REACH * size
    near[1:] &= centres[1:, involved, 1] > floor - radii[involved]
    first = np.zeros(near.shape, dtype=np.bool_)
    first[0] = True
    spread = np.broadcast_to(radii[involved], near.shape)
    return centres[:, involved][near], spread[near], first[near]
