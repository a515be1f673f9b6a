"""The server itself: a free port, the browser, and an end at Ctrl-C."""

from __future__ import annotations

import contextlib
import socket
import threading
import webbrowser
from collections.abc import Callable, Iterator
from pathlib import Path

import uvicorn

from brisance.errors import BrisanceError, InputError
from brisance.formats.html import check_viewer
from brisance.view.app import make_app
from brisance.view.guard import LARGEST_BODY

PORT = 7437
"""Port to begin with; a free one is taken where it is in use."""
LOOPBACK = ("127.0.0.1", "::1", "localhost")


class _Server(uvicorn.Server):
    """Leaves signals alone: Ctrl-C ends the command as it ends every other."""

    @contextlib.contextmanager
    def capture_signals(self) -> Iterator[None]:
        yield


def serve(
    scene: Path,
    *,
    folder: Path | None = None,
    host: str = "127.0.0.1",
    port: int | None = None,
    open_browser: bool = True,
    told: Callable[[str], object] = print,
) -> None:
    """Serve the live view of ``scene`` until the process ends.

    ``folder`` holds the scenes that may be opened, by default those beside ``scene``; ``told`` hears the
    address once it answers. Raises :class:`InputError` where the scene is outside the folder or nothing can
    be bound to ``host``, and :class:`BrisanceError` where the viewer has not been built.
    """
    server, bound, address = prepare(scene, folder=folder, host=host, port=port)
    threading.Thread(target=_announce, args=(server, address, told, open_browser), daemon=True).start()
    server.run(sockets=[bound])
    if not server.started:
        raise BrisanceError(f"the live view could not start at {address}")


def prepare(
    scene: Path, *, folder: Path | None = None, host: str = "127.0.0.1", port: int | None = None
) -> tuple[uvicorn.Server, socket.socket, str]:
    """The server of :func:`serve`, not yet running, the socket it is to listen at, and its address."""
    check_viewer()
    root = folder if folder is not None else scene.parent
    if not scene.is_file():
        raise InputError(f"{scene} does not exist; give the path of a scene file (.toml).")
    if scene.resolve().parent != root.resolve():
        raise InputError(f"{scene} is not in the folder {root}; give the folder that it is in as --folder.")
    bound = _bind(host, port)
    number = bound.getsockname()[1]
    shown = f"[{host}]" if ":" in host else "localhost" if host in ("0.0.0.0", "::") else host
    address = f"http://{shown}:{number}/"
    app = make_app(
        root,
        first=scene.name,
        names=[host, socket.gethostname()] if host not in LOOPBACK else [],
        any_address=host not in LOOPBACK,
    )
    config = uvicorn.Config(
        app,
        log_level="critical",
        lifespan="off",
        ws="websockets-sansio",
        ws_max_size=LARGEST_BODY,
        ws_per_message_deflate=False,
        limit_concurrency=256,
        server_header=False,
        date_header=False,
    )
    return _Server(config), bound, address


def _announce(
    server: uvicorn.Server, address: str, told: Callable[[str], object], open_browser: bool
) -> None:
    pause = threading.Event()
    while not server.started:
        pause.wait(0.02)
    told(address)
    if open_browser:
        with contextlib.suppress(webbrowser.Error):
            webbrowser.open(address)


def _bind(host: str, port: int | None) -> socket.socket:
    """A listening socket: at ``port``, else at :data:`PORT`, else wherever there is room."""
    refused: OSError | None = None
    for candidate in (PORT if port is None else port, 0):
        try:
            family = socket.AF_INET6 if ":" in host else socket.AF_INET
            bound = socket.socket(family, socket.SOCK_STREAM)
            bound.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            bound.bind((host, candidate))
            bound.listen(128)
        except (OSError, OverflowError) as error:
            bound.close()
            refused = error if isinstance(error, OSError) else OSError(0, "no such port")
            continue
        return bound
    reason = ((refused and refused.strerror) or str(refused)).lower()
    raise InputError(f"--host {host} cannot be listened at: {reason}; leave it out for this machine alone.")
