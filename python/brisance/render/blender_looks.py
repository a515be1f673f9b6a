"""What things are made of, in Blender: procedural materials for the names a scene file knows.

No image is read: colour varies from piece to piece by a number that Blender draws from the piece's name, and
within a piece by noise in its own frame, so that the pattern travels with it and pieces that share a mesh
still differ.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from brisance.render.blender_nodes import Nodes, new_picture
from brisance.render.noise import fractal_noise

Colour = tuple[float, float, float]

TEXELS = 512
"""Width of the noise picture."""

PICTURE_SIDE = 0.5
"""What the noise picture covers [m]."""

STRIDES = {"X": 61.7, "Y": 173.3, "Z": 317.9}
"""From one piece to the next the pattern is moved by up to these [m], far more than it is wide."""


@dataclass(frozen=True)
class Look:
    """A rough solid. Colours are linear RGB."""

    colours: tuple[Colour, ...]
    """From one piece to the next the colour runs through these."""
    stain: Colour
    """Colour of the patches on a piece."""
    stained: float
    """How much of that colour shows, 0..1."""
    roughness: float
    bump: float
    """Depth of the surface's relief [m]."""
    metallic: float = 0.0
    stretch: Colour = (1.0, 1.0, 1.0)
    """How dense the pattern is along each axis: unequal numbers make a grain."""


LOOKS = {
    "brick": Look(
        ((0.130, 0.034, 0.020), (0.235, 0.062, 0.032), (0.290, 0.088, 0.045), (0.370, 0.150, 0.082)),
        stain=(0.40, 0.27, 0.19),
        stained=0.30,
        roughness=0.9,
        bump=0.0022,
    ),
    "wood": Look(
        ((0.22, 0.11, 0.045), (0.34, 0.19, 0.085), (0.42, 0.26, 0.13)),
        stain=(0.12, 0.055, 0.022),
        stained=0.6,
        roughness=0.65,
        bump=0.0005,
        stretch=(0.08, 1.6, 1.6),
    ),
    "concrete": Look(
        ((0.30, 0.29, 0.27), (0.38, 0.37, 0.35)),
        stain=(0.21, 0.20, 0.185),
        stained=0.35,
        roughness=0.9,
        bump=0.0006,
        stretch=(0.3, 0.3, 0.3),
    ),
    "stone": Look(
        ((0.21, 0.19, 0.165), (0.32, 0.30, 0.265), (0.25, 0.25, 0.245)),
        stain=(0.12, 0.11, 0.10),
        stained=0.6,
        roughness=0.85,
        bump=0.002,
    ),
    "metal": Look(
        ((0.36, 0.37, 0.39), (0.46, 0.46, 0.47)),
        stain=(0.22, 0.15, 0.11),
        stained=0.2,
        roughness=0.38,
        bump=0.00004,
        metallic=1.0,
    ),
    "plastic": Look(
        ((0.045, 0.11, 0.23), (0.055, 0.135, 0.27)),
        stain=(0.035, 0.085, 0.18),
        stained=0.2,
        roughness=0.35,
        bump=0.00003,
    ),
}
"""The rough materials by name; glass is a case of its own."""


def dress(materials: Any) -> None:
    """Give materials whose names hold a known word the look of that word; others stay as they are."""
    noise = noise_picture()
    for material in materials:
        name = material.name.lower()
        if "glass" in name:
            (_broken_glass if "broken" in name else _glass)(material)
            continue
        look = next((look for word, look in LOOKS.items() if word in name), None)
        if look is not None:
            _solid(material, look, noise)


def noise_picture() -> Any:
    """A tile of three noises: patches in red, grain in green, relief in blue."""
    patches = fractal_noise(TEXELS, slope=1.9, largest=0.5, smallest=0.004, seed=1)
    grain = fractal_noise(TEXELS, slope=1.15, largest=0.12, smallest=0.003, seed=2)
    relief = fractal_noise(TEXELS, slope=1.5, largest=0.16, smallest=0.004, seed=3)
    return new_picture("Noise", np.dstack([patches, grain, relief, np.ones_like(relief)]))


