"""Starts Blender in a process of its own and hands over its pictures one by one."""

from __future__ import annotations

import importlib.util
import json
import os
import signal
import subprocess
import sys
from collections.abc import Generator, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from brisance.errors import BrisanceError, InputError
from brisance.interrupt import if_stopped
from brisance.render.job import Job

COMMAND = [sys.executable, "-m", "brisance.render.blender_worker"]
"""What is started: reads a job from standard input, writes one line of JSON a frame to standard output."""

VERBOSE = "BRISANCE_TRACEBACK"
"""Environment variable that, set to 1, lets Blender's own messages through to standard error."""


def require(*modules: str) -> None:
    """Raise :class:`InputError` unless the packages of ``brisance[render]`` are there."""
    missing = [name for name in modules if importlib.util.find_spec(name) is None]
    if missing:
        raise InputError(
            f"rendering needs {' and '.join(missing)}, which is missing; run pip install 'brisance[render]' "
            "with Python 3.11."
        )


def rendered(job: Job) -> Generator[tuple[int, Path], None, None]:
    """Run the job; yields each frame's number and picture as soon as it is finished.

    Ending the iteration early, by Ctrl-C or by closing it, stops Blender at once. Raises
    :class:`BrisanceError` with Blender's own reason where it fails.
    """
    with _worker(job) as process:
        assert process.stdout is not None
        for line in process.stdout:
            facts = json.loads(line)
            if "error" in facts:
                raise BrisanceError(f"{job.usd} could not be rendered: {facts['error'].rstrip('.')}.")
            yield facts["frame"], Path(facts["path"])
        code = process.wait()
    if code:
        reason = signal.Signals(-code).name if code < 0 else f"exit code {code}"
        raise BrisanceError(
            f"{job.usd} could not be rendered: Blender stopped unexpectedly ({reason}); set {VERBOSE}=1 "
            "to see its own messages."
        )


@contextmanager
def _worker(job: Job) -> Iterator[subprocess.Popen[str]]:
    """The rendering process, which never outlives the block and which Ctrl-C does not reach."""
    process = subprocess.Popen(
        COMMAND,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        encoding="utf-8",
        env=_environment(),
        start_new_session=True,
    )

    def end() -> None:
        process.kill()
        process.wait()

    try:
        with if_stopped(end):
            assert process.stdin is not None
            with suppress(BrokenPipeError), process.stdin:
                process.stdin.write(job.to_json())
            yield process
    finally:
        end()
        if process.stdout is not None:
            process.stdout.close()


def _environment() -> dict[str, str]:
    """The environment with this package's own folder first on the module path, however it was found here."""
    home = str(Path(__file__).resolve().parents[2])
    known = os.environ.get("PYTHONPATH")
    return os.environ | {"PYTHONPATH": os.pathsep.join([home, known] if known else [home])}
