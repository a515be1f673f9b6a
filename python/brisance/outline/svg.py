"""Outlines in a drawing: its polygons, rectangles, circles and paths, at the size the drawing states."""

from __future__ import annotations

import math
import re
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from brisance.errors import InputError
from brisance.outline.svg_path import numbers, path_rings

Array = NDArray[np.float64]

_METRES = {"": 0.0254 / 96, "px": 0.0254 / 96, "pt": 0.0254 / 72, "pc": 0.0254 / 6} | {
    "in": 0.0254,
    "mm": 1e-3,
    "cm": 1e-2,
    "m": 1.0,
}
_ROUND = 96
"""Points of a circle."""
_NOT_SHOWN = ("defs", "clipPath", "mask", "symbol", "marker", "pattern", "metadata")


def svg_rings(text: str, path: Path) -> list[Array]:
    """The rings of all shapes in a drawing [m], y up. Open lines, text and images are passed over."""
    if "<!ENTITY" in text:
        raise InputError(f"{path} declares entities, which are not read; save it as plain SVG.")
    try:
        root = ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        raise InputError(f"{path} is not valid SVG: {error}.") from error
    if _tag(root) != "svg":
        raise InputError(f"{path} is XML, but not SVG; give a drawing whose first element is svg.")
    try:
        rings = list(_shapes(root, np.eye(3)))
        scale = _scale(root)
    except (ValueError, IndexError) as error:
        raise InputError(f"{path} has a shape that cannot be read: {error}.") from error
    return [ring * scale * np.array([1.0, -1.0]) for ring in rings]


def _scale(root: ElementTree.Element) -> float:
    """Metres a unit of the drawing."""
    box = numbers(root.get("viewBox", ""))
    stated = re.fullmatch(r"\s*([\d.eE+-]+)\s*([a-z]*)\s*", root.get("width", ""))
    if stated is None or stated[2] not in _METRES:
        return _METRES["px"]
    width = float(stated[1]) * _METRES[stated[2]]
    scale = width / box[2] if len(box) == 4 and box[2] > 0 else _METRES["px"]
    if not (math.isfinite(scale) and scale > 0):
        raise ValueError("its width is not a length above 0")
    return scale


def _shapes(element: ElementTree.Element, to_drawing: Array) -> Iterator[Array]:
    if _tag(element) in _NOT_SHOWN:
        return
    to_drawing = to_drawing @ _transform(element.get("transform", ""))
    for ring in _own_rings(element):
        yield ring @ to_drawing[:2, :2].T + to_drawing[:2, 2]
    for child in element:
        yield from _shapes(child, to_drawing)


def _own_rings(element: ElementTree.Element) -> list[Array]:
    def length(name: str) -> float:
        return float(element.get(name, "0"))

    kind = _tag(element)
    if kind in ("polygon", "polyline"):
        flat = numbers(element.get("points", ""))
        points = np.array(flat[: len(flat) // 2 * 2]).reshape(-1, 2)
        closed = kind == "polygon" or (len(points) > 0 and (points[0] == points[-1]).all())
        return [points] if closed else []
    if kind == "rect":
        x, y, width, height = (length(name) for name in ("x", "y", "width", "height"))
        return [np.array([(x, y), (x + width, y), (x + width, y + height), (x, y + height)])]
    if kind in ("circle", "ellipse"):
        radii = ("r", "r") if kind == "circle" else ("rx", "ry")
        turn = 2 * np.pi * np.arange(_ROUND) / _ROUND
        unit = np.stack([np.cos(turn), np.sin(turn)], axis=1)
        return [(length("cx"), length("cy")) + unit * [length(name) for name in radii]]
    return path_rings(element.get("d", "")) if kind == "path" else []


def _transform(text: str) -> Array:
    """The matrix of a ``transform``."""
    whole = np.eye(3)
    for name, inside in re.findall(r"(\w+)\s*\(([^)]*)\)", text):
        given = numbers(inside)
        if name == "matrix":
            a, b, c, d, e, f = given
            step = [[a, c, e], [b, d, f], [0, 0, 1]]
        elif name == "translate":
            step = [[1, 0, given[0]], [0, 1, given[1] if len(given) > 1 else 0], [0, 0, 1]]
        elif name == "scale":
            step = [[given[0], 0, 0], [0, given[-1], 0], [0, 0, 1]]
        elif name == "rotate":
            turn = math.radians(given[0])
            x, y = given[1:3] or (0.0, 0.0)
            c, s = math.cos(turn), math.sin(turn)
            step = [[c, -s, x - c * x + s * y], [s, c, y - s * x - c * y], [0, 0, 1]]
        elif name in ("skewX", "skewY"):
            lean = math.tan(math.radians(given[0]))
            step = [[1, lean if name == "skewX" else 0, 0], [lean if name == "skewY" else 0, 1, 0], [0, 0, 1]]
        else:
            raise ValueError(f"transform {name} is not known")
        whole = whole @ np.array(step)
    return whole


def _tag(element: ElementTree.Element) -> str:
    return str(element.tag).rpartition("}")[2]
