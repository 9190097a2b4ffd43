"""Load on a service: the same requests again and again on many connections, each timed."""

import asyncio
from collections import Counter
from collections.abc import Coroutine, Sequence
from contextlib import closing, suppress
from dataclasses import dataclass, field
from time import perf_counter
from typing import Any

import numpy as np

AGAIN = 0.05
"""After so long a connection that ended is made anew [s]."""


def request(method: str, path: str, body: bytes = b"", media: str = "application/json") -> bytes:
    """A request as it goes over the wire."""
    head = f"{method} {path} HTTP/1.1\r\nHost: localhost\r\n"
    if method == "POST":
        head += f"Content-Type: {media}\r\nContent-Length: {len(body)}\r\n"
    return head.encode() + b"\r\n" + body


@dataclass(slots=True)
class Load:
    """What became of some requests."""

    seconds: float = 0.0
    latencies: list[float] = field(default_factory=list)
    """[s]."""
    statuses: Counter[int] = field(default_factory=Counter)
    """Of answers; 0 counts connections that were not made, or ended without one."""

    @property
    def rate(self) -> float:
        """Answers a second [1/s]."""
        return len(self.latencies) / self.seconds

    def percentile(self, share: float) -> float:
        """Of the latencies [ms]."""
        return 1e3 * float(np.percentile(self.latencies, share))


class _Connection(asyncio.Protocol):
    """Sends one request after another, as soon as the last was answered or after a pause."""

    def __init__(self, requests: Sequence[bytes], pause: float, load: Load) -> None:
        self._requests, self._pause, self._load = requests, pause, load
        self._sent = 0
        self._came = b""
        self._began = 0.0
        self._transport: asyncio.Transport | None = None
        self.ended: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        """Done when the service, and not this program, has ended it."""

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        assert isinstance(transport, asyncio.Transport) or hasattr(transport, "write")
        self._transport = transport  # type: ignore[assignment]
        self._send()

    def connection_lost(self, exc: Exception | None) -> None:
        if self._transport is not None and not self.ended.done():
            self.ended.set_result(None)
        self._transport = None

    def _send(self) -> None:
        if self._transport is not None:
            self._began = perf_counter()
            self._transport.write(self._requests[self._sent % len(self._requests)])
            self._sent += 1

    def data_received(self, data: bytes) -> None:
        self._came += data
        head, found, body = self._came.partition(b"\r\n\r\n")
        if not found:
            return
        _, _, rest = head.lower().partition(b"content-length:")
        if len(body) < int(rest.partition(b"\r\n")[0]):
            return
        self._load.latencies.append(perf_counter() - self._began)
        self._load.statuses[int(self._came[9:12])] += 1
        self._came = b""
        if self._pause:
            asyncio.get_running_loop().call_later(self._pause, self._send)
        else:
            self._send()

    def close(self) -> None:
        transport, self._transport = self._transport, None
        if transport is not None:
            transport.abort()


async def put_load(
    port: int,
    requests: Sequence[bytes],
    *,
    seconds: float,
    connections: int = 16,
    pause: float = 0.0,
    address: str = "127.0.0.1",
) -> Load:
    """Ask for a while, each connection for itself; one that the service ends is made anew.

    Args:
        port: of the service on this machine.
        requests: in turn.
        seconds: for how long.
        connections: how many.
        pause: between an answer and the next request [s].
        address: asked from.
    """
    load = Load()

    async def ask() -> None:
        while True:
            await _ask_on_one(_Connection(requests, pause, load), port, address)
            load.statuses[0] += 1
            await asyncio.sleep(AGAIN)

    return await _ask_for(seconds, [ask() for _ in range(connections)], load)


async def _ask_on_one(connection: _Connection, port: int, address: str) -> None:
    """Ask until the service ends the connection."""
    loop = asyncio.get_running_loop()
    with closing(connection), suppress(OSError):
        await loop.create_connection(lambda: connection, "127.0.0.1", port, local_addr=(address, 0))
        await connection.ended


async def put_new_load(
    port: int, wanted: bytes, *, seconds: float, pause: float, address: str
) -> Load:
    """Ask for a while, each time on a new connection.

    Args:
        port: of the service on this machine.
        wanted: the request.
        seconds: for how long.
        pause: between an answer and the next connection [s].
        address: asked from.
    """
    load = Load()

    async def ask() -> None:
        while True:
            began = perf_counter()
            try:
                reader, writer = await asyncio.open_connection(
                    "127.0.0.1", port, local_addr=(address, 0)
                )
                writer.write(wanted)
                head = await reader.readuntil(b"\r\n\r\n")
                size = head.lower().partition(b"content-length:")[2].partition(b"\r\n")[0]
                await reader.readexactly(int(size))
                load.statuses[int(head[9:12])] += 1
                load.latencies.append(perf_counter() - began)
                writer.close()
            except (OSError, EOFError):
                load.statuses[0] += 1
            await asyncio.sleep(pause)

    return await _ask_for(seconds, [ask()], load)


async def _ask_for(seconds: float, asking: Sequence[Coroutine[Any, Any, None]], load: Load) -> Load:
    tasks = [asyncio.create_task(each) for each in asking]
    began = perf_counter()
    await asyncio.sleep(seconds)
    load.seconds = perf_counter() - began
    for task in tasks:
        task.cancel()
    await asyncio.wait(tasks)
    return load
