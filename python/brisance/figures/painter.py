"""Pictures of a simulation's pieces, lit and shadowed: quick, and clear enough for a figure."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from brisance.figures import style
from brisance.figures.raster import Raster
from brisance.render.camera import CameraPose, View, frame, looking_from
from brisance.rotation import matrix_from_quaternion

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Picture

    from brisance.piece import PieceMesh
    from brisance.result import Result

Array = NDArray[np.float64]

LIGHT = np.array([-0.4, 0.6, 0.7]) / np.linalg.norm([-0.4, 0.6, 0.7])
"""Direction to the light, in the camera's axes: from the upper left behind the viewer."""
AMBIENT = 0.55
"""Brightness of a face turned away from the light."""
SKY, GROUND, SHADOW = (
    np.array(colour) for colour in ((0.96, 0.96, 0.95), (0.89, 0.88, 0.85), (0.76, 0.74, 0.71))
)
COLOURS = {
    "brick": (0.78, 0.40, 0.29),
    "wood": (0.72, 0.53, 0.34),
    "concrete": (0.68, 0.68, 0.66),
    "metal": (0.55, 0.60, 0.66),
    "stone": (0.62, 0.58, 0.53),
    "plastic": (0.35, 0.58, 0.78),
    "glass": (0.62, 0.80, 0.82),
}
SAMPLES = 2
"""Samples along each side of a pixel."""


