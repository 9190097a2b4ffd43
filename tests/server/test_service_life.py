"""The service's beginning and end: quick, and nothing is left behind."""

import asyncio
import contextlib
import os
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import httpx2 as httpx
import orjson
import pytest
import viser
from relguide_server.app import create_app
from relguide_server.settings import ServiceSettings
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed
from websockets.typing import Subprotocol

from relguide.contract.protocol import PROTOCOL
from tests.server.flown import ideal_flight
from tests.server.serving import ideal_app, ideal_catalogue, serve
from tests.server.test_api import HARD


def test_nothing_is_left_after_shutdown() -> None:
    async def watch(address: str) -> None:
        ids = []
        async with httpx.AsyncClient(base_url=f"http://{address}") as client:
            for _ in range(3):
                answer = await client.post("/api/v1/flights", json={"scenario": "ideal"})
                ids.append(answer.json()["id"])
        scene = [Subprotocol(f"viser-v{viser.__version__}")]
        stream = [Subprotocol(PROTOCOL)]
        url = f"ws://{address}"
        for flight_id in ids:
            path = f"/api/v1/flights/{flight_id}/stream"
            async with (
                connect(url + path, subprotocols=stream, proxy=None) as one,
                connect(f"{url}/scene/{flight_id}", subprotocols=scene, proxy=None) as other,
            ):
                await one.recv()
                await other.recv()

    def flown(commands):
        return ideal_flight(commands, duration=3600.0)

    with serve(ideal_app(flown)) as address:  # once before counting: pools and caches stay
        asyncio.run(watch(address))
    threads, descriptors = threading.active_count(), len(os.listdir("/proc/self/fd"))
    with serve(ideal_app(flown)) as address:
        asyncio.run(watch(address))
        assert threading.active_count() > threads
        stopping = time.monotonic()
    assert time.monotonic() - stopping < 20.0
    assert threading.active_count() <= threads
    assert len(os.listdir("/proc/self/fd")) <= descriptors


def test_bodies_that_do_not_come_are_answered_as_it_stops(
    caplog: pytest.LogCaptureFixture,
) -> None:
    head = (
        "POST {path} HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
        "Content-Length: 100\r\n\r\n{{"
    )
    with serve(ideal_app()) as address, contextlib.ExitStack() as opened:
        host, _, port = address.partition(":")
        sockets = []
        for path in ("/api/v1/plans", "/api/v1/plans/batch", "/api/v1/flights", "/api/v1/areas"):
            sockets.append(opened.enter_context(socket.create_connection((host, int(port)))))
            sockets[-1].sendall(head.format(path=path).encode())
        kept = opened.pop_all()
        time.sleep(0.3)
        stopping = time.monotonic()
    with kept:
        assert time.monotonic() - stopping < 8.0
        for waiting in sockets:
            answer = waiting.recv(4096).decode()
            assert answer.startswith("HTTP/1.1 503")
            assert "retry-after: 5" in answer
            assert "#stopping" in answer
    assert not [record for record in caplog.records if record.exc_info]


@pytest.mark.parametrize("end", ["the service", "its process"])
def test_lines_that_are_left_as_their_answer_breaks_off_say_why(
    end: str, caplog: pytest.LogCaptureFixture
) -> None:
    lines = [orjson.dumps({**HARD, "id": f"case {k}"}) for k in range(200)]
    headers = {"Content-Type": "application/x-ndjson"}
    app = create_app(ServiceSettings(workers=1), catalogue=ideal_catalogue())
    answered: list[dict[str, Any]] = []
    with contextlib.ExitStack() as service:
        url = f"http://{service.enter_context(serve(app))}/api/v1/plans/batch?max_ms=1000"
        wait_until(lambda: app.state.workers.ready)
        batch = httpx.stream("POST", url, content=b"\n".join(lines), headers=headers, timeout=60.0)
        with batch as answer, ThreadPoolExecutor(1) as other:
            for line in answer.iter_lines():
                if not answered and end == "the service":
                    other.submit(service.close)
                elif not answered:
                    os.kill(app.state.workers.processes[0], signal.SIGSEGV)
                answered.append(orjson.loads(line))
    assert [one["id"] for one in answered] == [f"case {k}" for k in range(200)]
    assert answered[0]["status"] == "planned"
    assert answered[-1]["status"] == "refused"
    said = {"the service": "The service is stopping", "its process": "The process that worked on"}
    assert said[end] in answered[-1]["message"]
    assert not [record for record in caplog.records if "ASGI" in record.getMessage()]


