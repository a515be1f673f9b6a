"""Rotations: degrees about fixed axes become quaternions and matrices."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from brisance.rotation import matrix_from_quaternion, quaternion_from_degrees, rotate

ANGLES = st.tuples(*[st.floats(-360.0, 360.0)] * 3)


@pytest.mark.parametrize(
    ("degrees", "vector", "expected"),
    [
        ((90, 0, 0), (0, 1, 0), (0, 0, 1)),
        ((0, 90, 0), (0, 0, 1), (1, 0, 0)),
        ((0, 0, 90), (1, 0, 0), (0, 1, 0)),
        ((90, 90, 0), (0, 1, 0), (1, 0, 0)),
        ((90, 0, 90), (0, 0, 1), (1, 0, 0)),
    ],
)
def test_degrees_turn_about_x_then_y_then_z(
    degrees: tuple[float, ...], vector: tuple[float, ...], expected: tuple[float, ...]
) -> None:
    assert rotate(quaternion_from_degrees(degrees), vector) == pytest.approx(np.array(expected), abs=1e-15)


@given(angles=ANGLES)
def test_quaternion_is_the_product_of_three_turns(angles: tuple[float, ...]) -> None:
    quaternion = quaternion_from_degrees(angles)
    a, b, c = np.radians(angles)
    about_x = np.array([[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]])
    about_y = np.array([[np.cos(b), 0, np.sin(b)], [0, 1, 0], [-np.sin(b), 0, np.cos(b)]])
    about_z = np.array([[np.cos(c), -np.sin(c), 0], [np.sin(c), np.cos(c), 0], [0, 0, 1]])
    assert quaternion[0] >= 0.0
    assert np.linalg.norm(quaternion) == pytest.approx(1.0, abs=1e-15)
    assert matrix_from_quaternion(quaternion) == pytest.approx(about_z @ about_y @ about_x, abs=1e-14)
