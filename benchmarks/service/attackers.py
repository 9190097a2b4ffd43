"""Attackers of a service, each kind by its own means, until their process is ended.

    python -m benchmarks.service.attackers PORT KIND COUNT

Each comes from an address of its own, 127.0.0.2 and so on, as clients of a service do.
"""

import asyncio
import json
import os
import sys
from collections.abc import Awaitable, Callable
from contextlib import suppress

from websockets.asyncio.client import connect
from websockets.exceptions import WebSocketException
from websockets.typing import Subprotocol

from benchmarks.service.load import request
from benchmarks.service.situations import STRAIGHT, heavy
from relguide.contract.protocol import PROTOCOL

PLANS, BATCH, AREAS = "/api/v1/plans", "/api/v1/plans/batch", "/api/v1/areas"
PATIENCE = 60.0
"""How long an attacker waits for an answer [s]."""
Attack = Callable[[int, str], Awaitable[None]]
"""What an attacker does again and again: given the port, from its address."""


async def _ask(port: int, address: str, wanted: bytes, *, hang_up: float = PATIENCE) -> None:
    """Ask, and wait for the end of the answer; hang up after a while."""
    reader, writer = await asyncio.open_connection("127.0.0.1", port, local_addr=(address, 0))
    try:
        with suppress(TimeoutError):
            async with asyncio.timeout(hang_up):
                writer.write(wanted)
                await writer.drain()
                head = await reader.readuntil(b"\r\n\r\n")
                _, sized, rest = head.lower().partition(b"content-length:")
                if sized:
                    await reader.readexactly(int(rest.partition(b"\r\n")[0]))
                else:
                    await reader.readuntil(b"\r\n0\r\n\r\n")
    finally:
        writer.transport.abort()


async def heavy_plans(port: int, address: str) -> None:
    """Situations that take as long as they may."""
    for body in HEAVY:
        await _ask(port, address, request("POST", PLANS, json.dumps(body).encode()))


async def patient_plans(port: int, address: str) -> None:
    """The same, with ten seconds for each."""
    for body in HEAVY:
        wanted = request("POST", f"{PLANS}?max_ms=10000", json.dumps(body).encode())
        await _ask(port, address, wanted)


async def batches(port: int, address: str) -> None:
    """A thousand of them at a time, with ten seconds for each."""
    lines = (HEAVY * 1000)[:1000]
    wanted = request("POST", f"{BATCH}?max_ms=10000", json.dumps(lines).encode())
    await _ask(port, address, wanted)


async def areas(port: int, address: str) -> None:
    """Areas of 512 × 512 nodes, behind a leader with twenty turns."""
    body = {"situation": HEAVY[0], "columns": 512, "rows": 512, "times": True}
    await _ask(port, address, request("POST", AREAS, json.dumps(body).encode()))


async def unknown_keys(port: int, address: str) -> None:
    """As many unknown keys as each route takes in, and 8 MB of them."""
    keys = {f"k{number}": 0 for number in range(600_000)}
    text = json.dumps(keys).encode()
    for path, size in (
        (PLANS, 0),
        (BATCH, 0),
        (BATCH, 3_900_000),
        (PLANS, 60_000),
        (AREAS, 15_000),
    ):
        body = text if not size else text[:size].rpartition(b",")[0] + b"}"
        await _ask(port, address, request("POST", path, body))
    small = text[:15_000].rpartition(b",")[0] + b"}"
    for _ in range(50):
        await _ask(port, address, request("POST", "/api/v1/flights", small))


async def hang_ups(port: int, address: str) -> None:
    """Leave as soon as the request is sent, and a little later, on new connections each."""
    for body in HEAVY:
        wanted = request("POST", f"{PLANS}?max_ms=10000", json.dumps(body).encode())
        for patience in (*[0.001] * 100, 0.01, 0.1, 1.0):
            await _ask(port, address, wanted, hang_up=patience)


async def frames(port: int, address: str) -> None:
    """Frames on a stream, as fast as they go, and on though the service has closed it."""
    async with connect(
        await _any_stream(port, address),
        subprotocols=[Subprotocol(PROTOCOL)],
        proxy=None,
        local_addr=(address, 0),
    ) as stream:
        flood = bytes((0x82, 0x80, 0, 0, 0, 0)) * 1000  # empty ones
        while not stream.transport.is_closing():
            stream.transport.write(flood)
            await asyncio.sleep(0.002)


async def idle_connections(port: int, address: str) -> None:
    """256 connections that ask for `/healthz` every three seconds."""
    await _stay(port, address, 256)


async def idle_crowds(port: int, address: str) -> None:
    """250 of the same: from 40 addresses, 10,000."""
    await _stay(port, address, 250)


