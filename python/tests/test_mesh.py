"""Meshes of users: what is sound is weighed exactly, what is broken is repaired and said so."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from meshes import (
    CUBE_POINTS,
    CUBE_QUADS,
    CUBE_TRIANGLES,
    ROUNDING,
    Floats,
    body_of,
    body_of_faces,
    l_shape,
    shifted,
    solid,
    write_obj,
)
from pxr import Gf, Usd, UsdGeom

from brisance import _engine
from brisance.errors import InputError
from brisance.objects.mesh.repair import repair


def pair(first: Floats, second: Floats) -> tuple[Floats, list[tuple[int, ...]]]:
    """Two boxes as one mesh."""
    faces = [*CUBE_QUADS, *(tuple(index + 8 for index in quad) for quad in CUBE_QUADS)]
    return np.concatenate([first, second]), faces


def refusal(path: Path, **keys: object) -> str:
    """The sentence with which a mesh is refused."""
    with pytest.raises(InputError) as error:
        body_of(path, **keys)
    sentence = str(error.value)
    assert "\n" not in sentence
    assert "Traceback" not in sentence
    assert path.name in sentence
    return sentence


def test_box_is_weighed_exactly(tmp_path: Path) -> None:
    size = np.array([2.0, 0.5, 3.0])
    body = body_of_faces(tmp_path, shifted((5, 6, 7), size=size), CUBE_QUADS, density=700.0)
    volume, centre, inertia = solid(body)
    a, b, c = size**2
    assert body.warnings == []
    assert body.mass == pytest.approx(700.0 * 3.0, rel=ROUNDING)
    assert volume == pytest.approx(3.0, rel=ROUNDING)
    assert centre == pytest.approx(np.array([6.0, 6.25, 8.5]), rel=ROUNDING)
    assert inertia == pytest.approx(np.diag([b + c, a + c, a + b]) * 3.0 / 12, rel=ROUNDING, abs=1e-12)
    assert body.look.face_counts.tolist() == [4] * 6


def test_corner_tetrahedron_is_weighed_exactly(tmp_path: Path) -> None:
    faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    body = body_of_faces(tmp_path, [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], faces)
    volume, centre, inertia = solid(body)
    # Over it, ∫x² = 1/60 and ∫xy = 1/120 about the corner; moved to the centre: 1/160 and -1/480.
    assert volume == pytest.approx(1 / 6, rel=ROUNDING)
    assert centre == pytest.approx(np.full(3, 0.25), rel=ROUNDING)
    assert inertia == pytest.approx(np.eye(3) * (2 / 160 - 1 / 480) + np.ones((3, 3)) / 480, rel=ROUNDING)


def test_torus_approaches_its_closed_form(tmp_path: Path) -> None:
    major, minor = 1.0, 0.3
    torus = trimesh.creation.torus(major, minor, major_sections=160, minor_sections=96)
    body = body_of_faces(tmp_path, torus.vertices, torus.faces)
    volume, centre, inertia = solid(body)
    whole = 2 * math.pi**2 * major * minor**2
    along = whole * (major**2 + 0.75 * minor**2)
    across = whole * (0.5 * major**2 + 0.625 * minor**2)
    assert body.warnings == []
    # Facets of 1/160 and 1/96 of a turn cut (2π/n)²/6 = 0.1 % and less of an area, some of it twice.
    assert volume == pytest.approx(whole, rel=3e-3)
    assert centre == pytest.approx(np.zeros(3), abs=1e-9)
    assert np.diag(inertia) == pytest.approx(np.array([across, across, along]), rel=5e-3)
    assert not body.encloses((0, 0, 0))
    assert body.encloses((major, 0, 0))


def test_concave_mesh_is_kept_as_it_is(tmp_path: Path) -> None:
    body = body_of_faces(tmp_path, *l_shape())
    volume, centre, _ = solid(body)
    assert body.warnings == []
    assert volume == pytest.approx(3.0, rel=ROUNDING)
    assert centre == pytest.approx(np.array([2.5 / 3, 2.5 / 3, 0.5]), rel=ROUNDING)
    assert sorted(body.look.face_counts.tolist()) == [4, 4, 4, 4, 4, 4, 6, 6]
    assert body.encloses((0.5, 1.5, 0.5))
    assert not body.encloses((1.5, 1.5, 0.5))


def test_hollow_mesh_keeps_its_cavity(tmp_path: Path) -> None:
    points, faces = pair(shifted(0.0, size=2.0), shifted(0.5))
    hollow = [*faces[:6], *(face[::-1] for face in faces[6:])]
    body = body_of_faces(tmp_path, points, hollow)
    assert body.volume == pytest.approx(7.0, rel=ROUNDING)
    assert body.warnings == []
    assert not body.encloses((1.0, 1.0, 1.0))


def test_open_box_gets_its_lid(tmp_path: Path) -> None:
    body = body_of_faces(tmp_path, CUBE_POINTS, CUBE_QUADS[:5])
    assert body.volume == pytest.approx(1.0, rel=ROUNDING)
    assert len(body.warnings) == 1
    assert "1 hole was filled, of 1 m²" in body.warnings[0]
    assert len(body.look.face_counts) == 5


def test_inside_out_mesh_is_turned(tmp_path: Path) -> None:
    body = body_of_faces(tmp_path, CUBE_POINTS, [quad[::-1] for quad in CUBE_QUADS])
    assert body.volume == pytest.approx(1.0, rel=ROUNDING)
    assert "looked inwards and were turned outwards" in body.warnings[0]
    corners = body.look.points[body.look.face_indices].reshape(6, 4, 3)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert (np.einsum("fi,fi->f", normals, corners.mean(axis=1)) > 0).all()


def test_faces_of_mixed_winding_are_turned(tmp_path: Path) -> None:
    faces = [quad[::-1] if number in (1, 4) else quad for number, quad in enumerate(CUBE_QUADS)]
    body = body_of_faces(tmp_path, CUBE_POINTS, faces)
    assert body.volume == pytest.approx(1.0, rel=ROUNDING)
    assert "turned outwards" in body.warnings[0]


@pytest.mark.parametrize("order", [1, -1], ids=["same way", "back to back"])
def test_doubled_faces_count_once(tmp_path: Path, order: int) -> None:
    body = body_of_faces(tmp_path, CUBE_POINTS, [*CUBE_TRIANGLES, *(f[::order] for f in CUBE_TRIANGLES)])
    assert body.volume == pytest.approx(1.0, rel=ROUNDING)
    assert "12 faces lying on another were dropped" in body.warnings[0]


def test_two_sided_quads_count_once(tmp_path: Path) -> None:
    """The two sides of a quad are cut along different diagonals, so no triangle lies on another."""
    body = body_of_faces(tmp_path, CUBE_POINTS, [*CUBE_QUADS, *(quad[::-1] for quad in CUBE_QUADS)])
    assert body.volume == pytest.approx(1.0, rel=1e-6)
    assert len(body.warnings) == 1


def test_unwelded_triangles_are_joined(tmp_path: Path) -> None:
    points = CUBE_POINTS[np.array(CUBE_TRIANGLES).ravel()]
    body = body_of_faces(tmp_path, points, np.arange(36).reshape(12, 3))
    assert body.volume == pytest.approx(1.0, rel=ROUNDING)
    assert body.warnings == []


def test_overlapping_parts_count_once(tmp_path: Path) -> None:
    body = body_of_faces(tmp_path, *pair(shifted(0.0), shifted((0.5, 0.25, 0.25))))
    assert body.volume == pytest.approx(2.0 - 0.5 * 0.75**2, rel=1e-6)
    assert "were united for the physics" in body.warnings[0]
    assert len(body.look.face_counts) == 12


def test_separate_parts_are_one_body(tmp_path: Path) -> None:
    body = body_of_faces(tmp_path, *pair(shifted(0.0), shifted((3.0, 0.0, 0.0))))
    assert body.volume == pytest.approx(2.0, rel=ROUNDING)
    assert body.centre == pytest.approx(np.array([2.0, 0.5, 0.5]), rel=ROUNDING)
    assert body.warnings == []


def test_self_crossing_mesh_weighs_what_it_encloses(tmp_path: Path) -> None:
    """A prism over a bow tie: its two halves are wound against each other, and both are inside."""
    outline = np.array([(0, 0), (2, 1), (2, 0), (0, 1)], float)
    points = np.concatenate([np.column_stack([outline, np.full(4, z)]) for z in (0.0, 1.0)])
    sides = [(n, (n + 1) % 4, (n + 1) % 4 + 4, n + 4) for n in range(4)]
    body = body_of_faces(tmp_path, points, [(3, 2, 1, 0), (4, 5, 6, 7), *sides])
    assert len(body.warnings) == 1
    # Two triangles of 1/2 m² each; the outline is built from cells about 1/100 as wide as the mesh.
    assert body.volume == pytest.approx(1.0, rel=0.03)


def pentagram(thickness: float) -> tuple[Floats, list[tuple[int, ...]]]:
    """A prism over a star drawn in one stroke through five points of the unit circle."""
    turn = 2 * np.arange(5) * (2 * math.pi / 5)
    outline = np.column_stack([np.cos(turn), np.sin(turn)])
    points = np.concatenate([np.column_stack([outline, np.full(5, z)]) for z in (0.0, thickness)])
    ends = [(0, 1, 2), (0, 2, 3), (0, 3, 4)]
    sides = [(n, (n + 1) % 5, (n + 1) % 5 + 5, n + 5) for n in range(5)]
    return points, [*(end[::-1] for end in ends), *((a + 5, b + 5, c + 5) for a, b, c in ends), *sides]


STROKE_AREA = 2.5 * math.sin(4 * math.pi / 5)
"""Area [m²] that the stroke of the star runs around, its five-sided core counted twice."""
CORE_AREA = 2.5 * math.sin(2 * math.pi / 5) * (math.cos(2 * math.pi / 5) / math.cos(math.pi / 5)) ** 2


def test_core_of_a_star_counts_once(tmp_path: Path) -> None:
    body = body_of_faces(tmp_path, *pentagram(1.0))
    # The outline is built from lines about 1/150 of the star's width apart.
    assert body.volume == pytest.approx(STROKE_AREA - CORE_AREA, rel=0.01)
    assert "takes an outline of all that it encloses" in body.warnings[0]


def test_crossings_too_thin_for_an_outline_are_said(tmp_path: Path) -> None:
    body = body_of_faces(tmp_path, *pentagram(1e-4))
    assert body.volume == pytest.approx(STROKE_AREA * 1e-4, rel=1e-6)
    assert "its surface crosses itself" in body.warnings[0]


def test_touching_parts_lose_the_wall_between_them(tmp_path: Path) -> None:
    body = body_of_faces(tmp_path, *pair(shifted(0.0), shifted((1.0, 0.0, 0.0))))
    edges = body.vertices[body.triangles[:, 1:]] - body.vertices[body.triangles[:, :1]]
    assert body.volume == pytest.approx(2.0, rel=ROUNDING)
    assert np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1).sum() / 2 == pytest.approx(10.0)


@pytest.mark.parametrize("extra", [(1, 4, 10, 7), (10, 4, 12, 13)])
def test_inner_wall_and_fin_are_left_out(tmp_path: Path, extra: tuple[int, ...]) -> None:
    """A box cut across the middle of its x side, with a wall inside or a fin on its top."""
    outline = np.array([(-0.5, 0), (0, 0), (0.5, 0), (0.5, 1), (0, 1), (-0.5, 1)])
    fin = [(0, 2, 0), (0, 2, 1)]
    points = np.concatenate([*(np.column_stack([outline, np.full(6, z)]) for z in (0.0, 1.0)), fin])
    ends = [(0, 1, 4, 5), (1, 2, 3, 4)]
    sides = [(n, (n + 1) % 6, (n + 1) % 6 + 6, n + 6) for n in range(6)]
    faces = [*(end[::-1] for end in ends), *(tuple(n + 6 for n in end) for end in ends), *sides]
    body = body_of_faces(tmp_path, points, [*faces, extra])
    assert body.volume == pytest.approx(1.0, rel=ROUNDING)
    assert "2 faces of fins or inner walls were left out" in body.warnings[0]
    assert len(body.look.face_counts) == len(faces) + 1


def test_corner_that_is_not_a_number_is_cut_off(tmp_path: Path) -> None:
    points = CUBE_POINTS.copy()
    points[7] = np.nan
    body = body_of_faces(tmp_path, points, CUBE_QUADS)
    # What is left of three quads and the lid over the gap bound half the cube or more.
    assert 0.5 <= body.volume < 1.0
    assert "not a number" in body.warnings[0]
    assert np.isfinite(body.look.points).all()


@settings(max_examples=40, deadline=None, derandomize=True)
@given(
    st.lists(st.tuples(*[st.integers(0, 3)] * 3), min_size=3, max_size=9),
    st.lists(st.tuples(*[st.integers(0, 8)] * 3), min_size=1, max_size=20),
)
def test_any_soup_is_a_closed_body_or_refused(
    points: list[tuple[int, int, int]], triangles: list[tuple[int, int, int]]
) -> None:
    corners = np.array(triangles) % len(points)
    try:
        mesh = repair(np.array(points, float), corners, label="soup")
    except InputError:  # empty or flat
        return
    found = _engine.mass_properties(vertices=mesh.points, triangles=mesh.triangles)
    # Its points lie in a cube of 3 m; the outline may bulge out of it by half a cell.
    assert 0.0 < found["volume_m3"] < 28.0


def sheet(height: float) -> tuple[Floats, list[tuple[int, ...]]]:
    """A square sheet of 12 × 12 faces in waves of a height."""
    x, z = np.meshgrid(np.linspace(0, 1, 13), np.linspace(0, 1, 13), indexing="ij")
    points = np.stack([x, height * np.sin(7 * x) * np.cos(5 * z), z], axis=-1).reshape(-1, 3)
    corners = [13 * i + j for i in range(12) for j in range(12)]
    return points, [(n, n + 1, n + 14, n + 13) for n in corners]


def test_open_surface_is_carried_by_its_hull(tmp_path: Path) -> None:
    points, faces = sheet(0.2)
    body = body_of_faces(tmp_path, points, faces)
    assert body.volume == pytest.approx(trimesh.convex.convex_hull(points).volume, rel=1e-6)
    assert len(body.warnings) == 1
    assert "convex hull carries mass and loads" in body.warnings[0]
    assert len(body.look.face_counts) == len(faces)


def test_flat_sheet_is_refused(tmp_path: Path) -> None:
    sentence = refusal(write_obj(tmp_path / "sheet.obj", *sheet(0.0)))
    assert "flat" in sentence


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("empty.obj", b""),
        ("empty.stl", b""),
        ("empty.ply", b""),
        ("empty.glb", b""),
        ("empty.usdc", b""),
        ("points_only.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\n"),
        ("garbage.obj", b"f one two three\n"),
        ("missing_corner.obj", b"v 0 0 0\nv 1 0 0\nf 1 2 3\n"),
        ("not_numbers.obj", b"v nan 0 0\nv 1 0 0\nv 0 inf 0\nf 1 2 3\n"),
        ("garbage.stl", bytes(range(256)) * 3),
        ("garbage.ply", b"ply\nformat ascii 1.0\nelement vertex 3\nend_header\n"),
        ("garbage.glb", b"glTF" + bytes(range(200))),
        ("garbage.usda", b"#usda 1.0\ndef Mesh {"),
        ("garbage.usd", b"no stage"),
        ("prop.fbx", b"Kaydara FBX Binary"),
    ],
)
def test_unusable_file_is_one_sentence(tmp_path: Path, name: str, content: bytes) -> None:
    (tmp_path / name).write_bytes(content)
    refusal(tmp_path / name)


def test_missing_file_and_folder_are_one_sentence(tmp_path: Path) -> None:
    missing = tmp_path / "nowhere.obj"
    assert f"does not exist: {missing} is not there" in refusal(missing)
    (tmp_path / "folder.obj").mkdir()
    assert "is a folder" in refusal(tmp_path / "folder.obj")


def test_a_mesh_of_no_numbers_is_told_apart_from_an_empty_one(tmp_path: Path) -> None:
    (tmp_path / "nan.obj").write_text("v nan 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 3 4\n")
    assert "3 of its 3 have a corner that is not a finite number" in refusal(tmp_path / "nan.obj")
    (tmp_path / "line.obj").write_text("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 2\n")
    assert "is empty" in refusal(tmp_path / "line.obj")


def test_a_mesh_of_next_to_no_mass_is_refused(tmp_path: Path) -> None:
    path = write_obj(tmp_path / "box.obj", shifted(0.0), CUBE_QUADS)
    with pytest.raises(InputError, match=r'mesh "\w+" has a mass of 0\.05 kg, far less than the air'):
        body_of(path, mass=0.05)
    assert body_of(path, mass=0.2).mass == 0.2


@pytest.mark.parametrize("suffix", ["stl", "ply", "glb", "off"])
def test_formats_of_triangles(tmp_path: Path, suffix: str) -> None:
    torus = trimesh.creation.torus(1.0, 0.3, major_sections=24, minor_sections=12)
    path = tmp_path / f"torus.{suffix}"
    torus.export(path)
    body = body_of(path)
    # Files hold single precision or a few decimals.
    assert body.volume == pytest.approx(torus.volume, rel=1e-5)
    assert body.centre == pytest.approx(np.zeros(3), abs=1e-6)
    assert body.warnings == []


def test_transforms_of_a_glb_are_applied(tmp_path: Path) -> None:
    scene = trimesh.Scene()
    place = trimesh.transformations.translation_matrix([3.0, 0.0, 1.0])
    scene.add_geometry(trimesh.creation.box((1, 2, 1)), transform=place)
    scene.add_geometry(trimesh.creation.box((1, 2, 1)), transform=-np.diag([1.0, 1, 1, -1]))
    scene.export(tmp_path / "pair.glb")
    body = body_of(tmp_path / "pair.glb")
    assert body.volume == pytest.approx(4.0, rel=1e-6)
    assert body.centre == pytest.approx(np.array([1.5, 0.0, 0.5]), abs=1e-6)
    assert body.warnings == []


def write_usd(path: Path, *, metres: float, up: str, scale: tuple[float, float, float] = (1, 1, 1)) -> Path:
    """A box of 100 × 200 × 300 units with a corner in the origin, under a scaled transform."""
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageMetersPerUnit(stage, metres)
    UsdGeom.SetStageUpAxis(stage, up)
    UsdGeom.Xform.Define(stage, "/Root").AddScaleOp().Set(Gf.Vec3f(*scale))
    mesh = UsdGeom.Mesh.Define(stage, "/Root/Box")
    points = shifted(0.0, size=(100.0, 200.0, 300.0))
    mesh.CreatePointsAttr([Gf.Vec3f(*point) for point in points.tolist()])
    mesh.CreateFaceVertexCountsAttr([4] * 6)
    mesh.CreateFaceVertexIndicesAttr([index for quad in CUBE_QUADS for index in quad])
    mesh.CreateSubdivisionSchemeAttr("none")
    stage.GetRootLayer().Save()
    return path


@pytest.mark.parametrize("suffix", ["usda", "usdc"])
def test_usd_in_centimetres_with_z_up(tmp_path: Path, suffix: str) -> None:
    body = body_of(write_usd(tmp_path / f"box.{suffix}", metres=0.01, up="Z"))
    assert body.warnings == []
    assert body.volume == pytest.approx(6.0, rel=1e-6)
    # Z up becomes Y up: (x, y, z) goes to (x, z, -y).
    assert body.centre == pytest.approx(np.array([0.5, 1.5, -1.0]), rel=1e-6)
    assert np.ptp(body.look.points, axis=0) == pytest.approx(np.array([1.0, 3.0, 2.0]), rel=1e-6)


def test_negative_scale_keeps_faces_outwards(tmp_path: Path) -> None:
    body = body_of(write_usd(tmp_path / "box.usda", metres=0.01, up="Y", scale=(-1, 1, 2)))
    assert body.warnings == []
    assert body.volume == pytest.approx(12.0, rel=1e-6)
    assert body.centre == pytest.approx(np.array([-0.5, 1.0, 3.0]), rel=1e-6)
