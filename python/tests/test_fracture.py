"""The command ``brisance fracture``: what it says, what it writes in every format, and what it refuses."""

from __future__ import annotations

import itertools
import json
import os
import re
import signal
import subprocess
import sys
import time
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.image import imread
from pxr import Usd, UsdGeom, UsdPhysics, UsdShade, UsdValidation

import brisance as br
from brisance.cli.main import main
from brisance.formats.pattern_picture import STEPS, chains
from brisance.formats.usd_summary import summarise

Capture = pytest.CaptureFixture[str]

PROGRAM = "import sys; from brisance.cli.main import main; sys.exit(main(sys.argv[1:]))"
NAMES = ("pane.svg", "pane.png", "pane.json", "pane.usdc", "pane.usda", "pane.usdz")
OPTIONS = """
    --width 0.7 --height 0.4 --pieces 50 --glass laminated --shape cross --fork-angle 35 --fork-variance 10
    --wiggle-probability 0.3 --wiggle-variance 30 --wiggle-spacing 0.01 --rings 0.2 --reach 0.6 --toward 30
    --thickness 0.01 --seed 9 --seed-at 0.3 0.4 --seed-at 0.8 0.7
"""
DENSITY = 2500.0
"""Of soda-lime glass [kg/m³]."""

NOTCHED = """x,y
0,0
1.2,0
1.2,0.5
0.6,0.5
0.6,1.2
0,1.2

0.2,0.15
0.45,0.15
0.45,0.4
0.2,0.4
"""


def done(capsys: Capture, *arguments: str | Path) -> str:
    """Run the command, which must succeed and say nothing on stderr; return what it printed."""
    code = main(["fracture", *map(str, arguments)])
    out, err = capsys.readouterr()
    assert (code, err) == (0, "")
    return out


