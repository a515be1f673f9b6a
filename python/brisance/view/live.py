"""The conversation with one page: scenes come in, recordings go out, and only the newest counts.

The page sends ``{"id", "file", "scene", "have"}`` as text. It hears ``{"id", "progress": [done, total]}``
now and then, and at last either ``{"id", "error"}`` as text or the recording as one binary message whose
header holds the ``id``. A newer request calls an older one off, which is then never answered.
"""

from __future__ import annotations

import asyncio
import json
import time
from typing import Any

from starlette.websockets import WebSocket, WebSocketDisconnect

from brisance.errors import InputError
from brisance.formats.packed import pack
from brisance.simulation import simulate
from brisance.view.folder import ScenesFolder
from brisance.view.work import GLANCE, CalledOffError, Job, Workers, sentence


class Conversation:
    """One open page."""

    def __init__(self, socket: WebSocket, folder: ScenesFolder, workers: Workers) -> None:
        self._socket = socket
        self._folder = folder
        self._workers = workers
        self._sending = asyncio.Lock()
        self._newest: asyncio.Task[None] | None = None

    async def hold(self) -> None:
        """Answer until the page goes; whatever still runs for it is then called off."""
        await self._socket.accept()
        try:
            while True:
                message = await self._socket.receive()
                if message["type"] == "websocket.disconnect":
                    break
                self._call_off()
                self._newest = asyncio.create_task(self._answer(message.get("text")))
        except WebSocketDisconnect:
            pass
        finally:
            self._call_off()

    def _call_off(self) -> None:
        if self._newest is not None:
            self._newest.cancel()

    async def _answer(self, text: str | None) -> None:
        number = None
        try:
            request = _request(text)
            number = request.get("id")
            message = await self._simulated(request)
            async with self._sending:
                await self._socket.send_bytes(message)
        except (asyncio.CancelledError, CalledOffError, WebSocketDisconnect):
            return
        except BaseException as error:  # a panic of the engine is no Exception
            await self._say({"id": number, "error": sentence(error)})

    async def _simulated(self, request: dict[str, Any]) -> bytes:
        job = Job()
        run = asyncio.create_task(self._workers.run(job, lambda job: self._recording(job, request)))
        told = (0, 0)
        try:
            while not (await asyncio.wait({run}, timeout=GLANCE))[0]:
                if job.progress != told:
                    told = job.progress
                    await self._say({"id": request["id"], "progress": told})
        finally:
            run.cancel()
        return run.result()

    def _recording(self, job: Job, request: dict[str, Any]) -> bytes:
        started = time.perf_counter()
        file = request.get("file")
        scene = self._folder.scene(file, request.get("scene"))
        with self._folder.named_in_errors(file):
            result = simulate(scene, progress=job.goes_on)
        job.goes_on()
        known = request.get("have")
        simulated = time.perf_counter()
        return pack(
            result,
            known=known if isinstance(known, str) else "",
            extra={"id": request["id"], "server_s": simulated - started},
        )

    async def _say(self, told: dict[str, Any]) -> None:
        try:
            async with self._sending:
                await self._socket.send_text(json.dumps(told))
        except (WebSocketDisconnect, RuntimeError):
            return


def _request(text: str | None) -> dict[str, Any]:
    """A request as sent: JSON with a whole number ``id``."""
    try:
        request = json.loads(text or "")
    except (ValueError, RecursionError):
        raise InputError("A request must be JSON.") from None
    if not isinstance(request, dict):
        raise InputError("A request must be a table of keys.")
    number = request.get("id")
    if not isinstance(number, int) or isinstance(number, bool) or abs(number) >= 2**53:
        raise InputError("A request must have an id, a whole number.")
    return request
