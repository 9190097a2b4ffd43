"""Passes of the event loop, in which requests of many clients begin.

In each pass the loop goes on with all that is ready. If many ask at once, or one on many
connections, that may be so much that an answer for somebody else, which takes some passes, comes
late. So once a pass is long, no more requests begin in it. Those that wait begin one in each pass,
and their clients take turns.
"""

import asyncio
from time import perf_counter

from starlette.types import ASGIApp, Receive, Scope, Send

from relguide.units import Second
from relguide_server.shares.clients import client_of
from relguide_server.shares.fair_queue import FairQueue

LONG: Second = 0.002
"""A pass that takes longer is long."""


class Admission:
    """ASGI middleware: requests of a client that are many begin a few in each pass of the loop."""

    def __init__(self, app: ASGIApp) -> None:
        self.app = app
        self._began = 0.0
        self._waiting: FairQueue[asyncio.Future[None]] = FairQueue(0)
        self._is_counted = False

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one connection, when its turn comes."""
        if scope["type"] == "http":
            await self._wait_for_turn(client_of(scope))
        await self.app(scope, receive, send)

    async def _wait_for_turn(self, client: str) -> None:
        if not self._is_counted:
            self._begin_pass()
        if perf_counter() - self._began > LONG or self._waiting.count_of(client):
            turn = asyncio.get_running_loop().create_future()
            self._waiting.put(turn, client)
            await turn

    def _begin_pass(self) -> None:
        self._began, self._is_counted = perf_counter(), True
        asyncio.get_running_loop().call_soon(self._end_pass)

    def _end_pass(self) -> None:
        """Let one request that waits begin in the next pass."""
        self._is_counted = False
        if self._waiting:
            self._begin_pass()
        while self._waiting:
            turn = self._waiting.take()
            if not turn.done():  # else it was given up
                turn.set_result(None)
                return
