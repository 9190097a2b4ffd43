"""Load on a service: the same requests again and again on many connections, each timed."""

import asyncio
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from time import perf_counter

import numpy as np


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

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        assert isinstance(transport, asyncio.Transport) or hasattr(transport, "write")
        self._transport = transport  # type: ignore[assignment]
        self._send()

    def connection_lost(self, exc: Exception | None) -> None:
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
        if self._transport is not None:
            self._transport.abort()


async def put_load(
    port: int,
    requests: Sequence[bytes],
    *,
    seconds: float,
    connections: int = 16,
    pause: float = 0.0,
) -> Load:
    """Ask for a while, each connection for itself.

    Args:
        port: of the service on this machine.
        requests: in turn.
        seconds: for how long.
        connections: how many.
        pause: between an answer and the next request [s].
    """
    loop, load = asyncio.get_running_loop(), Load()
    opened = [
        await loop.create_connection(lambda: _Connection(requests, pause, load), "127.0.0.1", port)
        for _ in range(connections)
    ]
    load.latencies.clear()
    began = perf_counter()
    await asyncio.sleep(seconds)
    load.seconds = perf_counter() - began
    for _, connection in opened:
        connection.close()
    return load
