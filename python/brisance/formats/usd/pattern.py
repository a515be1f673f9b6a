"""A broken pane as USD: every fragment a solid in its place, ready to be thrown by whoever takes it over.

.. code-block:: text

    /World                   brisance: version, seed, …
      Materials/glass        and glass_broken for what cracks cut
      PhysicsScene           gravity
      pane/piece_0 …         a Mesh a fragment, with mass and inertia; brisance: closed_at_s, area_m2, mass_kg

The pane stands in the plane z = 0 about the origin and faces +z. Nothing moves: ``brisance:closed_at_s`` says
when the cracks had cut a fragment free, so that tools can show the pattern grow.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from pxr import Gf, Sdf, Vt

from brisance.formats.usd.authoring import attribute, define
from brisance.formats.usd.geometry import Geometries
from brisance.formats.usd.layer import check_usd_path, start_layer, write_layer
from brisance.formats.usd.materials import author_materials, tint_colours
from brisance.formats.usd.physics import author_body, author_scene
from brisance.formats.usd.prims_layout import author_looks

if TYPE_CHECKING:
    from brisance.pane import Fracture

MATERIAL = "glass"
FRAME_RATE = 24.0
"""Of a file in which nothing moves: USD's own default [1/s]."""

_T = Sdf.ValueTypeNames
_OPS = Vt.TokenArray(["xformOp:translate"])


def write_pattern_usd(fracture: Fracture, path: Path | str) -> None:
    """Write the solid pieces of a broken pane, whole or not at all."""
    check_usd_path(path)
    write_layer(build_pattern_layer(fracture), path)


def build_pattern_layer(fracture: Fracture) -> Sdf.Layer:
    """Return a broken pane as a layer in memory."""
    layer = Sdf.Layer.CreateAnonymous(".usdc")
    with Sdf.ChangeBlock():
        world = start_layer(layer, scene="fracture", seed=fracture.seed, frames=1, frame_rate=FRAME_RATE)
        attribute(world, "brisance:layout", _T.Token, "prims", uniform=True)
        broken = any("broken" in mesh.groups for mesh in fracture.meshes)
        author_materials(world, [MATERIAL], broken=broken)
        author_scene(world)
        _author_pane(world, fracture)
    return layer


def _author_pane(world: Sdf.PrimSpec, fracture: Fracture) -> None:
    pane = define(world, "pane", "Xform")
    pane.kind = "component"
    solids = fracture.solids
    masses, areas, closed = solids.mass_kg.tolist(), solids.area_m2.tolist(), fracture.closed_at.tolist()
    for name, kind, value in (
        ("name", _T.String, "pane"),
        ("material", _T.Token, MATERIAL),
        ("glass", _T.Token, fracture.pattern.glass),
        ("pieces", _T.Int, len(masses)),
        ("moving_pieces", _T.Int, 0),
        ("total_mass_kg", _T.Double, sum(masses)),
        ("thickness_m", _T.Double, fracture.thickness),
        ("critical_length_m", _T.Double, fracture.critical_length),
    ):
        attribute(pane, f"brisance:{name}", kind, value, uniform=True)
    geometries, colour = Geometries([], hard=fracture.meshes), tint_colours(MATERIAL)[0]
    inertias, places = _principal(fracture), fracture.positions.tolist()
    for index, mesh in enumerate(fracture.meshes):
        piece = define(pane, f"piece_{index}", "Mesh")
        author_body(piece, mass=masses[index], inertia=inertias[index])
        author_looks(piece, geometries[mesh], material=MATERIAL, colour=colour)
        attribute(piece, "xformOp:translate", _T.Double3, Gf.Vec3d(*places[index]))
        attribute(piece, "xformOpOrder", _T.TokenArray, _OPS, uniform=True)
        attribute(piece, "brisance:mass_kg", _T.Double, masses[index])
        attribute(piece, "brisance:area_m2", _T.Double, areas[index])
        attribute(piece, "brisance:closed_at_s", _T.Double, closed[index])


def _principal(fracture: Fracture) -> list[tuple[Gf.Vec3f, Gf.Quatf]]:
    """Principal moments of every piece, and the turn about z from their axes to the pane's."""
    inertia = fracture.solids.inertia_kg_m2.reshape(-1, 3, 3)
    xx, yy, xy, zz = inertia[:, 0, 0], inertia[:, 1, 1], inertia[:, 0, 1], inertia[:, 2, 2]
    middle, radius = 0.5 * (xx + yy), np.hypot(0.5 * (xx - yy), xy)
    half = 0.25 * np.arctan2(2 * xy, xx - yy)
    moments = np.stack([middle + radius, middle - radius, zz], axis=1).tolist()
    return [
        (Gf.Vec3f(*three), Gf.Quatf(cosine, 0.0, 0.0, sine))
        for three, cosine, sine in zip(moments, np.cos(half).tolist(), np.sin(half).tolist(), strict=True)
    ]
