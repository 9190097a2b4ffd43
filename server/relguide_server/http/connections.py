"""A connection to the service: bounds on what may come over it, how slowly, and on their number."""

import asyncio
from collections.abc import Callable, Mapping
from typing import Any

from starlette.types import ASGIApp, Message, Receive, Scope, Send
from uvicorn.protocols.http.httptools_impl import HttpToolsProtocol

from relguide_server.http.errors import problem
from relguide_server.http.security_headers import SECURITY_HEADERS, add_security_headers

HEAD_PATIENCE = 15.0
"""How long the head of a request may take to come [s]."""
LONGEST_HEAD = 64 * 1024
"""How much of it may have come before it is whole, or of anything else that is no body [bytes]."""
TOO_LONG = f"The head of a request may have at most {LONGEST_HEAD:,} bytes."
READ_PATIENCE = 30.0
"""How long a client may read nothing of an answer that waits for it [s]."""
TOLD = 64
"""So many connections beyond those that are served are told so."""
TOO_MANY = "This server has {most} connections, the most it serves: try again in a moment."
TWO_HOSTS = "A request has one Host, not more."
NOTHING: Mapping[str, str] = {}
TOO_MANY_OF_YOURS = "You have {most} connections already, the most of a client's: close some."


class Connection(HttpToolsProtocol):
    """Uvicorn's connection, on which nothing is without end: heads, waits, and how many there are.

    Half of the connections are for one client at most, so that none keeps others out. Those beyond
    are told so (503), whatever they ask; those far beyond are closed unheard.
    """

    def __init__(
        self, *arguments: Any, most: int, proxies: Callable[[str], bool], **options: Any
    ) -> None:
        """As uvicorn makes it.

        Args:
            arguments: of uvicorn.
            most: connections served at once.
            proxies: says of an address whether it speaks for many clients.
            options: of uvicorn.
        """
        super().__init__(*arguments, **options)
        self._most, self._proxies = most, proxies
        self._unread = 0
        self._refusal: ASGIApp | None = None
        self.too_many = ""
        """Why it is one too many; empty if it is not."""
        self._deaf: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Wait for a request."""
        super().connection_made(transport)
        self._late = self.loop.call_later(HEAD_PATIENCE, transport.close)
        if len(self.connections) <= self._most // 2:
            return
        told = sum(bool(getattr(other, "too_many", "")) for other in self.connections)
        if len(self.connections) - told > self._most:
            self.too_many = TOO_MANY.format(most=self._most)
        elif self.client is not None and not self._proxies(self.client[0]):
            if self._count_served(self.client[0]) > self._most // 2:
                self.too_many = TOO_MANY_OF_YOURS.format(most=self._most // 2)
        if self.too_many and told >= TOLD:
            transport.abort()

    def _count_served(self, host: str) -> int:
        """How many connections from an address are served."""
        return sum(
            (getattr(other, "client", None) or ("",))[0] == host
            and not getattr(other, "too_many", "")
            for other in self.connections
        )

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
        if self.too_many:
            self._refusal = refuse(503, self.too_many, {"Retry-After": "1"})
        elif [name for name, _ in self.headers].count(b"host") > 1:
            self._refusal = refuse(400, TWO_HOSTS)
        if self._refusal is not None:
            self.app = self._refusal
        super().on_headers_complete()

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

    def connection_lost(self, exc: Exception | None) -> None:
        """The connection has ended."""
        self._late.cancel()
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
