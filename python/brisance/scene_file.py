"""Scene files: TOML in, :class:`brisance.model.Scene` out, and back.

In a file, charges are ``[[charge]]`` tables and objects are ``[[block]]``, ``[[brick_wall]]``,
``[[mesh]]`` and ``[[window]]`` tables; all other keys are those of the model.
"""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from pydantic import Field, ValidationError

from brisance.errors import InputError
from brisance.formats.atomic import write_text
from brisance.model import Block, BrickWall, Charge, MeshObject, Scene, SceneSettings, Window
from brisance.sentences import Problem, first_problem

_BARE_WORD = re.compile(r"[A-Za-z][\w./ -]*")


class SceneFile(SceneSettings):
    """A scene as its file lays it out; the schema of this class documents the file."""

    charge: list[Charge] = Field(default_factory=list, description="The charges, one or more.")
    block: list[Block] = Field(default_factory=list, description="Boxes.")
    brick_wall: list[BrickWall] = Field(default_factory=list, description="Walls in running bond.")
    mesh: list[MeshObject] = Field(default_factory=list, description="Meshes from files.")
    window: list[Window] = Field(default_factory=list, description="Panes that may break.")


def load(path: Path | str, overrides: Iterable[str] = ()) -> Scene:
    """Read a scene file.

    ``overrides`` are changes such as ``"charge.0.mass=50"``, applied in order before anything is checked; the
    value is TOML, and a bare word counts as text. A duration that is a number takes the place of the file's
    ``"rest"`` and of its ``longest``. Raises :class:`InputError` with one sentence for whatever is wrong.
    """
    path = Path(path)
    data = _parse(path)
    changed = [_apply(data, override) for override in overrides]
    clock = data.get("time")
    by_number = "time.duration" in changed and "time.longest" not in changed
    if by_number and isinstance(clock, dict) and clock.get("duration") != "rest":
        clock.pop("longest", None)
    return scene_of(data, path, changed)


@contextmanager
def named_in_errors(path: Path | str) -> Iterator[None]:
    """Begin what is found wrong with a scene only as it is built or simulated with its file, as
    :func:`load` does.
    """
    try:
        yield
    except InputError as error:
        raise InputError(f"{path}: {error}") from error


def read_tables(path: Path | str) -> dict[str, Any]:
    """The tables of a scene file as plain data, not yet checked.

    Raises :class:`InputError` where it cannot be read or is not TOML.
    """
    return _parse(Path(path))


def scene_of(data: dict[str, Any], path: Path | str, changed: Sequence[str] = ()) -> Scene:
    """Check the tables of a scene file, as TOML gives them, and return the scene.

    ``path`` is where they are from: errors begin with it, files named in the scene are looked for beside it,
    and a scene without a name has the file's. ``changed`` are keys that a ``--set`` wrote. Raises
    :class:`InputError` with one sentence for whatever is wrong.
    """
    path = Path(path)
    try:
        wire = SceneFile.model_validate(data)
    except ValidationError as error:
        problem = first_problem(error, SceneFile)
        raise InputError(problem.sentence(_where(path, problem, changed))) from None
    settings = {key: getattr(wire, key) for key in SceneSettings.model_fields if key in wire.model_fields_set}
    settings.setdefault("name", path.stem.replace("_", " "))
    try:
        return Scene.model_validate(
            {
                **settings,
                "charges": wire.charge,
                "objects": [*wire.block, *wire.brick_wall, *wire.mesh, *wire.window],
                "base_folder": path.parent,
            }
        )
    except ValidationError as error:
        raise InputError(first_problem(error, Scene).sentence(str(path))) from None


def dump(scene: Scene, path: Path | str) -> None:
    """Write a scene as TOML, with only the keys that were set; :func:`load` gives the same scene back."""
    write_text(path, dumps(scene))


def dumps(scene: Scene) -> str:
    """A scene as the text of its file, with only the keys that were set."""
    data = scene.model_dump(mode="json", exclude_unset=True, exclude={"charges", "objects"})
    tables: dict[str, list[dict[str, Any]]] = {"charge": [_keys(charge) for charge in scene.charges]}
    for obj in scene.objects:
        tables.setdefault(obj.kind, []).append({"name": obj.name, **_keys(obj)})
    return _toml(data, tables)


