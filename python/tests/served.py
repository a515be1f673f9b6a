"""The server of the live view in a thread, and a page's side of the conversation with it."""

from __future__ import annotations

import http.client
import json
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from websockets.sync.client import ClientConnection, connect

from brisance.formats.html import STATIC
from brisance.formats.packed import read
from brisance.scene_file import read_tables
from brisance.view.server import prepare

SCENES = Path(__file__).parents[2] / "scenes"
WALL = SCENES / "brick_wall.toml"
SECRET = "brick_mass = 4321.125"

needs_viewer = pytest.mark.skipif(
    not (STATIC / "index.html").is_file(), reason="the viewer has not been built; run make viewer"
)


@dataclass(frozen=True)
class Server:
    host: str
    port: int
    folder: Path

    @property
    def origin(self) -> str:
        return f"http://{self.host}:{self.port}"

    def request(
        self, method: str, path: str, body: bytes | str | None = None, **headers: str
    ) -> tuple[int, bytes, dict[str, str]]:
        """Status, body and headers (in small letters) of an answer."""
        link = http.client.HTTPConnection(self.host, self.port, timeout=20)
        try:
            link.request(method, path, body, {name.replace("_", "-"): text for name, text in headers.items()})
            answer = link.getresponse()
            return answer.status, answer.read(), {k.lower(): v for k, v in answer.getheaders()}
        finally:
            link.close()

    def json(self, path: str) -> Any:
        status, body, _ = self.request("GET", path)
        assert status == 200
        return json.loads(body)

    def post(self, path: str, data: Any) -> tuple[int, bytes, dict[str, str]]:
        return self.request("POST", path, json.dumps(data), content_type="application/json")

    def live(self, **more: Any) -> ClientConnection:
        return connect(f"ws://{self.host}:{self.port}/api/live", compression=None, max_size=None, **more)

    def settles(self) -> bool:
        """Whether, within a few seconds, no run is under way."""
        for _ in range(200):
            if self.json("/api/status")["running"] == 0:
                return True
            time.sleep(0.05)
        return False


@contextmanager
def served(root: Path) -> Iterator[Server]:
    """A server of a folder of scenes in ``root``, with files beside it that are no request's business."""
    folder = root / "scenes"
    folder.mkdir()
    for name in ("brick_wall.toml", "crates.toml", "slow_motion.toml"):
        (folder / name).write_bytes((SCENES / name).read_bytes())
    (folder / "broken.toml").write_text("name = [")
    (folder / "pyproject.toml").write_text("[project]\nname = 'no scene'\n")
    (root / "secret.toml").write_text(f"{SECRET}\n[[charge]]\nmass = 1\nposition = [0, 1, 0]\n")
    (root / "secret.obj").write_text("v 0 0 0\n")
    (folder / "link.toml").symlink_to(root / "secret.toml")
    made, bound, _ = prepare(folder / "brick_wall.toml", port=0)
    thread = threading.Thread(target=made.run, kwargs={"sockets": [bound]}, daemon=True)
    thread.start()
    while not made.started:
        time.sleep(0.01)
    yield Server("127.0.0.1", bound.getsockname()[1], folder)
    made.should_exit = made.force_exit = True
    thread.join(10)


def wall() -> dict[str, Any]:
    return read_tables(WALL)


def answered(link: ClientConnection, number: int) -> tuple[dict[str, Any], dict[str, Any]] | str:
    """The recording, or the sentence, that answers a request."""
    for _ in range(10_000):
        told = link.recv(timeout=60)
        if isinstance(told, bytes):
            header, arrays = read(told)
            if header["id"] == number:
                return header, arrays
        else:
            heard = json.loads(told)
            if heard["id"] == number and "error" in heard:
                return str(heard["error"])
    raise AssertionError("no answer")


def ask(link: ClientConnection, number: int, scene: Any, **more: Any) -> Any:
    link.send(json.dumps({"id": number, "file": "brick_wall.toml", "scene": scene, **more}))
    return answered(link, number)


def endless() -> dict[str, Any]:
    """A scene that would take hours, in steps that are over in an instant."""
    return {**wall(), "time": {"duration": 10.0, "frame_rate": 1, "step": 1e-8}}