def refused(capsys: Capture, *arguments: str | Path) -> str:
    """Run the command on wrong input: exit code 2 and one sentence."""
    assert main(["fracture", *map(str, arguments)]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("brisance: ") and err.endswith((".\n", "?\n")) and err.count("\n") == 1
    return err


@pytest.fixture(scope="module")
def broken() -> br.Fracture:
    """A pane in about 120 pieces."""
    return br.fracture(br.Pattern(pieces=120), width=0.9, height=0.6, thickness=0.004, seed=3)


@pytest.fixture(scope="module")
def stage(broken: br.Fracture, tmp_path_factory: pytest.TempPathFactory) -> Usd.Stage:
    """The same, written as USD and opened again."""
    path = tmp_path_factory.mktemp("usd") / "pane.usdc"
    broken.write(path)
    return Usd.Stage.Open(str(path))


def meshes(stage: Usd.Stage) -> list[UsdGeom.Mesh]:
    """The pieces of a pane."""
    return [UsdGeom.Mesh(prim) for prim in stage.GetPrimAtPath("/World/pane").GetChildren()]


def test_the_command_is_the_python_interface(capsys: Capture, tmp_path: Path) -> None:
    by_command, by_python = tmp_path / "command", tmp_path / "python"
    pattern = br.Pattern(
        pieces=50,
        glass="laminated",
        shape="cross",
        fork_angle=35.0,
        fork_variance=10.0,
        wiggle_probability=0.3,
        wiggle_variance=30.0,
        wiggle_spacing=0.01,
        rings=0.2,
        reach=0.6,
        toward=30.0,
        seeds=[(0.3, 0.4), (0.8, 0.7)],
    )
    pane = br.fracture(pattern, width=0.7, height=0.4, thickness=0.01, seed=9)
    for folder in (by_command, by_python):
        folder.mkdir()
    outputs = itertools.chain.from_iterable(("-o", by_command / name) for name in NAMES)
    done(capsys, *OPTIONS.split(), *outputs)
    for name in NAMES:
        pane.write(by_python / name)
        seen, truth = (by_command / name).read_bytes(), (by_python / name).read_bytes()
        assert without_timing(seen) == without_timing(truth), name


def without_timing(file: bytes) -> bytes:
    """A file without the line that says how long the work took."""
    return re.sub(rb'(?m)^"timing_s".*$', b"", file)


def test_it_says_what_came_of_it(capsys: Capture, tmp_path: Path) -> None:
    path = tmp_path / "pane.json"
    out = done(capsys, "--pieces", "100", "-o", path)
    data = json.loads(path.read_text())
    count, length = len(data["fragments"]), data["parameters"]["critical_length_m"]
    last = max(crack["end_s"] for crack in data["cracks"])
    made = f"{count} fragments from a critical length of {length:.4g} m"
    assert out == f"{made}, cracked in {1e3 * last:.3g} ms: {path}\n"
    assert 90 <= count <= 110
    # The length that it names gives the same number again.
    again = done(capsys, "--critical-length", repr(length))
    assert again.startswith(f"{count} fragments ") and "nothing written; add -o" in again
    assert done(capsys, "--pieces", "30", "--quiet", "-o", path) == ""


def test_help_has_an_example(capsys: Capture) -> None:
    assert "brisance fracture --width 1.2 --height 0.8 --pieces 300 -o pane.svg" in done(capsys, "--help")


@pytest.mark.parametrize("glass", ["annealed", "tempered"])
def test_json_holds_polygons_and_the_tree_of_cracks(glass: str, capsys: Capture, tmp_path: Path) -> None:
    outline, path = tmp_path / "pane.csv", tmp_path / "pane.json"
    outline.write_text(NOTCHED)
    done(capsys, "--outline", outline, "--glass", glass, "--pieces", "90", "--seed", "5", "-o", path)
    data = json.loads(path.read_text())
    assert set(data) == {"parameters", "outline", "fragments", "cracks", "timing_s"}
    assert all(set(f) == {"polygon", "holes", "area_m2", "closed_at_s"} for f in data["fragments"])
    assert all(set(c) == {"from", "to", "start_s", "end_s", "parent"} for c in data["cracks"])
    assert data["parameters"]["seed"] == 5 and data["parameters"]["pattern"]["glass"] == glass
    assert all(seconds > 0 for seconds in data["timing_s"].values())

    whole = sum(area(ring) for ring in data["outline"])
    assert whole == pytest.approx(0.6 * 1.2 + 0.6 * 0.5 - 0.25 * 0.25, rel=1e-12)
    total = 0.0
    for fragment in data["fragments"]:
        outer, holes = area(fragment["polygon"]), [area(hole) for hole in fragment["holes"]]
        assert outer > 0 and all(hole < 0 for hole in holes)
        assert fragment["area_m2"] == pytest.approx(outer + sum(holes), rel=1e-9, abs=1e-15)
        total += fragment["area_m2"]
    assert total == pytest.approx(whole, rel=1e-9)

    last = max(crack["end_s"] for crack in data["cracks"])
    assert all(0 <= f["closed_at_s"] <= last * (1 + 1e-9) for f in data["fragments"])
    for number, crack in enumerate(data["cracks"]):
        assert 0 <= crack["start_s"] <= crack["end_s"]
        assert crack["parent"] is None or 0 <= crack["parent"] < number
    assert any(crack["parent"] is None and crack["start_s"] == 0 for crack in data["cracks"])


def area(ring: list[list[float]]) -> float:
    """Signed area of a ring."""
    x, y = (np.array(ring) - ring[0]).T
    return float(0.5 * (x @ np.roll(y, -1) - y @ np.roll(x, -1)))


@pytest.mark.parametrize(
    "pattern",
    [
        br.Pattern(pieces=120),
        br.Pattern(pieces=120, glass="tempered"),
        # Straight cracks run through many ages and are cut up.
        br.Pattern(pieces=60, wiggle_probability=0.0, rings=0.0),
    ],
)
def test_svg_draws_every_crack_once(pattern: br.Pattern, tmp_path: Path) -> None:
    pane = br.fracture(pattern, width=0.9, height=0.6)
    pane.write(tmp_path / "pane.svg")
    root = ElementTree.parse(tmp_path / "pane.svg").getroot()
    space = {"svg": "http://www.w3.org/2000/svg"}
    groups = root.findall("svg:g[@id='cracks']/svg:g", space)
    assert 2 <= len(groups) <= STEPS
    assert len({group.get("stroke") for group in groups}) == len(groups)
    drawn = [lines(path) for group in groups for path in group.findall("svg:path", space)]
    ends = 1e3 * pane.engine.crack_ends
    lengths = np.hypot(ends[:, 2] - ends[:, 0], ends[:, 3] - ends[:, 1])
    total = sum(np.linalg.norm(np.diff(line, axis=0), axis=1).sum() for line in drawn)
    # Coordinates are rounded to a millionth of the pane.
    assert total == pytest.approx(lengths.sum(), rel=1e-4)
    # Ends of cracks are corners of lines, at their place on the page: y downward, 27 mm of margin.
    corners = np.round(np.concatenate(drawn), 2)
    wanted = np.concatenate([ends[:, :2], ends[:, 2:]]) * (1, -1) + (27, 627)
    gaps = [np.abs(corners - point).max(axis=1).min() for point in wanted[:: max(1, len(wanted) // 200)]]
    assert max(gaps) <= 0.011
    assert float(root.get("width", "").removesuffix("mm")) == pytest.approx(900 + 2 * 27)


def lines(path: ElementTree.Element) -> Any:
    """The points of a drawn path."""
    return np.array([float(number) for number in path.get("d", "").strip("MZ").split()]).reshape(-1, 2)


def test_ages_of_a_drawing_are_those_of_the_cracks(broken: br.Fracture) -> None:
    growth, ends = broken.engine.crack_growth_m, broken.engine.crack_ends
    first = {tuple(end[:2]): start for end, start in zip(ends.tolist(), growth[:, 0], strict=True)}
    times = []
    for age, found in chains(broken):
        known = [float(broken.time(first[tuple(line[0])])) for line in found if tuple(line[0]) in first]
        times += [(age, time) for time in known]
    ages, when = np.array(times).T
    # Within an age all starts are earlier than those of the next one.
    for step in range(STEPS - 1):
        before, after = when[ages <= step], when[ages > step]
        assert not len(before) or not len(after) or before.max() <= after.min() + 1e-12


def test_png_is_a_picture_of_the_asked_size(capsys: Capture, tmp_path: Path) -> None:
    path = tmp_path / "pane.png"
    done(capsys, "--pieces", "60", "--size", "400x300", "-o", path)
    few = imread(path)[..., :3]
    assert few.shape[:2] == (300, 400)
    done(capsys, "--pieces", "600", "--size", "400x300", "-o", path)
    many = imread(path)[..., :3]
    inked = [float((picture < 0.6).any(axis=2).mean()) for picture in (few, many)]
    assert 0.02 < inked[0] < inked[1] < 0.5
    done(capsys, "--pieces", "60", "--width", "2", "-o", path)
    assert imread(path).shape[1] == round(2400 * 1.06)


def test_usd_pieces_are_closed_and_fill_the_pane(broken: br.Fracture, stage: Usd.Stage) -> None:
    pieces = meshes(stage)
    assert len(pieces) == len(broken.polygons)
    total, low, high = 0.0, np.full(3, np.inf), np.full(3, -np.inf)
    for mesh in pieces:
        assert set(mesh.GetFaceVertexCountsAttr().Get()) == {3}
        triangles = np.array(mesh.GetFaceVertexIndicesAttr().Get()).reshape(-1, 3)
        edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
        assert sorted(map(tuple, edges)) == sorted(map(tuple, edges[:, ::-1]))
        place = UsdGeom.Xformable(mesh).GetLocalTransformation().ExtractTranslation()
        points = np.array(mesh.GetPointsAttr().Get(), dtype=np.float64)
        a, b, c = points[triangles].transpose(1, 0, 2)
        total += np.einsum("ij,ij->", a, np.cross(b, c)) / 6
        low = np.minimum(low, (points + place).min(axis=0))
        high = np.maximum(high, (points + place).max(axis=0))
    # float32 points: each coordinate is off by 6e-8 of itself at most.
    assert total == pytest.approx(0.9 * 0.6 * 0.004, rel=1e-6)
    np.testing.assert_allclose(low, [-0.45, -0.3, -0.002], atol=1e-7)
    np.testing.assert_allclose(high, [0.45, 0.3, 0.002], atol=1e-7)


def test_usd_pieces_carry_looks_facts_and_mass(broken: br.Fracture, stage: Usd.Stage) -> None:
    pane = stage.GetPrimAtPath("/World/pane")
    assert pane.GetAttribute("brisance:critical_length_m").Get() == broken.critical_length
    total = 0.0
    for index, mesh in enumerate(meshes(stage)):
        prim = mesh.GetPrim()
        assert prim.GetAttribute("brisance:closed_at_s").Get() == broken.closed_at[index]
        subsets = {
            subset.GetPrim().GetName(): list(subset.GetIndicesAttr().Get())
            for subset in UsdGeom.Subset.GetGeomSubsets(mesh, "face", "materialBind")
        }
        assert set(subsets) == {"broken", "outside"}
        assert sorted(subsets["broken"] + subsets["outside"]) == list(range(mesh.GetFaceCount()))
        for name, material in (("broken", "glass_broken"), ("outside", "glass")):
            bound, _ = UsdShade.MaterialBindingAPI(prim.GetChild(name)).ComputeBoundMaterial()
            assert bound.GetPrim().GetName() == material
        uvs = np.array(UsdGeom.PrimvarsAPI(mesh).GetPrimvar("st").Get())
        np.testing.assert_array_equal(uvs, broken.meshes[index].uvs)
        api = UsdPhysics.MassAPI(prim)
        total += api.GetMassAttr().Get()
        # Principal moments and axes give the engine's tensor back, in single precision.
        axes = api.GetPrincipalAxesAttr().Get()
        assert tuple(axes.GetImaginary())[:2] == (0, 0)
        angle = 2 * np.arctan2(axes.GetImaginary()[2], axes.GetReal())
        turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
        tensor = turn @ np.diag(api.GetDiagonalInertiaAttr().Get()) @ turn.T
        truth = broken.solids.inertia_kg_m2[index].reshape(3, 3)
        np.testing.assert_allclose(tensor, truth, atol=1e-6 * truth.max())
    assert total == pytest.approx(0.9 * 0.6 * 0.004 * DENSITY, rel=1e-6)


@pytest.mark.parametrize("suffix", [".usdc", ".usda", ".usdz"])
def test_every_validator_of_usd_is_satisfied(suffix: str, broken: br.Fracture, tmp_path: Path) -> None:
    path = tmp_path / f"pane{suffix}"
    broken.write(path)
    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    found = UsdValidation.ValidationContext(validators).Validate(Usd.Stage.Open(str(path)))
    assert [error.GetErrorAsString() for error in found] == []
    summary = summarise(path)
    assert (summary.pieces, summary.moving, summary.seed) == (len(broken.polygons), 0, 3)
    assert summary.mass_kg == pytest.approx(0.9 * 0.6 * 0.004 * DENSITY, rel=1e-9)


def test_the_same_seed_gives_the_same_bytes_in_another_process(tmp_path: Path) -> None:
    for folder, threads in (("a", "1"), ("b", "4")):
        (tmp_path / folder).mkdir()
        outputs = itertools.chain.from_iterable(("-o", f"{folder}/{name}") for name in NAMES)
        subprocess.run(
            [
                sys.executable,
                "-c",
                PROGRAM,
                *("fracture", "--pieces", "150", "--seed", "11", "--seed-at", "0.3", "0.6", *outputs),
            ],
            cwd=tmp_path,
            env={"RAYON_NUM_THREADS": threads},
            check=True,
            capture_output=True,
        )
    for name in NAMES:
        first, second = ((tmp_path / folder / name).read_bytes() for folder in "ab")
        assert without_timing(first) == without_timing(second), name


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ("--critical-length 0", "--critical-length must be greater than 0"),
        ("--critical-length -0.1", "--critical-length must be greater than 0"),
        ("--critical-length nan", "--critical-length must be a finite number"),
        (
            "--critical-length 3 --width 2",
            "--critical-length must be at most the longer side of the pane, 2 m",
        ),
        ("--critical-length 1e-15", "--critical-length asks for about"),
        ("--pieces 0", "--pieces must be 1 or more"),
        ("--pieces 1000000000000", "--pieces asks for about 1,000,000,000,000 fragments"),
        ("--pieces 9 --critical-length 0.1", "--pieces and --critical-length"),
        ("--fork-angle 0", "--fork-angle must be greater than 0"),
        ("--fork-angle 180", "--fork-angle must be less than 180"),
        ("--fork-variance 181", "--fork-variance must be 180 or less"),
        ("--wiggle-probability 1.5", "--wiggle-probability must be 1 or less"),
        ("--wiggle-variance -1", "--wiggle-variance must be 0 or more"),
        ("--wiggle-spacing 0", "--wiggle-spacing must be greater than 0"),
        ("--wiggle-spacing 1e-12", "--wiggle-spacing asks for about"),
        ("--rings 2", "--rings must be 1 or less"),
        ("--reach 0", "--reach must be greater than 0"),
        ("--toward inf", "--toward must be a finite number"),
        ("--glass bullet-proof", "--glass"),
        ("--shape dot", "--shape"),
        ("--width 0", "--width must be a finite number above 0"),
        ("--height nan", "--height must be a finite number above 0"),
        ("--thickness -1", "--thickness must be a finite number above 0"),
        ("--seed -1", "--seed must be a whole number"),
        ("--seed-at 0.5", "--seed-at takes two numbers"),
        ("--seed-at 0.5 1.5", "--seed-at must be shares of width and height from 0 to 1"),
        ("--seed-at 0 0.5", "--seed-at 0 0.5 lies outside the pane or on its border"),
        ("--seed-at 0.8 0.8 --outline notched.csv", "--seed-at 0.8 0.8 lies outside"),
        ("--seed-at 0.25 0.25 --outline notched.csv", "--seed-at 0.25 0.25 lies outside"),
        ("--outline none.csv", "none.csv does not exist"),
        ("--outline .", "cannot be read as an outline"),
        ("--outline outline.dxf", "give .csv, .json or .svg"),
        ("--outline open.csv", "fewer than three points"),
        ("--outline words.csv", "line 2: one, two is not a point"),
        ("--outline crossed.json", "--outline crossed.json crosses or touches itself"),
        ("--outline notched.csv --width -1", "--width must be a finite number above 0"),
        ("--size wide", "--size wide is not a size"),
        ("-o pane.obj", "no suffix that names a format"),
        ("-o none/pane.svg", "the folder none does not exist"),
        ("-o .", "is a directory"),
        ("--bogus", "--bogus"),
    ],
)
def test_wrong_input_is_one_sentence_and_leaves_files_alone(
    options: str, said: str, capsys: Capture, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("notched.csv").write_text(NOTCHED)
    Path("open.csv").write_text("0,0\n1,1\n")
    Path("words.csv").write_text("x,y\none,two\n")
    Path("crossed.json").write_text("[[[0, 0], [2, 1], [2, 0], [0, 2]]]")
    Path("kept.svg").write_text("precious")
    before = sorted(tmp_path.iterdir())
    assert said in refused(capsys, *options.split(), "-o", "kept.svg")
    assert sorted(tmp_path.iterdir()) == before
    assert Path("kept.svg").read_text() == "precious"


@pytest.mark.skipif(os.name == "nt", reason="Windows sends no interrupt to one process")
def test_ctrl_c_stops_the_cracks(tmp_path: Path) -> None:
    path = tmp_path / "pane.svg"
    path.write_text("precious")
    # So many pieces are searched for over many seconds.
    arguments = ["fracture", "--pieces", "500000", "-o", str(path)]
    program = PROGRAM.replace("sys.exit", "print('ready', flush=True); sys.exit")
    with subprocess.Popen(
        [sys.executable, "-c", program, *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as process:
        try:
            assert process.stdout is not None
            assert process.stdout.readline() == "ready\n"
            time.sleep(1.0)  # so that it is in the engine; sooner is heard as well
            process.send_signal(signal.SIGINT)
            out, err = process.communicate(timeout=30)
        finally:
            process.kill()
    assert (process.returncode, out, err) == (130, "", "brisance: stopped.\n")
    assert path.read_text() == "precious"
    assert list(tmp_path.iterdir()) == [path]


def test_a_picture_too_large_is_refused(capsys: Capture, tmp_path: Path) -> None:
    assert "--size" in refused(capsys, "--pieces", "60", "--size", "90000x90000", "-o", tmp_path / "pane.png")
    assert list(tmp_path.iterdir()) == []
