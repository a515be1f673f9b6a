"""Recomputes every number and picture of docs/window.md.

    .venv/bin/python docs/study/window_study.py

writes the pictures to docs/figures and prints the tables of the page. Under a minute.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import window_measures as measures

from brisance.figures import FIGURES

HERE = Path(__file__).resolve().parent
PICTURES = {"window-plume": (880, 700), "window-fragments": (1100, 860)}
"""Figures that the page shows, and their sizes [pixels]."""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument(
        "-o", "--output", type=Path, default=HERE.parent / "figures", help="folder of the pictures"
    )
    folder = parser.parse_args().output
    for table in measures.tables():
        print("\n".join(table), end="\n\n")
    for name, size in PICTURES.items():
        path, table = FIGURES[name].build(folder, size=size)
        table.unlink()
        path = path.rename(folder / f"{name.replace('-', '_')}.png")
        print(path, f"{path.stat().st_size / 1024:.0f} kB")


if __name__ == "__main__":
    main()
