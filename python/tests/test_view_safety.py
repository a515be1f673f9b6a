"""The server of the live view: whom it refuses, and that nothing that is sent brings it down."""

from __future__ import annotations

import http.client
import json
import random
import socket
import string
import time
from collections.abc import Iterator
from typing import Any

import pytest
from served import SECRET, Server, answered, ask, endless, needs_viewer, served, wall
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import ClientConnection

from brisance.view.guard import LARGEST_BODY

pytestmark = needs_viewer


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Server]:
    with served(tmp_path_factory.mktemp("served")) as running:
        yield running


@pytest.mark.parametrize(
    ("headers", "status"),
    [
        ({"Origin": "http://evil.example"}, 403),
        ({"Origin": "null"}, 403),
        ({"Origin": "http://127.0.0.1:1"}, 403),
        ({"Origin": "https://127.0.0.1"}, 403),
        ({"Host": "evil.example"}, 421),
        ({"Host": "127.0.0.1.evil.example"}, 421),
        ({"Host": "localhost@evil.example"}, 421),
        ({"Host": "192.168.0.7"}, 421),
        ({"Host": ""}, 421),
    ],
)
def test_other_origins_are_refused(server: Server, headers: dict[str, str], status: int) -> None:
    for method, path in (("GET", "/"), ("GET", "/api/scenes"), ("POST", "/api/save/toml")):
        found, body, _ = server.request(method, path, **headers)
        assert found == status
        assert json.loads(body)["error"].endswith(".")


def test_other_origins_get_no_conversation(server: Server) -> None:
    with pytest.raises(InvalidStatus):
        server.live(origin="http://evil.example")
    with pytest.raises(InvalidStatus):
        server.live(additional_headers={"Host": "evil.example"})
    with server.live(origin=server.origin) as link:
        assert ask(link, 1, wall())[0]["id"] == 1


def test_a_form_from_elsewhere_cannot_post(server: Server) -> None:
    """What a page may send without asking first (text/plain) is not taken."""
    status, _, _ = server.request("POST", "/api/save/toml", "{}", content_type="text/plain")
    assert status == 415


@pytest.mark.parametrize(
    "path",
    [
        "/../secret.toml",
        "/%2e%2e/secret.toml",
        "/api/scenes/..%2fsecret.toml",
        "/api/scenes/%2e%2e%2fsecret.toml",
        "/api/scenes/link.toml",
        "/api/scenes//etc/passwd",
        "/api/scenes/pyproject.toml",
        "/%00",
        "/api/scenes/%00",
        "//etc/passwd",
    ],
)
def test_no_file_outside_the_folder_is_served(server: Server, path: str) -> None:
    status, body, _ = server.request("GET", path)
    assert 400 <= status < 500
    assert SECRET.encode() not in body and b"root:" not in body


@pytest.mark.parametrize(
    "file", ["../secret.obj", "/etc/passwd", "meshes/../../secret.obj", "a\0b", "~/../../x"]
)
def test_no_file_outside_the_folder_is_read_for_a_scene(server: Server, file: str) -> None:
    scenes = [
        {**wall(), "mesh": [{"file": file, "mass": 1, "position": [3, 1, 0]}]},
        {**wall(), "charge": [{"mass": 1, "position": [0, 1, -5], "curves": file}]},
    ]
    with server.live() as link:
        for number, scene in enumerate(scenes):
            sentence = ask(link, number, scene)
            if file.startswith("~"):
                assert "does not exist" in sentence or "cannot" in sentence or "leads out" in sentence
            else:
                assert "leads out of the scenes folder" in sentence


def test_the_file_a_request_begins_with_must_be_listed(server: Server) -> None:
    with server.live() as link:
        for number, file in enumerate(["../secret.toml", "link.toml", "", None, 3, "broken"]):
            link.send(json.dumps({"id": number, "file": file, "scene": wall()}))
            assert "no such scene" in str(answered(link, number))


def test_what_would_not_fit_is_refused_before_any_work(server: Server) -> None:
    tables = {**wall(), "time": {"duration": 1e6, "frame_rate": 1e3}}
    with server.live() as link:
        started = time.perf_counter()
        sentence = ask(link, 1, tables)
    assert "more than the live view shows" in sentence
    assert time.perf_counter() - started < 5


