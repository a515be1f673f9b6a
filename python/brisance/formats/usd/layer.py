"""The layer that a USD file is made of: what every file of ours says of itself, and its way to disk."""

from __future__ import annotations

import os
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

from pxr import Sdf, Tf

from brisance.errors import InputError
from brisance.formats.atomic import check_writable, replacing
from brisance.formats.usd.authoring import attribute
from brisance.interrupt import if_stopped

SUFFIXES = (".usd", ".usda", ".usdc", ".usdz")
"""Endings of USD file names: ``.usda`` is text, ``.usd`` and ``.usdc`` are binary, ``.usdz`` is a package."""

_PACKAGE_TIME = time.mktime((1980, 1, 2, 0, 0, 0, 0, 0, -1))
"""Packages state when their file was made, in local time; a fixed moment keeps their bytes the same [s]."""

_T = Sdf.ValueTypeNames


def check_usd_path(path: Path | str) -> Path:
    """Return the path, or raise :class:`InputError` unless a USD file can be written there."""
    path = Path(path)
    if path.suffix.lower() not in SUFFIXES:
        raise InputError(
            f"{path} does not name a USD file; let it end in {', '.join(SUFFIXES[:-1])} or {SUFFIXES[-1]}."
        )
    return check_writable(path)


def start_layer(layer: Sdf.Layer, *, scene: str, seed: int, frames: int, frame_rate: float) -> Sdf.PrimSpec:
    """Author axes, units, time codes and origin of a layer; return its default prim ``/World``."""
    root = layer.pseudoRoot
    root.SetInfo("upAxis", "Y")
    root.SetInfo("metersPerUnit", 1.0)
    root.SetInfo("kilogramsPerUnit", 1.0)
    layer.defaultPrim = "World"
    layer.timeCodesPerSecond = layer.framesPerSecond = frame_rate
    layer.startTimeCode, layer.endTimeCode = 0.0, float(frames - 1)
    layer.comment = f"Brisance {_version()}: {scene}, seed {seed}"
    layer.customLayerData = {"brisance": {"version": _version(), "scene": scene, "seed": str(seed)}}
    world = Sdf.PrimSpec(layer, "World", Sdf.SpecifierDef, "Xform")
    world.kind = "assembly"
    attribute(world, "brisance:version", _T.String, _version(), uniform=True)
    attribute(world, "brisance:scene", _T.String, scene, uniform=True)
    attribute(world, "brisance:seed", _T.Int64, seed, uniform=True)
    return world


def write_layer(layer: Sdf.Layer, path: Path | str) -> None:
    """Write a layer to a path that :func:`check_usd_path` has passed, whole or not at all."""
    path = Path(path)
    with replacing(path) as temporary:
        if path.suffix.lower() == ".usdz":
            _package(layer, temporary, shown=path)
        else:
            _export(layer, temporary, shown=path)


def _version() -> str:
    import brisance

    return str(brisance.__version__)


def _export(layer: Sdf.Layer, path: Path, *, shown: Path) -> None:
    """Write a layer to ``path``; an error names the file the user asked for, ``shown``."""
    with _refusals(shown):
        if not layer.Export(str(path)):
            raise InputError(f"{shown} could not be written; check the free space on its disk.")


def _package(layer: Sdf.Layer, path: Path, *, shown: Path) -> None:
    from pxr import UsdUtils

    work = TemporaryDirectory()
    with work as folder, if_stopped(work.cleanup):
        inner = Path(folder) / f"{Tf.MakeValidIdentifier(shown.stem)}.usdc"
        _export(layer, inner, shown=shown)
        os.utime(inner, (_PACKAGE_TIME, _PACKAGE_TIME))
        with _refusals(shown):
            if not UsdUtils.CreateNewUsdzPackage(Sdf.AssetPath(str(inner)), str(path)):
                raise InputError(f"{shown} could not be written; check the free space on its disk.")


@contextmanager
def _refusals(path: Path) -> Iterator[None]:
    try:
        yield
    except Tf.ErrorException as error:
        raise InputError(f"{path} could not be written; check the free space on its disk.") from error
