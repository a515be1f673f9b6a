"""The ``d`` of an SVG path as rings of points: lines as they are, curves and arcs in short steps."""

from __future__ import annotations

import cmath
import math
import re

import numpy as np
from numpy.typing import NDArray

_COUNTS = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7, "Z": 0}
_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_STEPS = 16
"""Points of a Bézier curve; arcs have as many a right angle."""


def numbers(text: str) -> list[float]:
    """All numbers in a text."""
    return [float(number) for number in re.findall(_NUMBER, text)]


def path_rings(d: str) -> list[NDArray[np.float64]]:
    """The closed subpaths of a path, each as points (n, 2). :class:`ValueError` for what is not a path."""
    subpaths: list[list[complex]] = []
    at = start = handle = 0j
    before = ""
    for letter, given in _commands(d):
        kind = letter.upper()
        base = at if letter.islower() else 0j
        if kind == "M":
            at = start = base + complex(*given)
            subpaths.append([at])
        elif not subpaths:
            raise ValueError("a path must begin with M")
        elif kind == "Z":
            at = start
            subpaths[-1].append(start)
        else:
            if before == "Z":
                subpaths.append([at])
            smooth = 2 * at - handle if before in ("CS" if kind == "S" else "QT") and before else at
            points, handle = _stroke(kind, given, at, base, smooth)
            subpaths[-1] += points
            at = points[-1]
        before = kind
    closed = [points[:-1] for points in subpaths if len(points) > 1 and points[0] == points[-1]]
    return [np.array([(p.real, p.imag) for p in _distinct(points)]) for points in closed]


def _distinct(points: list[complex]) -> list[complex]:
    """Points of a ring, none twice in a row but for rounding."""
    near = 1e-9 * max(abs(point) for point in points)
    return [p for p, last in zip(points, [points[-1], *points[:-1]], strict=True) if abs(p - last) > near]


def _commands(d: str) -> list[tuple[str, list[float]]]:
    found = []
    for letter, text in re.findall(r"([A-Za-z])([^A-DF-Za-df-z]*)", d):
        count = _COUNTS.get(letter.upper())
        if count is None:
            raise ValueError(f"a path has the command {letter}")
        # The two flags of an arc are single digits that need nothing between them and what follows.
        given = _arc_numbers(text) if count == 7 else numbers(text)
        if (count == 0) != (not given) or (count and len(given) % count):
            raise ValueError(f"a path has {len(given)} numbers after {letter}")
        found.append((letter, given[:count]))
        following = {"M": "L", "m": "l"}.get(letter, letter)
        found += [(following, given[i : i + count]) for i in range(count, len(given), count or 1)]
    return found


def _arc_numbers(text: str) -> list[float]:
    flag = r"[\s,]*([01])[\s,]*"
    arcs = re.findall(
        rf"({_NUMBER})[\s,]*({_NUMBER})[\s,]*({_NUMBER}){flag}{flag}({_NUMBER})[\s,]*({_NUMBER})", text
    )
    return [float(number) for arc in arcs for number in arc]


def _stroke(
    kind: str, given: list[float], at: complex, base: complex, smooth: complex
) -> tuple[list[complex], complex]:
    """The points of one stroke without its start, and the handle that a smooth one goes on from."""
    if kind == "H":
        return [complex(base.real + given[0], at.imag)], at
    if kind == "V":
        return [complex(at.real, base.imag + given[0])], at
    if kind == "A":
        end = base + complex(given[5], given[6])
        return _arc(at, end, complex(given[0], given[1]), given[2], given[3] != given[4], given[4] != 0), end
    points = [base + complex(*pair) for pair in zip(given[::2], given[1::2], strict=True)]
    if kind == "L":
        return points, points[-1]
    if kind in "ST":
        points = [smooth, *points]
    t = np.arange(1, _STEPS + 1) / _STEPS
    control = [at, *points]
    degree = len(control) - 1
    curve = sum(math.comb(degree, i) * (1 - t) ** (degree - i) * t**i * p for i, p in enumerate(control))
    return [*np.asarray(curve).tolist()[:-1], points[-1]], points[-2]


def _arc(start: complex, end: complex, radii: complex, tilt: float, far: bool, sweeps: bool) -> list[complex]:
    """An elliptical arc by its ends: on the unit circle after the ellipse is turned back and shrunk.

    ``far`` tells on which side of the chord the centre lies.
    """
    rx, ry = abs(radii.real), abs(radii.imag)
    if start == end or rx == 0 or ry == 0:
        return [end]
    turn = cmath.rect(1.0, math.radians(tilt))

    def shrunk(point: complex) -> complex:
        back = point / turn
        return complex(back.real / rx, back.imag / ry)

    a, b = shrunk(start), shrunk(end)
    grow = max(1.0, abs(b - a) / 2)
    a, b = a / grow, b / grow
    rise = math.sqrt(max(0.0, 1 - abs(b - a) ** 2 / 4))
    centre = (a + b) / 2 + (1 if far else -1) * rise * 1j * (b - a) / abs(b - a)
    from_angle, angle = cmath.phase(a - centre), cmath.phase((b - centre) / (a - centre))
    if sweeps and angle < 0:
        angle += 2 * math.pi
    elif not sweeps and angle > 0:
        angle -= 2 * math.pi
    count = max(2, math.ceil(abs(angle) / (math.pi / 2) * _STEPS))
    points = [grow * (centre + cmath.rect(1.0, from_angle + angle * i / count)) for i in range(1, count)]
    return [*(complex(p.real * rx, p.imag * ry) * turn for p in points), end]
