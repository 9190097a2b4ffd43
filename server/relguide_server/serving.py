"""How the service is started and stopped: what `relguide serve` calls."""

import asyncio
import socket
import sys
from typing import Any

import uvicorn
from fastapi import FastAPI
from uvicorn.protocols.http.httptools_impl import HttpToolsProtocol

from relguide_server.live_fleet import Fleet
from relguide_server.workers import Workers

TO_SAY_GOODBYE = 0.3
"""How long streams may take to be told why they end [s]."""
TO_FINISH = 1.0
"""How long requests may take to be answered once the service is to stop [s]."""
SWITCH = 0.5e-3
"""How long a thread may keep the interpreter from others that want it [s]: flights plan in threads,
and with Python's own 5 ms each of them would hold up the event loop so long."""
HEAD_PATIENCE = 15.0
"""How long the head of a request may take to come [s]."""
LONGEST_HEAD = 64 * 1024
"""How much of it may have come before it is whole, or of anything else that is no body [bytes]."""
TOO_LONG = f"The head of a request may have at most {LONGEST_HEAD:,} bytes."


class Connection(HttpToolsProtocol):
    """Uvicorn's connection, which ends where the head of a request is endless, or never comes."""

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Wait for a request."""
        super().connection_made(transport)
        self._unread = 0
        self._late = self.loop.call_later(HEAD_PATIENCE, transport.close)

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
        super().on_headers_complete()

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


class Server(uvicorn.Server):
    """Uvicorn's server, which tells streams and requests why they end."""

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """Stop: streams, jobs and bodies to come end with a sentence; requests have a second."""
        app = self.config.loaded_app
        while not isinstance(app, FastAPI):
            app = app.app
        fleet: Fleet = app.state.fleet
        workers: Workers = app.state.workers
        fleet.dismiss()
        app.state.bodies.stop()
        await workers.stop()
        await asyncio.sleep(TO_SAY_GOODBYE)
        await super().shutdown(sockets)


def serve(app: FastAPI, *, host: str, port: int) -> None:
    """Serve until a signal says to stop; then end within three seconds."""
    sys.setswitchinterval(SWITCH)
    most = app.state.settings.max_connections
    options = uvicorn_options(host=host, port=port)
    Server(uvicorn.Config(app, limit_concurrency=most, **options)).run()


def uvicorn_options(*, host: str, port: int) -> dict[str, Any]:
    """How uvicorn is configured.

    uvloop is taken where it is installed ("auto"). Compressing each of 20 messages a second
    would cost more than the stream itself, so per-message deflate is off.
    """
    return {
        "host": host,
        "port": port,
        "loop": "auto",
        "http": Connection,
        "ws_per_message_deflate": False,
        "ws_max_size": 1024 * 1024,  # a browser sends us camera positions, nothing larger
        "timeout_graceful_shutdown": TO_FINISH,
        "log_config": None,  # ours holds: logs.py
        "log_level": "warning",
        "access_log": False,
        "proxy_headers": False,  # app.py sees to them, after mount.py
        "server_header": False,
    }
