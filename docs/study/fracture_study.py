"""Recomputes every number and picture of docs/fracture.md.

    .venv/bin/python docs/study/fracture_study.py

writes the pictures to docs/figures and prints the tables of the page. About a minute.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import fracture_measures as measures
import fracture_pictures as pictures

HERE = Path(__file__).resolve().parent


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument(
        "-o", "--output", type=Path, default=HERE.parent / "figures", help="folder of the pictures"
    )
    folder = parser.parse_args().output
    folder.mkdir(parents=True, exist_ok=True)
    for table in measures.tables():
        print("\n".join(table), end="\n\n")
    for path in pictures.draw_all(folder):
        print(path, f"{path.stat().st_size / 1024:.0f} kB")


if __name__ == "__main__":
    main()