def _solid(material: Any, look: Look, noise: Any) -> None:
    nodes = Nodes(material)
    place, chance = _place(nodes, look.stretch)
    last = len(look.colours) - 1
    base = nodes.ramp(chance, [(index / last, colour) for index, colour in enumerate(look.colours)])
    coarse, fine, relief = nodes.channels(nodes.picture(noise, place, side=PICTURE_SIDE, boxed=True))
    patches = nodes.maths("MULTIPLY", _step(nodes, coarse, 0.5, 1.0), look.stained)
    colour = nodes.mix(patches, base, look.stain)
    grain = nodes.maths("ADD", nodes.maths("MULTIPLY", fine, 0.4), 0.8)
    colour = nodes.add("ShaderNodeHueSaturation", Color=colour, Value=grain)
    nodes.surface(
        nodes.add(
            "ShaderNodeBsdfPrincipled",
            Base_Color=colour,
            Roughness=look.roughness,
            Metallic=look.metallic,
            Specular_IOR_Level=0.25,
            Normal=nodes.bump(relief, depth=look.bump),
        )
    )


def _glass(material: Any) -> None:
    """Thin clear glass: what lies behind shows straight through, and only grazing rays are mirrored.

    Rays are not bent, so one that leaves would be mirrored inside again and again and come out black: only
    the side on which it enters mirrors.
    """
    nodes = Nodes(material)
    clear = nodes.add("ShaderNodeBsdfTransparent", Color=(0.93, 0.965, 0.95))
    nodes.surface(_mirrored(nodes, clear))


def _broken_glass(material: Any) -> None:
    """A cut through glass: seen along the pane it is green, and lit up by what runs inside the pane."""
    nodes = Nodes(material)
    through = nodes.add("ShaderNodeBsdfTransparent", Color=(0.74, 0.90, 0.84))
    glow = nodes.add("ShaderNodeBsdfTranslucent", Color=(0.62, 0.84, 0.77))
    nodes.surface(
        _mirrored(nodes, nodes.add("ShaderNodeMixShader", Fac=0.5, Shader=through, Shader_001=glow))
    )


def _mirrored(nodes: Nodes, body: Any) -> Any:
    mirror = nodes.add("ShaderNodeBsdfGlossy", Color=(1.0, 1.0, 1.0), Roughness=0.02)
    outside = nodes.maths("SUBTRACT", 1.0, nodes.add("ShaderNodeNewGeometry", output="Backfacing"))
    fresnel = nodes.maths("MULTIPLY", nodes.add("ShaderNodeFresnel", IOR=1.5), outside)
    return nodes.add("ShaderNodeMixShader", Fac=fresnel, Shader=body, Shader_001=mirror)


def _place(nodes: Nodes, stretch: Colour) -> tuple[Any, Any]:
    """A point in the piece's own frame [m], moved for each piece, and the piece's number in 0..1."""
    own = nodes.add("ShaderNodeTexCoord", output="Object")
    chance = nodes.add("ShaderNodeObjectInfo", output="Random")
    shift = {axis: nodes.maths("MULTIPLY", chance, stride) for axis, stride in STRIDES.items()}
    moved = nodes.add(
        "ShaderNodeMapping", Vector=own, Scale=stretch, Location=nodes.add("ShaderNodeCombineXYZ", **shift)
    )
    return moved, chance


def _step(nodes: Nodes, value: Any, low: float, high: float) -> Any:
    """0 below ``low``, 1 above ``high``, smooth between."""
    return nodes.add(
        "ShaderNodeMapRange",
        settings={"interpolation_type": "SMOOTHSTEP"},
        Value=value,
        From_Min=low,
        From_Max=high,
    )
