"""Who may ask, and how much: the checks before any request is looked at.

The server acts for whoever sits at this machine, so a page from elsewhere must not reach it through their
browser. Such a page betrays itself by its ``Origin``; one that has pointed its own name at this machine (DNS
rebinding) by its ``Host``.
"""

from __future__ import annotations

import ipaddress
from collections.abc import Iterable
from urllib.parse import urlsplit

from starlette.responses import JSONResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

LARGEST_BODY = 1 << 20
"""Bytes of a request at most; the longest scene file is a hundredth of it."""

_HEADERS = [
    (
        b"content-security-policy",
        b"default-src 'self'; img-src 'self' data: blob:; style-src 'self' 'unsafe-inline'; "
        b"object-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    ),
    (b"x-content-type-options", b"nosniff"),
    (b"referrer-policy", b"no-referrer"),
    (b"cross-origin-resource-policy", b"same-origin"),
    (b"cross-origin-opener-policy", b"same-origin"),
    (b"cache-control", b"no-store"),
]


class Guard:
    """Refuses what comes from another origin or is too large, and marks every answer.

    ``names`` are the host names by which the server may be called, besides those of this machine itself.
    Where it is bound to an address that others reach, any address given as numbers is fine too: rebinding
    needs a name.
    """

    def __init__(self, app: ASGIApp, *, names: Iterable[str], any_address: bool) -> None:
        self._app = app
        self._names = {"localhost", "127.0.0.1", "::1", *(name.casefold() for name in names)}
        self._any_address = any_address

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on, or refuse it."""
        if scope["type"] not in ("http", "websocket"):
            return
        refusal = self._refusal(scope)
        if refusal is not None:
            if scope["type"] == "websocket":
                await receive()
                await send({"type": "websocket.close", "code": 1008, "reason": refusal[1]})
            else:
                await JSONResponse({"error": refusal[1]}, refusal[0])(scope, receive, _marked(send))
            return
        await self._app(scope, _counted(receive) if scope["type"] == "http" else receive, _marked(send))

    def _refusal(self, scope: Scope) -> tuple[int, str] | None:
        headers = [(key.lower(), value.decode("latin-1")) for key, value in scope["headers"]]
        hosts = [value for key, value in headers if key == b"host"]
        if len(hosts) != 1 or not self._known(hosts[0]):
            return 421, "This server answers only under its own address."
        origins = [value for key, value in headers if key == b"origin"]
        if any(origin.casefold() != f"http://{hosts[0]}".casefold() for origin in origins):
            return 403, "Requests from other origins are refused."
        if scope["type"] == "http" and scope["method"] == "POST":
            kinds = [value.partition(";")[0].strip() for key, value in headers if key == b"content-type"]
            if kinds != ["application/json"]:
                return 415, "Send JSON, as application/json."
        lengths = [value for key, value in headers if key == b"content-length"]
        if any(not length.isdecimal() or int(length[:20]) > LARGEST_BODY for length in lengths):
            return 413, f"A request may have {LARGEST_BODY:,} bytes at most."
        return None

    def _known(self, host: str) -> bool:
        try:
            parts = urlsplit(f"//{host}")
            name, _ = (parts.hostname or "").casefold(), parts.port
        except ValueError:
            return False
        if parts.netloc != host or parts.username is not None or name in ("", None):
            return False
        if name in self._names:
            return True
        if not self._any_address:
            return False
        try:
            ipaddress.ip_address(name)
        except ValueError:
            return False
        return True


class TooLargeError(Exception):
    """A body went on beyond :data:`LARGEST_BODY`."""


def _counted(receive: Receive) -> Receive:
    """``receive``, until the parts of a body add up to too much."""
    size = 0

    async def counted() -> Message:
        nonlocal size
        message = await receive()
        size += len(message.get("body", b""))
        if size > LARGEST_BODY:
            raise TooLargeError
        return message

    return counted


def _marked(send: Send) -> Send:
    """``send``, with the headers that keep the page to itself."""

    async def marked(message: Message) -> None:
        if message["type"] == "http.response.start":
            message = {**message, "headers": [*message.get("headers", []), *_HEADERS]}
        await send(message)

    return marked
