"""The layout of a brick wall: the wall of the example by hand count, and what any wall must satisfy."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from brisance.errors import InputError
from brisance.model import BrickWall, Charge, Ground, Scene, Time
from brisance.objects.block import box_mesh
from brisance.objects.brick_wall import Layout, layout, wall_pieces
from brisance.piece import PieceMesh
from brisance.simulation import simulate

ROUNDING = 1e-12
"""Metres: far above the rounding of sums of lengths of a few metres, far below any joint."""

lengths = st.floats(0.01, 2.0)
walls = st.builds(
    lambda rows, columns, size, gap: BrickWall(
        rows=rows, columns=columns, brick_size=size, brick_mass=3.0, mortar_gap=gap * size[0]
    ),
    st.integers(1, 9),
    st.integers(1, 9),
    st.tuples(lengths, lengths, lengths),
    st.sampled_from([0.0, 0.03, 0.2]),
)


def example() -> BrickWall:
    return BrickWall(rows=6, columns=4, brick_size=(0.32, 0.16, 0.10), brick_mass=10.0)


def volume(mesh: PieceMesh) -> float:
    """Volume inside a mesh by the divergence theorem, each face as a fan."""
    total, start = 0.0, 0
    points = mesh.points.astype(np.float64)
    for count in mesh.face_counts.tolist():
        corners = points[mesh.face_indices[start : start + count]]
        start += count
        for second, third in pairwise(corners[1:]):
            total += float(corners[0] @ np.cross(second, third)) / 6
    return total


def spans(bricks: Layout) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    return bricks.centre - bricks.size / 2, bricks.centre + bricks.size / 2


def test_the_example_has_27_bricks_of_240_kg_in_all() -> None:
    bricks = layout(example())
    assert len(bricks.row) == 27
    assert int(bricks.whole.sum()) == 21  # 3 courses of 4, 3 courses of 3
    assert np.bincount(bricks.row).tolist() == [4, 5, 4, 5, 4, 5]
    result = simulate(
        Scene(charges=[Charge(mass=1, position=(0, 0.3, -15))], objects=[example()], time=Time(duration=0.01))
    )
    assert result.bodies.mass_kg.sum() == pytest.approx(240.0, rel=1e-14)
    assert np.unique(result.bodies.mass_kg).tolist() == [5.0, 10.0]
    assert (result.bodies.mass_kg == 5.0).sum() == 6


def test_half_bricks_end_the_odd_courses_and_joints_are_staggered() -> None:
    bricks = layout(example())
    for row in range(6):
        own = bricks.row == row
        halves = np.flatnonzero(~bricks.whole[own]).tolist()
        assert halves == ([] if row % 2 == 0 else [0, 4])
    low, high = spans(bricks)
    even = np.unique(np.round(high[bricks.row == 0, 0], 9))[:-1]
    odd = np.unique(np.round(high[bricks.row == 1, 0], 9))[:-1]
    np.testing.assert_allclose(even, [-0.32, 0.0, 0.32], atol=ROUNDING)
    np.testing.assert_allclose(odd, [-0.48, -0.16, 0.16, 0.48], atol=ROUNDING)
    assert low[:, 1].min() == 0.0


@given(walls)
@settings(max_examples=60, deadline=None)
def test_bricks_fill_the_wall_and_nothing_else(wall: BrickWall) -> None:
    bricks = layout(wall)
    length, height, thickness = wall.size
    low, high = spans(bricks)
    assert len(bricks.row) == wall.piece_count
    np.testing.assert_allclose(low.min(axis=0), [-length / 2, 0, -thickness / 2], atol=1e-9)
    np.testing.assert_allclose(high.max(axis=0), [length / 2, height, thickness / 2], atol=1e-9)
    joints_in_rows = wall.mortar_gap * wall.brick_size[1] * thickness * (len(bricks.row) - wall.rows)
    joints_between = wall.mortar_gap * (wall.rows - 1) * length * thickness
    filled = float(bricks.size.prod(axis=1).sum()) + joints_in_rows + joints_between
    assert filled == pytest.approx(length * height * thickness, rel=1e-9)


@given(walls)
@settings(max_examples=60, deadline=None)
def test_no_two_bricks_overlap(wall: BrickWall) -> None:
    low, high = spans(layout(wall))
    shared = np.minimum(high[:, None], high[None]) - np.maximum(low[:, None], low[None])
    overlaps = (shared > ROUNDING).all(axis=2)
    np.fill_diagonal(overlaps, False)
    assert not overlaps.any()


@given(walls)
@settings(max_examples=60, deadline=None)
def test_left_mirrors_right_to_the_last_bit(wall: BrickWall) -> None:
    bricks = layout(wall)
    for row in range(wall.rows):
        x = bricks.centre[bricks.row == row, 0]
        np.testing.assert_array_equal(x, -x[::-1])
        length = bricks.size[bricks.row == row, 0]
        np.testing.assert_array_equal(length, length[::-1])


@given(walls)
@settings(max_examples=40, deadline=None)
def test_a_side_is_buried_where_a_neighbour_or_the_ground_covers_it(wall: BrickWall) -> None:
    """A point just beyond the joint, off each side's middle, is in another brick or below the wall's foot."""
    bricks = layout(wall)
    low, high = spans(bricks)
    beyond = wall.mortar_gap + 1e-3 * wall.brick_size[0]
    for brick in range(len(bricks.row)):
        for side in range(6):
            axis, sign = side // 2, (-1, 1)[side % 2]
            point = bricks.centre[brick].copy()
            point[axis] += sign * (bricks.size[brick, axis] / 2 + min(beyond, wall.size[axis]))
            if axis == 1:
                # The middle of a side may face a joint of the next course, a quarter of a brick aside not.
                point[0] += bricks.size[brick, 0] / 4
                point[1] = bricks.centre[brick, 1] + sign * (wall.brick_size[1] + wall.mortar_gap)
            covered = bool(((low <= point) & (point <= high)).all(axis=1).any()) or point[1] < 0
            assert bricks.buried[brick, side] == covered, (brick, side)


def test_pieces_are_named_by_course_and_place_and_share_two_meshes() -> None:
    pieces = wall_pieces(example(), name="wall")
    assert pieces.names[:6] == [
        "wall_r0_c0",
        "wall_r0_c1",
        "wall_r0_c2",
        "wall_r0_c3",
        "wall_r1_c0",
        "wall_r1_c1",
    ]
    assert len({id(mesh) for mesh in pieces.meshes}) == 2
    assert pieces.meshes[0] is pieces.meshes[1]
    assert pieces.meshes[4] is pieces.meshes[8]


@given(lengths, lengths, lengths)
@settings(max_examples=30, deadline=None)
def test_a_box_mesh_is_closed_faces_outward_and_holds_its_volume(x: float, y: float, z: float) -> None:
    for bevel in (0.0, 0.04 * min(x, y, z)):
        mesh = box_mesh((x, y, z), bevel)
        edges: dict[tuple[int, int], int] = {}
        start = 0
        for count in mesh.face_counts.tolist():
            face = mesh.face_indices[start : start + count].tolist()
            start += count
            for edge in zip(face, [*face[1:], face[0]], strict=True):
                edges[edge] = edges.get(edge, 0) + 1
        assert all(number == 1 and edges.get((b, a)) == 1 for (a, b), number in edges.items())
        # An edge strip cuts off a prism of bevel²/2; single precision keeps 1e-6 of the rest.
        cut = 2 * bevel**2 * (x + y + z)
        assert volume(mesh) == pytest.approx(x * y * z - cut, rel=2e-3 if bevel else 1e-5)


def test_a_turned_wall_stands_where_its_position_and_rotation_say() -> None:
    wall = BrickWall(rows=2, columns=2, brick_mass=10, position=(5, 1, -2), rotation=(0, 90, 0))
    result = simulate(
        Scene(
            charges=[Charge(mass=1e-6, position=(0, 60, 0))],
            objects=[wall],
            ground=Ground(height=1),
            time=Time(duration=0.01, frame_rate=100),
        )
    )
    own = layout(wall).centre
    # A quarter turn about Y takes +x to -z and +z to +x.
    expected = np.column_stack([5 + own[:, 2], 1 + own[:, 1], -2 - own[:, 0]])
    np.testing.assert_allclose(result.positions[0], expected, atol=1e-6)
    np.testing.assert_allclose(np.abs(result.orientations[0, :, [0, 2]]), math.sqrt(0.5), atol=1e-6)


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        ({"brick_mass": 1, "density": 2}, "has both density and brick_mass"),
        ({}, "has neither density nor brick_mass"),
        ({"brick_mass": 1, "mortar_gap": 0.4}, "mortar_gap"),
        ({"brick_mass": 1, "rows": 0}, "rows must be 1 or more"),
        ({"brick_mass": 1, "columns": 2.5}, "columns must be a whole number"),
        ({"brick_mass": 1, "brick_size": (0.3, 0.0, 0.1)}, "brick_size.1 must be greater than 0"),
    ],
)
def test_an_impossible_wall_is_refused(keys: dict[str, Any], said: str) -> None:
    with pytest.raises(InputError, match=said):
        BrickWall(**keys)
