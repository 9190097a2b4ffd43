"""A WebSocket of the service: bounds on what may come over it, so that none holds up the others."""

from typing import Any

from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol
from websockets.frames import Frame

A_SECOND = 256 * 1024
"""What a client may send, in bytes a second: three times what streams and scenes allow."""
AT_ONCE = 1024 * 1024
"""The same at once, after a while of silence [bytes]: room to be told why, for who is only fast."""
A_FRAME = 256
"""What a frame counts beside its bytes, as each takes time, however small it is [bytes]."""
A_SLICE = 1024
"""So much is read before what it held is counted [bytes]."""


class Socket(WebSocketsSansIOProtocol):
    """Uvicorn's WebSocket. One that sends too much is cut off, and no more of it is read.

    Who sends more than a stream allows, but not so much, is told why: that is for the stream. But
    after it has closed a socket the server reads on, for the answer: here it is bounded as well.
    """

    def __init__(self, *arguments: Any, **options: Any) -> None:
        """As uvicorn makes it."""
        super().__init__(*arguments, **options)
        self._left = float(AT_ONCE)
        self._counted_at = self.loop.time()

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
            self.transport.abort()
        return self._left >= 0.0
