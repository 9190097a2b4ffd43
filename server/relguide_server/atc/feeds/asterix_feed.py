"""ASTERIX over UDP: `asterix://HOST:PORT`, also of a multicast group."""

import asyncio
import socket
import struct
from collections import deque
from ipaddress import ip_address

from relguide_server.atc.feeds.asterix_records import decode, load
from relguide_server.atc.feeds.feed_state import FeedState, clock

MOST_WAITING = 2_000
"""Datagrams that wait to be read, at most; the oldest go. A record takes some 0.2 ms."""


class _Datagrams(asyncio.DatagramProtocol):
    """Keeps what comes until it is read."""

    def __init__(self, state: FeedState) -> None:
        self.state = state
        self.waiting: deque[bytes] = deque()
        self.came = asyncio.Event()

    def datagram_received(self, data: bytes, addr: object) -> None:
        if len(self.waiting) >= MOST_WAITING:
            self.waiting.popleft()
            self.state.lost += 1
        self.waiting.append(data)
        self.came.set()

    def error_received(self, exc: Exception) -> None:
        self.state.fault = f"The socket says: {exc}."


async def listen_to_asterix(host: str, port: int, state: FeedState) -> None:
    """Take datagrams until cancelled.

    Args:
        host: an address of this machine, or a multicast group.
        port: of UDP.
        state: of the feed.

    Raises:
        OSError: if nothing can be received there.
    """
    await asyncio.to_thread(load)
    loop = asyncio.get_running_loop()
    transport, datagrams = await loop.create_datagram_endpoint(
        lambda: _Datagrams(state), sock=_socket(host, port)
    )
    try:
        while True:
            await datagrams.came.wait()
            datagrams.came.clear()
            took = list(datagrams.waiting)
            datagrams.waiting.clear()
            await asyncio.to_thread(_read, took, state)
    finally:
        transport.close()


def _read(datagrams: list[bytes], state: FeedState) -> None:
    for datagram in datagrams:
        now = clock()
        said = decode(datagram, now)
        state.messages += 1
        state.malformed += said.malformed
        state.unusable += said.unusable
        if said.malformed:
            state.fault = f"A datagram of {len(datagram)} bytes was no ASTERIX that can be read."
        state.take(said.found, now)
        for ident in said.gone:
            state.reports.drop(state.source, ident)


def _socket(host: str, port: int) -> socket.socket:
    """A socket that receives there."""
    address = ip_address(host)
    family = socket.AF_INET6 if address.version == 6 else socket.AF_INET
    receiver = socket.socket(family, socket.SOCK_DGRAM)
    try:
        receiver.setblocking(False)
        if not address.is_multicast:
            receiver.bind((host, port))
            return receiver
        receiver.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        receiver.bind(("", port))
        if address.version == 6:
            group = struct.pack("16sI", address.packed, 0)
            receiver.setsockopt(socket.IPPROTO_IPV6, socket.IPV6_JOIN_GROUP, group)
        else:
            group = struct.pack("4s4s", address.packed, socket.inet_aton("0.0.0.0"))
            receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, group)
    except OSError:
        receiver.close()
        raise
    return receiver
