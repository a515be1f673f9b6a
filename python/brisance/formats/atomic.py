"""Files appear whole or not at all: written under a temporary name beside the target, then renamed onto
it.
"""

from __future__ import annotations

import os
import secrets
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from brisance.errors import InputError
from brisance.interrupt import if_stopped


def check_writable(path: Path | str) -> Path:
    """Return ``path`` as a Path, or raise :class:`InputError` if a file could not be written there.

    Worth calling before long work whose result goes there. The target must not be a folder; its folder must
    exist and be writable.
    """
    path = Path(path)
    folder = path.parent
    if path.is_dir():
        raise InputError(f"{path} is a directory, so no file can be written there; give a file name.")
    if not folder.exists():
        raise InputError(f"{path} cannot be written: the folder {folder} does not exist; create it first.")
    if not folder.is_dir():
        raise InputError(f"{path} cannot be written: {folder} is a file, not a folder.")
    if not os.access(folder, os.W_OK | os.X_OK):
        raise InputError(
            f"{path} cannot be written: the folder {folder} is not writable; choose another one."
        )
    return path


@contextmanager
def replacing(path: Path | str) -> Iterator[Path]:
    """Yield a temporary path in the folder of ``path``; rename it onto ``path`` when the block ends well.

    The temporary name keeps the suffix of ``path``, for libraries that choose a format by it. Whatever ends
    the block early (an error, Ctrl-C) removes the temporary and leaves an existing file at ``path`` as it
    was.

    Raises :class:`InputError` where nothing can be written: a folder as target, a missing or unwritable
    parent, a full disk.
    """
    path = check_writable(path)
    temporary = path.with_name(f".{path.stem}.{secrets.token_hex(4)}.tmp{path.suffix}")
    try:
        with if_stopped(temporary.unlink):
            yield temporary
            os.replace(temporary, path)
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise InputError(f"{path} could not be written: {reason}.") from error
    finally:
        with suppress(OSError):
            temporary.unlink()


def write_text(path: Path | str, text: str) -> None:
    """Write ``text`` to ``path`` as UTF-8, whole or not at all."""
    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8")
