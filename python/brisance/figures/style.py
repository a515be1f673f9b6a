"""How every figure looks: plain settings, and colours that colour-blind readers can tell apart."""

from __future__ import annotations

INK = "#222222"
GREY = "#6b6b6b"
PALE = "#e4e4e4"
BLUE = "#0072b2"
ORANGE = "#d55e00"
GREEN = "#009e73"
PURPLE = "#cc79a7"
SKY = "#56b4e9"
AMBER = "#e69f00"

CYCLE = (BLUE, ORANGE, GREEN, PURPLE, AMBER, SKY)
"""Line colours in order, after Okabe and Ito (2008)."""

DPI = 160
"""Pixels per inch of a saved picture; text is sized in points."""

SETTINGS: dict[str, object] = {
    "font.family": "DejaVu Sans",
    "font.size": 9.0,
    "text.color": INK,
    "axes.edgecolor": GREY,
    "axes.labelcolor": INK,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.titlesize": 9.0,
    "axes.titlecolor": GREY,
    "axes.titlelocation": "left",
    "figure.titlesize": 11.5,
    "figure.titleweight": "bold",
    "grid.color": PALE,
    "grid.linewidth": 0.7,
    "xtick.color": GREY,
    "ytick.color": GREY,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "lines.linewidth": 1.8,
    "lines.solid_capstyle": "round",
    "legend.frameon": False,
    "legend.handlelength": 1.6,
    "savefig.facecolor": "white",
    "figure.facecolor": "white",
}
"""Settings of matplotlib under which every figure is drawn."""
