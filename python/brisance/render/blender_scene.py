"""A shot in Blender: the file as its importer brings it in, dressed, lit, and rendered frame by frame.

Blender is Z up, so every place of the job is turned on the way in.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import atan
from pathlib import Path
from typing import Any

import bpy
from mathutils import Matrix, Vector

from brisance.render.blender_looks import dress
from brisance.render.blender_set import build_ground, build_sky
from brisance.render.job import Job

MOST_ROUNDED = 3000
"""Files of up to this many meshes get their edges rounded."""

ROUND_LIMIT = 0.01
"""Radius of a rounded edge [m]: a twenty-fifth of the piece's thinnest side, and this at most."""


def take(job: Job) -> Iterator[tuple[int, str]]:
    """Render the job; yields each frame's number and file when it is written."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    _import(job)
    dress(bpy.data.materials)
    _soften([thing for thing in bpy.data.objects if thing.type == "MESH"])
    _build_set(job)
    _set_up_picture(scene.render, job)
    _set_up_cycles(scene.cycles, job)
    scene.view_settings.view_transform, scene.view_settings.look = "AgX", "AgX - Medium High Contrast"
    camera = _camera(scene)
    for index, frame in enumerate(job.frames):
        scene.frame_set(frame)
        _aim(camera, job, index)
        scene.render.filepath = str(Path(job.folder, f"{frame:04d}.png"))
        bpy.ops.render.render(write_still=True)
        yield frame, scene.render.filepath


def _import(job: Job) -> None:
    """Bring the file in as a user would, without its lamps, cameras, guides and ground."""
    result = bpy.ops.wm.usd_import(
        filepath=job.usd,
        import_cameras=False,
        import_lights=False,
        import_guide=False,
        import_proxy=False,
        create_world_material=False,
    )
    if "FINISHED" not in result:
        raise RuntimeError("Blender could not import it")
    if job.ground_prim is not None:
        ground = bpy.data.objects.get(job.ground_prim.rsplit("/", 1)[-1])
        if ground is not None:
            bpy.data.objects.remove(ground)


def _soften(solids: list[Any]) -> None:
    """Treat meshes as rigid, and round their edges if there are not too many: worn edges catch the light."""
    for solid in solids:
        solid.cycles.use_deform_motion = False
    if len(solids) > MOST_ROUNDED:
        return
    for solid in solids:
        bevel = solid.modifiers.new("Wear", "BEVEL")
        bevel.width = min(0.04 * min(solid.dimensions), ROUND_LIMIT)
        bevel.segments, bevel.limit_method, bevel.harden_normals = 2, "ANGLE", True
        solid.data.shade_smooth()


def _build_set(job: Job) -> None:
    build_sky(_turned(job.sun))
    if job.ground_height is not None:
        eye, focus = (Vector(_turned(place)) for place in (_position(job.cameras[0]), job.focus))
        build_ground(job.ground_height, (focus.x, focus.y), (eye - focus).length)


def _set_up_picture(render: Any, job: Job) -> None:
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y, render.resolution_percentage = *job.size, 100
    render.image_settings.file_format, render.image_settings.color_mode = "PNG", "RGB"
    render.image_settings.compression = 15
    for stamp in (
        "date",
        "time",
        "render_time",
        "memory",
        "hostname",
        "filename",
        "frame",
        "camera",
        "scene",
    ):
        setattr(render, f"use_stamp_{stamp}", False)
    render.use_persistent_data = True
    render.use_motion_blur, render.motion_blur_shutter = job.motion_blur, 0.5


def _set_up_cycles(cycles: Any, job: Job) -> None:
    """Few paths and a denoiser, on the processor.

    The denoiser's own clean-up of its guides (``ACCURATE``) gives smoother edges at 2 paths a pixel than 16
    paths do without it, for a quarter of the time.
    """
    cycles.device = "CPU"
    cycles.samples, cycles.use_adaptive_sampling, cycles.seed = job.samples, False, job.seed
    cycles.use_denoising, cycles.denoiser = True, "OPENIMAGEDENOISE"
    cycles.denoising_prefilter, cycles.denoising_quality = "ACCURATE", "BALANCED"
    cycles.max_bounces, cycles.diffuse_bounces, cycles.glossy_bounces = 6, 2, 2
    # A ray through a cloud of shards enters and leaves many of them.
    cycles.transparent_max_bounces = 64
    cycles.caustics_reflective = cycles.caustics_refractive = False


def _camera(scene: Any) -> Any:
    lens = bpy.data.cameras.new("Camera")
    lens.sensor_fit, lens.clip_start, lens.clip_end = "HORIZONTAL", 0.01, 1e5
    camera = bpy.data.objects.new("Camera", lens)
    scene.collection.objects.link(camera)
    scene.camera = camera
    return camera


def _aim(camera: Any, job: Job, index: int) -> None:
    """Put the camera where the job has it at a frame."""
    index = index if len(job.cameras) > 1 else 0
    right, up, back, place = zip(*job.cameras[index][:3], strict=True)
    rows = zip(_turned(right), _turned(up), _turned(back), _turned(place), strict=True)
    camera.matrix_world = Matrix([*rows, (0.0, 0.0, 0.0, 1.0)])
    camera.data.angle = 2.0 * atan(job.half_widths[index])


def _turned(vector: Any) -> tuple[float, float, float]:
    """A Y-up vector in Blender's Z-up frame."""
    return vector[0], -vector[2], vector[1]


def _position(world_from_camera: list[list[float]]) -> tuple[float, float, float]:
    return world_from_camera[0][3], world_from_camera[1][3], world_from_camera[2][3]
