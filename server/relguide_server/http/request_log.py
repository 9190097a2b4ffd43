"""What every request leaves behind: its id in the answer, its time in the metrics, its log line.

The answer gets the headers that make a browser strict in the same go.
"""

import re
from logging import DEBUG
from random import getrandbits
from time import perf_counter

from starlette.types import ASGIApp, Message, Receive, Scope, Send

from relguide_server.http.errors import log
from relguide_server.http.logs import request_id
from relguide_server.http.metrics import Metrics
from relguide_server.http.security_headers import add_security_headers

HEADER = b"x-request-id"
SOUND = re.compile(r"[\w.:/+=@-]{1,128}", re.ASCII)
"""An id that is taken as it was sent; any other is replaced by one of ours."""
METHODS = ("GET", "POST", "DELETE", "OPTIONS")
"""HEAD is answered as GET; others are counted as one."""
NO_ROUTE = "none"
"""Where a request went that is no route of the API: to a file of the page, or nowhere."""


class RequestLog:
    """ASGI middleware: gives each request an id and strict headers, measures it and notes it.

    `X-Request-ID` is taken from the request or made, stands in each line of the log that is written
    while it is answered, and is returned. A log of level `debug` has a line for every request.
    """

    def __init__(self, app: ASGIApp, *, metrics: Metrics) -> None:
        self.app = app
        self.metrics = metrics

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one connection."""
        if scope["type"] not in ("http", "websocket"):
            await self.app(scope, receive, send)
            return
        name = _sent(scope) or f"{getrandbits(128):032x}"
        # never taken back: each connection is a task, and what goes wrong in it is logged last
        request_id.set(name)
        if scope["type"] == "http":
            await self._serve(scope, receive, send, name.encode())
        else:
            await self.app(scope, receive, send)

    async def _serve(self, scope: Scope, receive: Receive, send: Send, name: bytes) -> None:
        started, status = perf_counter(), 0

        async def send_named(message: Message) -> None:
            nonlocal status
            if message["type"] == "http.response.start":
                status = message["status"]
                add_security_headers(message)
                message["headers"].append((HEADER, name))
            await send(message)

        try:
            await self.app(scope, receive, send_named)
        except BaseException:
            status = status or 500
            raise
        finally:
            seconds = perf_counter() - started
            route = getattr(scope.get("route"), "path", NO_ROUTE)
            method = scope["method"] if scope["method"] in METHODS else "other"
            self.metrics.count_request(route, method, status, seconds)
            if log.isEnabledFor(DEBUG):
                fields = {
                    "method": method,
                    "path": scope["path"],
                    "route": route,
                    "status": status,
                    "ms": round(1e3 * seconds, 3),
                    "client": (scope.get("client") or ("",))[0],
                }
                log.debug("%s %s: %d", method, scope["path"], status, extra={"fields": fields})


def _sent(scope: Scope) -> str:
    """The id that a request brings; empty if it brings none that can be taken."""
    for name, value in scope["headers"]:
        if name == HEADER:
            text: str = value.decode("latin-1")
            return text if SOUND.fullmatch(text) else ""
    return ""
