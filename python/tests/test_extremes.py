"""Numbers that are each allowed and together beyond all numbers end in one sentence; an old result stays."""

from __future__ import annotations

from pathlib import Path

import pytest

from brisance.cli.main import main

SCENES = Path(__file__).parents[2] / "scenes"

Capture = pytest.CaptureFixture[str]


def refusal(capsys: Capture, scene: str, output: Path, *changes: str) -> str:
    """The sentence with which a run ends that would overwrite ``output``."""
    output.write_bytes(b"what was there")
    flags = [flag for change in changes for flag in ("--set", change)]
    assert main(["run", str(SCENES / scene), "--frames", "20", *flags, "-o", str(output)]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.count("\n") == 1
    assert output.read_bytes() == b"what was there"
    return err


def test_a_body_at_no_finite_place_is_named_with_the_time(capsys: Capture, tmp_path: Path) -> None:
    output = tmp_path / "crates.usdc"
    sentence = refusal(capsys, "crates.toml", output, "block.1.position.0=1e150")
    assert sentence.startswith(
        f"brisance: {SCENES / 'crates.toml'}: turned crate: its pose is not finite at 0 s; "
    )
    assert sentence.endswith("nearer to real ones.\n")
    # A sheet as thin as that weighs nothing: the first front throws it beyond all numbers.
    sentence = refusal(capsys, "crates.toml", output, "block.1.size.2=1e-308")
    assert sentence.startswith(
        f"brisance: {SCENES / 'crates.toml'}: turned crate: its pose is not finite at 0.0"
    )


def test_a_piece_of_a_pane_is_named_by_its_window(capsys: Capture, tmp_path: Path) -> None:
    output = tmp_path / "window.usdc"
    sentence = refusal(capsys, "window_thesis.toml", output, "window.0.position.0=1e150")
    scene = SCENES / "window_thesis.toml"
    assert sentence.startswith(
        f"brisance: {scene}: a piece of window.0 (window): its pose is not finite at 0 s; "
    )


@pytest.mark.parametrize(
    ("change", "problem"),
    [
        ("block.0.size.1=1e-40", "big crate: size [m] is 1e-40, but where bodies touch it must be"),
        ("block.0.position.0=1e200", "big crate: position [m] is 1e200, but"),
        ("block.0.density=1e200", "big crate: mass [kg] is 1e200, but"),
        ("ground.friction=1e200", "ground: friction is 1e200, but"),
    ],
)
def test_what_contacts_cannot_compute_with_is_named(
    capsys: Capture, tmp_path: Path, change: str, problem: str
) -> None:
    sentence = refusal(capsys, "crates.toml", tmp_path / "crates.usdc", change, "dynamics.contacts=true")
    assert sentence.startswith(f"brisance: {SCENES / 'crates.toml'}: {problem}")


@pytest.mark.parametrize("command", ["run", "inspect"])
def test_what_is_found_as_a_scene_is_built_begins_with_its_file(
    capsys: Capture, tmp_path: Path, command: str
) -> None:
    scene = tmp_path / "can.toml"
    scene.write_text(
        "[[charge]]\nmass = 1\nposition = [0, 1, -3]\n"
        "[[mesh]]\nname = 'can'\nfile = 'none.obj'\ndensity = 600\n"
    )
    assert main([command, str(scene)]) == 2
    sentence = capsys.readouterr().err
    assert sentence.startswith(f'brisance: {scene}: mesh "can": file ')
    assert sentence.count(str(scene)) == 1
