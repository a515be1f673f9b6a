"""What a render has to know about a USD file beforehand: pieces, ground, charges and cameras.

Everything is returned in Brisance's own frame (right-handed, Y up, metres), whatever the file's axis and
unit.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from pxr import Gf, Sdf, Tf, Usd, UsdGeom

from brisance.errors import InputError
from brisance.render.camera import Array, CameraPose

MAX_SAMPLES = 25
"""Frames at which positions are read: enough to frame an action, few enough for thousands of pieces."""

GROUND_NAME = "Ground"
"""Name of the prim that stands for the ground plane."""


@dataclass(frozen=True, eq=False)
class Stage:
    """The facts of one USD file."""

    path: Path
    start: int
    end: int
    frame_rate: float
    """Frames per second of scene time [1/s]."""
    centres: Array
    """(samples, pieces, 3) middle of each piece's bounding box [m], at even steps, first frame to last."""
    radii: Array
    """(pieces,) radius of the sphere about that box [m]."""
    ground: tuple[str, float] | None
    """Path and height [m] of the ground plane, if the file has one."""
    charges: Array
    """(charges, 3) where the charges are [m]; may be empty."""

    @property
    def frames(self) -> range:
        """Every frame of the file."""
        return range(self.start, self.end + 1)


def read_stage(path: Path) -> Stage:
    """Read the facts of a USD file; :class:`InputError` where it is missing, unreadable or shows nothing."""
    stage = open_stage(path)
    home = _home_from_stage(stage)
    start, end = round(stage.GetStartTimeCode()), round(stage.GetEndTimeCode())
    end = max(start, end)
    times = np.unique(np.linspace(start, end, min(MAX_SAMPLES, end - start + 1)).round())
    ground = _ground(stage, home)
    pieces = _Pieces(stage, home, skip=ground[0] if ground else None)
    if not len(pieces.radii):
        raise InputError(
            f"{path} shows no mesh, so there is nothing to render; give a file written by brisance run."
        )
    centres = np.stack([pieces.centres(Usd.TimeCode(float(time))) for time in times])
    return Stage(
        path, start, end, stage.GetTimeCodesPerSecond(), centres, pieces.radii, ground, _charges(stage, home)
    )


def open_stage(path: Path) -> Usd.Stage:
    """Open a USD file, or say in one sentence why it cannot be opened."""
    if not path.exists():
        raise InputError(f"{path} does not exist; give a USD file written by brisance run.")
    if path.is_dir():
        raise InputError(f"{path} is a directory; give a USD file written by brisance run.")
    try:
        return Usd.Stage.Open(str(path))
    except Tf.ErrorException as error:
        raise InputError(
            f"{path} is not a USD file that can be read; give one written by brisance run."
        ) from error


def camera_poses(path: Path, prim_path: str, frames: list[int], aspect: float) -> list[CameraPose]:
    """The poses [m] of a camera prim of the file at the given frames; one only when it stands still.

    The picture keeps the camera's horizontal angle; ``aspect`` (width over height) gives the vertical one.
    """
    stage = open_stage(path)
    prim = stage.GetPrimAtPath(prim_path) if _is_path(prim_path) else None
    if not prim or not prim.IsA(UsdGeom.Camera):
        found = [str(item.GetPath()) for item in stage.Traverse() if item.IsA(UsdGeom.Camera)]
        known = f"; its cameras are {', '.join(found[:5])}" if found else "; it holds no camera"
        raise InputError(
            f"camera: {prim_path} is no camera in {path}{known}; use front, side, below or a camera's path."
        )
    home = _home_from_stage(stage)
    poses = [_camera_pose(UsdGeom.Camera(prim), home, frame, aspect) for frame in frames]
    same = all(
        np.array_equal(pose.world_from_camera, poses[0].world_from_camera)
        and pose.half_width == poses[0].half_width
        for pose in poses
    )
    return poses[:1] if same else poses


def _is_path(text: str) -> bool:
    return bool(Sdf.Path.IsValidPathString(text)) and text.startswith("/")


def _camera_pose(camera: UsdGeom.Camera, home: Array, frame: int, aspect: float) -> CameraPose:
    lens = camera.GetCamera(Usd.TimeCode(frame))
    world = home @ _matrix(lens.transform)
    axes = world[:3, :3] / np.linalg.norm(world[:3, :3], axis=0)
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = axes, world[:3, 3]
    half_width = lens.horizontalAperture / (2.0 * lens.focalLength)
    return CameraPose(pose, half_width, half_width / aspect)


def _home_from_stage(stage: Usd.Stage) -> Array:
    """(4, 4) from the file's own frame to Y up and metres."""
    home = np.eye(4)
    if UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.z:
        home[:3, :3] = [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]
    home[:3, :3] *= UsdGeom.GetStageMetersPerUnit(stage)
    return home


def _matrix(matrix: Gf.Matrix4d) -> Array:
    """A USD matrix (row vectors) as one that acts on column vectors."""
    return np.array(matrix, dtype=np.float64).T


