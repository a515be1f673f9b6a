"""Rendering: where the camera stands, what a video holds, what is said when it fails, and one real picture.

Framing is checked against the definition of a perspective picture, not by the formulas that place the camera.
"""

from __future__ import annotations

import importlib.util
import os
import sys
import textwrap
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from pxr import Gf, Sdf, Usd, UsdGeom, Vt

from brisance.errors import BrisanceError, InputError
from brisance.render import blender, render
from brisance.render.blender_worker import describe
from brisance.render.camera import VIEWS, CameraPose, frame, looking_from
from brisance.render.job import Job
from brisance.render.noise import fractal_noise
from brisance.render.output import Output, OutputKind
from brisance.render.shot import action, place, prepare
from brisance.render.stage import camera_poses, read_stage

FRAMES = 11
needs_blender = pytest.mark.skipif(importlib.util.find_spec("bpy") is None, reason="needs brisance[render]")
needs_av = pytest.mark.skipif(importlib.util.find_spec("av") is None, reason="needs brisance[render]")


def make_stage(path: Path, *, instanced: bool = False, up: str = "Y", unit: float = 1.0) -> Path:
    """Three bricks standing at z = 0, hit from -z: they fly towards +z at 5 m/s; one frame is 20 ms."""
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageUpAxis(stage, up)
    UsdGeom.SetStageMetersPerUnit(stage, unit)
    stage.SetTimeCodesPerSecond(50)
    stage.SetStartTimeCode(0)
    stage.SetEndTimeCode(FRAMES - 1)
    stage.SetDefaultPrim(UsdGeom.Xform.Define(stage, "/World").GetPrim())

    def turned(x: float, y: float, z: float) -> tuple[float, float, float]:
        return (x / unit, y / unit, z / unit) if up == "Y" else (x / unit, -z / unit, y / unit)

    def flight(number: int, time: int) -> tuple[float, float, float]:
        return turned(0.4 * (number - 1), 0.08 + 0.3 * number, 0.1 * time)

    if instanced:
        instancer = UsdGeom.PointInstancer.Define(stage, "/World/wall")
        _brick(stage, "/World/wall/Prototypes/brick", turned)
        instancer.CreatePrototypesRel().AddTarget("/World/wall/Prototypes/brick")
        instancer.CreateProtoIndicesAttr([0, 0, 0])
        positions = instancer.CreatePositionsAttr()
        for time in range(FRAMES):
            positions.Set(Vt.Vec3fArray([Gf.Vec3f(*flight(number, time)) for number in range(3)]), time)
    else:
        UsdGeom.Xform.Define(stage, "/World/wall")
        for number in range(3):
            move = _brick(stage, f"/World/wall/brick_{number}", turned).AddTranslateOp()
            for time in range(FRAMES):
                move.Set(Gf.Vec3d(*flight(number, time)), time)
    ground = UsdGeom.Mesh.Define(stage, "/World/Ground")
    ground.CreatePointsAttr([turned(*corner) for corner in [(-9, 0, 9), (9, 0, 9), (9, 0, -9), (-9, 0, -9)]])
    ground.CreateFaceVertexCountsAttr([4])
    ground.CreateFaceVertexIndicesAttr([0, 1, 2, 3])
    charge = UsdGeom.Sphere.Define(stage, "/World/Charges/charge_0")
    charge.CreatePurposeAttr("guide")
    charge.AddTranslateOp().Set(Gf.Vec3d(*turned(0, 0.3, -15)))
    camera = UsdGeom.Camera.Define(stage, "/World/Eye")
    camera.AddTranslateOp().Set(Gf.Vec3d(*turned(0, 1, 8)))
    camera.CreateFocalLengthAttr(50.0)
    camera.CreateHorizontalApertureAttr(36.0)
    stage.Save()
    return path