def _keys(part: Any) -> dict[str, Any]:
    keys: dict[str, Any] = part.model_dump(mode="json", by_alias=True, exclude_unset=True, exclude_none=True)
    return keys


def _toml(data: dict[str, Any], tables: dict[str, list[dict[str, Any]]]) -> str:
    lines = [
        f"{key} = {json.dumps(value)}" for key, value in data.items() if not isinstance(value, dict | None)
    ]
    sections = [(f"[{key}]", value) for key, value in data.items() if isinstance(value, dict)]
    sections += [(f"[[{kind}]]", table) for kind, rows in tables.items() for table in rows]
    for header, table in sections:
        lines += ["", header]
        lines += [f"{key} = {_value_text(value)}" for key, value in table.items() if value is not None]
    return "\n".join(lines).lstrip("\n") + "\n"


def _value_text(value: Any) -> str:
    """A value as TOML has it: as in JSON, but for tables, which are written in line."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {_value_text(part)}" for key, part in value.items()) + " }"
    return json.dumps(value)


def _parse(path: Path) -> dict[str, Any]:
    try:
        text = path.read_bytes().decode("utf-8")
    except FileNotFoundError:
        raise InputError(f"{path} does not exist; give the path of a scene file (.toml).") from None
    except IsADirectoryError:
        raise InputError(f"{path} is a directory; give the path of a scene file (.toml).") from None
    except UnicodeDecodeError:
        raise InputError(
            f"{path} is not a text file in UTF-8, so it cannot be a scene file (.toml)."
        ) from None
    except (OSError, ValueError) as error:
        reason = (getattr(error, "strerror", None) or str(error)).lower()
        raise InputError(f"{path} cannot be read: {reason}.") from None
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        reason = str(error).replace("\n", "\\n")
        raise InputError(f"{path} is not valid TOML: {reason[:1].lower()}{reason[1:]}.") from None


def _where(path: Path, problem: Problem, changed: Sequence[str]) -> str:
    """The file, or the --set that wrote the key in question."""
    key = ".".join(str(part) for part in problem.key)
    by_flag = any(key == name or key.startswith(f"{name}.") or name.startswith(f"{key}.") for name in changed)
    return "--set" if key and by_flag else str(path)


def _apply(data: dict[str, Any], override: str) -> str:
    """Change ``data`` as ``override`` says and return the key it names."""
    key, equals, text = override.partition("=")
    key = key.strip()
    parts = key.split(".")
    if not equals or not all(parts):
        raise InputError(f"--set {override!r} is not of the form KEY=VALUE, such as charge.0.mass=50.")
    value = _value(key, text.strip())
    place: Any = data
    for depth, part in enumerate(parts[:-1]):
        place = _step(place, part, ".".join(parts[:depth]), key, create=True)
    if isinstance(place, list):
        _step(place, parts[-1], ".".join(parts[:-1]), key, create=False)
        place[int(parts[-1])] = value
    elif isinstance(place, dict):
        place[parts[-1]] = value
    else:
        raise InputError(f"--set {key}: {'.'.join(parts[:-1])} is a plain value, so it holds no {parts[-1]}.")
    return key


def _step(place: Any, part: str, above: str, key: str, *, create: bool) -> Any:
    if isinstance(place, list):
        if not part.isascii() or not part.isdigit():
            raise InputError(
                f"--set {key}: {above} is a list, so a number from 0 must follow it, not {part!r}."
            )
        if int(part) >= len(place):
            raise InputError(
                f"--set {key}: the number after {above} must be "
                f"{'0' if len(place) == 1 else f'0 to {len(place) - 1}'}, for the file holds {len(place)}, "
                f"not {part}."
            )
        return place[int(part)]
    if not isinstance(place, dict):
        raise InputError(f"--set {key}: {above} is a plain value, so it holds no {part}.")
    if part not in place and not above and part in ("charge", "block", "brick_wall", "mesh"):
        raise InputError(f"--set {key}: the scene has no [[{part}]] table to change; add one to the file.")
    return place.setdefault(part, {}) if create else place.get(part)


def _value(key: str, text: str) -> Any:
    try:
        return tomllib.loads(f"value = {text}")["value"]
    except tomllib.TOMLDecodeError:
        if _BARE_WORD.fullmatch(text):
            return text
        raise InputError(
            f'--set {key}: {text!r} is not a TOML value, such as 50, true, "text" or [0, 1, 2].'
        ) from None
