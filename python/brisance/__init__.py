"""Explosions for animation: physically based blast, from a scene file to the flight of every piece.

>>> import brisance as br
>>> scene = br.load("scenes/brick_wall.toml")
>>> result = br.simulate(scene)
>>> result.write("wall.usdc")

Names are imported when first used, so that ``import brisance`` costs next to nothing.
"""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from brisance.errors import BrisanceError, InputError
    from brisance.model import (
        Air,
        Block,
        BrickWall,
        Charge,
        Dynamics,
        Ground,
        Loading,
        MeshObject,
        Occlusion,
        Pattern,
        Scene,
        Time,
        Window,
        WindowPattern,
    )
    from brisance.pane import Fracture, fracture
    from brisance.result import Bodies, Pane, Result
    from brisance.scene_file import load
    from brisance.simulation import simulate

_HOME = {
    "BrisanceError": "errors",
    "InputError": "errors",
    "Air": "model",
    "Block": "model",
    "BrickWall": "model",
    "Charge": "model",
    "Dynamics": "model",
    "Ground": "model",
    "Loading": "model",
    "MeshObject": "model",
    "Occlusion": "model",
    "Pattern": "model",
    "Scene": "model",
    "Time": "model",
    "Window": "model",
    "WindowPattern": "model",
    "Fracture": "pane",
    "fracture": "pane",
    "Bodies": "result",
    "Pane": "result",
    "Result": "result",
    "load": "scene_file",
    "simulate": "simulation",
}

__all__ = [
    "Air",
    "Block",
    "Bodies",
    "BrickWall",
    "BrisanceError",
    "Charge",
    "Dynamics",
    "Fracture",
    "Ground",
    "InputError",
    "Loading",
    "MeshObject",
    "Occlusion",
    "Pane",
    "Pattern",
    "Result",
    "Scene",
    "Time",
    "Window",
    "WindowPattern",
    "__version__",
    "fracture",
    "load",
    "simulate",
]


def __getattr__(name: str) -> Any:
    import importlib

    if name == "__version__":
        from importlib.metadata import PackageNotFoundError, version

        try:
            value: Any = version("brisance")
        except PackageNotFoundError:
            value = "0+unknown"
    elif name in _HOME:
        value = getattr(importlib.import_module(f"brisance.{_HOME[name]}"), name)
    else:
        raise AttributeError(f"module 'brisance' has no attribute {name!r}")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return __all__