def test_memory_is_asked_before_any_work(server: Server, monkeypatch: pytest.MonkeyPatch) -> None:
    import brisance.memory

    monkeypatch.setattr(brisance.memory, "available_bytes", lambda: 1000)
    with server.live() as link:
        assert "of memory" in str(ask(link, 1, wall()))
    status, body, _ = server.post("/api/save/usdc", {"file": "brick_wall.toml", "scene": wall()})
    assert status == 422 and b"of memory" in body


@pytest.mark.parametrize(
    "text",
    [
        "",
        "nonsense",
        "[1, 2]",
        "{}",
        '{"id": "x"}',
        '{"id": 1.5}',
        '{"id": true}',
        "[" * 5000,
        '{"id": 1e999}',
    ],
)
def test_malformed_requests_are_answered(server: Server, text: str) -> None:
    with server.live() as link:
        link.send(text)
        heard = json.loads(str(link.recv(timeout=20)))
        assert heard["error"].startswith("A request must")
        link.send(b"\0\1binary")
        assert "error" in json.loads(str(link.recv(timeout=20)))
        assert ask(link, 5, wall())[0]["id"] == 5
    if not text.startswith("{"):
        status, body, _ = server.request("POST", "/api/save/toml", text, content_type="application/json")
        assert status == 422 and b"A request must be" in body


def _send_and_hear(link: ClientConnection, text: str) -> None:
    """The link may be closed at either."""
    link.send(text)
    link.recv(timeout=20)


def test_oversized_requests_are_refused(server: Server) -> None:
    large = b"x" * (LARGEST_BODY + 1)
    assert server.request("POST", "/api/save/toml", large, content_type="application/json")[0] == 413
    with server.live() as link, pytest.raises(ConnectionClosed):
        _send_and_hear(link, large.decode())
    # A body without a length, in chunks, that never ends by itself.
    link2 = http.client.HTTPConnection(server.host, server.port, timeout=20)
    link2.putrequest("POST", "/api/save/toml")
    link2.putheader("content-type", "application/json")
    link2.putheader("transfer-encoding", "chunked")
    link2.endheaders()
    try:
        for _ in range(40):
            link2.send(b"10000\r\n" + b"x" * 65536 + b"\r\n")
        assert link2.getresponse().status == 413
    except (BrokenPipeError, ConnectionResetError):
        pass
    assert server.json("/api/status")["running"] == 0


# What follows sends a few thousand requests that nobody would write by hand.

ODD: list[Any] = [
    None, True, False, 0, -1, 1e308, -1e308, 1e-308, 2**63, 2**70, 10**400, float("nan"), float("inf"), "",
    "x", "0", "../x", "/", "\0", "\ud800", "é" * 200, [], [[]], {}, {"a": {}}, [0, 0], [0, 0, 0, 0],
    [None] * 3, ["a", "b", "c"], [1e308] * 3, {"": ""}, [{}], "kingery", "surface",
]  # fmt: skip


def mutated(value: Any, chance: random.Random, rate: float = 0.12) -> Any:
    """A scene with parts replaced by something odd, with the probability ``rate``; or, less often, taken
    out, renamed or doubled.
    """
    if isinstance(value, dict):
        made = {}
        for key, part in value.items():
            luck = chance.random()
            if luck < rate / 3:
                continue
            name = "".join(chance.choices(string.printable, k=6)) if luck < rate / 2 else key
            made[name] = mutated(part, chance, rate)
        return made
    if isinstance(value, list):
        parts = [mutated(part, chance, rate) for part in value]
        return parts * 2 if chance.random() < rate / 3 else parts
    return chance.choice(ODD) if chance.random() < rate else value


def small(scene: dict[str, Any]) -> dict[str, Any]:
    """A scene that is over soon if it runs at all, so that a thousand can be tried."""
    return {**scene, "time": {"duration": 0.05, "frame_rate": 20}}


