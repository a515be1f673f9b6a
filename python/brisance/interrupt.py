"""Ctrl-C in the command: it ends at once, from wherever it is, and leaves nothing half done.

Python's own way, an exception out of nowhere, is mishandled by libraries that are being loaded: some swallow
it, some crash. So the command's handler does what must be done and ends the process. Where Brisance is used
as a library nothing here is in force, and Ctrl-C is Python's KeyboardInterrupt.
"""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress

TYPE_CHECKING = False
if TYPE_CHECKING:
    from types import FrameType
    from typing import NoReturn

_to_do: list[Callable[[], object]] = []


def end_on_ctrl_c() -> None:
    """From now on Ctrl-C ends the process with one line and exit code 130.

    A process that was started to ignore Ctrl-C (in the background of a script) goes on ignoring it.
    """
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, _end)


@contextmanager
def if_stopped(action: Callable[[], object]) -> Iterator[None]:
    """Have ``action`` done before Ctrl-C ends the process within the block."""
    _to_do.append(action)
    try:
        yield
    finally:
        _to_do.remove(action)


def restore_terminal() -> None:
    """Wipes the line of a progress bar and shows the cursor that it hides."""
    os.write(2, b"\r\x1b[2K\x1b[?25h")


def _end(number: int, frame: FrameType | None) -> NoReturn:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    for action in reversed(_to_do):
        with suppress(Exception):
            action()
    os.write(2, b"brisance: stopped.\n")
    os._exit(130)
