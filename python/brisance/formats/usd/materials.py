"""How materials look: one preview surface a material, and a handful of tints so that a wall reads as bricks.

The tint of a piece is its ``displayColor``. Plain viewers draw that colour itself, renderers get it through
the material, whose base colour reads the same primvar. Tints come from a short list per material so that
pieces of one mesh and tint can share a prototype.
"""

from __future__ import annotations

import zlib
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Sdf, Vt

from brisance.formats.usd.authoring import attribute, define, relate

TINTS = 8
"""Tints of each material."""

_SCOPE = "/World/Materials"
_T = Sdf.ValueTypeNames


@dataclass(frozen=True)
class Look:
    """Appearance of one material; colours are linear Rec. 709."""

    colour: tuple[float, float, float]
    broken: tuple[float, float, float]
    """Colour of a fracture surface."""
    spread: float
    """Brightness varies by this fraction up and down from piece to piece."""
    roughness: float
    metallic: float = 0.0
    opacity: float = 1.0
    ior: float = 1.5


LOOKS = {
    "brick": Look((0.40, 0.125, 0.075), (0.52, 0.21, 0.12), spread=0.30, roughness=0.85),
    "concrete": Look((0.38, 0.37, 0.35), (0.48, 0.46, 0.42), spread=0.08, roughness=0.9),
    "glass": Look((0.82, 0.90, 0.87), (0.55, 0.80, 0.70), spread=0.0, roughness=0.03, opacity=0.25, ior=1.52),
    "metal": Look((0.50, 0.50, 0.52), (0.62, 0.61, 0.60), spread=0.05, roughness=0.35, metallic=1.0),
    "plastic": Look((0.10, 0.22, 0.42), (0.22, 0.36, 0.55), spread=0.03, roughness=0.4),
    "stone": Look((0.30, 0.28, 0.25), (0.42, 0.40, 0.36), spread=0.20, roughness=0.9),
    "wood": Look((0.36, 0.20, 0.095), (0.55, 0.36, 0.19), spread=0.18, roughness=0.7),
    "ground": Look((0.20, 0.185, 0.16), (0.20, 0.185, 0.16), spread=0.0, roughness=0.95),
}
"""Every material a scene may name, and the ground's. A name that is not here is shown as stone."""


def look(material: str) -> Look:
    """Return the look of a material."""
    return LOOKS.get(material, LOOKS["stone"])


def material_path(material: str) -> Sdf.Path:
    """Path of the material's prim."""
    return Sdf.Path(f"{_SCOPE}/{material}")


def broken_path(material: str) -> Sdf.Path:
    """Path of the prim with the look of the material's fracture surfaces."""
    return Sdf.Path(f"{_SCOPE}/{material}_broken")


def author_materials(world: Sdf.PrimSpec, materials: list[str], *, broken: bool) -> None:
    """Author the named materials under ``/World/Materials``; with ``broken``, their fracture surfaces too."""
    scope = define(world, "Materials", "Scope")
    for name in materials:
        _author(scope, name, look(name), tinted=True)
        if broken:
            _author(scope, f"{name}_broken", look(name), tinted=False)


def piece_tints(source: str, count: int) -> NDArray[np.int64]:
    """Return each piece's tint, 0 to TINTS - 1: a hash of the object's name and the piece's number."""
    keys = np.arange(count, dtype=np.uint64) + np.uint64(zlib.crc32(source.encode()) << 20)
    keys *= np.uint64(0x9E3779B97F4A7C15)
    keys ^= keys >> np.uint64(32)
    keys *= np.uint64(0xD6E8FEB86659FD93)
    return ((keys >> np.uint64(40)) % np.uint64(TINTS)).astype(np.int64)


def tint_colours(material: str) -> list[Vt.Vec3fArray]:
    """Return the material's tints, dark to light, each as the value of a constant ``displayColor``."""
    shown = look(material)
    tints = []
    for step in np.linspace(-1.0, 1.0, TINTS):
        brightness = 1.0 + shown.spread * float(step)
        tints.append(Vt.Vec3fArray([Gf.Vec3f(*(min(1.0, c * brightness) for c in shown.colour))]))
    return tints


def _author(scope: Sdf.PrimSpec, name: str, shown: Look, *, tinted: bool) -> None:
    material = define(scope, name, "Material")
    surface = define(material, "Surface", "Shader")
    attribute(surface, "info:id", _T.Token, "UsdPreviewSurface", uniform=True)
    colour = attribute(surface, "inputs:diffuseColor", _T.Color3f, Gf.Vec3f(*shown.broken))
    attribute(surface, "inputs:roughness", _T.Float, shown.roughness if tinted else 0.5 + shown.roughness / 2)
    attribute(surface, "inputs:metallic", _T.Float, shown.metallic)
    attribute(surface, "inputs:opacity", _T.Float, shown.opacity)
    attribute(surface, "inputs:ior", _T.Float, shown.ior)
    attribute(surface, "outputs:surface", _T.Token)
    output = attribute(material, "outputs:surface", _T.Token)
    output.connectionPathList.explicitItems = [surface.path.AppendProperty("outputs:surface")]
    if tinted:
        colour.default = Gf.Vec3f(*shown.colour)
        reader = define(material, "Tint", "Shader")
        attribute(reader, "info:id", _T.Token, "UsdPrimvarReader_float3", uniform=True)
        attribute(reader, "inputs:varname", _T.String, "displayColor")
        attribute(reader, "inputs:fallback", _T.Float3, Gf.Vec3f(*shown.colour))
        attribute(reader, "outputs:result", _T.Float3)
        colour.connectionPathList.explicitItems = [reader.path.AppendProperty("outputs:result")]


def bind(prim: Sdf.PrimSpec, material: str) -> None:
    """Bind a material to a prim, which must have ``MaterialBindingAPI`` applied."""
    relate(prim, "material:binding", [material_path(material)])
