"""Keys that a scene sets and that count for nothing beside its other keys."""

from __future__ import annotations

from collections.abc import Iterator

from brisance.model import BrickWall, Scene, Window


def idle_keys(scene: Scene) -> Iterator[str]:
    """One sentence for every object with such keys."""
    for obj in scene.objects:
        if isinstance(obj, BrickWall):
            if obj.mortar is not None and not scene.dynamics.contacts:
                yield (
                    f"{obj.name}: its mortar binds nothing, for its bricks do not touch; set "
                    "dynamics.contacts = true."
                )
        elif isinstance(obj, Window):
            yield from _idle_in_window(obj)


def _idle_in_window(window: Window) -> Iterator[str]:
    given = window.model_fields_set
    frame_keys = [key for key in ("bite", "frame_material") if key in given]
    if frame_keys and not window.frame:
        keys, count = " and ".join(frame_keys), "counts" if len(frame_keys) == 1 else "count"
        yield f"{window.name}: {keys} {count} for nothing without a frame; set frame = true."
    if "strength" in given and window.release == "all at once" and not window.anchored:
        yield (
            f"{window.name}: strength counts for nothing, for the pane is in pieces before the blast; set "
            'release = "as it cracks".'
        )
