"""Broken panes from Python: what pieces, meshes and times of any pane must satisfy, and what is refused."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

import brisance as br
from brisance.errors import ArgumentError, InputError
from brisance.piece import PieceMesh

Array = NDArray[np.float64]

# A notch at the upper right, a square hole, both turned the wrong way round on purpose.
NOTCHED = [
    np.array([(0, 0), (0, 1.2), (0.6, 1.2), (0.6, 0.5), (1.2, 0.5), (1.2, 0)], dtype=float),
    np.array([(0.2, 0.15), (0.45, 0.15), (0.45, 0.4), (0.2, 0.4)]),
]
NOTCHED_AREA = 0.6 * 1.2 + 0.6 * 0.5 - 0.25 * 0.25


def area(ring: Array) -> float:
    """Signed area of a ring, about one of its points."""
    x, y = (ring - ring[0]).T
    return float(0.5 * (x @ np.roll(y, -1) - y @ np.roll(x, -1)))


def volume(mesh: PieceMesh) -> float:
    """Signed volume of a mesh of triangles: the sum of tetrahedra from the origin."""
    a, b, c = mesh.points.astype(np.float64)[mesh.face_indices.reshape(-1, 3)].transpose(1, 0, 2)
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)


def is_closed(mesh: PieceMesh) -> bool:
    """Whether every edge is used once each way."""
    triangles = mesh.face_indices.reshape(-1, 3)
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    there = sorted(map(tuple, edges.tolist()))
    back = sorted(map(tuple, edges[:, ::-1].tolist()))
    return there == back and len(set(there)) == len(there)


def check(broken: br.Fracture, whole: float) -> None:
    """What holds for every broken pane, of area ``whole`` [m²]."""
    areas = [[area(ring) for ring in rings] for rings in broken.polygons]
    assert all(outer > 0 for outer, *_ in areas)
    assert all(hole < 0 for _, *holes in areas for hole in holes)
    assert math.isclose(sum(map(sum, areas)), whole, rel_tol=1e-9)
    np.testing.assert_allclose(broken.solids.area_m2.sum(), whole, rtol=1e-9)

    times, parents = broken.crack_times, broken.engine.crack_parents
    assert (times[:, 1] >= times[:, 0]).all() and (times >= 0).all()
    assert (parents < np.arange(len(parents))).all()
    children = np.flatnonzero(parents >= 0)
    begin, end = broken.engine.crack_ends[:, :2], broken.engine.crack_ends[:, 2:]
    growth, parent = broken.engine.crack_growth_m, parents[children]
    along = np.einsum("ij,ij->i", begin[children] - begin[parent], end[parent] - begin[parent])
    length = np.linalg.norm(end[parent] - begin[parent], axis=1)
    share = np.divide(along, length**2, out=np.zeros_like(along), where=length > 0)
    there = begin[parent] + share[:, None] * (end[parent] - begin[parent])
    size = math.hypot(*(broken.bounds[1] - broken.bounds[0]))
    # A crack starts on its parent, and not before that came by; rings wait a while.
    assert (np.abs(there - begin[children]) <= 1e-9 * size).all()
    assert (share * length >= -1e-9 * size).all() and (share * length <= length + 1e-9 * size).all()
    passed = growth[parent, 0] + share * (growth[parent, 1] - growth[parent, 0])
    assert (growth[children, 0] >= passed - 1e-9 * size).all()
    last = times.max(initial=0.0)
    assert (broken.closed_at >= 0).all() and (broken.closed_at <= last * (1 + 1e-9)).all()

    assert len(broken.meshes) == len(broken.polygons)
    assert all(is_closed(mesh) for mesh in broken.meshes)
    # Points are float32: each coordinate is off by 6e-8 of itself at most, thickness and all.
    size = sum(volume(mesh) for mesh in broken.meshes)
    assert math.isclose(size, whole * broken.thickness, rel_tol=1e-6)


@settings(max_examples=40, deadline=None)
@given(
    width=st.floats(1e-3, 100),
    ratio=st.floats(0.1, 10),
    pieces=st.integers(1, 400),
    glass=st.sampled_from(["annealed", "tempered", "laminated"]),
    share=st.tuples(st.floats(0.05, 0.95), st.floats(0.05, 0.95)),
    thickness=st.floats(1e-4, 1),
    seed=st.integers(0, 2**63 - 1),
)
def test_any_pane_breaks_into_closed_pieces_that_fill_it(
    width: float,
    ratio: float,
    pieces: int,
    glass: Any,
    share: tuple[float, float],
    thickness: float,
    seed: int,
) -> None:
    height = width * ratio
    pattern = br.Pattern(glass=glass, pieces=pieces, seeds=[share])
    try:
        broken = br.fracture(pattern, width=width, height=height, thickness=thickness, seed=seed)
    except InputError as error:
        if "cannot be had" not in str(error):
            raise
        return
    check(broken, width * height)
    if glass != "tempered":
        assert abs(len(broken.polygons) - pieces) <= 0.1 * pieces + 1e-9


@pytest.mark.parametrize("glass", ["annealed", "tempered", "laminated"])
def test_a_pane_with_a_notch_and_a_hole_breaks(glass: Any) -> None:
    broken = br.fracture(br.Pattern(glass=glass, pieces=200), outline=NOTCHED)
    check(broken, NOTCHED_AREA)
    # The hole is a piece of nothing.
    middle = np.array([0.325, 0.275])
    assert np.linalg.norm(broken.solids.centroid_m - middle, axis=1).min() > 0.01


def test_meshes_know_their_place_and_what_was_cut() -> None:
    broken = br.fracture(br.Pattern(pieces=80), width=0.8, height=0.5, thickness=0.01)
    middle = np.array([0.4, 0.25])
    cut = 0.0
    for mesh, place in zip(broken.meshes, broken.positions, strict=True):
        corners = mesh.points[mesh.face_indices].astype(np.float64)
        assert mesh.uvs is not None
        # Texture coordinates are the place in the pane, whose middle is the origin.
        np.testing.assert_allclose(corners[:, :2] + place[:2] + middle, mesh.uvs, atol=2e-7)
        np.testing.assert_allclose(np.abs(corners[:, 2]), 0.005, rtol=1e-6)
        assert place[2] == 0
        triangles = corners.reshape(-1, 3, 3)
        normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]) / 2
        broken_faces = mesh.groups["broken"]
        assert (np.abs(normals[broken_faces, 2]) < 1e-12).all()
        cut += np.linalg.norm(normals[broken_faces], axis=1).sum()
        # The pane's own border is not a broken face.
        plane = triangles[:, :, :2] + place[:2] + middle
        for axis, side in ((0, 0.0), (0, 0.8), (1, 0.0), (1, 0.5)):
            on_side = (np.abs(plane[:, :, axis] - side) < 1e-7).all(axis=1)
            assert not np.isin(np.flatnonzero(on_side), broken_faces).any()
    # Every stretch of crack is a face of two pieces, but for the dangling ends that were cut off.
    perimeter = sum(
        np.linalg.norm(np.roll(ring, -1, axis=0) - ring, axis=1).sum()
        for rings in broken.polygons
        for ring in rings
    )
    assert cut == pytest.approx((perimeter - 2 * (0.8 + 0.5)) * 0.01, rel=1e-5)


def test_finely_turning_cracks_make_solids() -> None:
    # They curl up and meet themselves; what led there must not stay in a fragment as a double side.
    pattern = br.Pattern(
        literal=True,
        shape="segment",
        critical_length=0.05,
        wiggle_probability=1.0,
        wiggle_variance=70.0,
        wiggle_spacing=0.004,
    )
    for seed in range(5):
        check(br.fracture(pattern, seed=seed), 1.0)


def test_the_unbroken_pane_is_one_piece_without_broken_faces() -> None:
    broken = br.fracture(br.Pattern(pieces=1), width=2, height=1)
    check(broken, 2.0)
    assert len(broken.meshes) == 1
    assert broken.meshes[0].groups == {}


@pytest.mark.parametrize(
    ("argument", "said", "pattern", "pane"),
    [
        ("width", "above 0", {}, {"width": 0.0}),
        ("height", "above 0", {}, {"height": math.inf}),
        ("thickness", "above 0", {}, {"thickness": -1.0}),
        ("seed", "whole number", {}, {"seed": -1}),
        ("seed", "whole number", {}, {"seed": 2**63}),
        ("critical_length", "longer side of the pane, 1 m", {"critical_length": 1.5}, {}),
        ("critical_length", "of memory", {"critical_length": 1e-14}, {}),
        ("critical_length", "of memory", {"critical_length": 1e-8, "glass": "tempered"}, {}),
        ("pieces", "of memory", {"pieces": 10**12}, {}),
        ("wiggle_spacing", "of memory", {"wiggle_spacing": 1e-12}, {}),
        ("seeds", "0.9 0.9 lies outside the pane", {"seeds": [(0.9, 0.9)]}, {"outline": NOTCHED}),
        ("seeds", "0.25 0.2 lies outside", {"seeds": [(0.1, 0.1), (0.25, 0.2)]}, {"outline": NOTCHED}),
        ("outline", "three or more points", {}, {"outline": [[(0, 0), (1, 0)]]}),
        ("outline", "at least one ring", {}, {"outline": []}),
        ("outline", "crosses or touches itself", {}, {"outline": [[(0, 0), (2, 1), (2, 0), (0, 2)]]}),
        ("outline", "finite area", {}, {"outline": [[(0, 0), (1, 1), (2, 2)]]}),
        ("outline", "hole outside", {}, {"outline": [NOTCHED[0], NOTCHED[1] + 0.6]}),
    ],
)
def test_what_cannot_be_broken_is_told_by_its_argument(
    argument: str, said: str, pattern: dict[str, Any], pane: dict[str, Any]
) -> None:
    with pytest.raises(ArgumentError, match=f"^{argument} .*{said}.*[.]$") as caught:
        br.fracture(br.Pattern(**pattern), **pane)
    assert caught.value.argument == argument