def test_processes_plan_what_takes_longer_and_leave_with_it() -> None:
    app = create_app(ServiceSettings(workers=1), catalogue=ideal_catalogue())
    with serve(app) as address:
        wait_until(lambda: app.state.workers.ready)  # else an answer comes without it
        answer = httpx.post(f"http://{address}/api/v1/plans?max_ms=10000", json=HARD, timeout=60.0)
        assert answer.json()["status"] == "planned"
        (process,) = app.state.workers.processes
        assert (
            app.state.workers.done["trials"] >= 1
        )  # more, and "long_plans" too, on a busy machine
    assert not os.path.exists(f"/proc/{process}")


def test_it_stops_while_browsers_still_look() -> None:
    async def look(address: str) -> tuple[int | None, str | None]:
        async with httpx.AsyncClient(base_url=f"http://{address}") as client:
            answer = await client.post("/api/v1/flights", json={"scenario": "ideal"})
        path = answer.json()["stream_url"]
        async with connect(
            f"ws://{address}{path}", subprotocols=[Subprotocol(PROTOCOL)], proxy=None
        ) as stream:
            await stream.recv()
            looking.set()
            try:
                while True:
                    await stream.recv()
            except ConnectionClosed:
                return stream.close_code, stream.close_reason

    looking = threading.Event()
    ends: list[tuple[int | None, str | None]] = []
    with serve(ideal_app()) as address:
        browser = threading.Thread(target=lambda: ends.append(asyncio.run(look(address))))
        browser.start()
        assert looking.wait(10.0)
    browser.join(10.0)
    # "service restart": the page dials again
    assert ends == [(1012, "The service is stopping: it may be back in a moment.")]


def test_a_signal_ends_it_within_three_seconds_under_load() -> None:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    command = [sys.executable, "-m", "relguide", "serve", "--port", str(port)]
    service = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    url = f"http://127.0.0.1:{port}"

    def attack(path: str, body: object) -> None:
        with contextlib.suppress(httpx.HTTPError):
            httpx.post(url + path, json=body, timeout=60.0)

    try:
        wait_until(lambda: answers(url))
        batch, area = [HARD] * 1000, {"situation": HARD, "columns": 512, "rows": 512}
        attacks = [("/plans?max_ms=10000", HARD), ("/plans/batch", batch), ("/areas", area)] * 6
        attackers = [
            threading.Thread(target=attack, args=(f"/api/v1{path}", body)) for path, body in attacks
        ]
        for attacker in attackers:
            attacker.start()
        time.sleep(2.0)
        stopping = time.monotonic()
        service.terminate()
        _, complaints = service.communicate(timeout=10.0)
        assert time.monotonic() - stopping < 8.0
        assert b"Traceback" not in complaints
        for attacker in attackers:
            attacker.join(10.0)
    finally:
        service.kill()
        service.wait()


@pytest.mark.slow
@pytest.mark.parametrize("all_processes", [False, True])
def test_a_signal_ends_it_quietly_while_it_compiles(all_processes: bool, tmp_path: Path) -> None:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    service = subprocess.Popen(
        [sys.executable, "-m", "relguide", "serve", "--port", str(port)],
        env={**os.environ, "NUMBA_CACHE_DIR": str(tmp_path), "RELGUIDE_DATA": str(tmp_path)},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    url = f"http://127.0.0.1:{port}"
    try:
        wait_until(lambda: answers(url))
        wait_until(lambda: httpx.get(f"{url}/readyz").json()["preparing"] is not None)
        if all_processes:
            os.killpg(service.pid, signal.SIGTERM)
        else:
            service.terminate()
        _, said = service.communicate(timeout=20.0)
    finally:
        service.kill()
        service.wait()
    assert service.returncode == 0
    lines = [line for line in said.splitlines() if not line.startswith("Compiling kernels")]
    assert len(lines) == 1
    assert " INFO " in lines[0]
    assert lines[0].endswith("The service is stopping; its next start compiles what is left.")


def answers(url: str) -> bool:
    try:
        return httpx.get(f"{url}/healthz").status_code == 200
    except httpx.HTTPError:
        return False


def wait_until(holds: Callable[[], bool]) -> None:
    deadline = time.monotonic() + 60.0
    while not holds():
        assert time.monotonic() < deadline
        time.sleep(0.1)
