"""Renders frames of a USD file with Blender, as ``python -m brisance.render.blender_worker``.

The job comes as JSON on standard input; each finished frame, or the reason for stopping, goes as one line of
JSON to standard output. Whatever Blender itself prints is dropped, or shown on standard error with
BRISANCE_TRACEBACK=1.
"""

from __future__ import annotations

import json
import os
import sys
import traceback
from collections.abc import Iterator
from typing import TextIO

from brisance.render.job import Job


def main() -> int:
    """Run the job on standard input; 0 when every frame was rendered."""
    reports = _silence()
    try:
        job = Job.from_json(sys.stdin.read())
        for frame, path in _shot(job):
            _tell(reports, frame=frame, path=path)
    except BrokenPipeError:
        return 1
    except Exception as error:
        if _is_verbose():
            traceback.print_exc()
        _tell(reports, error=describe(error))
        return 1
    return 0


def _shot(job: Job) -> Iterator[tuple[int, str]]:
    from brisance.render.blender_scene import take

    return take(job)


def describe(error: Exception) -> str:
    """What went wrong, on one line; with the remedy where a system library is missing."""
    text = " ".join(str(error).split()) or type(error).__name__
    if isinstance(error, ImportError) and ".so" in text:
        return (
            f"Blender needs a system library that is missing ({text}); on Debian and Ubuntu, run "
            f"apt-get install {' '.join(DEBIAN_PACKAGES)}"
        )
    return text


DEBIAN_PACKAGES = (
    "libgl1",
    "libice6",
    "libsm6",
    "libx11-6",
    "libxext6",
    "libxfixes3",
    "libxi6",
    "libxkbcommon0",
    "libxrender1",
)
"""What Blender as a module links to and a bare Debian lacks; no display is needed for any of it."""


def _silence() -> TextIO:
    """A stream to the parent on the real standard output; standard output itself goes where noise belongs."""
    reports = os.fdopen(os.dup(1), "w", encoding="utf-8")
    if _is_verbose():
        os.dup2(2, 1)
    else:
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, 1)
        os.dup2(nowhere, 2)
    return reports


def _is_verbose() -> bool:
    return os.environ.get("BRISANCE_TRACEBACK") == "1"


def _tell(reports: TextIO, **facts: int | str) -> None:
    reports.write(json.dumps(facts) + "\n")
    reports.flush()


if __name__ == "__main__":
    sys.exit(main())
