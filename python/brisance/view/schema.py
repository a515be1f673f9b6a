"""What a scene may hold, as a JSON schema from which the page builds its controls."""

from __future__ import annotations

from typing import Any

from brisance import _engine
from brisance.curve_table import BUILT_IN
from brisance.scene_file import SceneFile

BOUNDS = {"gt": "exclusiveMinimum", "ge": "minimum", "lt": "exclusiveMaximum", "le": "maximum"}
"""JSON schema's names of bounds that pydantic leaves under its own where a value is converted first."""


def schema() -> dict[str, Any]:
    """The schema of a scene file; texts that name something known carry the names as ``examples``."""
    whole: dict[str, Any] = _standard(SceneFile.model_json_schema())
    charge = whole["$defs"]["Charge"]["properties"]
    charge["explosive"]["examples"] = [name for name, _ in _engine.explosives()]
    charge["curves"]["examples"] = list(BUILT_IN)
    return whole


def _standard(part: Any) -> Any:
    if isinstance(part, dict):
        plain = {key: _standard(value) for key, value in part.items()}
        if "properties" not in plain and "$defs" not in plain:
            plain = {BOUNDS.get(key, key): value for key, value in plain.items()}
        return plain
    return [_standard(value) for value in part] if isinstance(part, list) else part