class _Pieces:
    """The meshes and instances of a stage, each as a sphere."""

    def __init__(self, stage: Usd.Stage, home: Array, *, skip: str | None) -> None:
        self._home = home
        self._bounds = UsdGeom.BBoxCache(Usd.TimeCode.EarliestTime(), [UsdGeom.Tokens.default_])
        self._meshes: list[tuple[Usd.Prim, Array]] = []
        self._instancers: list[tuple[UsdGeom.PointInstancer, Array]] = []
        radii: list[float] = []
        walk = iter(Usd.PrimRange.Stage(stage, Usd.TraverseInstanceProxies()))
        for prim in walk:
            if not _is_shown(prim) or str(prim.GetPath()) == skip:
                walk.PruneChildren()
            elif prim.IsA(UsdGeom.PointInstancer):
                walk.PruneChildren()
                radii += self._add_instancer(UsdGeom.PointInstancer(prim))
            elif prim.IsA(UsdGeom.Gprim):
                centre, radius = self._sphere(prim)
                self._meshes.append((prim, centre))
                radii.append(radius)
        self.radii: Array = np.array(radii, dtype=np.float64)

    def centres(self, time: Usd.TimeCode) -> Array:
        """(pieces, 3) middle of each piece [m] at a time."""
        cache = UsdGeom.XformCache(time)
        rows = [_matrix(cache.GetLocalToWorldTransform(prim)) @ centre for prim, centre in self._meshes]
        parts = [np.array(rows).reshape(-1, 4)]
        for instancer, middles in self._instancers:
            world = _matrix(cache.GetLocalToWorldTransform(instancer.GetPrim()))
            poses = np.array(instancer.ComputeInstanceTransformsAtTime(time, time), dtype=np.float64)
            parts.append(np.einsum("nji,nj->ni", poses.reshape(-1, 4, 4), middles) @ world.T)
        return np.asarray((np.concatenate(parts) @ self._home.T)[:, :3])

    def _sphere(self, prim: Usd.Prim) -> tuple[Array, float]:
        """Middle (homogeneous, in the prim's own frame) and radius [m] of a prim's bounding box."""
        box = self._bounds.ComputeUntransformedBound(prim).ComputeAlignedRange()
        scale = float(np.cbrt(abs(np.linalg.det(self._home[:3, :3]))))
        return np.array([*box.GetMidpoint(), 1.0]), 0.5 * scale * float(np.linalg.norm(box.GetSize()))

    def _add_instancer(self, instancer: UsdGeom.PointInstancer) -> list[float]:
        stage = instancer.GetPrim().GetStage()
        targets = instancer.GetPrototypesRel().GetForwardedTargets()
        spheres = [self._sphere(stage.GetPrimAtPath(target)) for target in targets]
        indices = np.array(instancer.GetProtoIndicesAttr().Get(Usd.TimeCode.EarliestTime()), dtype=np.int64)
        self._instancers.append(
            (instancer, np.array([spheres[index][0] for index in indices]).reshape(-1, 4))
        )
        return [spheres[index][1] for index in indices]


def _is_shown(prim: Usd.Prim) -> bool:
    """Whether a prim is of a purpose that is rendered, and not hidden; one without geometry always is."""
    imageable = UsdGeom.Imageable(prim)
    if not imageable or prim.IsPseudoRoot():
        return True
    hidden = imageable.ComputeVisibility() == UsdGeom.Tokens.invisible
    return not hidden and imageable.ComputePurpose() in (UsdGeom.Tokens.default_, UsdGeom.Tokens.render)


def _ground(stage: Usd.Stage, home: Array) -> tuple[str, float] | None:
    """Path and height of the ground: the prim of that name directly under the default prim."""
    root = stage.GetDefaultPrim() or stage.GetPseudoRoot()
    prim = root.GetChild(GROUND_NAME)
    if not prim or not prim.IsA(UsdGeom.Boundable):
        return None
    bounds = UsdGeom.BBoxCache(Usd.TimeCode.EarliestTime(), UsdGeom.Imageable.GetOrderedPurposeTokens())
    box = bounds.ComputeWorldBound(prim).ComputeAlignedRange()
    return str(prim.GetPath()), float((home @ np.array([*box.GetMax(), 1.0]))[1])


def _charges(stage: Usd.Stage, home: Array) -> Array:
    """(charges, 3) positions of the guide prims named after a charge."""
    cache = UsdGeom.XformCache(Usd.TimeCode.EarliestTime())
    found = [
        _matrix(cache.GetLocalToWorldTransform(prim))[:, 3] for prim in stage.Traverse() if _is_charge(prim)
    ]
    return np.asarray((np.array(found, dtype=np.float64).reshape(-1, 4) @ home.T)[:, :3])


def _is_charge(prim: Usd.Prim) -> bool:
    imageable = UsdGeom.Imageable(prim)
    return (
        bool(imageable)
        and prim.IsA(UsdGeom.Gprim)
        and "charge" in prim.GetName().lower()
        and imageable.ComputePurpose() == UsdGeom.Tokens.guide
    )
