"""What an eye would find wrong with bodies that lie still: they jitter, sink, float, pop or overlap.

Everything is measured on the recorded poses of the true meshes, not on what the contact engine believes.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from manifold3d import Manifold, Mesh
from numpy.typing import NDArray

import brisance as br
from brisance.rotation import rotate

QUIET = 1.0
"""A body that has kept its place for so long [s] seems to be at rest."""
STILL = 1e-3
"""Motion of any of its points within this is keeping its place [m]."""

BEVELLED_BOX = (24, 26)
"""Corners and faces of a box with bevelled edges."""

DIRECTIONS = np.array([way for way in np.ndindex(3, 3, 3) if way > (1, 1, 1)]) - 1.0
"""Half of the 26 directions to the neighbours in a cubic lattice."""


@dataclass(frozen=True)
class Fault:
    """One thing that one body does wrong."""

    kind: str
    """jitters, pops, sinks, floats or overlaps."""
    body: str
    time_s: float
    size: float
    """How much of it: [m], or [m/s] for a body that pops."""

    def __str__(self) -> str:
        return f"{self.body} {self.kind} at {self.time_s:.2f} s: {self.size:.4g}"


def faults(result: br.Result, tolerance: float = 1e-3, overlap: float = 2e-3) -> list[Fault]:
    """All faults of the bodies of a run that lasts until rest, worse than a tolerance [m]."""
    found = [*_restless(result, tolerance), *_sunk(result, tolerance)]
    return [*found, *_at_the_end(result, tolerance, overlap)]


def lowest(result: br.Result, index: int) -> NDArray[np.float64]:
    """(F,) height of the lowest point of a body in each frame [m]."""
    points = outline(result, index)
    w, x, y, z = np.moveaxis(result.orientations[:, index].astype(np.float64), -1, 0)
    # The second row of the rotation matrix: what each of a point's coordinates gives to its height.
    row = np.stack([2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)], axis=-1)
    return (row @ points.T).min(axis=1) + result.positions[:, index, 1]


def outline(result: br.Result, index: int) -> NDArray[np.float64]:
    """(n, 3) the corners of a body about its centre of mass [m]; of a bevelled box, those of the whole box.

    Where a brick stands on another's edge, its drawn bevel leaves a slit of up to 3 mm; it is not counted.
    """
    mesh = result.meshes[index]
    points = mesh.points.astype(np.float64)
    if (len(points), len(mesh.face_counts)) != BEVELLED_BOX:
        return points
    low, high = points.min(axis=0), points.max(axis=0)
    return np.where(np.indices((2, 2, 2)).reshape(3, -1).T, high, low)


def strides(result: br.Result, index: int) -> NDArray[np.float64]:
    """(F - 1, 4, 3) how a body's middle and three points about it move from frame to frame [m]."""
    points = outline(result, index)
    reach = np.linalg.norm(points, axis=1).max()
    marks = np.vstack([np.zeros(3), reach * np.eye(3)])
    w, v = (
        result.orientations[:, index, :1].astype(np.float64),
        result.orientations[:, index, 1:].astype(np.float64),
    )
    twice = 2.0 * np.cross(v[:, None], marks[None])
    turned = marks + w[:, None] * twice + np.cross(v[:, None], twice)
    return np.diff(turned + result.positions[:, index, None].astype(np.float64), axis=0)


def _restless(result: br.Result, tolerance: float) -> Iterator[Fault]:
    """Bodies that seem to rest and then shake or jump, though no front comes and nothing near them moves."""
    every = np.stack([strides(result, index) for index in range(len(result.bodies))], axis=1)
    way = np.linalg.norm(every, axis=-1).max(axis=-1)
    frames = round(QUIET * result.frame_rate)
    for index, name in enumerate(result.bodies.names):
        moved = np.flatnonzero(way[:, index] > STILL)
        if not len(moved) or len(way) - moved[0] < frames:
            continue
        # Forth and back from one frame to the next, while the body as a whole goes nowhere.
        steps = every[:, index]
        back = np.einsum("fpi,fpi->fp", steps[1:], steps[:-1]) < 0.0
        shake = (np.minimum(*(np.linalg.norm(s, axis=-1) for s in (steps[1:], steps[:-1]))) * back).max(
            axis=-1
        )
        for frame in np.flatnonzero(shake > tolerance):
            around = steps[max(frame - frames, 0) : frame].sum(axis=0)
            if frame >= frames and np.abs(around).max() < 2 * STILL:
                yield Fault("jitters", name, result.times[frame + 1], float(shake[frame]))
        up = steps[:, 0, 1] * result.frame_rate
        for frame in np.flatnonzero(up > 0.1):
            calm = frame >= frames and way[frame - frames : frame, index].max() < STILL
            if calm and not _disturbed(result, way, index, frame):
                yield Fault("pops", name, result.times[frame + 1], float(up[frame]))


