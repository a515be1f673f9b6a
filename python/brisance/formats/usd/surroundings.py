"""What stands around the pieces: the ground, the charges, and the shock fronts that grow from them.

Charges and shock fronts have the purpose ``guide``: viewers show them on request, renderers and importers
leave them out. The ground has the purpose ``proxy``: viewers show it, a final render and Blender's import
leave it out, so it never gets in the way of the artist's own.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from pxr import Gf, Sdf, Vt

from brisance.formats.usd.authoring import attribute, define, samples
from brisance.formats.usd.materials import bind, look
from brisance.formats.usd.physics import author_static_collider

if TYPE_CHECKING:
    from brisance.model import Charge
    from brisance.result import Result

TNT_DENSITY = 1630.0
"""Density of cast TNT, from which the drawn size of a charge follows [kg/m³]."""

_T = Sdf.ValueTypeNames
_CHARGE_COLOUR = Gf.Vec3f(0.8, 0.05, 0.02)
_FRONT_COLOUR = Gf.Vec3f(1.0, 0.6, 0.15)


def author_ground(world: Sdf.PrimSpec, result: Result) -> None:
    """Author the scene's ground, if it has one: a square that reaches well past all that happens on it."""
    ground = result.scene.ground
    if ground is None:
        return
    sides = [np.abs(result.positions[..., axis]).max(initial=0.0) for axis in (0, 2)]
    sides += [abs(charge.position[axis]) for charge in result.scene.charges for axis in (0, 2)]
    half = 10.0 * math.ceil(max(10.0, 2.0 * float(max(sides))) / 10.0)
    corners = np.array([(-1, 0, -1), (-1, 0, 1), (1, 0, 1), (1, 0, -1)], dtype=np.float32) * np.float32(half)
    corners[:, 1] = ground.height
    prim = define(world, "Ground", "Mesh")
    author_static_collider(prim)
    attribute(prim, "purpose", _T.Token, "proxy", uniform=True)
    attribute(prim, "points", _T.Point3fArray, Vt.Vec3fArray.FromNumpy(corners))
    attribute(prim, "faceVertexCounts", _T.IntArray, Vt.IntArray([4]))
    attribute(prim, "faceVertexIndices", _T.IntArray, Vt.IntArray([0, 1, 2, 3]))
    attribute(prim, "normals", _T.Normal3fArray, Vt.Vec3fArray([Gf.Vec3f(0, 1, 0)]), interpolation="uniform")
    attribute(prim, "extent", _T.Float3Array, Vt.Vec3fArray.FromNumpy(corners[[0, 2]]))
    attribute(prim, "subdivisionScheme", _T.Token, "none", uniform=True)
    metres = Vt.Vec2fArray.FromNumpy(np.ascontiguousarray(corners[:, [2, 0]]))
    attribute(prim, "primvars:st", _T.TexCoord2fArray, metres, interpolation="faceVarying")
    colour = Vt.Vec3fArray([Gf.Vec3f(*look("ground").colour)])
    attribute(prim, "primvars:displayColor", _T.Color3fArray, colour, interpolation="constant")
    attribute(prim, "brisance:height_m", _T.Double, ground.height, uniform=True)
    attribute(prim, "brisance:friction", _T.Double, ground.friction, uniform=True)
    bind(prim, "ground")


def author_charges(world: Sdf.PrimSpec, result: Result) -> None:
    """Author each charge and its shock front."""
    scope = define(world, "Charges", "Scope")
    attribute(scope, "purpose", _T.Token, "guide", uniform=True)
    for number, charge in enumerate(result.scene.charges):
        tnt_mass = charge.mass * charge.factor
        radius = (3.0 * tnt_mass / (4.0 * math.pi * TNT_DENSITY)) ** (1.0 / 3.0)
        prim = _sphere(scope, f"charge_{number}", charge, colour=_CHARGE_COLOUR, opacity=1.0)
        attribute(prim, "radius", _T.Double, radius)
        attribute(prim, "extent", _T.Float3Array, _ball(radius))
        attribute(prim, "brisance:mass_kg", _T.Double, charge.mass, uniform=True)
        attribute(prim, "brisance:tnt_mass_kg", _T.Double, tnt_mass, uniform=True)
        if charge.explosive is not None or charge.tnt_equivalence is None:
            attribute(prim, "brisance:explosive", _T.String, charge.explosive or "TNT", uniform=True)
        attribute(prim, "brisance:burst", _T.Token, charge.burst, uniform=True)
        attribute(prim, "brisance:time_s", _T.Double, charge.time, uniform=True)
        attribute(prim, "brisance:gain", _T.Double, charge.gain, uniform=True)
        attribute(prim, "brisance:curves", _T.String, charge.curves, uniform=True)
        _author_front(
            scope, number, charge, np.asarray(result.front_radius(number), dtype=np.float64).tolist()
        )


def _author_front(scope: Sdf.PrimSpec, number: int, charge: Charge, radii: list[float]) -> None:
    """Author the shock front: a sphere that grows frame by frame, hidden until the charge detonates."""
    prim = _sphere(scope, f"shock_front_{number}", charge, colour=_FRONT_COLOUR, opacity=0.15)
    frames = [float(frame) for frame in range(len(radii))]
    samples(attribute(prim, "radius", _T.Double), frames, radii)
    samples(attribute(prim, "extent", _T.Float3Array), frames, map(_ball, radii))
    first = next((frame for frame, radius in zip(frames, radii, strict=True) if radius > 0), None)
    visibility = attribute(prim, "visibility", _T.Token)
    if first is None:
        visibility.default = "invisible"
    elif first > 0:
        samples(visibility, [0.0, first], ["invisible", "inherited"])


def _sphere(
    scope: Sdf.PrimSpec, name: str, charge: Charge, *, colour: Gf.Vec3f, opacity: float
) -> Sdf.PrimSpec:
    prim = define(scope, name, "Sphere")
    attribute(prim, "purpose", _T.Token, "guide", uniform=True)
    attribute(prim, "xformOp:translate", _T.Double3, Gf.Vec3d(*charge.position))
    attribute(prim, "xformOpOrder", _T.TokenArray, Vt.TokenArray(["xformOp:translate"]), uniform=True)
    attribute(
        prim, "primvars:displayColor", _T.Color3fArray, Vt.Vec3fArray([colour]), interpolation="constant"
    )
    attribute(
        prim, "primvars:displayOpacity", _T.FloatArray, Vt.FloatArray([opacity]), interpolation="constant"
    )
    return prim


def _ball(radius: float) -> Vt.Vec3fArray:
    return Vt.Vec3fArray([Gf.Vec3f(-radius), Gf.Vec3f(radius)])
