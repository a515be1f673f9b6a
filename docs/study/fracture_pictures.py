"""The pictures of docs/fracture.md."""

from __future__ import annotations

import io
from collections.abc import Callable, Sequence
from pathlib import Path

import fracture_measures as measures
import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from PIL import Image

import brisance as br
from brisance.figures import cracks, style

DPI = 130
GREYS, COLOURS = 10, 96
"""Shades of a picture of lines and of one with colours: few, so that its file stays small."""


def draw_all(folder: Path) -> list[Path]:
    """Draw every picture into a folder and return their paths."""
    sheets: dict[str, tuple[Callable[[], Figure], int]] = {
        "fracture_patterns": (patterns, GREYS),
        "fracture_forking": (forking, COLOURS),
        "fracture_distributions": (distributions, COLOURS),
        "fracture_knobs_1": (lambda: knobs(KNOBS[:4]), GREYS),
        "fracture_knobs_2": (lambda: knobs(KNOBS[4:]), GREYS),
        "fracture_time": (time, COLOURS),
    }
    with matplotlib.rc_context(dict(style.SETTINGS)):
        return [_save(sheet(), folder / f"{name}.png", shades) for name, (sheet, shades) in sheets.items()]


def _sheet(width: float, height: float) -> Figure:
    picture = Figure(figsize=(width, height), dpi=DPI, layout="constrained")
    FigureCanvasAgg(picture)
    return picture


def _save(picture: Figure, path: Path, shades: int) -> Path:
    memory = io.BytesIO()
    picture.savefig(memory, dpi=DPI)
    image = Image.open(memory).convert("RGB")
    image.quantize(shades, dither=Image.Dither.NONE).save(path, optimize=True)
    return path


def _pane(axes: Axes, pane: br.Fracture, title: str, *, width: float = 0.4) -> None:
    cracks.draw_cracks(axes, pane, width=width)
    axes.set_title(title)


def patterns() -> Figure:
    """One pane of each kind."""
    picture = _sheet(9.6, 10.0)
    literal = br.Pattern(literal=True, shape="segment", pieces=700, wiggle_probability=0.5)
    shown = [
        (cracks.wiggling_and_varied(), "thesis, Fig. 5.14: {} fragments, 1 m"),
        (br.fracture(literal, seed=6), "the same rule, finer: {} fragments, 1 m"),
        (br.fracture(br.Pattern(pieces=500), seed=2), "annealed: {} fragments, 1 m"),
        (br.fracture(br.Pattern(pieces=3000), seed=3), "annealed, many flaws: {} fragments, 1 m"),
        (
            br.fracture(br.Pattern(glass="tempered"), width=0.2, height=0.2, seed=2),
            "tempered: {} dice, 0.2 m",
        ),
        (_three_starts(), "three impacts: {} fragments, 1.2 m by 1 m"),
    ]
    for axes, (pane, title) in zip(picture.subplots(2, 3).ravel(), shown, strict=True):
        _pane(axes, pane, title.format(len(pane.polygons)), width=0.35)
    picture.set_size_inches(11.4, 7.8)
    return picture


def _three_starts() -> br.Fracture:
    pattern = br.Pattern(pieces=500, seeds=[(0.2, 0.3), (0.72, 0.22), (0.6, 0.8)])
    return br.fracture(pattern, width=1.2, height=1.0, seed=3)


def forking() -> Figure:
    """The literal rule and ours from the same start, and the sizes that come of them."""
    picture = _sheet(12.6, 4.5)
    axes = picture.subplots(1, 3)
    seed = int(np.argmax(measures.LITERAL.crowding))
    for place, case in zip(axes, (measures.LITERAL, measures.DRIVEN), strict=False):
        pane = case.panes[seed]
        _pane(place, pane, f"{case.name}: {len(pane.polygons)} fragments", width=0.35)
    for case, colour in ((measures.LITERAL, style.ORANGE), (measures.DRIVEN, style.BLUE)):
        axes[2].loglog(*measures.survivors(case.relative_area), color=colour, label=case.name)
    axes[2].set_xlim(1e-5, 200.0)
    axes[2].set_xlabel("area over the mean")
    axes[2].set_ylabel("share of fragments at least as large")
    axes[2].legend()
    return picture