def _disturbed(result: br.Result, way: NDArray[np.float64], index: int, frame: int) -> bool:
    """Whether something came near a body in the last two frames: another body in motion, or a front."""
    window = slice(max(frame - 2, 0), frame + 1)
    size = np.array([np.linalg.norm(mesh.points, axis=1).max() for mesh in result.meshes])
    apart = np.linalg.norm(result.positions[frame] - result.positions[frame, index], axis=1)
    near = apart < size + size[index] + 0.05
    near[index] = False
    fast = way[window].max(axis=0) > 2 * STILL
    loud = any(0.0 <= result.times[frame] - charge.time < 0.5 for charge in result.scene.charges)
    return bool((near & fast).any()) or loud


def _sunk(result: br.Result, tolerance: float) -> Iterator[Fault]:
    """Bodies that are in the ground by more than the tolerance while they lie still."""
    if result.scene.ground is None:
        return
    for index, name in enumerate(result.bodies.names):
        depth = result.scene.ground.height - lowest(result, index)
        still = np.linalg.norm(strides(result, index), axis=-1).max(axis=-1) < 0.1 * STILL
        deep = np.flatnonzero(still & (depth[1:] > tolerance))
        if len(deep):
            worst = deep[depth[1:][deep].argmax()]
            yield Fault("sinks", name, result.times[worst + 1], float(depth[worst + 1]))


def _at_the_end(result: br.Result, tolerance: float, overlap: float) -> Iterator[Fault]:
    """Bodies that end in the air or in another one. Those that never moved are where the scene put them."""
    ground = -np.inf if result.scene.ground is None else result.scene.ground.height
    solids = [_solid(result, index) for index in range(len(result.bodies))]
    boxes = np.array([solid.bounding_box() for solid in solids])
    moved = np.linalg.norm(result.positions[-1] - result.positions[0], axis=1) > STILL
    for index in np.flatnonzero(moved):
        low, high = boxes[index, :3] - 0.005, boxes[index, 3:] + 0.005
        others = np.flatnonzero(((boxes[:, :3] < high) & (boxes[:, 3:] > low)).all(axis=1))
        gap = boxes[index, 1] - ground
        for other in others[others != index]:
            gap = min(gap, solids[index].min_gap(solids[other], 0.005))
            common = solids[index] ^ solids[other]
            if (
                other < index
                and not common.is_empty()
                and (depth := _depth(solids[index], solids[other], common, overlap))
            ):
                names = f"{result.bodies.names[index]} and {result.bodies.names[other]}"
                yield Fault("overlaps", names, result.times[-1], depth)
        if gap > tolerance:
            yield Fault("floats", result.bodies.names[index], result.times[-1], float(gap))


def _solid(result: br.Result, index: int) -> Manifold:
    mesh = result.meshes[index]
    turn = result.orientations[-1, index].astype(np.float64)
    points = rotate(turn, outline(result, index)) + result.positions[-1, index]
    if len(points) == 8:
        return Manifold.hull_points(points.astype(np.float32))
    corners, merged = np.unique(points.astype(np.float32), axis=0, return_inverse=True)
    faces = np.split(merged.reshape(-1)[mesh.face_indices], np.cumsum(mesh.face_counts)[:-1])
    # Faces with more than three corners are convex here.
    fans = [(face[0], face[k], face[k + 1]) for face in faces for k in range(1, len(face) - 1)]
    triangles = np.array([fan for fan in fans if len(set(fan)) == 3], dtype=np.uint32)
    return Manifold(Mesh(corners, triangles))


def _depth(one: Manifold, other: Manifold, common: Manifold, least: float) -> float:
    """How far a body must be moved to be out of another one [m]: 0 if ``least`` is enough."""
    points = np.asarray(common.to_mesh().vert_properties)[:, :3].astype(np.float64)
    ways = np.vstack([DIRECTIONS, np.linalg.svd(points - points.mean(axis=0), full_matrices=False)[2]])
    ways = np.vstack([ways, -ways]) / np.linalg.norm(np.vstack([ways, ways]), axis=1)[:, None]
    depth = least
    while True:
        left = min((one.translate(tuple(depth * way)) ^ other).volume() for way in ways)
        if left < 0.01 * common.volume():
            return 0.0 if depth == least else depth
        depth *= 1.25
