"""Runs in threads, so that the server goes on listening; each can be called off.

The engine lets go of Python's lock while it works and asks twenty times a second whether to go on. What comes
before (a mesh being repaired, shelters being found) cannot be called off; it ends by itself and its result
is dropped.
"""

from __future__ import annotations

import asyncio
import os
import sys
import threading
import traceback
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

from brisance.errors import BrisanceError

WORKERS = 4
"""Runs at a time. Each uses every core, so more would only take turns; fewer would wait for stale ones."""
GLANCE = 0.05
"""Seconds between two looks at how far a run is."""

T = TypeVar("T")


class CalledOffError(Exception):
    """The run is no longer wanted."""


class Job:
    """One run: told to stop from one thread, heard of in another."""

    def __init__(self) -> None:
        self._stop = threading.Event()
        self.progress = (0, 0)
        """Frames done and all frames; 0 of 0 before the first."""

    def call_off(self) -> None:
        """Have the run end soon."""
        self._stop.set()

    def goes_on(self, done: int = 0, total: int = 0) -> None:
        """What a run calls now and then; raises :class:`CalledOffError` when it is no longer wanted."""
        if self._stop.is_set():
            raise CalledOffError
        self.progress = (done, total)


class Workers:
    """The threads that runs share."""

    def __init__(self) -> None:
        self._pool = ThreadPoolExecutor(WORKERS, thread_name_prefix="simulation")
        self._running = 0

    @property
    def running(self) -> int:
        """Runs under way or waiting for a thread."""
        return self._running

    async def run(self, job: Job, work: Callable[[Job], T]) -> T:
        """Do ``work`` in a thread and return what it gives; cancelling the caller calls the job off."""

        def guarded() -> T:
            job.goes_on()
            return work(job)

        self._running += 1
        future = asyncio.get_running_loop().run_in_executor(self._pool, guarded)
        future.add_done_callback(self._ended)
        try:
            return await asyncio.shield(future)
        except asyncio.CancelledError:
            job.call_off()
            future.add_done_callback(lambda ended: ended.cancelled() or ended.exception())
            raise

    def _ended(self, future: asyncio.Future[T]) -> None:
        self._running -= 1


def sentence(error: BaseException) -> str:
    """What to tell of an error: its own sentence where the request is to blame."""
    if isinstance(error, BrisanceError):
        told = str(error)
        return told if told.endswith((".", "?")) else f"{told}."
    if isinstance(error, MemoryError):
        return "There is not enough memory for this; lower the number of frames or pieces."
    if os.environ.get("BRISANCE_TRACEBACK"):
        traceback.print_exception(error, file=sys.stderr)
    what = " ".join(f"{type(error).__name__}: {error}".split())
    return f"Unexpected error, {what[:300]} (set BRISANCE_TRACEBACK=1 to see where)."
