"""Passes of the event loop, in which requests of many clients begin.

In each pass the loop goes on with all that is ready. If a client asks on many connections at once,
that may be so much that an answer for somebody else, which takes some passes, comes late. So once a
pass is long, more requests of a client that has begun one in it wait for the next.
"""

import asyncio
from collections import deque
from time import perf_counter

from starlette.types import ASGIApp, Receive, Scope, Send

from relguide.units import Second

LONG: Second = 0.002
"""A pass that takes longer is long."""


class Passes:
    """ASGI middleware: requests of a client that are many begin a few in each pass of the loop."""

    def __init__(self, app: ASGIApp) -> None:
        self.app = app
        self._began = 0.0
        self._clients: set[str] = set()
        self._waiting: dict[str, deque[asyncio.Future[None]]] = {}
        self._is_counted = False

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one connection, when its turn comes."""
        if scope["type"] == "http":
            address = scope.get("client")
            await self._wait_for_turn(address[0] if address else "")
        await self.app(scope, receive, send)

    async def _wait_for_turn(self, client: str) -> None:
        if not self._is_counted:
            self._begin_pass()
        is_late = perf_counter() - self._began > LONG and client in self._clients
        if is_late or client in self._waiting:
            turn = asyncio.get_running_loop().create_future()
            self._waiting.setdefault(client, deque()).append(turn)
            await turn
        self._clients.add(client)

    def _begin_pass(self) -> None:
        self._began, self._is_counted = perf_counter(), True
        self._clients.clear()
        asyncio.get_running_loop().call_soon(self._end_pass)

    def _end_pass(self) -> None:
        """Let one request of each client that waits begin in the next pass."""
        self._is_counted = False
        if not self._waiting:
            return
        self._begin_pass()
        for client, turns in list(self._waiting.items()):
            turn = turns.popleft()
            if not turn.done():  # else it was given up
                turn.set_result(None)
            if not turns:
                del self._waiting[client]