def test_two_thousand_mutated_scenes_are_each_answered(server: Server) -> None:
    chance = random.Random(1)
    answers = {"recording": 0, "sentence": 0}
    with server.live() as link:
        for number in range(2000):
            scene = mutated(small(wall()), chance, chance.choice([0.01, 0.04, 0.12]))
            if isinstance(scene.get("time"), dict):
                scene["time"].pop("step", None)
            answer = ask(link, number, scene)
            if isinstance(answer, str):
                answers["sentence"] += 1
                assert "Unexpected error" not in answer, (scene, answer)
                assert answer.endswith((".", "?"))
                assert "Traceback" not in answer and "\n" not in answer
            else:
                answers["recording"] += 1
        assert ask(link, 99_999, wall())[0]["id"] == 99_999
    assert min(answers.values()) > 200


def test_a_flood_of_requests_is_answered_at_its_end(server: Server) -> None:
    chance = random.Random(2)
    with server.live() as link:
        for number in range(1000):
            scene = chance.choice([mutated(wall(), chance), endless(), wall(), chance.choice(ODD)])
            link.send(
                json.dumps({"id": number, "file": chance.choice(["brick_wall.toml", "x"]), "scene": scene})
            )
        assert ask(link, 99_999, wall())[0]["id"] == 99_999
    assert server.settles()


def test_a_thousand_odd_http_requests_leave_the_server_alive(server: Server) -> None:
    chance = random.Random(3)
    paths = [
        "/",
        "/api/scenes",
        "/api/scenes/",
        "/api/schema",
        "/api/live",
        "/api/save/usdc",
        "/viewer.js",
        "/api",
    ]
    pieces = ["..", "%2e%2e", "%00", "%ff", "a" * 300, "?", "#", "//", "\\", "%", ";", ":", "é"]
    for _ in range(1000):
        path = chance.choice(paths) + "".join(chance.choices(pieces, k=chance.randrange(3)))
        method = chance.choice(["GET", "POST", "PUT", "DELETE", "HEAD", "OPTIONS", "TRACE", "X"])
        extra = chance.choice(
            [
                "",
                "Range: bytes=9-1\r\n",
                "Content-Length: 5\r\n",
                "Content-Length: -1\r\n",
                "Cookie: a\r\n",
                "X:\r\n",
            ]
        )
        kind = chance.choice(["application/json", "text/html", ""])
        body = chance.choice(["", "{}", "nul", "[[", "\x00\x01"])
        head = (
            f"{method} {path} HTTP/1.1\r\nHost: {server.host}:{server.port}\r\nConnection: close\r\n"
            f"Content-Type: {kind}\r\n{extra}\r\n{body}"
        )
        first = raw(server, head.encode())
        assert first == b"" or first.startswith(b"HTTP/1.1 ")
        assert not first.startswith(b"HTTP/1.1 500")
    assert server.json("/api/scenes")["first"] == "brick_wall.toml"


def test_bytes_that_are_no_http_leave_the_server_alive(server: Server) -> None:
    chance = random.Random(4)
    for _ in range(500):
        raw(server, chance.randbytes(chance.randrange(1, 400)) + chance.choice([b"", b"\r\n\r\n"]))
    assert server.json("/api/status")["running"] == 0


def test_frames_that_are_no_conversation_leave_the_server_alive(server: Server) -> None:
    """After a proper handshake, bytes that are no proper frames."""
    chance = random.Random(5)
    hello = (
        f"GET /api/live HTTP/1.1\r\nHost: {server.host}:{server.port}\r\nUpgrade: websocket\r\n"
        "Connection: Upgrade\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
        "Sec-WebSocket-Version: 13\r\n\r\n"
    )
    for _ in range(200):
        answer = raw(server, hello.encode() + chance.randbytes(chance.randrange(1, 200)))
        assert answer.startswith(b"HTTP/1.1 101")
    assert server.settles()
    assert server.json("/api/status")["pages"] == 0


def raw(server: Server, data: bytes) -> bytes:
    """What comes back first for bytes sent as they are."""
    with socket.create_connection((server.host, server.port), timeout=5) as link:
        try:
            link.sendall(data)
            link.shutdown(socket.SHUT_WR)
            return link.recv(4096)
        except OSError:
            return b""
