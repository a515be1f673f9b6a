"""Files to save: the scene of a request as TOML, or what it gives as USD, GLB, a page, or a report."""

from __future__ import annotations

import re
import tempfile
from pathlib import Path

from brisance.model import Scene
from brisance.scene_file import dumps
from brisance.simulation import simulate
from brisance.view.work import Job

KINDS = {
    "toml": "application/toml",
    "usdc": "application/octet-stream",
    "glb": "model/gltf-binary",
    "html": "text/html",
    "json": "application/json",
}
"""What can be saved, and what a browser calls it."""


def saved(scene: Scene, kind: str, job: Job) -> bytes:
    """The bytes of a file of one of the :data:`KINDS`."""
    if kind == "toml":
        return dumps(scene).encode()
    result = simulate(scene, progress=job.goes_on)
    job.goes_on()
    with tempfile.TemporaryDirectory(prefix="brisance-") as folder:
        path = Path(folder) / f"scene.{kind}"
        result.write(path)
        return path.read_bytes()


def file_name(scene: Scene, kind: str) -> str:
    """A name for the file, made of the scene's, safe on any system."""
    plain = re.sub(r"[^A-Za-z0-9_-]+", "_", scene.name).strip("_") or "scene"
    return f"{plain[:60]}.{kind}"
