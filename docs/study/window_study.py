"""Recomputes every number and picture of docs/window.md.

    .venv/bin/python docs/study/window_study.py

writes the pictures to docs/figures and prints the tables of the page; with --write it also puts them into the
page, whose prose is then to be read again. Under a minute.
"""

from __future__ import annotations

import argparse
import re
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
    parser.add_argument("--write", action="store_true", help="put the tables into docs/window.md")
    arguments = parser.parse_args()
    folder = arguments.output
    for table in measures.tables():
        print("\n".join(table), end="\n\n")
    if arguments.write:
        write_tables(HERE.parent / "window.md")
    folder.mkdir(parents=True, exist_ok=True)
    for name in PICTURES:
        with tempfile.TemporaryDirectory() as scratch:
            picture = Image.open(FIGURES[name].build(scratch)[0]).convert("RGB")
        small = picture.resize((WIDTH, WIDTH * picture.height // picture.width), Image.Resampling.LANCZOS)
        path = folder / f"{name.replace('-', '_')}.png"
        small.quantize(COLOURS).save(path, optimize=True)
        print(path, f"{path.stat().st_size / 1024:.0f} kB")


def write_tables(page: Path) -> None:
    """Put every table in the place of the one with the same header."""
    text = page.read_text(encoding="utf-8")
    for table in measures.tables():
        text, places = re.subn(
            re.escape(table[0]) + r"(\n\|.*)*", lambda _, lines=table: "\n".join(lines), text
        )
        if places != 1:
            raise SystemExit(f"{page} has {places} tables that begin with {table[0]}")
    page.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