async def _stay(port: int, address: str, count: int) -> None:
    async def stay() -> None:
        while True:
            with suppress(OSError, EOFError):
                reader, writer = await asyncio.open_connection(
                    "127.0.0.1", port, local_addr=(address, 0)
                )
                try:
                    while True:
                        writer.write(request("GET", "/healthz"))
                        await reader.readuntil(b"}")
                        await asyncio.sleep(3.0)
                finally:
                    writer.transport.abort()
            await asyncio.sleep(1.0)

    await asyncio.gather(*(stay() for _ in range(count)))


async def held_flights(port: int, address: str) -> None:
    """All flights that one may have, at rate 60 and polled, and 64 watchers of another's."""
    start = request("POST", "/api/v1/flights", b'{"scenario":"fig_6b","rate":60}')
    url = await _any_stream(port, address)
    for _ in range(15):
        await _ask(port, address, start)

    async def watch() -> None:
        with suppress(OSError, WebSocketException):
            async with connect(
                url, subprotocols=[Subprotocol(PROTOCOL)], proxy=None, local_addr=(address, 0)
            ) as stream:
                async for _ in stream:
                    pass

    async def poll() -> None:
        while True:
            for flight in await _flights(port, address):
                path = f"/api/v1/flights/{flight['id']}"
                await _ask(port, address, request("GET", path))
            await asyncio.sleep(4.0)

    await asyncio.gather(poll(), *(watch() for _ in range(64)))


async def _any_stream(port: int, address: str) -> str:
    """Where the first of all flights is watched."""
    flights = await _flights(port, address)
    return f"ws://127.0.0.1:{port}/api/v1/flights/{flights[0]['id']}/stream"


async def _flights(port: int, address: str) -> list[dict[str, str]]:
    reader, writer = await asyncio.open_connection("127.0.0.1", port, local_addr=(address, 0))
    try:
        writer.write(request("GET", "/api/v1/flights"))
        head = await reader.readuntil(b"\r\n\r\n")
        size = int(head.lower().partition(b"content-length:")[2].partition(b"\r\n")[0])
        listed: list[dict[str, str]] = json.loads(await reader.readexactly(size))["flights"]
    finally:
        writer.transport.abort()
    return listed


async def slow_bodies(port: int, address: str) -> None:
    """Fifty requests at a time whose bodies come a byte a second."""

    async def crawl() -> None:
        reader, writer = await asyncio.open_connection("127.0.0.1", port, local_addr=(address, 0))
        body = json.dumps(STRAIGHT).encode()
        wanted = request("POST", PLANS, body)
        try:
            writer.write(wanted[: -len(body)])
            for byte in body:
                writer.write(bytes([byte]))
                await writer.drain()
                await asyncio.sleep(1.0)
                if reader.at_eof():
                    return
        finally:
            writer.transport.abort()

    await asyncio.gather(*(crawl() for _ in range(50)), return_exceptions=True)


async def deaf_sockets(port: int, address: str) -> None:
    """Ten streams, and ten requests for large answers, none of which is ever read."""
    body = {"situation": STRAIGHT, "columns": 256, "rows": 256, "times": True}
    url = await _any_stream(port, address)
    streams, writers = [], []
    for _ in range(10):
        stream = await connect(
            url, subprotocols=[Subprotocol(PROTOCOL)], proxy=None, local_addr=(address, 0)
        )
        stream.transport.pause_reading()
        streams.append(stream)
        _, writer = await asyncio.open_connection("127.0.0.1", port, local_addr=(address, 0))
        writer.transport.pause_reading()
        for _ in range(20):
            writer.write(request("POST", AREAS, json.dumps(body).encode()))
        writers.append(writer)
    await asyncio.sleep(PATIENCE)


KINDS: dict[str, Attack] = {
    attack.__name__: attack
    for attack in (
        heavy_plans,
        patient_plans,
        batches,
        areas,
        unknown_keys,
        hang_ups,
        frames,
        idle_connections,
        idle_crowds,
        held_flights,
        slow_bodies,
        deaf_sockets,
    )
}
HEAVY = heavy(8)
COUNTS = {"hang_ups": 24, "frames": 24, "idle_connections": 2, "idle_crowds": 40, "held_flights": 2}
"""How many of a kind there are, each from an address of its own; of the others six."""


async def attack(port: int, kind: str, count: int) -> None:
    """Attack until ended."""

    async def go_on(address: str) -> None:
        while True:
            with suppress(OSError, EOFError, WebSocketException):
                await KINDS[kind](port, address)
            await asyncio.sleep(0.01)

    await asyncio.gather(*(go_on(f"127.0.0.{2 + k}") for k in range(count)))


if __name__ == "__main__":
    if hasattr(os, "nice"):
        os.nice(15)  # in truth they are other machines
    asyncio.run(attack(int(sys.argv[1]), sys.argv[2], int(sys.argv[3])))
