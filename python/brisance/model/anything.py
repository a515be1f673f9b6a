"""Every kind of object in a scene, and what they are called."""

from __future__ import annotations

from collections.abc import Sequence

from brisance.model.objects import Block, BrickWall, MeshObject
from brisance.model.window import Window

AnyObject = Block | BrickWall | MeshObject | Window


def object_keys(objects: Sequence[AnyObject]) -> list[str]:
    """The path of each object in a scene file, such as ``block.0``: its table and its number there."""
    seen: dict[str, int] = {}
    keys = []
    for obj in objects:
        number = seen.get(obj.kind, 0)
        seen[obj.kind] = number + 1
        keys.append(f"{obj.kind}.{number}")
    return keys


def named(objects: Sequence[AnyObject]) -> tuple[AnyObject, ...]:
    """The objects, each with a name: its own, else its table and number."""
    keys = object_keys(objects)
    owner: dict[str, str] = {}
    for obj, key in zip(objects, keys, strict=True):
        if obj.name is None:
            continue
        if obj.name in owner:
            raise ValueError(
                f"{key}.name {obj.name!r} is already the name of {owner[obj.name]}; give each its own name"
            )
        owner[obj.name] = key
    named = []
    for obj, key in zip(objects, keys, strict=True):
        name = obj.name or key.replace(".", "_")
        while obj.name is None and name in owner:
            name += "_"
        owner.setdefault(name, key)
        named.append(obj if obj.name else obj.model_copy(update={"name": name}))
    return tuple(named)