def _brick(stage: Usd.Stage, path: str, turned) -> UsdGeom.Mesh:  # type: ignore[no-untyped-def]
    mesh = UsdGeom.Mesh.Define(stage, path)
    corners = [turned(0.16 * x, 0.08 * y, 0.05 * z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    mesh.CreatePointsAttr(corners)
    mesh.CreateExtentAttr(UsdGeom.PointBased.ComputeExtent(Vt.Vec3fArray(corners)))
    mesh.CreateFaceVertexCountsAttr([4] * 6)
    mesh.CreateFaceVertexIndicesAttr([0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3])
    return mesh


@pytest.fixture
def usd(tmp_path: Path) -> Path:
    return make_stage(tmp_path / "wall.usda")


def seen(pose: CameraPose, points: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Which points project into the picture: |x / depth| and |y / depth| within the half angles' tangents."""
    local = np.linalg.inv(pose.world_from_camera) @ np.column_stack([points, np.ones(len(points))]).T
    depth = -local[2]
    with np.errstate(divide="ignore", invalid="ignore"):
        inside = (np.abs(local[0] / depth) <= pose.half_width) & (
            np.abs(local[1] / depth) <= pose.half_height
        )
    return (depth > 0) & inside


def surface(centres: NDArray[np.float64], radii: NDArray[np.float64]) -> NDArray[np.float64]:
    """(spheres, directions, 3) points spread over each sphere."""
    steps = np.arange(200) + 0.5
    polar, turn = np.arccos(1 - 2 * steps / 200), np.pi * (1 + 5**0.5) * steps
    unit = np.column_stack([np.cos(turn) * np.sin(polar), np.sin(turn) * np.sin(polar), np.cos(polar)])
    return centres[:, None] + radii[:, None, None] * unit


numbers = st.floats(-20, 20, allow_nan=False)
spheres = st.lists(st.tuples(numbers, numbers, numbers, st.floats(0.01, 3)), min_size=1, max_size=12)


@settings(max_examples=60, deadline=None)
@given(
    spheres=spheres, azimuth=st.floats(-180, 180), elevation=st.floats(-80, 80), aspect=st.floats(0.5, 2.5)
)
def test_every_sphere_is_in_the_picture(
    spheres: list[tuple[float, float, float, float]], azimuth: float, elevation: float, aspect: float
) -> None:
    data = np.array(spheres)
    turn, rise = np.radians([azimuth, elevation])
    direction = np.array([np.cos(rise) * np.sin(turn), np.sin(rise), np.cos(rise) * np.cos(turn)])
    pose = frame(data[:, :3], data[:, 3], direction, aspect=aspect, fraction=1.0)
    assert seen(pose, surface(data[:, :3], data[:, 3]).reshape(-1, 3)).all()
    assert pose.inside(data[:, :3], data[:, 3]).all()
    assert np.allclose(pose.world_from_camera[:3, 2], direction)


def test_camera_stands_as_near_as_it_can() -> None:
    """A sphere of radius r touches the sides of a pyramid of half angle a at distance r / sin a."""
    pose = frame(np.zeros((1, 3)), np.ones(1), np.array([0.0, 0.0, 1.0]), aspect=1.0, fraction=1.0)
    half = np.arctan(pose.half_width * 0.96)  # 4 % of the picture is kept free
    assert np.allclose(pose.position, [0.0, 0.0, 1.0 / np.sin(half)])


@pytest.mark.parametrize("fraction", [0.8, 0.95, 0.99])
def test_outliers_do_not_push_the_camera_away(fraction: float) -> None:
    random = np.random.default_rng(3)
    centres, radii = random.normal(size=(2000, 3)), np.full(2000, 0.05)
    centres[::400] *= 1000.0
    pose = frame(centres, radii, np.array([0.0, 0.0, 1.0]), aspect=16 / 9, fraction=fraction)
    assert fraction <= pose.inside(centres, radii).mean() < 1.0
    assert pose.position[2] < 30.0


def test_marked_spheres_stay_in_whatever_the_fraction() -> None:
    random = np.random.default_rng(4)
    centres, radii = random.normal(size=(500, 3)), np.full(500, 0.1)
    centres[7] = (40.0, 0.0, 0.0)
    marked = np.arange(500) == 7
    pose = frame(centres, radii, np.array([0.0, 0.0, 1.0]), aspect=1.5, fraction=0.5, always=marked)
    assert pose.inside(centres, radii)[7]


def test_views_look_from_where_the_debris_goes() -> None:
    away = np.array([0.0, 5.0, 2.0])  # only its horizontal part counts
    front, side, below = (looking_from(VIEWS[name], away) for name in ("front", "side", "below"))
    assert front[2] > 0.9 and 0 < front[1] < 0.2
    assert abs(side[2]) < 0.25 and abs(side[0]) > 0.95
    assert below[1] < -0.5 and below[2] > 0
    assert np.allclose([np.linalg.norm(v) for v in (front, side, below)], 1.0)


@pytest.mark.parametrize("view", VIEWS)
def test_the_wall_and_its_flight_are_framed(usd: Path, view: str) -> None:
    stage = read_stage(usd)
    pose = place(stage, view, 16 / 9)
    for moment in stage.centres:
        assert pose.inside(moment, stage.radii).all()
    assert (pose.position[1] < 0) == (view == "below")
    assert np.linalg.norm(pose.position) < 15  # not drawn back to have the charge in view


def test_action_leaves_out_what_stands_far_off_and_what_flies_far_away() -> None:
    centres = np.zeros((5, 4, 3))
    centres[:, 1] = [0.4, 0.0, 0.0]  # stands still, close by
    centres[:, 2] = [80.0, 0.0, 0.0]  # stands still, far away
    centres[:, 0, 2] = np.arange(5)
    centres[:, 3, 2] = 50.0 * np.arange(5)  # leaves at once
    found, radii, first = action(centres, np.full(4, 0.3), floor=-np.inf)
    assert np.abs(found).max() < 6.0
    assert len(found) == len(radii) == len(first)
    assert first.sum() == 3


def test_action_leaves_out_what_has_sunk_below_the_ground() -> None:
    centres = np.zeros((5, 2, 3))
    centres[:, :, 1] = 1.0 - 0.35 * np.arange(5)[:, None]  # the last is 0.4 m down
    found, _, _ = action(centres, np.full(2, 0.3), floor=0.0)
    assert found[:, 1].min() == pytest.approx(-0.05)


@pytest.mark.parametrize(
    ("up", "unit", "instanced"), [("Y", 1.0, True), ("Z", 1.0, False), ("Z", 0.01, True)]
)
def test_files_of_any_layout_axis_and_unit_read_the_same(
    tmp_path: Path, up: str, unit: float, instanced: bool
) -> None:
    plain = read_stage(make_stage(tmp_path / "a.usda"))
    other = read_stage(make_stage(tmp_path / "b.usda", up=up, unit=unit, instanced=instanced))
    assert plain.centres.shape == (FRAMES, 3, 3)
    assert np.allclose(other.centres, plain.centres, atol=1e-5)  # positions of instances are single precision
    assert np.allclose(other.radii, plain.radii, rtol=1e-5)
    assert np.allclose(plain.radii, np.linalg.norm([0.16, 0.08, 0.05]), rtol=1e-5)
    assert other.ground == pytest.approx(plain.ground) == ("/World/Ground", 0.0)
    assert np.allclose(other.charges, [[0, 0.3, -15]], atol=1e-6)
    assert list(plain.frames) == list(range(FRAMES))
    assert plain.frame_rate == 50


def test_a_camera_of_the_file_is_taken_as_it_is(usd: Path) -> None:
    pose = camera_poses(usd, "/World/Eye", [0, 5], 2.0)[0]
    assert np.allclose(pose.position, [0, 1, 8])
    assert pose.half_width == pytest.approx(36 / 2 / 50)
    assert pose.half_height == pytest.approx(pose.half_width / 2)


def test_a_moving_camera_has_a_pose_a_frame(usd: Path) -> None:
    stage = Usd.Stage.Open(str(usd))
    move = stage.GetPrimAtPath("/World/Eye").GetAttribute("xformOp:translate")
    move.Set(Gf.Vec3d(0, 1, 8), 0)
    move.Set(Gf.Vec3d(0, 1, 18), 10)
    stage.Save()
    poses = camera_poses(usd, "/World/Eye", [0, 5, 10], 1.5)
    assert [round(float(pose.position[2]), 6) for pose in poses] == [8, 13, 18]


def test_job_survives_its_journey(usd: Path, tmp_path: Path) -> None:
    job = prepare(
        read_stage(usd),
        frames=[0, 1],
        folder=tmp_path,
        camera="side",
        size=(64, 36),
        samples=2,
        motion_blur=True,
    )
    copy = Job.from_json(job.to_json())
    assert copy.to_json() == job.to_json()
    assert copy.ground_height == 0.0


def test_output_names() -> None:
    assert Output.of(Path("a/shot.MP4")).kind is OutputKind.VIDEO
    assert Output.of(Path("shot.png")).kind is OutputKind.PICTURE
    sequence = Output.of(Path("frames/wall_####.png"))
    assert sequence.kind is OutputKind.SEQUENCE
    assert sequence.name(7) == Path("frames/wall_0007.png")
    assert sequence.name(12345) == Path("frames/wall_12345.png")


def test_noise_is_uniform_tileable_and_repeatable() -> None:
    noise = fractal_noise(64, slope=1.5, seed=2)
    assert np.array_equal(noise, fractal_noise(64, slope=1.5, seed=2))
    assert np.allclose(np.quantile(noise, [0, 0.25, 0.5, 0.75, 1]), [0, 0.25, 0.5, 0.75, 1], atol=1e-3)
    step = np.abs(np.diff(noise, axis=0)).mean()
    assert np.abs(noise[0] - noise[-1]).mean() < 2 * step  # the seam is no rougher than the rest


@needs_av
def test_video_shows_what_it_was_given(tmp_path: Path) -> None:
    import av

    from brisance.render.video import VideoWriter

    path = tmp_path / "clip.mp4"
    across = np.linspace(0, 255, 64, dtype=np.uint8)
    shown = [
        np.stack(np.broadcast_arrays(across, across[:36, None], np.uint8(20 * k)), axis=2) for k in range(5)
    ]
    with VideoWriter(path, size=(64, 36), fps=25) as video:
        for picture in shown:
            video.add(picture, times=2)
    with av.open(str(path)) as container:
        stream = container.streams.video[0]
        assert (stream.codec_context.name, stream.codec_context.pix_fmt) == ("h264", "yuv420p")
        assert (stream.width, stream.height, stream.average_rate) == (64, 36, 25)
        frames = [
            frame.reformat(format="rgb24", src_colorspace="ITU709").to_ndarray()
            for frame in container.decode(video=0)
        ]
    assert len(frames) == 10
    for index, decoded in enumerate(frames):
        error = np.abs(decoded.astype(int) - shown[index // 2])
        assert error.mean() < 4.0  # of 255: what quantisation and halved colour resolution cost
    head = path.read_bytes()
    assert head.index(b"moov") < head.index(b"mdat")  # the index comes first: plays while it loads


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"output": "out.avi"}, "out.mp4, out.png or frames/####.png"),
        ({"output": "missing/out.mp4"}, "does not exist"),
        ({"output": "out.mp4", "frame": 3}, "no video"),
        ({"output": "out.mp4", "size": (641, 360)}, "642x360"),
        ({"output": "out.png", "size": (0, 360)}, "16 to 16384"),
        ({"output": "out.png", "frame": 99}, "from 0 to 10"),
        ({"output": "out.png", "samples": 0}, "1 or more"),
        ({"output": "out.png", "quality": "best"}, "draft or final"),
        ({"output": "out.mp4", "fps": 0}, "1 to 240"),
        ({"output": "out.png", "camera": "top"}, "front, side, below"),
        ({"output": "out.png", "camera": "/World/wall"}, "/World/Eye"),
    ],
)
def test_wrong_requests_are_one_sentence(
    usd: Path, monkeypatch: pytest.MonkeyPatch, arguments: dict[str, object], words: str
) -> None:
    monkeypatch.chdir(usd.parent)
    monkeypatch.setattr("brisance.render.require", lambda *modules: None)
    output = arguments.pop("output")
    with pytest.raises(InputError) as error:
        render(usd, output, **arguments)  # type: ignore[arg-type]
    assert words in str(error.value) and "\n" not in str(error.value)
    assert sorted(path.name for path in usd.parent.iterdir()) == ["wall.usda"]


@pytest.mark.parametrize("content", [None, "not a scene", "#usda 1.0\n"])
def test_files_that_cannot_be_rendered(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, content: str | None
) -> None:
    monkeypatch.setattr("brisance.render.require", lambda *modules: None)
    path = tmp_path / "wall.usda"
    if content is not None:
        path.write_text(content)
    with pytest.raises(InputError, match=r"wall\.usda") as error:
        render(path, tmp_path / "out.png")
    assert "\n" not in str(error.value)


def test_missing_package_is_named(monkeypatch: pytest.MonkeyPatch, usd: Path) -> None:
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    with pytest.raises(InputError, match=r"bpy and av.*pip install 'brisance\[render\]'.*3\.11"):
        render(usd, usd.with_name("out.mp4"))


def stand_in(monkeypatch: pytest.MonkeyPatch, body: str) -> None:
    """Replace Blender by a script that has the job in ``job`` and calls ``tell`` with its lines."""
    head = """
        import json, os, sys, time
        job = json.load(sys.stdin)
        def tell(**facts):
            print(json.dumps(facts), flush=True)
        def paint(frame):
            path = os.path.join(job["folder"], f"{frame:04d}.png")
            open(path, "wb").write(b"picture of frame %d" % frame)
            tell(frame=frame, path=path)
    """
    script = textwrap.dedent(head) + textwrap.dedent(body)
    monkeypatch.setattr(blender, "COMMAND", [sys.executable, "-c", script])
    monkeypatch.setattr("brisance.render.require", lambda *modules: None)


def test_sequence_is_numbered_and_counted(usd: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    stand_in(monkeypatch, "for frame in job['frames']: paint(frame)")
    counted: list[tuple[int, int]] = []
    written = render(
        usd, usd.parent / "new" / "##.png", progress=lambda done, total: counted.append((done, total))
    )
    assert [path.name for path in written] == [f"{k:02d}.png" for k in range(FRAMES)]
    assert written[3].read_bytes() == b"picture of frame 3"
    assert counted == [(k, FRAMES) for k in range(FRAMES + 1)]


def test_a_picture_is_of_the_middle_unless_told(usd: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    stand_in(monkeypatch, "for frame in job['frames']: paint(frame)")
    (path,) = render(usd, usd.with_name("out.png"))
    assert path.read_bytes() == b"picture of frame 5"
    (path,) = render(usd, usd.with_name("out.png"), frame=0)
    assert path.read_bytes() == b"picture of frame 0"


@pytest.mark.parametrize(
    ("body", "words"),
    [
        ("tell(error='the sky fell down')", "the sky fell down."),
        ("os.abort()", "SIGABRT"),
        ("sys.exit(3)", "exit code 3"),
    ],
)
def test_blender_failing_is_one_sentence(
    usd: Path, monkeypatch: pytest.MonkeyPatch, body: str, words: str
) -> None:
    stand_in(monkeypatch, body)
    output = usd.with_name("out.png")
    output.write_bytes(b"kept")
    with pytest.raises(BrisanceError) as error:
        render(usd, output)
    assert words in str(error.value) and "\n" not in str(error.value)
    assert not isinstance(error.value, InputError)
    assert output.read_bytes() == b"kept"


def test_interrupting_stops_blender_and_keeps_what_was_there(
    usd: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    mark = usd.with_name("pid")
    stand_in(monkeypatch, f"open({str(mark)!r}, 'w').write(str(os.getpid())); paint(0); time.sleep(600)")
    output = usd.parent / "####.png"

    def interrupt(done: int, total: int) -> None:
        if done == 1:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        render(usd, output, progress=interrupt)
    with pytest.raises(ProcessLookupError):
        os.kill(int(mark.read_text()), 0)
    assert sorted(path.name for path in usd.parent.iterdir()) == ["0000.png", "pid", "wall.usda"]


def test_missing_system_library_comes_with_its_remedy() -> None:
    missing = ImportError("libXi.so.6: cannot open shared object file: No such file or directory")
    assert "libXi.so.6" in (text := describe(missing)) and "apt-get install" in text and "libxi6" in text


@needs_blender
@pytest.mark.parametrize("instanced", [False, True])
def test_blender_renders_the_bricks(tmp_path: Path, instanced: bool) -> None:
    """Bricks are red, ground and sky are not, and the bricks are where the camera has them."""
    from brisance.render.video import read_picture

    usd = make_stage(tmp_path / "wall.usdc", instanced=instanced)
    stage = Usd.Stage.Open(str(usd))
    material = "/World/Materials/brick"
    stage.DefinePrim(material, "Material")
    for path in (
        ["/World/wall/Prototypes/brick"] if instanced else [f"/World/wall/brick_{k}" for k in range(3)]
    ):
        prim = stage.GetPrimAtPath(path)
        prim.ApplyAPI("MaterialBindingAPI")
        prim.CreateRelationship("material:binding").AddTarget(Sdf.Path(material))
    stage.Save()
    (path,) = render(usd, tmp_path / "out.png", frame=4, size=(64, 36), samples=2)
    (again,) = render(usd, tmp_path / "again.png", frame=4, size=(64, 36), samples=2)
    assert again.read_bytes() == path.read_bytes()
    picture = read_picture(path).astype(int)
    assert picture.shape == (36, 64, 3)
    facts = read_stage(usd)
    pose = place(facts, "front", 64 / 36)
    local = np.linalg.inv(pose.world_from_camera) @ np.column_stack([facts.centres[4], np.ones(3)]).T
    columns = 32 + 32 * local[0] / -local[2] / pose.half_width
    rows = 18 - 18 * local[1] / -local[2] / pose.half_height
    for column, row in zip(columns.astype(int), rows.astype(int), strict=True):
        red, _, blue = picture[row, column]
        assert red > blue + 40
    sky = picture[1, 32]
    assert abs(sky[0] - sky[2]) < 40 and sky.min() > 120
