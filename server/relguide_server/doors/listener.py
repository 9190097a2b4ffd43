"""The port: accepts all who knock at once, and begins their connections in turn.

The kernel hands connections over in the order in which they came, so a client that opens many
keeps all others waiting. Here they are taken out as fast as they come. Those of clients that may
not come in, and those whose client has left again, are closed unheard; of the others a few begin in
each pass of the event loop, and their clients take turns.
"""

import asyncio
import select
import socket
import struct
from collections.abc import Callable, Sequence
from contextlib import suppress

from relguide.units import Second
from relguide_server.doors.connection_shares import ConnectionShares
from relguide_server.http.errors import log
from relguide_server.shares.clients import client_at
from relguide_server.shares.fair_queue import FairQueue

BACKLOG = 2048
"""Connections that wait in the kernel."""
AT_ONCE = 128
"""So many are taken out in one pass of the loop: some 2 ms."""
BEGUN = 8
"""So many begin in one pass."""
FEWEST = 256
"""At least so many of one client may wait to begin."""
BREATH: Second = 0.2
"""How long no more are accepted where the process has no more descriptors."""
LEFT = getattr(select, "POLLRDHUP", getattr(select, "POLLHUP", 0))
"""How the kernel says that a client has hung up; only Linux says so of one that has sent some."""
RESET = struct.pack("ii", 1, 0)
"""Close without waiting for what is unsent, and leave nothing behind in the kernel."""


class Listener:
    """A port that is listened at; uvicorn takes it for a server of asyncio."""

    def __init__(
        self,
        sockets: Sequence[socket.socket],
        shares: ConnectionShares,
        begin: Callable[[], asyncio.Protocol],
    ) -> None:
        """Listen from now on.

        Args:
            sockets: bound to the port.
            shares: says who may come in.
            begin: makes what serves one connection.
        """
        self.sockets = sockets
        self._shares, self._begin = shares, begin
        self._loop = asyncio.get_running_loop()
        self._waiting: FairQueue[tuple[socket.socket, str]] = FairQueue(
            2 * max(shares.most, FEWEST)
        )
        """One client may have half of them: as many as are served at once."""
        self._beginning: set[asyncio.Task[object]] = set()
        self._closed = self._turning = False
        for each in sockets:
            each.listen(BACKLOG)
            each.setblocking(False)
        self._accept_more()

    def close(self) -> None:
        """Accept nobody any more."""
        self._closed = True
        for each in self.sockets:
            self._loop.remove_reader(each)
            each.close()
        while self._waiting:
            _drop(self._waiting.take()[0])

    async def wait_closed(self) -> None:
        """Wait until those that had begun are begun."""
        if self._beginning:
            await asyncio.wait(self._beginning)

    def _accept_more(self) -> None:
        if not self._closed:
            for each in self.sockets:
                self._loop.add_reader(each, self._accept, each)

    def _accept(self, port: socket.socket) -> None:
        for _ in range(AT_ONCE):
            try:
                accepted, address = port.accept()
            except (BlockingIOError, InterruptedError, ConnectionAbortedError):
                break
            except OSError as error:  # no descriptor is left: those that are used end some time
                log.warning("No connection can be accepted: %s", error.strerror)
                for each in self.sockets:
                    self._loop.remove_reader(each)
                self._loop.call_later(BREATH, self._accept_more)
                break
            host = address[0]
            client = client_at(host)
            if self._shares.is_open_to(host) and self._waiting.has_room(client):
                self._waiting.put((accepted, host), client)
            else:
                _drop(accepted)
        if self._waiting and not self._turning:
            self._begin_some()

    def _begin_some(self) -> None:
        """Begin the next few, and go on in the next pass."""
        begun = 0
        while self._waiting and begun < BEGUN:
            accepted, host = self._waiting.take()
            if _has_left(accepted):
                self._shares.note_hang_up(host)
                _drop(accepted)
                continue
            begun += 1
            beginning = self._loop.create_task(self._begin_one(accepted))
            self._beginning.add(beginning)
            beginning.add_done_callback(self._beginning.discard)
        self._turning = bool(self._waiting)
        if self._turning:
            self._loop.call_soon(self._begin_some)

    async def _begin_one(self, accepted: socket.socket) -> None:
        with suppress(OSError):  # it may leave at any moment
            accepted.setblocking(False)
            accepted.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            await self._loop.connect_accepted_socket(self._begin, accepted)


def bound(host: str, port: int) -> list[socket.socket]:
    """Sockets bound to all addresses of a host.

    Raises:
        OSError: if one cannot be.
    """
    sockets: list[socket.socket] = []
    found = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE)
    for family, kind, protocol, _, address in dict.fromkeys(found):
        made = socket.socket(family, kind, protocol)
        sockets.append(made)
        made.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        if family == socket.AF_INET6:
            made.setsockopt(socket.IPPROTO_IPV6, socket.IPV6_V6ONLY, 1)
        try:
            made.bind(address)
        except OSError:
            for each in sockets:
                each.close()
            raise
    return sockets


def _has_left(accepted: socket.socket) -> bool:
    """Whether the client has hung up while it waited."""
    watched = select.poll()
    watched.register(accepted, LEFT)
    return bool(watched.poll(0))


def _drop(accepted: socket.socket) -> None:
    with suppress(OSError):
        accepted.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, RESET)
    accepted.close()
