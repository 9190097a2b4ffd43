"""Express: the plainest of all requests, answered before anything else looks at it.

A program that posts a situation to `/api/v1/plans` sends a handful of headers, none of which says
anything that this service would have to judge: no page, no proxy, no token, no id. If the situation
is planned at once, what the layers of the app would add to the answer is known beforehand, and to
pass them all takes longer than to plan. Whatever is not as plain, is wrong, or takes a worker goes
on to them as it came.
"""

import asyncio
from logging import DEBUG
from random import getrandbits
from time import perf_counter

from starlette.types import ASGIApp, Message, Receive, Scope, Send

from relguide_server.http.access import HostNames
from relguide_server.http.bodies import JSON, SMALL
from relguide_server.http.errors import Refusal, log
from relguide_server.http.logs import request_id
from relguide_server.http.metrics import Metrics
from relguide_server.http.request_log import HEADER
from relguide_server.http.security_headers import SECURITY_HEADERS
from relguide_server.planning.plan_service import PlanService
from relguide_server.planning.plans import LOOKED, PATH, USUAL
from relguide_server.records.service import RecordsService

IDLE = frozenset(
    (b"user-agent", b"accept", b"accept-encoding", b"accept-language", b"connection")
)  # fmt: skip
"""Headers that change nothing."""
TYPE, HOST, LENGTH = b"content-type", b"host", b"content-length"
TYPES = (JSON.encode(), f"{JSON}; charset=utf-8".encode())
HEADERS = ((TYPE, JSON.encode()), *SECURITY_HEADERS.items())
SOON = 0.1
"""How long the body may take to come [s]: with the head, as programs send it."""


class FastPath:
    """ASGI middleware: plans what is plain and planned at once; everything else goes on."""

    def __init__(
        self,
        app: ASGIApp,
        *,
        names: HostNames | None,
        plan_service: PlanService,
        records: RecordsService,
        metrics: Metrics,
    ) -> None:
        """Put it before an app.

        Args:
            app: what everything else goes on to.
            names: of this server; `None` where more is asked of a request, a token.
            plan_service: plans.
            records: keeps plans.
            metrics: count requests.
        """
        self.app = app
        self._names, self._desk, self._keeper, self._metrics = names, plan_service, records, metrics

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one connection."""
        if not self._is_plain(scope):
            await self.app(scope, receive, send)
            return
        started = perf_counter()
        try:
            async with asyncio.timeout(SOON):
                message = await receive()
        except TimeoutError:
            await self.app(scope, receive, send)
            return
        name = f"{getrandbits(128):032x}"
        request_id.set(name)
        status = 500
        try:
            text = self._answer(scope, message)
            if text is None:
                status = 0
                await self.app(scope, _again(message, receive), send)
                return
            size = (LENGTH, str(len(text)).encode())
            headers = [*HEADERS, size, (HEADER, name.encode())]
            await send({"type": "http.response.start", "status": 200, "headers": headers})
            await send({"type": "http.response.body", "body": text})
            status = 200
        finally:
            if status:  # else the app has counted it
                self._metrics.count_request(PATH, "POST", status, perf_counter() - started)

    def _is_plain(self, scope: Scope) -> bool:
        """Whether nothing of a request has to be judged but its situation."""
        if (
            scope["type"] != "http"
            or scope["path"] != PATH
            or scope["method"] != "POST"
            or scope["query_string"]
            or self._names is None
            or log.isEnabledFor(DEBUG)
        ):
            return False
        host, kind = b"", b""
        for name, value in scope["headers"]:
            if name == HOST:
                host = value
            elif name == TYPE:
                kind = value
            elif name not in IDLE and name != LENGTH:
                return False
        return kind in TYPES and self._names.include(host.decode("latin-1"))

    def _answer(self, scope: Scope, message: Message) -> bytes | None:
        """The answer to a situation that has come whole; `None` if others have to find it."""
        if message["type"] != "http.request" or message.get("more_body"):
            return None
        body = message.get("body", b"")
        if len(body) > SMALL:
            return None
        address = scope.get("client")
        client = address[0] if address else ""
        try:
            answered = self._desk.answer_at_once(body, USUAL, client=client)
        except Refusal as refusal:
            scope[LOOKED] = refusal
            return None
        if answered is None:
            scope[LOOKED] = None
            return None
        self._keeper.note_plan(
            body, planner="", status=answered.status, seconds=answered.seconds, asked_by=client
        )
        return self._desk.count(answered)


def _again(message: Message, receive: Receive) -> Receive:
    """What receives a message again, and then what follows it."""
    taken = False

    async def receive_again() -> Message:
        nonlocal taken
        if taken:
            return await receive()
        taken = True
        return message

    return receive_again
