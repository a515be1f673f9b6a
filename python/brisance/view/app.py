"""The routes of the live view."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from starlette.applications import Starlette
from starlette.exceptions import HTTPException
from starlette.middleware import Middleware
from starlette.requests import ClientDisconnect, Request
from starlette.responses import JSONResponse, Response
from starlette.routing import Mount, Route, WebSocketRoute
from starlette.staticfiles import StaticFiles
from starlette.websockets import WebSocket

import brisance
from brisance.errors import InputError
from brisance.formats.html import STATIC
from brisance.view.folder import ScenesFolder
from brisance.view.guard import Guard, TooLargeError
from brisance.view.live import Conversation
from brisance.view.saving import KINDS, file_name, saved
from brisance.view.schema import schema
from brisance.view.work import CalledOffError, Job, Workers, sentence

MOST_PAGES = 32
"""Pages open at a time."""
BODY_SECONDS = 20.0
"""How long a request may take to arrive."""


def make_app(
    folder: Path, *, first: str = "", names: Iterable[str] = (), any_address: bool = False
) -> Starlette:
    """The live view of the scenes in ``folder``; ``first`` is the one to open with.

    ``names`` and ``any_address`` say under which hosts it may be called, see :class:`Guard`.
    """
    view = _View(ScenesFolder(folder), first)
    routes = [
        Route("/api/schema", view.schema),
        Route("/api/scenes", view.scenes),
        Route("/api/scenes/{name}", view.scene),
        Route("/api/status", view.status),
        Route("/api/save/{kind}", view.save, methods=["POST"]),
        WebSocketRoute("/api/live", view.live),
        Mount("/", StaticFiles(directory=STATIC, html=True)),
    ]
    return Starlette(
        routes=routes,
        middleware=[Middleware(Guard, names=tuple(names), any_address=any_address)],
        exception_handlers={
            InputError: _refused,
            TooLargeError: _too_large,
            HTTPException: _http_error,
            Exception: _unexpected,
        },
    )


class _View:
    def __init__(self, folder: ScenesFolder, first: str) -> None:
        self._folder = folder
        self._first = first
        self._workers = Workers()
        self._pages = 0

    async def schema(self, request: Request) -> Response:
        return JSONResponse(schema())

    async def scenes(self, request: Request) -> Response:
        names = self._folder.names()
        first = self._first if self._first in names else names[0] if names else ""
        return JSONResponse({"scenes": names, "first": first, "version": brisance.__version__})

    async def scene(self, request: Request) -> Response:
        name = request.path_params["name"]
        return Response(
            json.dumps({"file": name, "scene": self._folder.tables(name)}), media_type="application/json"
        )

    async def status(self, request: Request) -> Response:
        return JSONResponse({"pages": self._pages, "running": self._workers.running})

    async def save(self, request: Request) -> Response:
        kind = request.path_params["kind"]
        if kind not in KINDS:
            raise HTTPException(404, f"There is no {kind!r} to save; choose {', '.join(KINDS)}.")
        asked = await _body(request)
        scene = self._folder.scene(asked.get("file"), asked.get("scene"))

        def save(job: Job) -> bytes:
            with self._folder.named_in_errors(asked.get("file")):
                return saved(scene, kind, job)

        run = asyncio.create_task(self._workers.run(Job(), save))
        try:
            while not (await asyncio.wait({run}, timeout=0.25))[0]:
                if await request.is_disconnected():
                    raise CalledOffError
            data = run.result()
        except CalledOffError:
            return Response(status_code=499)
        finally:
            run.cancel()
        name = file_name(scene, kind)
        return Response(
            data, media_type=KINDS[kind], headers={"content-disposition": f'attachment; filename="{name}"'}
        )

    async def live(self, socket: WebSocket) -> None:
        if self._pages >= MOST_PAGES:
            await socket.close(1013, "Too many pages are open.")
            return
        self._pages += 1
        try:
            await Conversation(socket, self._folder, self._workers).hold()
        finally:
            self._pages -= 1


async def _body(request: Request) -> dict[str, Any]:
    try:
        async with asyncio.timeout(BODY_SECONDS):
            data = json.loads(await request.body())
    except (ValueError, RecursionError):
        raise InputError("A request must be JSON.") from None
    except (TimeoutError, ClientDisconnect):
        raise HTTPException(408, "The request did not arrive.") from None
    if not isinstance(data, dict):
        raise InputError("A request must be a table of keys.")
    return data


async def _refused(request: Request, error: Exception) -> Response:
    return JSONResponse({"error": sentence(error)}, 422)


async def _too_large(request: Request, error: Exception) -> Response:
    return JSONResponse({"error": "The request is too large."}, 413, {"connection": "close"})


async def _http_error(request: Request, error: Exception) -> Response:
    assert isinstance(error, HTTPException)
    return JSONResponse({"error": error.detail}, error.status_code)


async def _unexpected(request: Request, error: Exception) -> Response:
    return JSONResponse({"error": sentence(error)}, 500)
