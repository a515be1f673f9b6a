"""The place a shot is taken in, in Blender: sun, sky, and a ground that fades into the haze."""

from __future__ import annotations

from math import radians
from typing import Any

import bpy
import numpy as np
from mathutils import Matrix, Vector

from brisance.render.blender_nodes import Nodes, new_picture
from brisance.render.noise import fractal_noise

HAZE = (0.74, 0.74, 0.73)
"""Linear RGB of the sky at the horizon, which the distant ground turns into."""

SKY = [
    (0.0, (0.22, 0.19, 0.155)),
    (0.42, (0.46, 0.43, 0.39)),
    (0.5, HAZE),
    (0.54, (0.57, 0.65, 0.75)),
    (0.66, (0.27, 0.43, 0.70)),
    (1.0, (0.12, 0.26, 0.56)),
]
"""Linear RGB from straight down to straight up; the lower half stands in for the ground where there is
none."""

TEXELS = 1024
"""Width of the picture of the ground."""

NEAR_TILE, BROAD_TILE = 4.7, 31.0
"""What the two pictures of the ground cover [m], more in wide shots: the near one holds nothing so large that
its repeat shows."""


def build_sky(sun_direction: tuple[float, float, float]) -> None:
    """A clear day: a sun a few degrees wide, and a sky that lights the shadows.

    ``sun_direction`` is the unit vector towards the sun, Z up.
    """
    world = bpy.data.worlds.new("Sky")
    bpy.context.scene.world = world
    nodes = Nodes(world)
    place = nodes.add("ShaderNodeTexCoord", output="Generated")
    height = nodes.add("ShaderNodeSeparateXYZ", output="Z", Vector=place)
    colour = nodes.ramp(nodes.maths("MULTIPLY_ADD", height, 0.5, 0.5), SKY)
    nodes.surface(nodes.add("ShaderNodeBackground", Color=colour, Strength=1.0))
    world.cycles.sampling_method = "NONE"
    light = bpy.data.lights.new("Sun", "SUN")
    light.energy, light.angle, light.color = 5.0, radians(2.5), (1.0, 0.91, 0.79)
    lamp = bpy.data.objects.new("Sun", light)
    lamp.rotation_euler = Vector(sun_direction).to_track_quat("Z", "Y").to_euler()
    bpy.context.scene.collection.objects.link(lamp)


def build_ground(height: float, centre: tuple[float, float], size: float) -> None:
    """A plane of dry earth at a height [m], so wide that its edge is lost in the haze.

    ``size`` [m] is how far the camera stands from the action; the haze is scaled to it.
    """
    reach = 400.0 * size
    mesh = bpy.data.meshes.new("Terrain")
    corners = [(-reach, -reach, 0.0), (reach, -reach, 0.0), (reach, reach, 0.0), (-reach, reach, 0.0)]
    mesh.from_pydata(corners, [], [(0, 1, 2, 3)])
    mesh.materials.append(_earth(size))
    terrain = bpy.data.objects.new("Terrain", mesh)
    terrain.matrix_world = Matrix.Translation((*centre, height))
    bpy.context.scene.collection.objects.link(terrain)


def _earth(size: float) -> Any:
    material = bpy.data.materials.new("Earth")
    material.cycles.emission_sampling = "NONE"
    nodes = Nodes(material)
    place = nodes.add("ShaderNodeTexCoord", output="Object")
    near = nodes.picture(_earth_picture(), place, side=max(NEAR_TILE, 0.6 * size))
    relief = near.node.outputs["Alpha"]
    broad = nodes.picture(_broad_picture(), nodes.turned(place, 0.6), side=max(BROAD_TILE, 4.0 * size))
    colour = nodes.add(
        "ShaderNodeVectorMath", settings={"operation": "MULTIPLY"}, Vector=near, Vector_001=broad
    )
    soil = nodes.add("ShaderNodeBsdfDiffuse", Color=colour, Normal=nodes.bump(relief, depth=0.006))
    haze = nodes.add("ShaderNodeEmission", Color=HAZE, Strength=1.0)
    distance = nodes.add("ShaderNodeCameraData", output="View Distance")
    share = nodes.add(
        "ShaderNodeMapRange",
        settings={"interpolation_type": "SMOOTHERSTEP"},
        Value=distance,
        From_Min=size,
        From_Max=16.0 * size,
    )
    nodes.surface(nodes.add("ShaderNodeMixShader", Fac=share, Shader=soil, Shader_001=haze))
    return material


def _earth_picture() -> Any:
    """Dry earth seen from close by: its colour, and its relief as alpha."""
    patches = fractal_noise(TEXELS, slope=1.6, largest=0.1, seed=4)[..., None]
    grain = fractal_noise(TEXELS, slope=0.9, largest=0.04, seed=5)[..., None]
    dark, light = np.array((0.225, 0.188, 0.145)), np.array((0.325, 0.280, 0.224))
    colour = (dark + patches * (light - dark)) * (0.8 + 0.4 * grain)
    relief = fractal_noise(TEXELS, slope=1.45, largest=0.15, smallest=0.002, seed=6)
    return new_picture("Earth", np.dstack([colour, relief]))


def _broad_picture() -> Any:
    """What makes one stretch of ground lighter than another."""
    tone = 0.74 + 0.26 * fractal_noise(TEXELS, slope=1.55, largest=0.3, seed=7)
    return new_picture("Broad", np.dstack([tone, tone, tone, np.ones_like(tone)]))
