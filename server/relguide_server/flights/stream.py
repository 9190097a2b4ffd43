"""One client of a flight's stream: a queue of two that drops the oldest, snapshots, and answers."""

import asyncio
from collections import deque
from collections.abc import Callable
from contextlib import suppress

from starlette.websockets import WebSocket, WebSocketDisconnect, WebSocketState

from relguide.contract.upstream import Upstream
from relguide_server.doors.sockets import SHED
from relguide_server.flights.frames import (
    LONGEST,
    MOST,
    NOT_UNDERSTOOD,
    TOO_FAST,
    FrameReader,
    UnwelcomeFrame,
)
from relguide_server.http.metrics import Metrics

QUEUE = 2
"""Ticks that may wait for one client: a tenth of a second."""
ANSWERS = 8
"""Answers that may: of more, the newest."""
WRONG_PROTOCOL, UNKNOWN_FLIGHT, FLIGHT_GONE, FLIGHT_BROKEN = 4400, 4404, 4410, 4500
TOO_MANY = 4429
"""Close codes of a stream, each sent with a sentence."""
RESTART = 1012
"""The same, of the protocol itself: the page dials again."""
CLOSE_CODES = {
    WRONG_PROTOCOL: "the client offered no sub-protocol that this server speaks",
    UNKNOWN_FLIGHT: "there is no such flight",
    FLIGHT_GONE: "the flight was removed",
    NOT_UNDERSTOOD: f"the client sent what is no frame of the stream, or more than {LONGEST} bytes",
    TOO_MANY: "as many watch the flight as may, or as many of one client",
    TOO_FAST: f"the client sent more than {MOST} frames a second",
    FLIGHT_BROKEN: "the flight was stopped by a mistake of the server",
    RESTART: "the service stops: it may be back in a moment",
    SHED: "the server is full, and this client has the most of its connections",
}
"""What each says."""


class StreamClient:
    """The queue of one client. Lives on the event loop."""

    def __init__(self, snapshot: Callable[[], str], metrics: Metrics) -> None:
        self._snapshot = snapshot
        self._metrics = metrics
        self._queue: deque[tuple[str, bool]] = deque()
        self._answers: deque[str] = deque(maxlen=ANSWERS)
        self.knows_it_has_none = False
        """Whether it was told that it has no control."""
        self._behind = True  # a new client has missed everything so far
        self._goodbye: tuple[int, str] | None = None
        self._wake = asyncio.Event()

    def offer(self, text: str, *, essential: bool) -> None:
        """Put a tick in the queue; never waits.

        Args:
            text: the tick.
            essential: whether it holds more than a sample. A client that misses such a tick gets a
                snapshot next, so a slow client may be late but is never wrong.
        """
        if len(self._queue) == QUEUE:
            _, lost = self._queue.popleft()
            self._behind |= lost
            self._metrics.ticks_dropped.inc()
        self._queue.append((text, essential))
        self._wake.set()

    def answer(self, text: str) -> None:
        """Say something to this client alone, before any tick that waits."""
        self._answers.append(text)
        self._wake.set()

    def close(self, code: int, reason: str) -> None:
        """End the stream with a sentence."""
        self._goodbye = (code, reason)
        self._wake.set()

    async def pump(self, websocket: WebSocket, hear: Callable[[Upstream], None]) -> None:
        """Send to an accepted WebSocket, and hear what it sends, until either side ends it.

        Args:
            websocket: it.
            hear: told of each frame that it sends.
        """
        sender = asyncio.create_task(self._send_all(websocket))
        listener = asyncio.create_task(_listen(websocket, hear))
        try:
            done, _ = await asyncio.wait((sender, listener), return_when=asyncio.FIRST_COMPLETED)
        finally:
            sender.cancel()
            listener.cancel()
        try:
            for task in done:
                task.result()  # a mistake of ours in there is raised here
        except UnwelcomeFrame as unwelcome:
            self._metrics.frames_refused.labels(unwelcome.why).inc()
            if websocket.application_state is not WebSocketState.CONNECTED:
                return  # it was cut off meanwhile
            with suppress(WebSocketDisconnect):
                await websocket.close(unwelcome.code, unwelcome.reason)

    async def _send_all(self, websocket: WebSocket) -> None:
        try:
            while True:
                match await self._next():
                    case str() as text:
                        await websocket.send_text(text)
                        self._metrics.ticks_sent.inc()
                    case code, reason:
                        await websocket.close(code, reason)
                        return
        except WebSocketDisconnect:
            pass  # it left while we were sending: as good as any other moment

    async def _next(self) -> str | tuple[int, str]:
        while True:
            if self._answers:
                return self._answers.popleft()
            if self._behind:
                self._behind = False
                self._queue.clear()  # the snapshot holds all that
                return self._snapshot()
            if self._queue:
                return self._queue.popleft()[0]
            if self._goodbye is not None:
                return self._goodbye
            self._wake.clear()
            await self._wake.wait()


async def _listen(websocket: WebSocket, hear: Callable[[Upstream], None]) -> None:
    """Hear each frame until the client is gone; those that only watch send none.

    Raises:
        UnwelcomeFrame: if the socket is to be closed for one.
    """
    reader = FrameReader()
    while (event := await websocket.receive())["type"] != "websocket.disconnect":
        hear(reader.read(event))
