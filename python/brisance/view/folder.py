"""The scenes folder: what may be opened, and the scene of a request, checked as one from a file would be."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

from brisance.errors import InputError
from brisance.formats.packed import check_shown
from brisance.memory import check_fits
from brisance.model import Scene
from brisance.scene_file import named_in_errors, read_tables, scene_of
from brisance.sentences import on_one_line

DEEPEST = 16
"""Levels of tables and lists in a scene at most; the model itself uses four."""

COPIES = 3
"""A recording is held as poses, as its message and as what is being sent."""

_PLAIN_NAME = re.compile(r"[^./\\\x00-\x1f][^/\\\x00-\x1f]*\.toml")
_UNLISTED = "There is no such scene in the folder; choose one of the list."


class ScenesFolder:
    """The ``.toml`` files of one folder that hold a charge; nothing outside it is read."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._root = folder.resolve()

    def names(self) -> list[str]:
        """File names of the scenes, sorted."""
        return [path.name for path in sorted(self._folder.glob("*.toml")) if self._is_scene(path)]

    def tables(self, name: str) -> dict[str, Any]:
        """The tables of a scene, unchecked. Raises :class:`InputError` for a name that is not listed."""
        path = self._path(name)
        if not self._is_scene(path):
            raise InputError(_UNLISTED)
        data = read_tables(path)
        # TOML holds dates, infinities and nan, and JSON does not; as text they are refused by the model.
        plain: dict[str, Any] = json.loads(json.dumps(data, default=str), parse_constant=str)
        return plain

    def scene(self, name: Any, data: Any) -> Scene:
        """The scene that a request carries, ``name`` being the file it began as.

        Raises :class:`InputError` with the sentence that the command line would print, and also for files
        outside the folder and for what would not fit in memory.
        """
        path = self._path(name)
        if not isinstance(data, dict):
            raise InputError(f"{path}: a scene must be a table of keys.")
        self._check_files(path, data)
        scene = scene_of(data, path)
        with named_in_errors(path):
            check_shown(scene)
            check_fits(scene.time.frames, scene.piece_count, copies=COPIES)
        return scene

    def named_in_errors(self, name: Any) -> AbstractContextManager[None]:
        """Begin what a run finds wrong with the scene of a request with its file, as :meth:`scene` does."""
        return named_in_errors(self._path(name))

    def _path(self, name: Any) -> Path:
        """Path of a file of the folder itself: no other folder, nothing hidden, no link that leads out."""
        if not isinstance(name, str) or not _PLAIN_NAME.fullmatch(name) or len(name) > 200:
            raise InputError(_UNLISTED)
        path = self._folder / name
        if not path.is_file() or path.resolve().parent != self._root:
            raise InputError(_UNLISTED)
        return path

    def _is_scene(self, path: Path) -> bool:
        if not _PLAIN_NAME.fullmatch(path.name) or path.resolve().parent != self._root:
            return False
        try:
            return "charge" in read_tables(path)
        except InputError:
            # One that does not parse is listed all the same: opening it tells why.
            return path.is_file()

    def _check_files(self, path: Path, data: dict[str, Any]) -> None:
        """Refuse a text that, taken for the name of a file, leads out of the folder, whatever its key."""
        for key, text in _texts(data):
            try:
                outside = not (self._root / text).resolve().is_relative_to(self._root)
            except (OSError, ValueError, RuntimeError):
                outside = True
            if outside:
                shown = text if len(text) <= 40 else f"{text[:37]}..."
                raise InputError(
                    f"{path}: {on_one_line(key)} {shown!r} leads out of the scenes folder; put the file into "
                    "it, or start brisance view with a wider --folder."
                )


def _texts(value: Any, key: str = "", depth: int = 0) -> Iterator[tuple[str, str]]:
    """Every text in tables and lists, with its key; the name of the scene or of an object is no file."""
    if depth > DEEPEST:
        raise InputError(f"The scene nests deeper than {DEEPEST} levels.")
    parts: Iterator[tuple[Any, Any]]
    if isinstance(value, str):
        yield key, value
        return
    if isinstance(value, dict):
        parts = iter(value.items())
    elif isinstance(value, list):
        parts = enumerate(value)
    else:
        return
    for part, inner in parts:
        yield from _texts(inner, f"{key}.{part}" if key else str(part), depth + 1)