def equally_spaced(frames: int, count: int) -> list[int]:
    """The first of ``frames`` frames and ``count - 1`` more, as far apart as equal steps allow."""
    step = max(1, (frames - 1) // (count - 1))
    return [min(index * step, frames - 1) for index in range(count)]


def place_camera(
    result: Result, frames: list[int], view: View, *, aspect: float, close: bool = False
) -> CameraPose:
    """The nearest camera of one direction with every piece in view at all ``frames``.

    Pieces count as spheres around them, or with ``close`` as their boxes, which fits flat ones far better.
    """
    away = result.positions[0].mean(axis=0, dtype=float) - np.asarray(result.scene.charges[0].position)
    direction = looking_from(view, away)
    if close:
        corners = np.concatenate([box_corners(result, index) for index in frames])
        return frame(corners, np.zeros(len(corners)), direction, aspect=aspect, fraction=1.0)
    centres = np.asarray(result.positions[frames], dtype=float).reshape(-1, 3)
    radii = np.array([np.linalg.norm(mesh.points, axis=1).max() for mesh in result.meshes], dtype=float)
    return frame(centres, np.tile(radii, len(frames)), direction, aspect=aspect, fraction=1.0)


def box_corners(result: Result, index: int) -> Array:
    """Corners (8 n, 3) of the pieces' boxes at one frame in the world [m]."""
    ends = np.array(
        [(mesh.points.min(axis=0), mesh.points.max(axis=0)) for mesh in result.meshes], dtype=float
    )
    which = np.array(list(np.ndindex(2, 2, 2)))
    corners = ends[:, which, np.arange(3)]
    turned = np.einsum("nij,nkj->nki", _matrices(result, index), corners)
    return np.asarray((turned + result.positions[index][:, None]).reshape(-1, 3))


def _matrices(result: Result, index: int) -> Array:
    return np.array([matrix_from_quaternion(orientation) for orientation in result.orientations[index]])


def draw_frames(
    picture: Picture,
    result: Result,
    frames: list[int],
    view: View,
    *,
    rows: int,
    captions: bool = True,
    close: bool = False,
) -> None:
    """Draw ``frames`` of a result side by side in ``rows``, all seen by the same camera.

    ``close`` is that of :func:`place_camera`.
    """
    columns = len(frames) // rows
    width, height = picture.get_size_inches() * picture.dpi
    # The heading and the captions take some eighth of the height.
    panel = (int(width / columns), int(0.88 * height / rows))
    panels = picture.subplots(rows, columns, squeeze=False).ravel()
    camera = place_camera(result, frames, view, aspect=panel[0] / panel[1], close=close)
    for axes, index in zip(panels, frames, strict=True):
        axes.imshow(paint(result, index, camera, size=panel), interpolation="antialiased")
        axes.grid(False)
        axes.set_xticks([])
        axes.set_yticks([])
        for spine in axes.spines.values():
            spine.set_color(style.PALE)
        if captions:
            axes.set_title(f"{1e3 * result.times[index]:.0f} ms", loc="center", y=-0.02, va="top")


def paint(result: Result, index: int, camera: CameraPose, *, size: tuple[int, int]) -> Array:
    """All pieces at one frame, and the ground with their shadows where the camera stands above it.

    Returns the picture (height, width, 3), each colour 0 to 1, ``SAMPLES`` times ``size`` pixels each way.
    """
    raster = Raster(
        width=SAMPLES * size[0],
        height=SAMPLES * size[1],
        half_width=camera.half_width,
        half_height=camera.half_height,
    )
    raster.colour[:] = SKY
    world = world_triangles(result, index)
    draw_ground(raster, result, world, camera)
    raster.draw(*lit(result, world, camera))
    raster.outline(0.45)
    return raster.colour


def world_triangles(result: Result, index: int) -> list[Array]:
    """The surface of every piece at one frame as triangles (n, 3 corners, 3) in the world [m]."""
    poses = zip(result.meshes, result.orientations[index], result.positions[index], strict=True)
    return [
        np.asarray(mesh.points, dtype=float)[triangles(mesh)] @ matrix_from_quaternion(orientation).T
        + position
        for mesh, orientation, position in poses
    ]


def triangles(mesh: PieceMesh) -> NDArray[np.int32]:
    """Corners (n, 3) of the fans that a mesh's convex faces are cut into."""
    starts = np.cumsum(mesh.face_counts) - mesh.face_counts
    each = mesh.face_counts - 2
    first = np.repeat(starts, each)
    second = first + 1 + np.arange(len(first)) - np.repeat(np.cumsum(each) - each, each)
    return np.asarray(mesh.face_indices[np.stack([first, second, second + 1], axis=1)])


def lit(result: Result, world: list[Array], camera: CameraPose) -> tuple[Array, Array, NDArray[np.intp]]:
    """The triangles turned to the camera, in its axes (n, 3, 3), their colours (n, 3) and pieces (n,)."""
    local = (np.concatenate(world) - camera.position) @ camera.world_from_camera[:3, :3]
    pieces = np.repeat(np.arange(len(world)), [len(piece) for piece in world])
    bases = base_colours(result)[pieces]
    normal = np.cross(local[:, 1] - local[:, 0], local[:, 2] - local[:, 0])
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-30)
    front = (normal * local[:, 0]).sum(axis=1) < 0.0
    brightness = AMBIENT + (1.0 - AMBIENT) * np.clip(normal @ LIGHT, 0.0, None)
    colours = np.clip(1.15 * bases * brightness[:, None], 0.0, 1.0)
    return local[front], colours[front], pieces[front]


def draw_ground(raster: Raster, result: Result, world: list[Array], camera: CameraPose) -> None:
    """Draw the ground up to the horizon, and the pieces' shadows; nothing for a camera below the ground."""
    ground = result.scene.ground
    if ground is None or camera.position[1] <= ground.height:
        return
    world_from_camera = camera.world_from_camera[:3, :3]
    ahead = world_from_camera.T @ (-world_from_camera[:, 2] * np.array([1.0, 0.0, 1.0]))
    raster.fill_below(ahead[1] / -ahead[2], GROUND)
    light = world_from_camera @ LIGHT
    corners = np.concatenate(world)
    fallen = corners - light * ((corners[:, :, 1:2] - ground.height) / light[1])
    shadows = (fallen - camera.position) @ world_from_camera
    raster.draw(shadows, np.broadcast_to(SHADOW, (len(shadows), 3)), np.full(len(shadows), -1))


def base_colours(result: Result) -> Array:
    """A colour (n, 3) for each piece: that of its material, varied a little from piece to piece."""
    counts = [source.stop - source.start for source in result.sources]
    materials = np.repeat([COLOURS[source.material] for source in result.sources], counts, axis=0)
    tint = 1.0 + 0.07 * np.sin(12.9898 * np.arange(len(materials)))
    return np.asarray(materials * tint[:, None])
