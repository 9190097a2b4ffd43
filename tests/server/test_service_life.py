"""The service's beginning and end: quick, and nothing is left behind."""

import asyncio
import os
import threading
import time

import httpx2 as httpx
import viser
from relguide_server.app import create_app
from relguide_server.settings import Settings
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed
from websockets.typing import Subprotocol

from relguide.contract.protocol import PROTOCOL
from tests.server.flown import ideal_flight
from tests.server.serving import ideal_app, ideal_departures, serve
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
    assert time.monotonic() - stopping < 5.0
    assert threading.active_count() <= threads
    assert len(os.listdir("/proc/self/fd")) <= descriptors


def test_processes_plan_what_takes_longer_and_leave_with_it() -> None:
    app = create_app(Settings(workers=1), departures=ideal_departures())
    with serve(app) as address:
        answer = httpx.post(f"http://{address}/api/v1/plans?max_ms=10000", json=HARD, timeout=60.0)
        assert answer.json()["status"] == "planned"
        (process,) = app.state.workers.processes
        assert app.state.workers.done["plans"] == 1
    assert not os.path.exists(f"/proc/{process}")


def test_it_stops_while_browsers_still_look() -> None:
    async def look(address: str) -> int | None:
        async with httpx.AsyncClient(base_url=f"http://{address}") as client:
            answer = await client.post("/api/v1/flights", json={"scenario": "ideal"})
        path = answer.json()["stream_url"]
        async with connect(
            f"ws://{address}{path}", subprotocols=[Subprotocol(PROTOCOL)], proxy=None
        ) as socket:
            await socket.recv()
            looking.set()
            try:
                while True:
                    await socket.recv()
            except ConnectionClosed:
                return socket.close_code

    looking = threading.Event()
    codes: list[int | None] = []
    with serve(ideal_app()) as address:
        browser = threading.Thread(target=lambda: codes.append(asyncio.run(look(address))))
        browser.start()
        assert looking.wait(10.0)
    browser.join(10.0)
    assert codes == [1012]  # "service restart": the page dials again
