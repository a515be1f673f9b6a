"""Windows from a scene file to results: keys and sentences, breaking and holding, frames, USD and report."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pxr import Usd, UsdGeom

import brisance as br
from brisance.cli.main import main
from brisance.errors import InputError
from brisance.objects.window import glazing, whole_mesh
from brisance.scene_file import dump

SCENES = Path(__file__).parents[2] / "scenes"
CHARGE = br.Charge(mass=500, position=(0, 0, -110))


def scene(window: br.Window | None = None, **keys: object) -> br.Scene:
    """A pane of 1 m and 6 mm under 15 kPa that breaks into about 150 pieces, unless told otherwise."""
    window = window or br.Window(width=1, height=1, pattern=br.WindowPattern(pieces=150), **keys)
    return br.Scene(charges=[CHARGE], objects=[window], time=br.Time(duration=0.4, frame_rate=100))


def test_a_window_breaks_and_its_pieces_leave_the_frame() -> None:
    result = br.simulate(scene())
    pane = result.panes[0]
    assert pane.fate == "fails"
    assert pane.peak_stress_pa == pytest.approx(45e6)
    assert 14e3 < pane.peak_pressure_pa < 16e3
    assert 120 < pane.stop - pane.start < 180
    names = list(result.bodies.names)
    assert names[:4] == [f"window_0_frame_{bar}" for bar in range(4)]
    assert names[pane.start] == "window_0_0"
    assert [source.name for source in result.sources] == ["window_0_frame", "window_0"]
    # The bars stand, most of the glass flies toward +z, some of it stays.
    assert (result.positions[:, :4] == result.positions[0, :4]).all()
    way = result.positions[-1, pane.start :, 2] - result.positions[0, pane.start :, 2]
    stays = np.isnan(result.bodies.free_time_s[pane.start :])
    assert stays.sum() == pane.staying > 0
    assert way[~stays].min() > 0 and np.median(way[~stays]) > 0.5
    assert np.abs(way[stays]).max() < 0.02
    free = result.bodies.free_time_s[pane.start :][~stays]
    assert free.min() >= (pane.failure_time_s or np.inf)
    assert result.bodies.mass_kg[pane.start :].sum() == pytest.approx(15.0)
    # What flies took the impulse less what edges and frame took; drag in still air takes a little.
    given = result.bodies.impulse_n_s[pane.start :].sum(axis=0)[2]
    assert 0.1 * given < pane.frame_impulse_n_s[2] < 0.8 * given


def test_stronger_glass_holds_and_says_how_close_it_came(capsys: pytest.CaptureFixture[str]) -> None:
    result = br.simulate(scene(strength=1e9))
    pane = result.panes[0]
    assert (pane.fate, pane.failure_time_s, pane.stop - pane.start) == ("holds", None, 1)
    assert 45e6 < pane.peak_stress_pa < 1e9
    assert (result.positions == result.positions[0]).all()
    assert np.ptp(pane.amplitude) > 1e4
    code = main(["run", str(SCENES / "tempered_door.toml"), "--set", "charge.0.mass=20"])
    assert code == 0
    assert "door holds:" in capsys.readouterr().out


def test_all_at_once_is_the_thesis() -> None:
    result = br.simulate(scene(release="all at once", frame=False))
    pane = result.panes[0]
    assert (pane.fate, pane.staying, pane.peak_stress_pa) == ("in pieces", 0, 0.0)
    assert np.allclose(result.bodies.free_time_s, result.bodies.arrival_time_s, atol=1e-5)
    # Even a breath of air moves a pane that is in pieces already.
    gentle = scene(release="all at once", frame=False).model_copy(
        update={"charges": (br.Charge(mass=0.001, position=(0, 0, -20)),)}
    )
    assert br.simulate(gentle).panes[0].fate == "in pieces"


def test_laminated_glass_stays_in_one_bulge() -> None:
    result = br.simulate(scene(glass="laminated"))
    pane = result.panes[0]
    assert pane.fate == "fails" and pane.staying == pane.stop - pane.start > 100
    shift = result.positions[-1, pane.start :, 2]
    assert 0.05 < shift.max() < 0.5 and (shift >= 0).all()
    assert (result.positions[-1] == result.positions[-2]).all()


def test_tempered_glass_breaks_into_dice_whatever_the_load() -> None:
    window = br.Window(width=0.3, height=0.4, glass="tempered", strength=1e6)
    pane = br.simulate(scene(window)).panes[0]
    assert pane.stop - pane.start == pytest.approx(0.12 / 0.007**2, rel=0.1)


def test_the_load_says_how_finely_it_breaks() -> None:
    window = br.Window(width=0.4, height=0.4, strength=5e6)
    pane = br.simulate(scene(window)).panes[0]
    from brisance import _engine

    formula, _ = _engine.mean_fragment_area(pressure=pane.peak_pressure_pa)
    assert pane.mean_area_m2 == pytest.approx(formula, rel=0.1)


def test_beyond_the_measured_pressures_it_warns_and_says_what_was_done() -> None:
    near = br.Charge(mass=2, position=(0, 0, -2))
    window = br.Window(width=0.05, height=0.05, strength=1e5, frame=False)
    result = br.simulate(br.Scene(charges=[near], objects=[window], time=br.Time(duration=0.02)))
    assert any("falls below a square millimetre, which is used instead" in w for w in result.warnings)
    assert result.panes[0].mean_area_m2 == pytest.approx(1e-6, rel=0.1)


def test_same_seed_same_bytes_on_any_threads_and_windows_differ() -> None:
    two = br.Scene(
        charges=[CHARGE],
        objects=[
            br.Window(width=1, height=1, position=(x, 0, 0), pattern=br.WindowPattern(pieces=100))
            for x in (-1, 1)
        ],
        time=br.Time(duration=0.35, frame_rate=50),
    )
    one, four = br.simulate(two, threads=1), br.simulate(two, threads=4)
    assert one.positions.tobytes() == four.positions.tobytes()
    assert one.orientations.tobytes() == four.orientations.tobytes()
    left, right = one.panes
    assert left.failure_place_m != right.failure_place_m
    other = br.simulate(two.model_copy(update={"seed": 2}))
    assert other.positions.shape != one.positions.shape or (other.positions != one.positions).any()


def test_seeds_are_where_cracks_start() -> None:
    pattern = br.WindowPattern(pieces=60, seeds=[(0.25, 0.75)], wiggle_probability=0, rings=0)
    result = br.simulate(scene(br.Window(width=2, height=1, pattern=pattern)))
    pane = result.panes[0]
    uvs = [mesh.uvs for mesh in result.meshes[pane.start :]]
    seed = np.array([-0.5, 0.25])
    touching = sum(bool((np.abs(np.asarray(uv) - seed).max(axis=1) < 1e-5).any()) for uv in uvs)
    assert touching >= 7, "a star of nine arms meets in the seed"


def test_any_outline_may_be_a_pane(tmp_path: Path) -> None:
    (tmp_path / "arch.csv").write_text("0,0\n1,0\n1,1\n0.5,1.4\n0,1\n")
    for outline in ("arch.csv", [(0, 0), (1, 0), (1, 1), (0.5, 1.4), (0, 1)]):
        window = br.Window(outline=outline, strength=3e6, pattern=br.WindowPattern(pieces=40))
        arched = scene(window).model_copy(update={"base_folder": tmp_path})
        result = br.simulate(arched)
        pane = result.panes[0]
        assert pane.fate == "fails"
        assert result.bodies.mass_kg[pane.start :].sum() == pytest.approx(1.2 * 0.006 * 2500)
        assert len(result.sources[0].name) and pane.start == 5, "a bar along each side"
        middle = np.average(
            result.positions[0, pane.start :], axis=0, weights=result.bodies.mass_kg[pane.start :]
        )
        assert abs(middle[0]) < 1e-6 and abs(middle[1]) < 0.1


@given(width=st.floats(0.05, 4), height=st.floats(0.05, 4), thickness=st.floats(0.001, 0.05))
@settings(max_examples=30, deadline=None)
def test_the_whole_pane_is_a_closed_mesh(width: float, height: float, thickness: float) -> None:
    window = br.Window(width=width, height=height, thickness=thickness, frame=False)
    mesh = whole_mesh(glazing(window, base_folder=Path()).rings, thickness)
    _check_closed(mesh, volume=width * height * thickness)


def test_the_whole_pane_of_any_outline_is_a_closed_mesh() -> None:
    window = br.Window(outline=[(0, 0), (1, 0), (1, 1), (0.5, 1.4), (0, 1)], frame=False)
    _check_closed(whole_mesh(glazing(window, base_folder=Path()).rings, 0.01), volume=0.012)


def _check_closed(mesh: object, *, volume: float) -> None:
    points = np.asarray(mesh.points, dtype=float)  # type: ignore[attr-defined]
    faces = np.split(mesh.face_indices, np.cumsum(mesh.face_counts)[:-1])  # type: ignore[attr-defined]
    edges = [pair for face in faces for pair in zip(face, np.roll(face, -1), strict=True)]
    assert len(set(edges)) == len(edges)
    assert {(b, a) for a, b in edges} == set(edges)
    inside = sum(
        np.dot(points[face[0]], np.cross(points[face[i]], points[face[i + 1]])) / 6
        for face in faces
        for i in range(1, len(face) - 1)
    )
    assert inside == pytest.approx(volume, rel=1e-4)


@pytest.mark.parametrize(
    ("keys", "sentence"),
    [
        ("width = 1", "window.0 has no height; give the size of the pane in metres, or an outline."),
        ("width = -1\nheight = 1", "window.0.width must be greater than 0, not -1."),
        ("width = 1\nheight = 1\nthickness = 0.0005", "window.0.thickness must be greater than 0.000762"),
        ("width = 1\nheight = 1\nbite = -0.1", "window.0.bite must be 0 or more, not -0.1."),
        (
            "width = 1\nheight = 0.2\nbite = 0.1",
            "window.0 has a bite of 0.1 m, which leaves nothing of the pane",
        ),
        ("width = 1\nheight = 1\noutline = [[0, 0], [1, 0], [0, 1]]", "has both outline and width"),
        ("outline = [[0, 0], [1, 0]]", "has an outline of fewer than three points"),
        ("outline = 'nofile.svg'", "nofile.svg does not exist"),
        ("outline = [[0, 0], [1, 0], [2, 0]]", "leaves nothing of the pane"),
        ("outline = [[0, 0], [2, 1], [1, 0], [0, 3]]", "the outline crosses or touches itself"),
        ("width = 1\nheight = 1\nglas = 'annealed'", "window.0.glas is not a known key; did you mean glass?"),
        ("width = 1\nheight = 1\nglass = 'float'", "window.0.glass must be"),
        ("width = 1\nheight = 1\nrelease = 'later'", "window.0.release must be"),
        (
            "width = 1\nheight = 1\n[window.pattern]\nseeds = [[0.5, 1.5]]",
            "window.0.pattern.seeds.0.1 must be",
        ),
        (
            "width = 1\nheight = 1\n[window.pattern]\nseeds = [[0.0, 0.5]]",
            "lies outside the pane or on its border",
        ),
        ("width = 1\nheight = 1\n[window.pattern]\npieces = 10\nfrom = 'load'", "has both pieces and from"),
        ("width = 1\nheight = 1\n[window.pattern]\nfrom = 'bomb'", "window.0.pattern.from must be 'load'"),
        ("width = 1\nheight = 1\n[window.pattern]\nform = 'load'", "did you mean from?"),
        ("width = 1\nheight = 1\n[window.pattern]\nfork_angle = 190", "window.0.pattern.fork_angle must be"),
        ("width = 1\nheight = 1\nposition = [0, 0, -110]", "charge.0.position is inside the window"),
        (
            "width = 1\nheight = 1\n[window.pattern]\npieces = 2000000000",
            "window.0 (window_0) would break into",
        ),
        (
            "width = 1\nheight = 1\n[window.pattern]\ncritical_length = 4",
            "window.0 (window_0): critical length",
        ),
    ],
)
def test_wrong_windows_get_one_sentence(
    keys: str, sentence: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "bad.toml"
    path.write_text(f"[[charge]]\nmass = 500\nposition = [0, 0, -110]\n[[window]]\n{keys}\n")
    assert main(["run", str(path), "--frames", "2"]) == 2
    said = capsys.readouterr().err
    assert sentence in said
    assert said.count("\n") == 1 and "Traceback" not in said


def test_a_charge_may_go_off_before_the_scene_but_not_reach_it() -> None:
    early = br.Charge(mass=500, position=(0, 0, -110), time=-0.25)
    before = scene().model_copy(update={"charges": (early,)})
    assert br.simulate(before).bodies.arrival_time_s.min() < 0.03
    late = before.model_copy(update={"charges": (early.model_copy(update={"time": -1.0}),)})
    with pytest.raises(InputError, match=r"charge 0 goes off so long before .* let it go off at -0\.26"):
        br.simulate(late)


def test_a_scene_with_windows_is_written_and_read_back(tmp_path: Path) -> None:
    loaded = br.load(SCENES / "shopfront.toml")
    dump(loaded, tmp_path / "again.toml")
    again = br.load(tmp_path / "again.toml")
    assert again.objects == loaded.objects and again.charges == loaded.charges


@pytest.mark.parametrize("layout", ["prims", "instancer"])
def test_usd_shows_the_pane_whole_until_it_breaks(layout: str, tmp_path: Path) -> None:
    early = br.Charge(mass=500, position=(0, 0, -110), time=-0.26)
    shot = scene().model_copy(update={"charges": (early,), "time": br.Time(duration=0.1, frame_rate=240)})
    result = br.simulate(shot)
    result.write(tmp_path / "w.usdc", layout=layout)
    stage = Usd.Stage.Open(str(tmp_path / "w.usdc"))
    pane = UsdGeom.Mesh(stage.GetPrimAtPath("/World/window_0_pane"))
    broken = pane.GetPrim().GetAttribute("brisance:broken_frame").Get()
    assert broken == np.searchsorted(result.times, result.panes[0].failure_time_s)
    assert pane.GetPrim().GetAttribute("brisance:fate").Get() == "fails"
    extents = [np.ptp(np.array(pane.GetPointsAttr().Get(frame)), axis=0).max() for frame in range(broken + 2)]
    assert min(extents[:broken]) > 0.99 and max(extents[broken:]) == 0.0
    bow = np.array(pane.GetPointsAttr().Get(broken - 1))[:, 2].max() - 0.003
    deepest = result.panes[0].deflection.max() * result.panes[0].amplitude[broken - 1]
    assert bow == pytest.approx(deepest, abs=1e-6)
    pieces = stage.GetPrimAtPath("/World/window_0")
    for frame, shown in ((0, 1e-6), (broken - 1, 1e-6), (broken, 1.0), (broken + 5, 1.0)):
        if layout == "instancer":
            scales = np.array(UsdGeom.PointInstancer(pieces).GetScalesAttr().Get(frame))
            assert np.allclose(scales, shown)
        else:
            cube = UsdGeom.Xformable(pieces).ComputeLocalToWorldTransform(frame)
            assert cube.ExtractRotationMatrix().GetDeterminant() ** (1 / 3) == pytest.approx(1.0) or shown < 1
            assert abs(cube.GetRow3(0).GetLength() - shown) < 1e-6
    assert stage.GetPrimAtPath("/World/window_0_frame")
    assert stage.GetPrimAtPath("/World/Materials/glass_broken")


def test_the_report_tells_of_windows(tmp_path: Path) -> None:
    result = br.simulate(scene())
    result.write(tmp_path / "w.json")
    told = json.loads((tmp_path / "w.json").read_text())
    window = told["windows"][0]
    assert window["name"] == "window_0" and window["fate"] == "fails"
    assert window["pieces"] == sum(body["source"] == "window_0" for body in told["bodies"])
    assert window["staying"] == sum(
        body["free_time_s"] is None and body["source"] == "window_0" for body in told["bodies"]
    )
    assert told["timing_s"]["fracture"] > 0


def test_inspect_tells_of_panes_without_breaking_them(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    assert main(["inspect", str(SCENES / "shopfront.toml")]) == 0
    said = capsys.readouterr().out
    assert "before panes break" in said
    assert any(line.split()[:2] == ["left", "window"] for line in said.splitlines())
    assert (
        main(["inspect", str(SCENES / "shopfront.toml"), "--occlusion", "-o", str(tmp_path / "map.png")]) == 0
    )


def test_the_car_shelters_the_pane_behind_it() -> None:
    panes = {pane.name: pane for pane in br.simulate(br.load(SCENES / "shopfront.toml")).panes}
    assert panes["left"].peak_pressure_pa < 0.6 * panes["right"].peak_pressure_pa
    assert (panes["left"].failure_time_s or 0) > (panes["right"].failure_time_s or 1)


def test_pieces_never_share_a_name_with_another_body() -> None:
    block = br.Block(name="window_0_7", size=(0.1, 0.1, 0.1), position=(5, 0, 0), mass=1)
    clash = scene().model_copy(update={"objects": (block, *scene().objects)})
    with pytest.raises(InputError, match=r"its piece 'window_0_7' has the name of a piece of window_0_7"):
        br.simulate(clash)


def test_the_summary_says_when_a_pane_breaks_after_the_last_frame(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", str(SCENES / "window.toml"), "--frames", "2"]) == 0
    assert "after these frames" in capsys.readouterr().out


def test_a_point_given_twice_is_refused_in_one_sentence() -> None:
    window = br.Window(outline=[(0, 0), (0, 0), (1, 0), (1, 1), (0, 1)])
    with pytest.raises(InputError, match="outline has a point twice in turn"):
        br.simulate(scene(window))
