"""Wavefront OBJ files: faces of any number of corners with their own texture coordinates.

Groups, materials, normals, lines and free-form curves are passed over; all faces make one mesh.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from brisance.objects.mesh.polygons import Points, PolygonMesh


def read_obj(path: Path) -> PolygonMesh:
    """Reads the faces of a file. Raises :class:`ValueError` that names the line of a wrong number."""
    text = path.read_text(encoding="utf-8", errors="replace").replace("\\\r\n", " ").replace("\\\n", " ")
    points: list[list[float]] = []
    coordinates: list[list[float]] = []
    counts: list[int] = []
    corners: list[int] = []
    uv_corners: list[int] = []
    for number, line in enumerate(text.split("\n"), start=1):
        words = line.split()
        if not words:
            continue
        try:
            if words[0] == "v":
                x, y, z = words[1:4]
                points.append([float(x), float(y), float(z)])
            elif words[0] == "vt":
                coordinates.append([float(words[1]), float(words[2]) if len(words) > 2 else 0.0])
            elif words[0] == "f":
                ends = words.index("#") if "#" in words else len(words)
                counts.append(ends - 1)
                for word in words[1:ends]:
                    first, _, rest = word.partition("/")
                    corners.append(_index(first, len(points)))
                    second = rest.partition("/")[0]
                    uv_corners.append(_index(second, len(coordinates)) if second else -1)
        except (ValueError, IndexError):
            raise ValueError(f"line {number} cannot be understood: {line.strip()[:60]!r}") from None
    if max(corners, default=-1) >= len(points):
        raise ValueError(f"a face names vertex {max(corners) + 1}, but there are {len(points)}")
    return PolygonMesh(
        np.array(points, np.float64).reshape(-1, 3),
        np.array(counts, np.int64),
        np.array(corners, np.int64),
        _texture_coordinates(coordinates, uv_corners),
    )


def _index(word: str, so_far: int) -> int:
    """Zero-based index of a one-based one, or of a negative one counted back from the last."""
    value = int(word)
    index = value - 1 if value > 0 else so_far + value
    if value == 0 or index < 0:
        raise ValueError(word)
    return index


def _texture_coordinates(coordinates: list[list[float]], corners: list[int]) -> Points | None:
    """(corners, 2), (0, 0) where a corner has none; None if none has any or one names a missing one."""
    chosen = np.array(corners, np.int64)
    if not (chosen >= 0).any() or chosen.max() >= len(coordinates):
        return None
    return np.where((chosen >= 0)[:, None], np.array(coordinates, np.float64)[chosen], 0.0)
