"""What a render writes, told by the name of its output."""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import Enum
from pathlib import Path

from brisance.errors import InputError

_HASHES = re.compile("#+")


class OutputKind(Enum):
    """The three things a render can be."""

    VIDEO = ".mp4"
    PICTURE = ".png"
    SEQUENCE = "####.png"


@dataclass(frozen=True)
class Output:
    """A render's output: its path as given, and what it stands for."""

    path: Path
    kind: OutputKind

    @staticmethod
    def of(path: Path) -> Output:
        """Read a name such as shot.mp4, shot.png or frames/####.png; :class:`InputError` for any other."""
        suffix = path.suffix.lower()
        if suffix == ".mp4":
            return Output(path, OutputKind.VIDEO)
        if suffix == ".png":
            return Output(path, OutputKind.SEQUENCE if _HASHES.search(path.stem) else OutputKind.PICTURE)
        raise InputError(
            f"{path} is no kind of file that can be rendered; give out.mp4, out.png or frames/####.png."
        )

    def name(self, frame: int) -> Path:
        """The file of one frame: the last run of hashes in the name becomes its number, padded with zeros."""
        runs = list(_HASHES.finditer(self.path.name))
        if self.kind is not OutputKind.SEQUENCE:
            return self.path
        first, last = runs[-1].span()
        number = f"{frame:0{last - first}d}"
        return self.path.with_name(self.path.name[:first] + number + self.path.name[last:])
