"""What a scene may hold, as a JSON schema from which the page builds its controls."""

from __future__ import annotations

from typing import Any

from brisance import _engine
from brisance.curve_table import BUILT_IN
from brisance.scene_file import SceneFile


def schema() -> dict[str, Any]:
    """The schema of a scene file; texts that name something known carry the names as ``examples``."""
    whole = SceneFile.model_json_schema()
    charge = whole["$defs"]["Charge"]["properties"]
    charge["explosive"]["examples"] = [name for name, _ in _engine.explosives()]
    charge["curves"]["examples"] = list(BUILT_IN)
    return whole
