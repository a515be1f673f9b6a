"""Recomputes every number and picture of docs/window.md.

    .venv/bin/python docs/study/window_study.py

writes the pictures to docs/figures and prints the tables of the page. Under a minute.
"""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path

import window_measures as measures
from PIL import Image

from brisance.figures import FIGURES

HERE = Path(__file__).resolve().parent
PICTURES = ("window-plume", "window-fragments")
"""Figures that the page shows."""
WIDTH, COLOURS = 1100, 96
"""Width [pixels] and colours of the page's pictures, which are to be small files."""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument(
        "-o", "--output", type=Path, default=HERE.parent / "figures", help="folder of the pictures"
    )
    folder = parser.parse_args().output
    for table in measures.tables():
        print("\n".join(table), end="\n\n")
    folder.mkdir(parents=True, exist_ok=True)
    for name in PICTURES:
        with tempfile.TemporaryDirectory() as scratch:
            picture = Image.open(FIGURES[name].build(scratch)[0]).convert("RGB")
        small = picture.resize((WIDTH, WIDTH * picture.height // picture.width), Image.Resampling.LANCZOS)
        path = folder / f"{name.replace('-', '_')}.png"
        small.quantize(COLOURS).save(path, optimize=True)
        print(path, f"{path.stat().st_size / 1024:.0f} kB")


if __name__ == "__main__":
    main()
