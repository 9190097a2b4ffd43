"""The service's beginning and end: quick, and nothing is left behind."""

import asyncio
import os
import threading
import time

import httpx2 as httpx
import viser
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed
from websockets.typing import Subprotocol

from relguide.contract.protocol import PROTOCOL
from tests.server.flown import ideal_flight
from tests.server.serving import ideal_app, serve


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
