"""How the service is started and stopped: what `relguide serve` calls."""

import asyncio
import gc
import signal
import socket
import sys
from functools import partial
from types import FrameType
from typing import Any

import uvicorn
from fastapi import FastAPI

from relguide_server.doors.connection_shares import ConnectionShares
from relguide_server.doors.connections import Connection
from relguide_server.doors.listener import Listener, bound
from relguide_server.doors.sockets import Socket
from relguide_server.flights.live_fleet import LiveFleet
from relguide_server.http.errors import log
from relguide_server.http.proxy import believed
from relguide_server.jobs.worker_pool import WorkerPool
from relguide_server.readiness import Preparation
from relguide_server.settings import ServiceSettings

TO_SAY_GOODBYE = 0.3
"""How long streams may take to be told why they end [s]."""
TO_FINISH = 1.0
"""How long requests may take to be answered once the service is to stop [s]."""
SWITCH = 0.5e-3
"""How long a thread may keep the interpreter from others that want it [s]: flights plan in threads,
and with Python's own 5 ms each of them would hold up the event loop so long."""

FULL = 50
"""So many collections of middle age are made between two that look through all that lives, in place
of Python's ten: such a one holds up the event loop for 15 to 30 ms."""


class Server(uvicorn.Server):
    """Uvicorn's server, which tells streams and requests why they end."""

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Listen, so that no client keeps others out."""
        connection: Any = self.config.http_protocol_class  # as `uvicorn_options` has it
        shares: ConnectionShares = connection.keywords["shares"]
        self._app().state.metrics.watch(shares.measure)
        if sys.platform == "win32":  # whose loops watch no sockets
            await super().startup(sockets)
            return
        try:
            ports = bound(self.config.host, self.config.port)
        except OSError as error:
            log.error("%s, port %d: %s", self.config.host, self.config.port, error.strerror)
            sys.exit(1)
        await self.lifespan.startup()
        if self.lifespan.should_exit:
            sys.exit(1)
        begin = partial(
            connection,
            config=self.config,
            server_state=self.server_state,
            app_state=self.lifespan.state,
        )
        self.servers = [Listener(ports, shares, begin)]  # type: ignore[list-item]
        self.started = True

    def handle_exit(self, sig: int, frame: FrameType | None) -> None:
        """Stop. SIGTERM is how a service is meant to end: it exits with 0, not by that signal."""
        super().handle_exit(sig, frame)
        if sig == signal.SIGTERM:
            self._captured_signals.remove(sig)

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """Stop: streams, jobs and bodies to come end with a sentence; requests have a second."""
        app = self._app()
        preparation: Preparation = app.state.preparation
        compiling = preparation.report()["preparing"]
        left = "; its next start compiles what is left" if compiling else ""
        log.info("The service is stopping%s.", left)
        preparation.dismiss()
        fleet: LiveFleet = app.state.fleet
        workers: WorkerPool = app.state.workers
        fleet.dismiss()
        app.state.desk.journal.dismiss()
        app.state.bodies.stop()
        await workers.stop()
        await asyncio.sleep(TO_SAY_GOODBYE)
        await super().shutdown(sockets)

    def _app(self) -> FastAPI:
        app = self.config.loaded_app
        while not isinstance(app, FastAPI):
            app = app.app
        return app


def serve(app: FastAPI, *, host: str, port: int) -> None:
    """Serve until a signal says to stop; then end within three seconds."""
    sys.setswitchinterval(SWITCH)
    gc.set_threshold(*gc.get_threshold()[:2], FULL)
    settings: ServiceSettings = app.state.settings
    options = uvicorn_options(
        host=host, port=port, most=settings.max_connections, proxies=settings.proxies
    )
    Server(uvicorn.Config(app, **options)).run()


def uvicorn_options(*, host: str, port: int, most: int, proxies: str) -> dict[str, Any]:
    """How uvicorn is configured.

    Args:
        host: the address to listen at.
        port: the port; 0 for a free one.
        most: connections served at once.
        proxies: those that are believed, each of which may have all of them.

    uvloop is taken where it is installed ("auto"). Compressing each of 20 messages a second
    would cost more than the stream itself, so per-message deflate is off.
    """
    shares = ConnectionShares(most, believed(proxies))
    return {
        "host": host,
        "port": port,
        "loop": "auto",
        "http": partial(Connection, shares=shares),
        "ws": partial(Socket, shares=shares),
        "ws_per_message_deflate": False,
        "ws_max_size": 1024 * 1024,  # a browser sends us camera positions, nothing larger
        "timeout_graceful_shutdown": TO_FINISH,
        "log_config": None,  # ours holds: logs.py
        "log_level": "warning",
        "access_log": False,
        "proxy_headers": False,  # app.py sees to them, after proxy.py
        "server_header": False,
    }
