"""The server of the live view: what it answers, whom it refuses, and that nothing sent brings it down."""

from __future__ import annotations

import http.client
import json
import random
import socket
import string
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import ClientConnection, connect

import brisance as br
from brisance.cli.main import main
from brisance.errors import InputError
from brisance.formats.html import STATIC
from brisance.formats.packed import read
from brisance.view.guard import LARGEST_BODY
from brisance.view.server import prepare

SCENES = Path(__file__).parents[2] / "scenes"
WALL = SCENES / "brick_wall.toml"
SECRET = "brick_mass = 4321.125"

pytestmark = pytest.mark.skipif(
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


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Server]:
    root = tmp_path_factory.mktemp("served")
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
    from brisance.scene_file import read_tables

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


def test_scenes_are_listed_without_what_is_none(server: Server) -> None:
    listed = server.json("/api/scenes")
    assert listed["scenes"] == ["brick_wall.toml", "broken.toml", "crates.toml", "slow_motion.toml"]
    assert listed["first"] == "brick_wall.toml"
    assert server.json("/api/scenes/crates.toml")["scene"]["charge"][1]["explosive"] == "PETN"


def test_a_scene_that_json_cannot_hold_is_opened_as_text(server: Server) -> None:
    odd = server.folder / "odd.toml"
    odd.write_text(
        "name = 1979-05-27\n[time]\nduration = inf\n[[charge]]\nmass = nan\nposition = [0, 0, 0]\n"
    )
    try:
        _, body, _ = server.request("GET", "/api/scenes/odd.toml")
        scene = json.loads(body, parse_constant=lambda text: pytest.fail(text))["scene"]
        with server.live() as link:
            assert "must be" in ask(link, 1, scene)
    finally:
        odd.unlink()


def test_the_schema_names_what_can_be_turned(server: Server) -> None:
    schema = server.json("/api/schema")
    charge = schema["$defs"]["Charge"]["properties"]
    assert "PETN" in charge["explosive"]["examples"]
    assert charge["mass"]["exclusiveMinimum"] == 0
    assert {"charge", "brick_wall", "time", "dynamics"} <= set(schema["properties"])


def test_the_page_and_its_headers(server: Server) -> None:
    status, body, headers = server.request("GET", "/")
    assert status == 200 and b'<div id="app">' in body
    assert "default-src 'self'" in headers["content-security-policy"]
    assert headers["x-content-type-options"] == "nosniff"
    assert "access-control-allow-origin" not in headers
    assert server.request("GET", "/viewer.js")[0] == 200


def test_a_live_run_is_the_run_of_the_command_line(server: Server) -> None:
    scene = br.load(WALL, ["charge.0.mass=60"])
    expected = br.simulate(scene)
    tables = wall()
    tables["charge"][0]["mass"] = 60
    with server.live() as link:
        header, arrays = ask(link, 7, tables)
    row = header["facts"].index("launch_speed_m_s")
    assert arrays["facts"][:, row] == pytest.approx(expected.bodies.launch_speed_m_s, rel=1e-6)
    assert arrays["pieces"].reshape(-1, 16)[:27, 9].sum() <= 27 * 41


def test_an_error_is_the_sentence_of_the_command_line(
    server: Server, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["run", str(server.folder / "brick_wall.toml"), "--set", "charge.0.mass=-5"]) == 2
    printed = capsys.readouterr().err.removeprefix("brisance: ").strip()
    tables = wall()
    tables["charge"][0]["mass"] = -5
    with server.live() as link:
        sentence = ask(link, 1, tables)
    assert sentence.partition(": ")[2] == printed.partition(": ")[2]
    assert sentence.endswith("charge.0.mass must be greater than 0, not -5.")


def test_a_newer_request_calls_an_older_one_off(server: Server) -> None:
    with server.live() as link:
        link.send(json.dumps({"id": 1, "file": "brick_wall.toml", "scene": endless()}))
        time.sleep(0.3)
        started = time.perf_counter()
        header, _ = ask(link, 2, wall())
        assert header["id"] == 2
        assert time.perf_counter() - started < 5
    assert server.settles()


def test_progress_is_told(server: Server) -> None:
    scene = {**wall(), "time": {"duration": 0.02, "frame_rate": 1000, "step": 1e-8}}
    told = []
    with server.live() as link:
        link.send(json.dumps({"id": 1, "file": "brick_wall.toml", "scene": scene}))
        while isinstance(heard := link.recv(timeout=60), str):
            told.append(json.loads(heard))
    seen = [entry["progress"] for entry in told]
    assert seen and seen == sorted(seen) and seen[-1][1] in (0, 21)


