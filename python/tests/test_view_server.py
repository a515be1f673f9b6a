"""The server of the live view: what it answers, as the command line would, and when it stops working."""

from __future__ import annotations

import http.client
import json
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from served import WALL, Server, ask, endless, needs_viewer, served, wall

import brisance as br
from brisance.cli.main import main
from brisance.errors import InputError
from brisance.view.server import prepare

pytestmark = needs_viewer


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Server]:
    with served(tmp_path_factory.mktemp("served")) as running:
        yield running


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


def test_an_error_of_a_run_begins_with_the_file(server: Server) -> None:
    tables = wall()
    tables["dynamics"] = {"contacts": True}
    tables["brick_wall"][0]["position"] = [0, 0, 1e9]
    with server.live() as link:
        sentence = ask(link, 1, tables)
    file = server.folder / "brick_wall.toml"
    assert sentence.startswith(f"{file}: wall_r0_c0: position [m] is 1e9, but where bodies touch it must be")


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
