"""Whole panes: what is seen of a window until it breaks.

A pane is in pieces from the first frame on as far as the engine is concerned, and its cracks would show.
So the whole pane is a Mesh of its own beside them, which bends as the pane does; it is seen until the pane
breaks, and the pieces from then on.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from pxr import Gf, Sdf, Vt

from brisance.formats.usd.authoring import Names, apply, attribute, define, samples
from brisance.formats.usd.geometry import Geometries
from brisance.formats.usd.materials import tint_colours
from brisance.formats.usd.prims_layout import author_looks
from brisance.formats.usd.show import quaternion

if TYPE_CHECKING:
    from brisance.result import Pane, Result

_T = Sdf.ValueTypeNames
NOTHING = 1e-6
"""Scale of what is not to be seen."""
MOMENT = 1e-3
"""How long the swap takes [frames]."""
_OPS = Vt.TokenArray(["xformOp:translate", "xformOp:orient"])


def author_pane(world: Sdf.PrimSpec, pieces: Sdf.PrimSpec, result: Result, pane: Pane, names: Names) -> None:
    """Author the whole pane beside the prim of its ``pieces``, and when each of the two is seen."""
    whole = define(world, names.identifier(f"{pane.name}_pane"), "Mesh")
    whole.kind = "component"
    apply(whole, "MaterialBindingAPI")
    geometry = Geometries([], hard=[pane.mesh])[pane.mesh]
    author_looks(whole, geometry, material="glass", colour=tint_colours("glass")[0])
    place = attribute(whole, "xformOp:translate", _T.Float3)
    place.default = Gf.Vec3f(*pane.window.position)
    turn = attribute(whole, "xformOp:orient", _T.Quatf)
    turn.default = quaternion(np.array(pane.window.orientation(), dtype=np.float32))
    attribute(whole, "xformOpOrder", _T.TokenArray, _OPS, uniform=True)
    frames = len(result.times)
    breaks = int(np.searchsorted(result.times, pane.broken_at_s))
    _author_facts(whole, pane, breaks if breaks < frames else None)
    _author_points(whole, pane, breaks, frames)
    if breaks > 0:
        hide = _hide_instances if pieces.typeName == "PointInstancer" else _hide_prims
        hide(pieces, pane, _swap(breaks, frames))


def _swap(breaks: int, frames: int) -> tuple[float, float] | None:
    """The last time code at which the whole pane is seen and the first at which its pieces are."""
    return (breaks - 0.5 - MOMENT, breaks - 0.5) if 0 < breaks < frames else None


def _author_points(whole: Sdf.PrimSpec, pane: Pane, breaks: int, frames: int) -> None:
    """Author how the whole pane bends, and that it is gone once it has broken."""
    flat, amplitude = pane.mesh.points, pane.amplitude[: min(breaks, frames)]
    gone = Vt.Vec3fArray.FromNumpy(np.broadcast_to(flat.min(axis=0), flat.shape).copy())
    points = whole.attributes["points"]
    if breaks == 0:
        points.default = gone
        return

    def bent(frame: int) -> Vt.Vec3fArray:
        moved = flat.copy()
        moved[:, 2] += (pane.deflection * amplitude[frame]).astype(np.float32)
        return Vt.Vec3fArray.FromNumpy(moved)

    changed = np.diff(amplitude) != 0
    needed = np.flatnonzero(np.append(changed, False) | np.insert(changed, 0, False)).tolist()
    swap = _swap(breaks, frames)
    if swap is not None:
        needed = sorted({*needed, 0, len(amplitude) - 1})
        samples(points, swap, (bent(len(amplitude) - 1), gone))
    samples(points, map(float, needed), map(bent, needed))
    furthest = pane.deflection * amplitude[int(np.argmax(np.abs(amplitude)))]
    low, high = flat.min(axis=0), flat.max(axis=0)
    low[2], high[2] = low[2] + min(furthest.min(), 0.0), high[2] + max(furthest.max(), 0.0)
    whole.attributes["extent"].default = Vt.Vec3fArray.FromNumpy(np.stack([low, high]))


def _hide_prims(pieces: Sdf.PrimSpec, pane: Pane, swap: tuple[float, float] | None) -> None:
    """Shrink the pieces into the middle of the window until they are to be seen."""
    attribute(pieces, "xformOp:translate", _T.Float3, Gf.Vec3f(*pane.window.position))
    scale = attribute(pieces, "xformOp:scale", _T.Float3, Gf.Vec3f(NOTHING))
    if swap is not None:
        samples(scale, (0.0, *swap), (Gf.Vec3f(NOTHING), Gf.Vec3f(NOTHING), Gf.Vec3f(1.0)))
    order = ["xformOp:translate", "xformOp:scale", "!invert!xformOp:translate"]
    attribute(pieces, "xformOpOrder", _T.TokenArray, Vt.TokenArray(order), uniform=True)


def _hide_instances(pieces: Sdf.PrimSpec, pane: Pane, swap: tuple[float, float] | None) -> None:
    count = pane.stop - pane.start
    hidden = Vt.Vec3fArray(count, Gf.Vec3f(NOTHING))
    scales = attribute(pieces, "scales", _T.Float3Array, hidden)
    if swap is not None:
        samples(scales, (0.0, *swap), (hidden, hidden, Vt.Vec3fArray(count, Gf.Vec3f(1.0))))


def _author_facts(whole: Sdf.PrimSpec, pane: Pane, breaks: int | None) -> None:
    facts = [
        ("fate", _T.Token, pane.fate),
        ("glass", _T.Token, pane.window.glass),
        ("peak_pressure_pa", _T.Double, pane.peak_pressure_pa),
        ("peak_stress_pa", _T.Double, pane.peak_stress_pa),
        ("strength_pa", _T.Double, pane.strength_pa),
        ("staying_pieces", _T.Int, pane.staying),
    ]
    if breaks is not None:
        facts.append(("broken_frame", _T.Int, breaks))
    if pane.failure_time_s is not None:
        facts.append(("failure_time_s", _T.Double, pane.failure_time_s))
    for name, kind, value in facts:
        attribute(whole, f"brisance:{name}", kind, value, uniform=True)
