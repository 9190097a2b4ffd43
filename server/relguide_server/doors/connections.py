"""A connection to the service: bounds on what may come over it, how slowly, and on their number."""

import asyncio
from collections.abc import Mapping
from typing import Any

from starlette.types import ASGIApp, Message, Receive, Scope, Send
from uvicorn.protocols.http.httptools_impl import HttpToolsProtocol

from relguide.units import Second
from relguide_server.doors.connection_shares import ConnectionShares
from relguide_server.doors.sockets import Socket
from relguide_server.http.access import OPEN
from relguide_server.http.errors import problem
from relguide_server.http.security_headers import SECURITY_HEADERS, add_security_headers
from relguide_server.shares.clients import client_at

HEAD_PATIENCE = 15.0
"""How long the head of a request may take to come [s]."""
LONGEST_HEAD = 64 * 1024
"""How much of it may have come before it is whole, or of anything else that is no body [bytes]."""
TOO_LONG = f"The head of a request may have at most {LONGEST_HEAD:,} bytes."
READ_PATIENCE = 30.0
"""How long a client may read nothing of an answer that waits for it [s]."""
TWO_HOSTS = "A request has one Host, not more."
NOTHING: Mapping[str, str] = {}


class Connection(HttpToolsProtocol):
    """Uvicorn's connection, on which nothing is without end: heads, waits, and how many there are.

    One that gets no place among those that are served is told so (503), whatever it asks; only
    whether the service lives and is ready is answered even so.
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
        self._asked_at: Second = self.loop.time()
        self._has_asked = self._is_shed = False
        self._unread = 0
        self._refusal: ASGIApp | None = None
        self._too_many = ""
        """Why it has no place; empty if it has one."""
        self._deaf: asyncio.TimerHandle | None = None

    @property
    def idle_since(self) -> Second | None:
        """Since when nothing is asked on it, by the loop's clock; `None` while it is answered.

        Whether the service lives is asked of many a service by those who only want to keep a
        connection: that does not count. Nor does a request that is slow to come, or an answer
        that is not read.
        """
        cycle = self.cycle
        is_asked = cycle is not None and not cycle.response_complete and not cycle.more_body
        if is_asked and self._deaf is None and not self._is_open():
            return None
        return self._asked_at

    def _is_open(self) -> bool:
        return self.scope is not None and self.scope.get("path") in OPEN

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Wait for a request."""
        super().connection_made(transport)
        self._late = self.loop.call_later(HEAD_PATIENCE, transport.close)
        host = self.client[0] if self.client else ""
        self.whose = client_at(host)
        self._too_many = self._shares.enter(self, host)

    def shed(self) -> None:
        """End it, to make room for another client's."""
        self._is_shed = True
        if self._deaf is None:
            self.transport.close()
        else:
            self.transport.abort()

    def on_message_begin(self) -> None:
        """A request begins."""
        super().on_message_begin()
        self._late.cancel()
        self._late = self.loop.call_later(HEAD_PATIENCE, self.transport.close)

    def data_received(self, data: bytes) -> None:
        """Read on, unless too much has come that is neither a whole head nor a part of a body.

        The parser collects a line until it ends: one that never does would fill the memory, and
        keep everybody waiting while it is copied.
        """
        self._unread += len(data)
        super().data_received(data)
        if self._unread > LONGEST_HEAD and not self.transport.is_closing():
            self.send_400_response(TOO_LONG)

    def on_headers_complete(self) -> None:
        """The head is there."""
        self._late.cancel()
        self._unread = 0
        if self._too_many and self.url.partition(b"?")[0].decode("latin-1") not in OPEN:
            self._refusal = refuse(503, self._too_many, {"Retry-After": "1"})
        elif [name for name, _ in self.headers].count(b"host") > 1:
            self._refusal = refuse(400, TWO_HOSTS)
        if self._refusal is not None:
            self.app = self._refusal
        super().on_headers_complete()
        if self._too_many and self.cycle is not None:
            self.cycle.keep_alive = False

    def _should_upgrade(self) -> bool:
        return self._refusal is None and super()._should_upgrade()

    def on_body(self, body: bytes) -> None:
        """A part of the body is there."""
        self._unread = 0
        super().on_body(body)

    def on_message_complete(self) -> None:
        """The request is there."""
        self._unread = 0
        super().on_message_complete()

    def on_response_complete(self) -> None:
        """A request has been answered."""
        self._has_asked = True
        if not self._is_open():
            self._asked_at = self.loop.time()
        super().on_response_complete()

    def handle_websocket_upgrade(self) -> None:
        """A stream goes on from here."""
        super().handle_websocket_upgrade()
        stream = self.transport.get_protocol()
        assert isinstance(stream, Socket)
        self._shares.hand_over(self, stream)

    def connection_lost(self, exc: Exception | None) -> None:
        """The connection has ended."""
        self._late.cancel()
        self._shares.leave(self)
        is_answered = self._has_asked and self.cycle.response_complete
        if not is_answered and not self._is_shed:
            self._shares.note_hang_up(self.client[0] if self.client else "")
        super().connection_lost(exc)
        self._stop_waiting()

    def pause_writing(self) -> None:
        """The client has not read for a while what was sent: it may go on so for a time."""
        super().pause_writing()
        self._stop_waiting()
        self._deaf = self.loop.call_later(READ_PATIENCE, self.transport.abort)

    def resume_writing(self) -> None:
        """It reads again."""
        self._stop_waiting()
        super().resume_writing()

    def _stop_waiting(self) -> None:
        if self._deaf is not None:
            self._deaf.cancel()
            self._deaf = None

    def send_400_response(self, msg: str) -> None:
        """Say what is wrong with what is no request."""
        answer = problem("", 400, msg, kind="not-http")
        head = [b"HTTP/1.1 400 Bad Request", b"connection: close"]
        head += [b": ".join(header) for header in (*answer.raw_headers, *SECURITY_HEADERS.items())]
        self.transport.write(b"\r\n".join((*head, b"", bytes(answer.body))))
        self.transport.close()


def refuse(status: int, detail: str, headers: Mapping[str, str] = NOTHING) -> ASGIApp:
    """An app that refuses everything, and hangs up."""
    kind = "not-http" if status == 400 else ""
    sent = {"Connection": "close", **headers}

    async def answer(scope: Scope, receive: Receive, send: Send) -> None:
        async def send_strict(message: Message) -> None:
            if message["type"] == "http.response.start":
                add_security_headers(message)
            await send(message)

        refused = problem(scope["path"], status, detail, kind=kind, headers=sent)
        await refused(scope, receive, send_strict)

    return answer
