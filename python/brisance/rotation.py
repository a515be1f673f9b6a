"""Rotations as a person types them (degrees about the axes) and as the engine takes them (unit quaternions).

Three angles mean: turn about the fixed x axis first, then about the fixed y axis, then about the fixed z
axis, so the matrix is ``Rz @ Ry @ Rx``. Quaternions are ``w, x, y, z``. A positive angle turns
counter-clockwise seen with the axis pointing at the viewer (right-handed).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray


def quaternion_from_degrees(rotation: Sequence[float]) -> NDArray[np.float64]:
    """The unit quaternion (4,) ``w, x, y, z``, ``w >= 0``, of angles [degrees] about x, then y, then z."""
    half = np.radians(np.asarray(rotation, dtype=np.float64)) / 2.0
    (cx, cy, cz), (sx, sy, sz) = np.cos(half), np.sin(half)
    quaternion = np.array(
        [
            cz * cy * cx + sz * sy * sx,
            cz * cy * sx - sz * sy * cx,
            cz * sy * cx + sz * cy * sx,
            sz * cy * cx - cz * sy * sx,
        ]
    )
    quaternion /= np.linalg.norm(quaternion)
    return -quaternion if quaternion[0] < 0.0 else quaternion


def matrix_from_quaternion(quaternion: ArrayLike) -> NDArray[np.float64]:
    """The rotation matrix (3, 3), acting on column vectors, of a unit quaternion ``w, x, y, z``."""
    w, x, y, z = np.asarray(quaternion, dtype=np.float64)
    return np.array(
        [
            [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
            [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
            [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
        ]
    )


def rotate(quaternion: ArrayLike, vectors: ArrayLike) -> NDArray[np.float64]:
    """``vectors`` (..., 3) turned by a unit quaternion ``w, x, y, z``."""
    rotated: NDArray[np.float64] = (
        np.asarray(vectors, dtype=np.float64) @ matrix_from_quaternion(quaternion).T
    )
    return rotated
