"""The facts of the report, as attributes in the ``brisance:`` namespace under the report's own names.

A mesh carries the values of its piece; an instancer carries arrays with one value an instance. A fact that a
piece does not have (the time of rest of one that never rests) is left out on a mesh and NaN in an array.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Sdf, Vt

from brisance.formats.report import SCALAR_FACTS
from brisance.formats.usd.authoring import attribute

if TYPE_CHECKING:
    from brisance.result import Result

"""Facts that are one number a piece."""

VECTORS = ("impulse_n_s", "final_position_m")
"""Facts that are three numbers a piece."""

_T = Sdf.ValueTypeNames


class Facts:
    """The facts of every piece of a result, in columns."""

    def __init__(self, result: Result) -> None:
        self._scalars = {
            name: np.asarray(getattr(result.bodies, name), dtype=np.float64) for name in SCALAR_FACTS
        }
        self._vectors = {name: np.asarray(getattr(result.bodies, name), dtype=np.float64) for name in VECTORS}
        self.mass: NDArray[np.float64] = self._scalars["mass_kg"]
        self._columns = {name: column.tolist() for name, column in self._scalars.items()}

    def author(self, prim: Sdf.PrimSpec, body: int) -> None:
        """Author the facts of one piece on its mesh."""
        for name, column in self._columns.items():
            value = column[body]
            if value == value:
                attribute(prim, f"brisance:{name}", _T.Double, value)
        for name, rows in self._vectors.items():
            attribute(prim, f"brisance:{name}", _T.Double3, Gf.Vec3d(*rows[body].tolist()))

    def author_arrays(self, prim: Sdf.PrimSpec, bodies: slice) -> None:
        """Author the facts of an object's pieces on its instancer."""
        for name, values in self._scalars.items():
            array = Vt.DoubleArray.FromNumpy(np.ascontiguousarray(values[bodies]))
            attribute(prim, f"brisance:{name}", _T.DoubleArray, array)
        for name, rows in self._vectors.items():
            vectors = Vt.Vec3dArray.FromNumpy(np.ascontiguousarray(rows[bodies]))
            attribute(prim, f"brisance:{name}", _T.Double3Array, vectors)
