"""The page that holds its own recording: one file, nothing outside it, and the recording as packed."""

from __future__ import annotations

import base64
import gzip
import re
from pathlib import Path

import pytest
from synthetic import synthetic_result

from brisance.cli.main import main
from brisance.errors import BrisanceError
from brisance.formats import html
from brisance.formats.packed import pack, read

WALL = Path(__file__).parents[2] / "scenes" / "brick_wall.toml"

needs_viewer = pytest.mark.skipif(
    not (html.STATIC / "index.html").is_file(), reason="the viewer has not been built; run make viewer"
)


def recording(page: str) -> bytes:
    found = re.search(r'id="recording">([^<]+)</script>', page)
    assert found is not None
    return gzip.decompress(base64.b64decode(found[1]))


@needs_viewer
def test_the_page_holds_the_recording_and_refers_to_nothing_else() -> None:
    result = synthetic_result()
    page = html.page(result)
    assert recording(page) == pack(result)
    # The script's own text aside: no element of the page loads anything.
    shell = re.sub(r"<script.*?</script>|<style>.*?</style>", "", page, flags=re.S)
    assert not re.search(r'(src|href)="(?!data:)', shell)
    assert page.count("</script>") == 2


@needs_viewer
def test_a_name_cannot_break_out_of_the_page() -> None:
    result = synthetic_result()
    name = "</title><script>alert(1)</script>"
    result.scene = result.scene.model_copy(update={"name": name})
    page = html.page(result)
    assert "<script>alert" not in page
    assert read(recording(page))[0]["name"] == name


@needs_viewer
def test_the_command_writes_the_page(tmp_path: Path) -> None:
    path = tmp_path / "wall.html"
    assert main(["run", str(WALL), "-o", str(path), "--quiet"]) == 0
    assert len(read(recording(path.read_text()))[0]["names"]) == 27


def test_without_a_viewer_one_is_told_before_any_work(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(html, "STATIC", tmp_path)
    path = tmp_path / "wall.html"
    path.write_text("an older page")
    assert main(["run", str(WALL), "-o", str(path)]) == 1
    assert "run make viewer" in capsys.readouterr().err
    assert path.read_text() == "an older page"
    with pytest.raises(BrisanceError, match="has not been built"):
        html.page(synthetic_result())
