"""Files appear whole or not at all."""

from __future__ import annotations

from pathlib import Path

import pytest

from brisance.errors import InputError
from brisance.formats.atomic import replacing, write_text


def test_a_file_is_replaced_as_a_whole(tmp_path: Path) -> None:
    path = tmp_path / "report.json"
    write_text(path, "old")
    with replacing(path) as temporary:
        temporary.write_text("new")
        assert temporary.parent == tmp_path
        assert temporary.suffix == ".json"
        assert path.read_text() == "old"
    assert path.read_text() == "new"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("failure", [KeyboardInterrupt, ValueError, InputError])
def test_whatever_cuts_it_short_the_old_file_stays(tmp_path: Path, failure: type[BaseException]) -> None:
    path = tmp_path / "report.json"
    write_text(path, "old")

    def write() -> None:
        with replacing(path) as temporary:
            temporary.write_text("half")
            raise failure

    with pytest.raises(failure):
        write()
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("", "is a directory"),
        ("none/report.json", "does not exist; create it first"),
        ("file/report.json", "is a file, not a folder"),
    ],
)
def test_a_place_that_holds_no_file_is_refused_before_anything_is_written(
    tmp_path: Path, name: str, said: str
) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match=said):
        write_text(tmp_path / name, "text")
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


def test_the_systems_own_reason_is_told(tmp_path: Path) -> None:
    def write() -> None:
        with replacing(tmp_path / "report.json"):
            raise OSError(28, "No space left on device")

    with pytest.raises(InputError, match=r"report\.json could not be written: no space left on device\.$"):
        write()
