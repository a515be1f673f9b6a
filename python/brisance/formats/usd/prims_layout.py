"""The open layout: a Mesh a piece, moved by its own transform, easy to pick, hide, edit and simulate."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Sdf, Vt

from brisance.formats.usd.authoring import Names, attribute, define, keep_name, samples
from brisance.formats.usd.geometry import Geometry, author_shape
from brisance.formats.usd.materials import bind
from brisance.formats.usd.physics import author_body
from brisance.formats.usd.show import Show, quaternion, quaternions, tints

if TYPE_CHECKING:
    from brisance.result import Source

_T = Sdf.ValueTypeNames
_OPS = Vt.TokenArray(["xformOp:translate", "xformOp:orient"])


def author_object(world: Sdf.PrimSpec, show: Show, source: Source) -> Sdf.PrimSpec:
    """Author an object as an Xform with one Mesh a piece; return its prim."""
    parent = show.define_object(world, source, "Xform")
    names = Names()
    tint, colours = tints(source)
    for body in range(source.start, source.stop):
        original = show.result.bodies.names[body]
        piece = define(parent, names.identifier(original), "Mesh")
        keep_name(piece, original)
        author_body(
            piece,
            mass=float(show.facts.mass[body]),
            velocity=Gf.Vec3f(*show.velocities[body].tolist()),
            spin=Gf.Vec3f(*show.spins[body].tolist()),
        )
        author_looks(
            piece,
            show.geometries[show.result.meshes[body]],
            material=source.material,
            colour=colours[tint[body - source.start]],
        )
        _author_motion(piece, show, body)
        show.facts.author(piece, body)
        show.advance(1)
    return parent


def author_looks(piece: Sdf.PrimSpec, geometry: Geometry, *, material: str, colour: Vt.Vec3fArray) -> None:
    """Author the shape of a piece, its material and its tint."""
    author_shape(piece, geometry, material=material)
    attribute(piece, "primvars:displayColor", _T.Color3fArray, colour, interpolation="constant")
    bind(piece, material)


def _author_motion(piece: Sdf.PrimSpec, show: Show, body: int) -> None:
    positions, orientations = show.positions[:, body], show.orientations[:, body]
    translate = attribute(
        piece,
        "xformOp:translate",
        _T.Float3,
        None if show.carries[0, body] else Gf.Vec3f(*positions[0].tolist()),
    )
    frames = np.flatnonzero(show.carries[:, body])
    if len(frames):
        samples(translate, _time_codes(frames), Vt.Vec3fArray.FromNumpy(positions[frames]))
    orient = attribute(
        piece, "xformOp:orient", _T.Quatf, None if show.turns[0, body] else quaternion(orientations[0])
    )
    frames = np.flatnonzero(show.turns[:, body])
    if len(frames):
        samples(orient, _time_codes(frames), quaternions(orientations[frames], Vt.QuatfArray))
    attribute(piece, "xformOpOrder", _T.TokenArray, _OPS, uniform=True)


def _time_codes(frames: NDArray[np.int64]) -> list[float]:
    return [float(frame) for frame in frames]