def distributions() -> Figure:
    """Sizes, aspect ratios, fork angles and vertices of four kinds of pane."""
    picture = _sheet(10.5, 8.0)
    sizes, aspect, angles, vertices = picture.subplots(2, 2).ravel()
    for case, colour in zip(measures.CASES, style.CYCLE, strict=False):
        sizes.loglog(*measures.survivors(case.relative_area), color=colour, label=case.name)
        _density(aspect, case.aspect, np.geomspace(1.0, 60.0, 40), colour)
        if len(case.fork_angles) > 100:
            _density(angles, case.fork_angles, np.linspace(0.0, 60.0, 61), colour)
        vertices.loglog(*measures.survivors(case.vertices.astype(float)), color=colour)
    area = np.array([0.02, 1.0])
    sizes.loglog(area, 0.08 * area**-0.5, color=style.GREY, linestyle="--", linewidth=1.2)
    sizes.annotate("slope −½", (0.02, 0.3), color=style.GREY)
    sizes.set(xlim=(1e-4, 200.0), ylim=(1e-4, 2.0), xlabel="area over the mean")
    sizes.set_ylabel("share of fragments at least as large")
    sizes.legend(loc="lower left")
    aspect.set(xscale="log", xlabel="length over width", ylabel="share of fragments in a bin")
    angles.set(xlabel="angle between the branches of a fork [°]", ylabel="share of forks in a bin")
    vertices.set(xlabel="vertices of a fragment", ylabel="share of fragments with at least as many")
    return picture


def _density(axes: Axes, values: measures.Array, edges: measures.Array, colour: str) -> None:
    share = np.histogram(values, edges)[0] / len(values)
    axes.stairs(share, edges, color=colour, linewidth=1.6)


Knob = tuple[tuple[str, ...], Sequence[dict[str, object]]]

KNOBS: Sequence[Knob] = (
    (("pieces",), [{"pieces": n} for n in (60, 300, 1200, 2500)]),
    (("fork_angle",), [{"fork_angle": angle} for angle in (8, 25, 50, 90)]),
    (("fork_variance",), [{"fork_variance": v, "wiggle_probability": 0} for v in (0, 15, 34.5, 90)]),
    (("wiggle_variance",), [{"wiggle_variance": v} for v in (0, 10, 20, 60)]),
    (("wiggle_spacing",), [{"wiggle_spacing": d, "wiggle_variance": 40} for d in (0.003, 0.01, 0.03, 0.1)]),
    (("rings",), [{"rings": share} for share in (0, 0.3, 0.6, 1)]),
    (
        ("shape", "literal"),
        [
            {"shape": "segment"},
            {"shape": "cross"},
            {"shape": "star"},
            {"shape": "segment", "literal": True},
        ],
    ),
    (
        ("seeds", "toward", "reach"),
        [
            {"seeds": [(0.15, 0.2)]},
            {"seeds": [(0.25, 0.3), (0.7, 0.7)]},
            {"toward": 60},
            {"reach": 0.3},
        ],
    ),
)
"""Settings, and how each is turned from left to right. What is not named is the default, in 300 pieces."""


def knobs(shown: Sequence[Knob]) -> Figure:
    """Small panes, one row for each setting."""
    picture = _sheet(8.0, 2.16 * len(shown))
    for row, (names, turns) in zip(picture.subplots(len(shown), 4), shown, strict=True):
        for axes, turn in zip(row, turns, strict=True):
            pane = br.fracture(br.Pattern(**({"pieces": 300} | turn)), seed=2)
            title = ", ".join(f"{key} = {value}" for key, value in turn.items() if key in names)
            _pane(axes, pane, title, width=0.3)
            axes.title.set_fontsize(6.5)
    return picture


def time() -> Figure:
    """One pane as its cracks run, coloured by when each was cut."""
    picture = _sheet(12.6, 3.6)
    pane = br.fracture(br.Pattern(pieces=500), seed=2)
    ends, cut = pane.engine.crack_ends.reshape(-1, 2, 2), 1e3 * pane.crack_times
    moments = (0.1, 0.2, 0.35, float(cut.max()))
    row = picture.subplots(1, 4)
    lines = None
    for axes, moment in zip(row, moments, strict=True):
        run = np.clip((moment - cut[:, 0]) / np.maximum(cut[:, 1] - cut[:, 0], 1e-12), 0.0, 1.0)
        reached = ends[:, 0] + run[:, None] * (ends[:, 1] - ends[:, 0])
        shown = run > 0.0
        closed = np.count_nonzero(1e3 * pane.closed_at <= moment + 1e-9)
        lines = LineCollection(
            list(np.stack([ends[:, 0], reached], axis=1)[shown]), cmap="viridis_r", linewidths=0.6
        )
        lines.set_array(cut[shown, 0])
        lines.set_clim(0.0, moments[-1])
        axes.add_collection(lines)
        ring = pane.outline[0]
        axes.plot(*np.vstack([ring, ring[:1]]).T, color=style.INK, linewidth=0.6)
        cracks.bare(axes)
        axes.set_title(f"{moment:.2f} ms: {closed} fragments closed")
    picture.colorbar(lines, ax=list(row), label="cut after [ms]", shrink=0.8)
    return picture
