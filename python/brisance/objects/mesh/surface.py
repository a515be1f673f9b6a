"""Triangles under repair that remember which triangle of the file they were, and the record of the repair."""

from __future__ import annotations

from dataclasses import dataclass, field

import manifold3d
import numpy as np
from numpy.typing import NDArray

from brisance.objects.mesh.polygons import Indices, Points

NEW = -1
"""Source of a triangle that the file does not hold."""


@dataclass(frozen=True, eq=False)
class Surface:
    """Triangles with their origin."""

    points: Points
    """(n, 3) [m]; some may be unused."""
    triangles: Indices
    """(t, 3)."""
    source: Indices
    """(t,) triangle of the file, or ``NEW``."""
    turned: NDArray[np.bool_]
    """(t,) whether it is wound the other way than in the file."""

    @classmethod
    def new(cls, points: Points, triangles: Indices) -> Surface:
        """Triangles that the file does not hold."""
        return cls(points, triangles, np.full(len(triangles), NEW), np.zeros(len(triangles), bool))

    @classmethod
    def of_manifold(cls, solid: manifold3d.Manifold) -> Surface:
        """The surface of a manifold3d solid."""
        mesh = solid.to_mesh64()
        return cls.new(
            np.array(mesh.vert_properties[:, :3]), np.array(mesh.tri_verts, np.int64).reshape(-1, 3)
        )

    def manifold(self) -> manifold3d.Manifold:
        """The closed surface as a manifold3d solid; an empty one if it cannot be one."""
        used, index = np.unique(self.triangles, return_inverse=True)
        triangles = index.reshape(-1, 3).astype(np.uint64)
        return manifold3d.Manifold(manifold3d.Mesh64(np.ascontiguousarray(self.points[used]), triangles))

    def hull(self) -> Surface:
        """The convex hull of its points; without triangles if they lie in a plane."""
        return Surface.of_manifold(manifold3d.Manifold.hull_points(self.points[np.unique(self.triangles)]))

    def select(self, kept: NDArray[np.bool_] | Indices) -> Surface:
        """Some of the triangles, by mask or number."""
        return Surface(self.points, self.triangles[kept], self.source[kept], self.turned[kept])

    def turn(self, which: NDArray[np.bool_]) -> Surface:
        """The same triangles, those where ``which`` (t,) wound the other way."""
        triangles = np.where(which[:, None], self.triangles[:, ::-1], self.triangles)
        return Surface(self.points, triangles, self.source, self.turned ^ which)

    def turn_all(self) -> Surface:
        """The same triangles, all wound the other way."""
        return self.turn(np.ones(len(self.triangles), bool))

    def with_vertices(self, triangles: Indices) -> Surface:
        """The same triangles between other vertices; those left with two corners in one place are dropped."""
        a, b, c = triangles.T
        whole = (a != b) & (b != c) & (c != a)
        return Surface(self.points, triangles, self.source, self.turned).select(whole)


def joined(surfaces: list[Surface]) -> Surface:
    """Several surfaces as one list of triangles, without merging anything. Shared points stay shared."""
    if len(surfaces) == 1:
        return surfaces[0]
    offsets: dict[int, int] = {}
    points: list[Points] = []
    total = 0
    for surface in surfaces:
        if id(surface.points) not in offsets:
            offsets[id(surface.points)] = total
            points.append(surface.points)
            total += len(surface.points)
    return Surface(
        np.concatenate(points),
        np.concatenate([surface.triangles + offsets[id(surface.points)] for surface in surfaces]),
        np.concatenate([surface.source for surface in surfaces]),
        np.concatenate([surface.turned for surface in surfaces]),
    )


@dataclass
class Notes:
    """What a repair did, as numbers; :meth:`clauses` says it in words."""

    not_numbers: int = 0
    without_area: int = 0
    doubled: int = 0
    gap_width: float = 0.0
    gaps: int = 0
    fins: int = 0
    hole_areas: list[float] = field(default_factory=list)
    turned: int = 0
    all_turned: bool = False
    hulls: int = 0
    whole_hull: bool = False
    flat_parts: int = 0
    joined_parts: int = 0
    rebuilt: bool = False
    crossed: bool = False
    enclosed: float = 0.0

    def clauses(self) -> list[str]:
        """What was done, in order, without the file's name; empty if the mesh was sound."""
        said: list[str] = []
        if self.not_numbers:
            number = self.not_numbers
            said.append(f"{_faces(number)} with a corner that is not a number {_was(number)} dropped")
        if self.without_area:
            said.append(f"{_faces(self.without_area)} without area {_was(self.without_area)} dropped")
        if self.doubled:
            said.append(f"{_faces(self.doubled)} lying on another {_was(self.doubled)} dropped")
        if self.gaps:
            said.append(f"gaps of up to {self.gap_width:.2g} m along {self.gaps} edges were closed")
        if self.fins:
            said.append(
                f"{_faces(self.fins)} of fins or inner walls {_was(self.fins)} left out of the physics"
            )
        if self.all_turned:
            said.append("its faces looked inwards and were turned outwards")
        elif self.turned:
            said.append(f"{_faces(self.turned)} that looked inwards {_was(self.turned)} turned outwards")
        if self.hole_areas:
            number = len(self.hole_areas)
            holes = "1 hole was filled, of" if number == 1 else f"{number} holes were filled, the largest of"
            said.append(f"{holes} {max(self.hole_areas):.3g} m²")
        if self.flat_parts:
            parts = "1 flat part was" if self.flat_parts == 1 else f"{self.flat_parts} flat parts were"
            said.append(f"{parts} left out of the physics")
        if self.whole_hull:
            said.append(
                "it cannot be closed, so its convex hull carries mass and loads while it looks as it is"
            )
        elif self.hulls:
            parts = "1 part" if self.hulls == 1 else f"{self.hulls} parts"
            said.append(
                f"{parts} cannot be closed, so convex hulls carry mass and loads while all looks as it is"
            )
        if self.joined_parts:
            said.append(
                f"{self.joined_parts} parts, some of which overlap or touch, were united for the physics"
            )
        if self.rebuilt:
            said.append("its surface crosses itself, so the physics takes an outline of all that it encloses")
        if self.crossed:
            said.append(
                "its surface crosses itself, and places inside several of its layers count several times"
            )
        if said:
            said.append(f"its volume is {self.enclosed:.4g} m³")
        return said


def _faces(count: int) -> str:
    return "1 face" if count == 1 else f"{count} faces"


def _was(count: int) -> str:
    return "was" if count == 1 else "were"
