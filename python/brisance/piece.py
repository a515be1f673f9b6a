"""What one rigid piece looks like, and the pieces one object of the scene is made of.

A :class:`PieceMesh` is pure shape in its body's own frame. A :class:`PieceSet` ties the pieces of one object
together: what the engine is given about them and what a writer shows of them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from brisance import _engine


@dataclass(frozen=True, eq=False)
class PieceMesh:
    """The closed surface of one piece.

    The frame is the body's: origin at the centre of mass, axes those of the unrotated object, lengths in
    metres. Identical pieces share the same object, so that ``mesh_a is mesh_b`` tells a writer what it may
    instance.
    """

    points: NDArray[np.float32]
    """(n, 3) corner positions [m]."""
    face_counts: NDArray[np.int32]
    """(f,) corners of each face, 3 or more."""
    face_indices: NDArray[np.int32]
    """(sum of face_counts,) indices into ``points``, counter-clockwise seen from outside."""
    uvs: NDArray[np.float32] | None = None
    """(sum of face_counts, 2) texture coordinates, one a face corner, or None where the shape has none."""
    groups: Mapping[str, NDArray[np.int32]] = field(default_factory=dict)
    """Named subsets of the faces (their indices), such as ``"broken"`` for fracture surfaces; may be
    empty.
    """


@dataclass(frozen=True, eq=False)
class PieceSet:
    """All pieces of one object in the scene, in the order in which the engine numbers them."""

    name: str
    """Name of the object they come from, unique in the scene."""
    material: str
    """What they look like: brick, wood, concrete, metal, stone, plastic or glass. It has no part in the
    physics.
    """
    names: list[str]
    """One unique name a piece, such as ``"wall_r0_c1"``."""
    meshes: list[PieceMesh]
    """One mesh a piece; identical pieces hold the same mesh object."""
    add_to: Callable[[_engine.Scene], None] | None = None
    """Adds the pieces' bodies to an engine scene, in the order of ``names``; None where the engine has made
    them itself.
    """
    warnings: list[str] = field(default_factory=list)
    """One sentence for each approximation that was made of the object."""
    encloses: Callable[[Sequence[float]], bool] | None = None
    """Whether a point of the world [m] lies inside a piece; None where the object's own keys tell."""

    def __len__(self) -> int:
        return len(self.names)