def test_a_page_that_goes_frees_the_worker(server: Server) -> None:
    with server.live() as link:
        link.send(json.dumps({"id": 1, "file": "brick_wall.toml", "scene": endless()}))
        deadline = time.perf_counter() + 10
        while server.json("/api/status")["running"] == 0 and time.perf_counter() < deadline:
            time.sleep(0.02)
        assert server.json("/api/status")["running"] == 1
        # As when a browser is killed: the system closes its sockets, and no farewell is said.
        link.socket.shutdown(socket.SHUT_RDWR)
        assert server.settles()


def test_a_save_that_nobody_waits_for_ends(server: Server) -> None:
    link = http.client.HTTPConnection(server.host, server.port)
    body = json.dumps({"file": "brick_wall.toml", "scene": endless()})
    link.request("POST", "/api/save/usdc", body, {"content-type": "application/json"})
    time.sleep(0.4)
    assert server.json("/api/status")["running"] == 1
    link.close()
    assert server.settles()


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


def test_oversized_requests_are_refused(server: Server) -> None:
    large = b"x" * (LARGEST_BODY + 1)
    assert server.request("POST", "/api/save/toml", large, content_type="application/json")[0] == 413
    with server.live() as link:
        link.send(large.decode())
        with pytest.raises(ConnectionClosed):
            link.recv(timeout=20)
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


def test_what_is_saved_is_what_python_writes(server: Server, tmp_path: Path) -> None:
    request = {"file": "brick_wall.toml", "scene": wall()}
    result = br.simulate(br.load(WALL))
    for kind in ("usdc", "glb", "html"):
        status, body, headers = server.post(f"/api/save/{kind}", request)
        assert status == 200
        assert f'filename="brick_wall.{kind}"' in headers["content-disposition"]
        result.write(tmp_path / f"wall.{kind}")
        written = (tmp_path / f"wall.{kind}").read_bytes()
        # The page holds how long the run took, so only its length is alike.
        assert body == written if kind != "html" else abs(len(body) - len(written)) < 200
    status, body, _ = server.post("/api/save/toml", request)
    saved = tmp_path / "saved.toml"
    saved.write_bytes(body)
    assert br.load(saved) == br.load(WALL).model_copy(update={"base_folder": tmp_path})
    status, body, _ = server.post("/api/save/json", request)
    assert len(json.loads(body)["bodies"]) == 27
    assert server.post("/api/save/exe", request)[0] == 404


def test_many_pages_at_once(server: Server) -> None:
    """Each page hears its own answer."""
    failures: list[str] = []

    def page(mass: int) -> None:
        tables = wall()
        tables["charge"][0]["mass"] = mass
        with server.live() as link:
            for number in range(4):
                header, _ = ask(link, number, tables)
                if header["charges"][0]["tnt_mass_kg"] != mass:
                    failures.append(f"{mass} heard of {header['charges'][0]}")

    pages = [threading.Thread(target=page, args=(10 + index,)) for index in range(12)]
    for thread in pages:
        thread.start()
    for thread in pages:
        thread.join(60)
    assert failures == []
    assert server.settles()


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


def test_a_taken_port_gives_way_to_a_free_one() -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        number = taken.getsockname()[1]
        _, bound, address = prepare(WALL, port=number)
        with bound:
            assert bound.getsockname()[1] != number
            assert address == f"http://127.0.0.1:{bound.getsockname()[1]}/"


def test_bad_beginnings_are_told(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="does not exist"):
        prepare(tmp_path / "none.toml")
    with pytest.raises(InputError, match="is not in the folder"):
        prepare(WALL, folder=tmp_path)
    with pytest.raises(InputError, match="cannot be listened at"):
        prepare(WALL, host="203.0.113.7")


def test_the_command_prints_its_address_and_ends_with_ctrl_c() -> None:
    import signal

    command = [sys.executable, "-m", "brisance", "view", str(WALL), "--no-open", "--port", "0"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        address = process.stdout.readline().strip()
        port = int(address.removesuffix("/").rpartition(":")[2])
        link = http.client.HTTPConnection("127.0.0.1", port, timeout=10)
        link.request("GET", "/api/scenes")
        assert json.loads(link.getresponse().read())["first"] == "brick_wall.toml"
        process.send_signal(signal.SIGINT)
        assert process.wait(10) == 130


def test_positions_fill_their_boxes(server: Server) -> None:
    """The piece table's boxes are those of the flights: low and high are reached."""
    with server.live() as link:
        header, arrays = ask(link, 1, wall())
    result = br.simulate(br.load(WALL))
    table = arrays["pieces"].reshape(-1, 16)[: len(header["names"])]
    assert np.array_equal(table[:, 0:3], result.positions.min(axis=0))
    assert np.allclose(table[:, 4:7], np.ptp(result.positions, axis=0))
