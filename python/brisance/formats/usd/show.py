"""What both layouts work from: a result's poses, shapes, colours and facts, converted once."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Sdf, Vt

from brisance.formats.usd.authoring import Names, attribute, define
from brisance.formats.usd.facts import Facts
from brisance.formats.usd.geometry import Geometries
from brisance.formats.usd.materials import piece_tints, tint_colours
from brisance.formats.usd.poses import carrying_frames, continuous, final_spins, final_velocities

if TYPE_CHECKING:
    from brisance.result import Result, Source

RESERVED = ("Materials", "Charges", "Ground", "PhysicsScene")
"""Names under ``/World`` that objects cannot have."""

_T = Sdf.ValueTypeNames


class Show:
    """A result as the layouts need it.

    ``positions`` (frames, bodies, 3) and ``orientations`` (frames, bodies, 4; w x y z, sign-continuous) are
    the recorded float32 values; ``carries`` and ``turns`` (frames, bodies) mark the frames that carry the
    motion of each. ``names`` gives out the names of prims under ``/World``.
    """

    def __init__(self, result: Result, progress: Callable[[int, int], None] | None) -> None:
        self.result = result
        self.positions: NDArray[np.float32] = np.ascontiguousarray(result.positions, dtype=np.float32)
        self.orientations = continuous(np.asarray(result.orientations, dtype=np.float32))
        self.carries = carrying_frames(self.positions)
        self.turns = carrying_frames(self.orientations)
        self.moves: NDArray[np.bool_] = self.carries[0] | self.turns[0]
        self.velocities = final_velocities(self.positions, result.frame_rate)
        self.spins = final_spins(self.orientations, result.frame_rate)
        shards = min((pane.start for pane in result.panes), default=len(result.meshes))
        self.geometries = Geometries(result.meshes[:shards], hard=result.meshes[shards:])
        self.facts = Facts(result)
        self.names = Names(RESERVED)
        self._progress = progress
        self._done = 0

    @property
    def bodies(self) -> int:
        """Number of pieces."""
        return self.positions.shape[1]

    def advance(self, pieces: int) -> None:
        """Tell whoever follows the writing that so many more pieces are authored."""
        self._done += pieces
        if self._progress is not None:
            self._progress(self._done, self.bodies)

    def define_object(self, world: Sdf.PrimSpec, source: Source, type_name: str) -> Sdf.PrimSpec:
        """Define the prim of an object, with what a reader wants to know of it at a glance."""
        prim = define(world, self.names.identifier(source.name), type_name)
        prim.kind = "component"
        bodies = slice(source.start, source.stop)
        attribute(prim, "brisance:name", _T.String, source.name, uniform=True)
        attribute(prim, "brisance:material", _T.Token, source.material, uniform=True)
        attribute(prim, "brisance:pieces", _T.Int, source.stop - source.start, uniform=True)
        attribute(prim, "brisance:moving_pieces", _T.Int, int(self.moves[bodies].sum()), uniform=True)
        attribute(
            prim, "brisance:total_mass_kg", _T.Double, float(self.facts.mass[bodies].sum()), uniform=True
        )
        return prim


def tints(source: Source) -> tuple[NDArray[np.int64], list[Vt.Vec3fArray]]:
    """Return the tint number of each piece of an object, and the colour of each tint."""
    return piece_tints(source.name, source.stop - source.start), tint_colours(source.material)


def quaternion(wxyz: NDArray[np.float32]) -> Gf.Quatf:
    """Return one orientation as USD has it."""
    w, x, y, z = wxyz.tolist()
    return Gf.Quatf(w, x, y, z)


def quaternions(wxyz: NDArray[np.float32], kind: type[Vt.QuatfArray] | type[Vt.QuathArray]) -> Vt.QuatfArray:
    """Return (n, 4) orientations as a USD array of the given kind; USD keeps the real part last in memory."""
    dtype = np.float16 if kind is Vt.QuathArray else np.float32
    return kind.FromNumpy(np.ascontiguousarray(wxyz[:, [1, 2, 3, 0]], dtype=dtype))
