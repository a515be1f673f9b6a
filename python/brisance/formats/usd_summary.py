"""What is in a USD result, read back for people: what ``brisance inspect result.usdc`` shows."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from pxr import Tf, Usd, UsdGeom

from brisance.errors import InputError
from brisance.formats.report import SCALAR_FACTS


@dataclass(frozen=True)
class ObjectSummary:
    """One object of the scene."""

    name: str
    material: str
    pieces: int
    moving: int
    """Pieces that move at all."""
    mass_kg: float
    """Of all its pieces [kg]."""


@dataclass(frozen=True)
class ChargeSummary:
    """One charge."""

    mass_kg: float
    tnt_mass_kg: float
    """Mass of TNT that is equivalent to it [kg]."""
    explosive: str | None
    """Name of the explosive, None where a factor was given instead."""
    position_m: tuple[float, float, float]
    burst: str
    time_s: float
    """When it detonates [s]."""
    gain: float


@dataclass(frozen=True)
class UsdSummary:
    """A USD result at a glance."""

    path: Path
    bytes: int
    version: str
    """Of Brisance, which wrote it."""
    scene: str
    seed: int
    layout: str
    """``"prims"`` or ``"instancer"``."""
    frames: int
    frame_rate: float
    """Frames a second of scene time [1/s]."""
    objects: tuple[ObjectSummary, ...]
    charges: tuple[ChargeSummary, ...]
    ground_height_m: float | None
    """None where there is no ground."""
    facts: dict[str, tuple[float, float]]
    """Smallest and largest value over all pieces of each fact; a fact that no piece has is left out."""
    warnings: tuple[str, ...]

    @property
    def pieces(self) -> int:
        """Number of pieces."""
        return sum(item.pieces for item in self.objects)

    @property
    def moving(self) -> int:
        """Number of pieces that move at all."""
        return sum(item.moving for item in self.objects)

    @property
    def mass_kg(self) -> float:
        """Mass of all pieces [kg]."""
        return sum(item.mass_kg for item in self.objects)

    @property
    def duration_s(self) -> float:
        """From the first frame to the last [s]."""
        return (self.frames - 1) / self.frame_rate


def summarise(path: Path | str) -> UsdSummary:
    """Read the summary of a USD file that Brisance wrote.

    :raises InputError: there is no such file, it is no USD, or Brisance did not write it.
    """
    path = Path(path)
    stage = _open(path)
    world = stage.GetDefaultPrim()
    if not world or not world.HasAttribute("brisance:version"):
        raise InputError(
            f"{path} is a USD file, but not one that Brisance wrote; give a result of brisance run."
        )
    objects = [prim for prim in world.GetChildren() if prim.HasAttribute("brisance:pieces")]
    return UsdSummary(
        path=path,
        bytes=path.stat().st_size,
        version=_get(world, "version"),
        scene=_get(world, "scene"),
        seed=_get(world, "seed"),
        layout=_get(world, "layout"),
        frames=round(stage.GetEndTimeCode() - stage.GetStartTimeCode()) + 1,
        frame_rate=stage.GetTimeCodesPerSecond(),
        objects=tuple(_object(prim) for prim in objects),
        charges=tuple(
            _charge(prim) for prim in _children(world, "Charges") if prim.HasAttribute("brisance:mass_kg")
        ),
        ground_height_m=_get(world.GetChild("Ground"), "height_m") if world.GetChild("Ground") else None,
        facts=_fact_ranges(objects),
        warnings=tuple(_get(world, "warnings") or ()),
    )


def _open(path: Path) -> Usd.Stage:
    if not path.exists():
        raise InputError(f"{path} does not exist; give a USD file written by brisance run.")
    if path.is_dir():
        raise InputError(f"{path} is a directory; give a USD file written by brisance run.")
    try:
        stage = Usd.Stage.Open(str(path))
    except Tf.ErrorException as error:
        raise InputError(f"{path} cannot be read as USD; give a file written by brisance run.") from error
    stage.Reload()
    return stage


def _get(prim: Usd.Prim, name: str) -> Any:
    return prim.GetAttribute(f"brisance:{name}").Get()


def _children(world: Usd.Prim, name: str) -> list[Usd.Prim]:
    scope = world.GetChild(name)
    return list(scope.GetChildren()) if scope else []


def _object(prim: Usd.Prim) -> ObjectSummary:
    return ObjectSummary(
        name=_get(prim, "name"),
        material=_get(prim, "material"),
        pieces=_get(prim, "pieces"),
        moving=_get(prim, "moving_pieces"),
        mass_kg=_get(prim, "total_mass_kg"),
    )


def _charge(prim: Usd.Prim) -> ChargeSummary:
    x, y, z = UsdGeom.Xformable(prim).GetLocalTransformation().ExtractTranslation()
    return ChargeSummary(
        mass_kg=_get(prim, "mass_kg"),
        tnt_mass_kg=_get(prim, "tnt_mass_kg"),
        explosive=_get(prim, "explosive"),
        position_m=(x, y, z),
        burst=_get(prim, "burst"),
        time_s=_get(prim, "time_s"),
        gain=_get(prim, "gain"),
    )


def _fact_ranges(objects: list[Usd.Prim]) -> dict[str, tuple[float, float]]:
    ranges = {}
    for name in SCALAR_FACTS:
        parts = [_fact_values(prim, name) for prim in objects]
        values = np.concatenate(parts) if parts else np.empty(0)
        values = values[~np.isnan(values)]
        if len(values):
            ranges[name] = (float(values.min()), float(values.max()))
    return ranges


def _fact_values(prim: Usd.Prim, name: str) -> np.ndarray[Any, np.dtype[np.float64]]:
    """The values of one fact over the pieces of an object, whichever its layout."""
    if prim.IsA(UsdGeom.PointInstancer):
        values = _get(prim, name)
    else:
        values = [value for child in prim.GetChildren() if (value := _get(child, name)) is not None]
    return np.array(values, dtype=np.float64)
