"""The picture of where pieces lie, of any scene and any report."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.image import imread

import brisance as br
from brisance.cli.main import main
from brisance.figures import dispersal, style

SCENES = Path(__file__).resolve().parents[2] / "scenes"
BLUE = np.array(to_rgb(style.BLUE))
SMALL = (420, 320)


def test_a_dispersal_is_drawn_of_any_scene_and_of_its_report(tmp_path: Path) -> None:
    scene = SCENES / "car_park.toml"
    drawn = tmp_path / "figures"
    br.simulate(br.load(scene)).write(tmp_path / "report.json")
    for file in (scene, tmp_path / "report.json"):
        assert main(["figure", "dispersal", "--of", str(file), "-o", str(drawn), "--quiet"]) == 0
    of_scene, of_report = (drawn / f"figure-dispersal-{stem}" for stem in ("car_park", "report"))
    assert of_scene.with_suffix(".csv").read_bytes() == of_report.with_suffix(".csv").read_bytes()
    # Its crates in blue; what never moved is pale, in the report as well.
    for path in (of_scene, of_report):
        picture = imread(path.with_suffix(".png"))[:, :700, :3]
        assert (np.abs(picture - BLUE).max(axis=-1) < 0.02).sum() > 200
    assert of_scene.with_suffix(".png").read_bytes() != of_report.with_suffix(".png").read_bytes()


def test_a_dispersal_of_something_else_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    def refusal(*words: str) -> str:
        assert main(["figure", *words, "-o", str(tmp_path / "none")]) == 2
        return capsys.readouterr().err

    report = tmp_path / "report.json"
    assert f"{report} does not exist" in refusal("dispersal", "--of", str(report))
    report.write_text('{"scene": "x", "bodies": []}')
    assert "is not a report of Brisance with a dispersal" in refusal("dispersal", "--of", str(report))
    assert "does not exist" in refusal("dispersal", "--of", str(tmp_path / "none.toml"))
    assert "--of is for the figure dispersal alone" in refusal("3.5", "--of", str(report))


def test_a_dispersal_of_what_stays_is_an_empty_picture(tmp_path: Path) -> None:
    whisper = br.load(SCENES / "car_park.toml", [f"charge.{i}.gain=0" for i in range(3)])
    figure = dispersal.figure_of(tmp_path / "whisper.json")
    br.simulate(whisper).write(tmp_path / "whisper.json")
    assert figure.compute().count.sum() == 0
    assert figure.build(tmp_path, size=SMALL)[0].is_file()
