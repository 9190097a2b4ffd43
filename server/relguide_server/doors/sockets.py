"""A WebSocket of the service: bounds on what may come over it, so that none holds up the others."""

from asyncio.transports import BaseTransport
from functools import partial
from math import inf
from typing import Any

from uvicorn._types import ASGISendEvent
from uvicorn.protocols.utils import ClientDisconnected
from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol
from websockets.frames import Frame
from websockets.http11 import Request

from relguide.units import Second
from relguide_server.doors.connection_shares import ConnectionShares
from relguide_server.shares.clients import client_at

A_SECOND = 256 * 1024
"""What a client may send, in bytes a second: twice what scenes allow."""
AT_ONCE = 1024 * 1024
"""The same at once, after a while of silence [bytes]: room to be told why, for who is only fast."""
A_FRAME = 640
"""What a frame counts beside its bytes, as each takes time, however small it is [bytes]."""
A_SLICE = 1024
"""So much is read before what it held is counted [bytes]."""
SHED = 1013
"""Close code of a stream that makes room for another client's connection."""
WHY_SHED = "This server is full, and you have the most of its connections: dial again in a moment."
TO_HEAR: Second = 1.0
"""How long it may take to be told so."""
BRIEF: Second = 1.0
"""A stream that its client leaves sooner counts as one that was not waited for."""
KEEP = "relguide.keep"
"""The extension of ASGI by which a route says that a stream is one of its flight's owner."""


class Socket(WebSocketsSansIOProtocol):
    """Uvicorn's WebSocket. One that sends too much is cut off, and no more of it is read.

    Who sends more than a stream allows, but not so much, is told why: that is for the stream. But
    after it has closed a socket the server reads on, for the answer: here it is bounded as well.
    """

    def __init__(self, *arguments: Any, shares: ConnectionShares, **options: Any) -> None:
        """As uvicorn makes it.

        Args:
            arguments: of uvicorn.
            shares: the places that there are.
            options: of uvicorn.
        """
        super().__init__(*arguments, **options)
        self._shares = shares
        self.whose = ""
        self._is_cut_off = False
        self._began_at: Second = self.loop.time()
        self._left = float(AT_ONCE)
        self._counted_at = self.loop.time()

    @property
    def idle_since(self) -> Second | None:
        """Never: a stream is only shed where its client has no idle connections."""
        return inf

    def connection_made(self, transport: BaseTransport) -> None:
        """Begin with the handshake."""
        super().connection_made(transport)
        self.whose = client_at(self.client[0] if self.client else "")

    def connection_lost(self, exc: Exception | None) -> None:
        """The connection has ended."""
        self._shares.leave(self)
        if not (self.close_sent or self._is_cut_off) and self.loop.time() - self._began_at < BRIEF:
            self._shares.note_hang_up(self.client[0] if self.client else "")
        super().connection_lost(exc)

    def handle_connect(self, event: Request) -> None:
        """The handshake is there: the app goes on."""
        super().handle_connect(event)
        if self.response.status_code == 101:
            self.scope["extensions"][KEEP] = {"keep": partial(self._shares.keep, self)}

    async def send(self, message: ASGISendEvent) -> None:
        """Send, unless it has been closed here, which the app learns of like any other end.

        Uvicorn closes one whose client answers no pings, and takes what is sent then for a mistake.
        """
        if self.close_sent and message["type"] == "websocket.send":
            raise ClientDisconnected
        await super().send(message)

    def shed(self) -> None:
        """End it, to make room for another client's."""
        if self.handshake_complete and not self.close_sent:
            self.conn.send_close(SHED, WHY_SHED)
            self.close_sent = True
            self.transport.write(b"".join(self.conn.data_to_send()))
        self.transport.close()
        self.loop.call_later(TO_HEAR, self.transport.abort)

    def data_received(self, data: bytes) -> None:
        """Read on, bit by bit, unless too much has come."""
        if not self.handshake_initiated:  # the request: Connection has bounded it
            super().data_received(data)
            return
        for begin in range(0, len(data), A_SLICE):
            part = data[begin : begin + A_SLICE]
            if not self._may(len(part)):
                return
            super().data_received(part)

    def handle_text(self, event: Frame) -> None:
        """A message begins, or is there."""
        if self._may(A_FRAME):
            super().handle_text(event)

    def handle_bytes(self, event: Frame) -> None:
        """The same in binary."""
        if self._may(A_FRAME):
            super().handle_bytes(event)

    def handle_cont(self, event: Frame) -> None:
        """Another part of a message is there."""
        if self._may(A_FRAME):
            super().handle_cont(event)

    def handle_ping(self) -> None:
        """The client asks whether we are there."""
        if self._may(A_FRAME):
            super().handle_ping()

    def handle_pong(self, event: Frame) -> None:
        """The client is there."""
        if self._may(A_FRAME):
            super().handle_pong(event)

    def _may(self, count: int) -> bool:
        """Count what came; cut the client off if it is too much."""
        now = self.loop.time()
        gained = A_SECOND * (now - self._counted_at)
        self._left, self._counted_at = min(self._left + gained, AT_ONCE) - count, now
        if self._left < 0.0 and not self.transport.is_closing():
            self._shares.note_flood(self.client[0] if self.client else "")
            self._is_cut_off = True
            self.transport.abort()
        return self._left >= 0.0
