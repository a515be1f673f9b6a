"""The command line: what it prints and where, its exit codes, and what is left on disk however it ends."""

from __future__ import annotations

import csv
import io
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

import brisance as br
from brisance import _engine
from brisance.cli.main import main, spread

SCENES = Path(__file__).parents[2] / "scenes"
WALL = str(SCENES / "brick_wall.toml")

CURVE_KEYS = [
    "distance_m",
    "scaled_distance_m_kg13",
    "overpressure_pa",
    "reflected_pressure_pa",
    "dynamic_pressure_pa",
    "front_velocity_m_s",
    "arrival_time_s",
    "duration_s",
    "impulse_pa_s",
    "reflected_impulse_pa_s",
]

Capture = pytest.CaptureFixture[str]


def refused(capsys: Capture, *arguments: str | Path) -> str:
    """Run a command that must fail on its input: exit code 2, one sentence on stderr, nothing on stdout."""
    assert main([str(argument) for argument in arguments]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("brisance: ")
    assert err.count("\n") == 1
    assert err.endswith((".\n", "?\n"))
    assert "Traceback" not in err
    return err


def done(capsys: Capture, *arguments: str | Path) -> tuple[str, str]:
    """Run a command that must succeed and return what it printed to stdout and to stderr."""
    code = main([str(argument) for argument in arguments])
    out, err = capsys.readouterr()
    assert code == 0, err
    return out, err


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["run", "none.toml"], "none.toml does not exist"),
        (["run", "."], ". is a directory"),
        (["run", "bad.toml"], "bad.toml is not valid TOML"),
        (["run", "window.toml"], "window.0 has no height; give the size of the pane"),
        (["run", WALL, "--set", "charge.0.mass=-1"], "must be greater than 0"),
        (["run", WALL, "--set", "charge.0.mass=nan"], "finite"),
        (["run", WALL, "--set", "charge.0.masss=1"], "did you mean mass?"),
        (["run", WALL, "--set", "charge.0.mass=heavy"], "must be a number"),
        (["run", WALL, "--set", "charge.7.mass=1"], "for the file holds 1"),
        (["run", WALL, "--set", "charge.0.position=[0, 0.3, 0]"], "inside the brick_wall 'wall'"),
        (["run", WALL, "--set", "charge=[]"], "no charge"),
        (["run", WALL, "--set", "time.duration=1e9", "--set", "time.frame_rate=1e6"], " of memory "),
        (["run", WALL, "--frames", "0"], "--frames"),
        (["run", WALL, "--threads", "0"], "--threads"),
        (["run", WALL, "-o", "."], ". is a directory"),
        (["run", WALL, "-o", "wall.mp4"], "ends in .usdc"),
        (["run", WALL, "-o", "wall.abc"], "ends in .usdc"),
        (["run", WALL, "-o", "wall.json"], "ends in .usdc"),
        (["run", WALL, "--set", "charge.0.gain=1e6"], "gain must be 1000 or less"),
        (["run", WALL, "--set", "brick_wall.0.brick_mass=1e-6"], "far less than the air in its place"),
        (["run", WALL, "--set", "air.pressure=1e-300"], "air.pressure must be 100 or more"),
        (["run", WALL, "--set", "air.temperature=1e5"], "air.temperature must be 1000 or less"),
        (["curves", "--mass", "1", "--pressure", "1e-300"], "--pressure must be 100 or more"),
        (["run", WALL, "-o", "none/wall.usdc"], "the folder none does not exist"),
        (["run", WALL, "-o", "bad.toml/wall.usdc"], "is a file, not a folder"),
        (["run", WALL, "--report", "wall.txt"], "ends in .json"),
        (["run", WALL, "--report", "none/wall.json"], "the folder none does not exist"),
        (["run"], "SCENE"),
        (["run", WALL, "--bogus"], "--bogus"),
        (["explode"], "explode"),
        (["inspect", "none.usdc"], "does not exist"),
        (["inspect", "bad.usdc"], "cannot be read as USD"),
        (["inspect", "bad.json"], "not a report of Brisance"),
        (["inspect", "bad.json", "--set", "seed=2"], "--set changes a scene"),
        (["curves"], "--mass"),
        (["curves", "--mass", "-1"], "--mass must be greater than 0"),
        (["curves", "--mass", "ten"], "--mass"),
        (["curves", "--mass", "1", "--distance", "0"], "--distance must be a finite number above 0"),
        (["curves", "--mass", "1", "--distance", "nan"], "--distance must be a finite number above 0"),
        (["curves", "--mass", "1", "--source", "brodie"], "did you mean brode?"),
        (["curves", "--mass", "1", "--burst", "water"], "--burst"),
        (["curves", "--mass", "1", "--explosive", "flour"], "flour"),
        (["curves", "--mass", "1", "--plot", "curves.gif"], "ends in .png, .svg or .pdf"),
        (["figure", "99.9"], "99.9"),
        (["render", "none.usdc", "-o", "out.mp4"], "none.usdc"),
        (["render", "none.usdc", "-o", "out.mp4", "--size", "wide"], "--size wide is not a size"),
        (["render", "none.usdc", "-o", "out.mp4", "--quality", "best"], "--quality"),
        (["render", "none.usdc", "-o", "out.mp4", "--fps", "0"], "fps: 0"),
    ],
)
def test_wrong_input_ends_with_one_sentence(
    arguments: list[str], said: str, capsys: Capture, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("bad.toml").write_text("[[charge]\n")
    Path("window.toml").write_text("[[charge]]\nmass = 1\nposition = [0, 0, 0]\n[[window]]\nwidth = 1\n")
    Path("bad.usdc").write_text("nothing of the kind")
    Path("bad.json").write_text("[1]")
    before = sorted(tmp_path.iterdir())
    assert said in refused(capsys, *arguments)
    assert sorted(tmp_path.iterdir()) == before


def test_an_output_that_cannot_be_replaced_survives(capsys: Capture, tmp_path: Path) -> None:
    output = tmp_path / "wall.usdc"
    output.write_text("precious")
    refused(capsys, "run", WALL, "-o", output, "--set", "charge.0.mass=-1")
    refused(capsys, "run", WALL, "-o", output, "--report", tmp_path / "none" / "wall.json")
    assert output.read_text() == "precious"
    assert list(tmp_path.iterdir()) == [output]


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root may write anywhere")
def test_a_folder_without_permission_is_refused(capsys: Capture, tmp_path: Path) -> None:
    output = tmp_path / "wall.usdc"
    output.write_text("precious")
    tmp_path.chmod(0o500)
    try:
        assert "is not writable" in refused(capsys, "run", WALL, "-o", output)
    finally:
        tmp_path.chmod(0o700)
    assert output.read_text() == "precious"


@pytest.mark.parametrize("suffix", [".usdc", ".json"])
@pytest.mark.parametrize(
    ("failure", "code"), [(KeyboardInterrupt(), 130), (OSError(28, "No space left on device"), 2)]
)
def test_a_write_cut_short_leaves_the_old_file(
    suffix: str,
    failure: BaseException,
    code: int,
    capsys: Capture,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def fail(source: Path, target: Path) -> None:
        raise failure

    output = tmp_path / f"wall{suffix}"
    output.write_text("precious")
    monkeypatch.setattr(os, "replace", fail)
    flag = "-o" if suffix == ".usdc" else "--report"
    assert main(["run", WALL, "--frames", "2", flag, str(output)]) == code
    assert capsys.readouterr().err.count("\n") == 1
    assert output.read_text() == "precious"
    assert list(tmp_path.iterdir()) == [output]


def interrupted(program: str, *arguments: str, after: float = 0.0) -> tuple[int, str, str]:
    """Run Python code and press Ctrl-C some seconds after it has said "ready"; exit code, stdout, stderr."""
    with subprocess.Popen(
        [sys.executable, "-c", program, *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as process:
        try:
            assert process.stdout is not None
            assert process.stdout.readline() == "ready\n"
            time.sleep(after)
            process.send_signal(signal.SIGINT)
            started = time.monotonic()
            out, err = process.communicate(timeout=30)
            assert time.monotonic() - started < 5.0, "within a second, were the machine not busy"
        finally:
            process.kill()
    return process.returncode, out, err


COMMAND = "import sys, brisance.__main__ as entry; print('ready', flush=True); sys.exit(entry.main())"
posix_only = pytest.mark.skipif(os.name == "nt", reason="Windows sends no interrupt to one process")


@posix_only
@pytest.mark.parametrize("after", [0.0, 0.02, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.6, 1.0])
def test_ctrl_c_ends_a_long_run_at_any_moment(tmp_path: Path, after: float) -> None:
    output = tmp_path / "props.usdc"
    output.write_text("precious")
    scene = str(SCENES / "mesh_props.toml")
    long = ("--set", "time.duration=100", "--set", "time.step=1e-7")
    ended = interrupted(COMMAND, "run", scene, "-o", str(output), *long, after=after)
    assert ended == (130, "", "brisance: stopped.\n")
    assert output.read_text() == "precious"
    assert list(tmp_path.iterdir()) == [output]


@posix_only
def test_ctrl_c_while_writing_leaves_the_old_file(tmp_path: Path) -> None:
    output = tmp_path / "wall.usdc"
    output.write_text("precious")
    program = (
        "import brisance.__main__, sys, time\n"
        "from brisance.formats.atomic import replacing\n"
        "with replacing(sys.argv[1]) as temporary:\n"
        "    temporary.write_text('half')\n"
        "    print('ready', flush=True)\n"
        "    time.sleep(60)\n"
    )
    assert interrupted(program, str(output)) == (130, "", "brisance: stopped.\n")
    assert output.read_text() == "precious"
    assert list(tmp_path.iterdir()) == [output]


@posix_only
def test_ctrl_c_stays_an_exception_for_users_of_the_library() -> None:
    program = (
        "import brisance, sys\n"
        "scene, threads = brisance.load(sys.argv[2], sys.argv[3:]), int(sys.argv[1]) or None\n"
        "print('ready', flush=True)\n"
        "try:\n"
        "    brisance.simulate(scene, threads=threads)\n"
        "except KeyboardInterrupt:\n"
        "    print('heard')\n"
    )
    endless = ("time.duration=100", "time.step=1e-7")
    many = ("brick_wall.0.rows=300", "brick_wall.0.columns=300")
    for threads, changes in (("0", endless), ("1", endless), ("0", many)):
        assert interrupted(program, threads, WALL, *changes, after=0.7) == (0, "heard\n", "")


def test_run_tells_what_happened_and_writes(capsys: Capture, tmp_path: Path) -> None:
    usd, report = tmp_path / "wall.usdc", tmp_path / "wall.json"
    out, err = done(capsys, "run", WALL, "-o", usd, "--report", report)
    assert out.startswith("brick wall: 27 pieces, 41 frames")
    assert f"animation: {usd}" in out
    assert f"report: {report}" in out
    assert err == ""
    assert sorted(path.name for path in tmp_path.iterdir()) == ["wall.json", "wall.usdc"]


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs a device that is always full")
def test_a_full_disk_under_the_output_is_one_sentence() -> None:
    program = "import sys; from brisance.cli.main import main; sys.exit(main())"
    with open("/dev/full", "w") as full:
        ended = subprocess.run(
            [sys.executable, "-c", program, "curves", "--mass", "1", "--quiet"],
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            check=False,
        )
    assert ended.returncode == 1
    assert ended.stderr == "brisance: the output: no space left on device.\n"


def test_quiet_prints_nothing(capsys: Capture, tmp_path: Path) -> None:
    report = tmp_path / "wall.json"
    assert done(capsys, "run", WALL, "--quiet", "--report", report) == ("", "")
    assert report.exists()


def test_frames_are_the_first_of_the_whole_run(capsys: Capture, tmp_path: Path) -> None:
    whole = br.simulate(br.load(WALL))
    for frames in (1, 2, 7, 1000):
        report = tmp_path / "wall.json"
        done(capsys, "run", WALL, "--frames", str(frames), "--report", report)
        facts = json.loads(report.read_text())
        last = min(frames, 41) - 1
        assert facts["frames"] == last + 1
        final = np.array([body["final_position_m"] for body in facts["bodies"]])
        np.testing.assert_array_equal(final.astype(np.float32), whole.positions[last])


def test_the_command_does_what_python_does(capsys: Capture, tmp_path: Path) -> None:
    report = tmp_path / "wall.json"
    done(capsys, "run", WALL, "--set", "charge.0.mass=50", "--report", report)
    from_command = json.loads(report.read_text())
    own = br.simulate(br.load(WALL, ["charge.0.mass=50"])).report()
    built = br.simulate(
        br.Scene(
            name="brick wall",
            time=br.Time(duration=0.4, frame_rate=100),
            ground=br.Ground(height=0, friction=0.6),
            charges=[br.Charge(mass=50, explosive="TNT", position=(0, 0.3, -15))],
            objects=[
                br.BrickWall(
                    name="wall", rows=6, columns=4, brick_size=(0.32, 0.16, 0.1), brick_mass=10, friction=0.1
                )
            ],
        )
    ).report()
    for facts in (own, built):
        assert facts["bodies"] == from_command["bodies"]
        assert facts["settings"] == from_command["settings"]
        assert facts["charges"] == from_command["charges"]


@pytest.mark.parametrize("suffix", [".usda", ".usdc"])
def test_two_runs_write_the_same_bytes(capsys: Capture, tmp_path: Path, suffix: str) -> None:
    files = [tmp_path / f"{name}{suffix}" for name in ("first", "second")]
    done(capsys, "run", WALL, "--quiet", "--threads", "1", "-o", files[0])
    done(capsys, "run", WALL, "--quiet", "--threads", "2", "-o", files[1])
    assert files[0].read_bytes() == files[1].read_bytes()


@pytest.mark.parametrize("path", sorted(SCENES.glob("*.toml")), ids=lambda path: path.stem)
def test_threads_do_not_change_a_bit(path: Path) -> None:
    scene = br.load(path)
    one, two = br.simulate(scene, threads=1), br.simulate(scene, threads=2)
    np.testing.assert_array_equal(one.positions, two.positions)
    np.testing.assert_array_equal(one.orientations, two.orientations)


def test_inspect_tells_a_scene_a_result_and_a_report(capsys: Capture, tmp_path: Path) -> None:
    usd, report = tmp_path / "wall.usdc", tmp_path / "wall.json"
    done(capsys, "run", WALL, "-o", usd, "--report", report)
    scene, _ = done(capsys, "inspect", WALL)
    assert "brick wall: 1 charge, 1 object, 27 pieces" in scene
    assert "240" in scene
    changed, _ = done(capsys, "inspect", WALL, "--set", "brick_wall.0.rows=2")
    assert "9 pieces" in changed
    from_usd, _ = done(capsys, "inspect", usd)
    from_report, _ = done(capsys, "inspect", report)
    for text in (from_usd, from_report):
        assert text.startswith("brick wall: 27 pieces, 41 frames at 100 frames/s, seed 1")
    # The tables of charges and of facts are the same, whichever file they were read from.
    for number in (1, 3):
        assert from_usd.split("\n\n")[number] == from_report.split("\n\n")[number]


@pytest.mark.parametrize("name", [path.name for path in sorted(SCENES.glob("*.toml"))])
def test_inspect_tells_every_scene(capsys: Capture, name: str) -> None:
    out, err = done(capsys, "inspect", SCENES / name)
    assert "charge.0" in out
    assert err == ""


@pytest.mark.parametrize("command", ["run", "inspect"])
def test_a_scene_without_ground_is_warned_of_where_something_can_fall(
    command: str, capsys: Capture, tmp_path: Path
) -> None:
    def told(ground: str, anchored: str) -> int:
        charge = "[[charge]]\nmass = 1\nposition = [0, 0.5, -5]\n"
        block = f"[[block]]\nsize = [1, 1, 1]\nmass = 10\nposition = [0, 0.5, 0]\nanchored = {anchored}\n"
        scene = tmp_path / "scene.toml"
        scene.write_text(f"[time]\nduration = 0.1\n{ground}{charge}{block}")
        return done(capsys, command, scene)[0].count("warning: The scene has no [ground]")

    assert told("", "false") == 1
    assert told("", "true") == 0
    assert told("[ground]\n", "false") == 0


def test_curves_print_the_same_numbers_three_ways(capsys: Capture) -> None:
    ask = ["curves", "--mass", "100", "--distance", "5", "10", "20"]
    as_json = json.loads(done(capsys, *ask, "--format", "json")[0])
    as_csv = list(csv.reader(io.StringIO(done(capsys, *ask, "--format", "csv")[0])))
    as_table, notes = done(capsys, *ask)
    engine = _engine.curves(mass=100.0, distance=np.array([5.0, 10.0, 20.0]))
    assert [list(row) for row in as_json] == [CURVE_KEYS] * 3
    assert as_csv[0] == CURVE_KEYS
    for number, row in enumerate(as_json):
        assert list(row.values()) == [engine[key][number] for key in CURVE_KEYS]
        # CSV keeps nine digits.
        np.testing.assert_allclose(
            [float(cell) for cell in as_csv[number + 1]], list(row.values()), rtol=1e-8
        )
    assert len(as_table.splitlines()) == 4
    assert "note:" in notes
    assert done(capsys, *ask, "--quiet")[1] == ""


def test_curves_take_distances_as_they_are_typed(capsys: Capture) -> None:
    spellings = (
        ["--distance", "5", "10"],
        ["--distance", "5", "--distance", "10"],
        ["--distance=5", "--distance=10"],
    )
    answers = {done(capsys, "curves", "--mass", "2", *words, "--format", "csv")[0] for words in spellings}
    assert len(answers) == 1
    assert spread(["curves", "--distance", "1", "2", "--mass", "3"]) == [
        "curves",
        "--distance",
        "1",
        "--distance",
        "2",
        "--mass",
        "3",
    ]


def test_curves_without_distances_show_a_range(capsys: Capture) -> None:
    rows = json.loads(done(capsys, "curves", "--mass", "8", "--format", "json")[0])
    assert len(rows) > 5
    pressures = [row["overpressure_pa"] for row in rows]
    assert pressures == sorted(pressures, reverse=True)


def test_curves_beyond_their_reach_come_with_a_note(capsys: Capture) -> None:
    out, err = done(capsys, "curves", "--mass", "1", "--distance", "1e4", "--format", "json")
    assert json.loads(out)[0]["overpressure_pa"] > 0
    assert "1 distance lies farther than kingery-bulmash reaches" in err


def test_curves_are_drawn(capsys: Capture, tmp_path: Path) -> None:
    picture = tmp_path / "curves.png"
    out, _ = done(capsys, "curves", "--mass", "5", "--plot", picture)
    assert f"plot: {picture}" in out
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_figures_are_listed(capsys: Capture) -> None:
    out, _ = done(capsys, "figure", "list")
    names = [line.split()[0] for line in out.splitlines()[1:]]
    assert "table-2.1" in names
    assert "2.7" in names
    assert len(set(names)) == len(names)


@pytest.mark.parametrize("command", ["run", "render", "inspect", "curves", "figure"])
def test_help_has_an_example(capsys: Capture, command: str) -> None:
    out, _ = done(capsys, command, "--help")
    assert "Example:" in out
    assert f"brisance {command} " in out
    assert command in done(capsys, "--help")[0]


def test_version(capsys: Capture) -> None:
    assert done(capsys, "--version")[0] == f"brisance {br.__version__}\n"


def test_an_unexpected_error_is_one_line_too(capsys: Capture, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*arguments: object, **keywords: object) -> None:
        raise RuntimeError("two\nlines")

    monkeypatch.setattr("brisance.simulation.simulate", broken)
    assert main(["run", WALL]) == 1
    err = capsys.readouterr().err
    assert err.count("\n") == 1
    assert "RuntimeError: two lines" in err
