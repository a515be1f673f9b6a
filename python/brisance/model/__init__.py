"""The scene: what an artist says, validated, in SI units (metres, kilograms, seconds, pascals, kelvins).

The same classes serve the scene file and Python. Each is frozen, refuses unknown keys, and takes numbers only
where it asks for numbers (no text, no true or false, no infinity). Axes are right-handed with Y up; angles
are in degrees, because a person types them here.

A value out of range raises :class:`brisance.errors.InputError` with one sentence.
"""

from __future__ import annotations

from brisance.model.anything import AnyObject, object_keys
from brisance.model.base import Material, Model
from brisance.model.charge import Charge, explosive_factor
from brisance.model.objects import Block, BrickWall, MeshObject, SceneObject
from brisance.model.pattern import Cracks, Pattern, WindowPattern
from brisance.model.scene import Scene
from brisance.model.settings import Air, Dynamics, Ground, Loading, Occlusion, SceneSettings, Time
from brisance.model.window import Window

__all__ = [
    "Air",
    "AnyObject",
    "Block",
    "BrickWall",
    "Charge",
    "Cracks",
    "Dynamics",
    "Ground",
    "Loading",
    "Material",
    "MeshObject",
    "Model",
    "Occlusion",
    "Pattern",
    "Scene",
    "SceneObject",
    "SceneSettings",
    "Time",
    "Window",
    "WindowPattern",
    "explosive_factor",
    "object_keys",
]
