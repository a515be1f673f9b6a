"""The compact layout: a PointInstancer an object, one array of positions and one of orientations a frame.

A prototype stands for all pieces with the same mesh, mass and tint, and carries shape, material and physics:
applied to a prototype, the rigid-body schemas make every instance a body of its own. What all prototypes have
in common stands once, in a class that they inherit.

Positions are the recorded float32 values. Orientations are half floats, as the schema's ``orientations``
holds them and as Blender reads them: each component is within 2.5e-4 of the recorded one, which turns a piece
by less than 0.06 degrees.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from pxr import Sdf, Vt

from brisance.formats.usd.authoring import apply, attribute, define, relate, samples
from brisance.formats.usd.geometry import author_shape
from brisance.formats.usd.materials import bind
from brisance.formats.usd.physics import author_kind, author_mass
from brisance.formats.usd.show import Show, quaternions, tints

if TYPE_CHECKING:
    from brisance.result import Source

_T = Sdf.ValueTypeNames


def author_object(world: Sdf.PrimSpec, show: Show, source: Source) -> Sdf.PrimSpec:
    """Author an object as a PointInstancer with one instance a piece; return its prim."""
    bodies = slice(source.start, source.stop)
    instancer = show.define_object(world, source, "PointInstancer")
    indices, radii = _author_prototypes(instancer, show, source)
    attribute(instancer, "protoIndices", _T.IntArray, Vt.IntArray.FromNumpy(indices))
    ids = np.arange(source.start, source.stop, dtype=np.int64)
    attribute(instancer, "ids", _T.Int64Array, Vt.Int64Array.FromNumpy(ids))
    attribute(
        instancer, "brisance:names", _T.StringArray, Vt.StringArray(list(show.result.bodies.names[bodies]))
    )
    show.facts.author_arrays(instancer, bodies)
    _author_motion(instancer, show, bodies, radii)
    show.advance(source.stop - source.start)
    return instancer


def _author_prototypes(
    instancer: Sdf.PrimSpec, show: Show, source: Source
) -> tuple[NDArray[np.int32], NDArray[np.float64]]:
    """Author the prototypes; return the prototype of each piece and its radius about its origin [m]."""
    scope = define(instancer, "Prototypes", "Scope")
    apply(scope, "MaterialBindingAPI")
    bind(scope, source.material)
    kind = Sdf.PrimSpec(scope, "piece", Sdf.SpecifierClass, "Mesh")
    author_kind(kind)
    attribute(kind, "primvars:displayColor", _T.Color3fArray, interpolation="constant")
    inherits = Sdf.PathListOp.Create(prependedItems=[kind.path])
    tint, colours = tints(source)
    known: dict[tuple[int, float, int], int] = {}
    paths: list[Sdf.Path] = []
    radii: list[float] = []
    indices = np.empty(source.stop - source.start, dtype=np.int32)
    for number, body in enumerate(range(source.start, source.stop)):
        mesh, mass, shade = show.result.meshes[body], float(show.facts.mass[body]), int(tint[number])
        geometry = show.geometries[mesh]
        key = (id(mesh), mass, shade)
        if key not in known:
            known[key] = len(paths)
            prim = define(scope, f"piece_{len(paths)}", "Mesh")
            prim.SetInfo("inheritPaths", inherits)
            author_mass(prim, mass)
            author_shape(prim, geometry, material=source.material)
            attribute(prim, "primvars:displayColor", _T.Color3fArray, colours[shade])
            paths.append(prim.path)
            radii.append(geometry.radius)
        indices[number] = known[key]
    relate(instancer, "prototypes", paths)
    return indices, np.array(radii)[indices]


def _author_motion(instancer: Sdf.PrimSpec, show: Show, bodies: slice, radii: NDArray[np.float64]) -> None:
    positions, orientations = show.positions[:, bodies], show.orientations[:, bodies]
    moving = np.flatnonzero(show.carries[:, bodies].any(axis=1)).tolist()
    turning = np.flatnonzero(show.turns[:, bodies].any(axis=1)).tolist()
    reach = radii.astype(np.float32)[:, None]
    _author_frames(
        attribute(instancer, "positions", _T.Point3fArray),
        moving,
        lambda frame: Vt.Vec3fArray.FromNumpy(np.ascontiguousarray(positions[frame])),
    )
    _author_frames(
        attribute(instancer, "orientations", _T.QuathArray),
        turning,
        lambda frame: quaternions(orientations[frame], Vt.QuathArray),
    )
    _author_frames(
        attribute(instancer, "extent", _T.Float3Array),
        moving,
        lambda frame: Vt.Vec3fArray.FromNumpy(
            np.stack([(positions[frame] - reach).min(axis=0), (positions[frame] + reach).max(axis=0)])
        ),
    )


def _author_frames(spec: Sdf.AttributeSpec, frames: list[int], value: Callable[[int], Any]) -> None:
    """Author the value of each frame as a time sample, or that of frame 0 alone where there are none."""
    if frames:
        samples(spec, map(float, frames), map(value, frames))
    else:
        spec.default = value(0)
