"""`Idempotency-Key`: a request that is sent again is answered as the first time, not done again.

A router whose `route_class` is `IdempotentRoute` takes the header on each POST. A request with the
same client, key, address and body waits for the first where that is still being worked on.
"""

import asyncio
from collections.abc import Callable, Coroutine
from contextlib import suppress
from functools import partial
from hashlib import sha256
from re import compile as pattern
from typing import Any

from fastapi import Request
from fastapi.routing import APIRoute
from starlette.datastructures import Headers
from starlette.exceptions import HTTPException
from starlette.requests import ClientDisconnect
from starlette.responses import Response
from starlette.types import Message, Scope

from relguide_server.http.access import owner_of
from relguide_server.http.bodies import FLIGHTS, JSON, address_of, read_body, unless_left
from relguide_server.http.errors import Refusal, answer_left, answer_refusal, log
from relguide_server.http.kept_answers import Answer, Asked, KeptAnswers

HEADER = "Idempotency-Key"
LONGEST = 255
"""Of a key [characters]."""
SOUND = r"^[!-~]([ -~]*[!-~])?$"
"""What a key must be: printable, without a space at either end."""
WRONG_KEY = f"{HEADER} must have 1 to {LONGEST} printable characters of ASCII, and be sent once."
REUSED = (
    f"This {HEADER} came with another request, {{first}}, whose body or address differs: a new "
    "request needs a key of its own."
)
TRY_AGAIN = (408, 429)
"""What is refused for now is not kept, nor are mistakes: the next try may succeed."""

_sound = pattern(SOUND)
Handler = Callable[[Request], Coroutine[Any, Any, Response]]
"""Answers a request, as the framework has it."""


class Work:
    """A request that is being worked on, for all clients that wait for its answer."""

    def __init__(self, asked: Asked, handler: Handler, scope: Scope, body: bytes) -> None:
        self.asked = asked
        self.given_up = False
        """Whether it was told that nobody waits for it any more, and gave up."""
        self._body: bytes | None = body
        self._waiting = 0
        self._alone = asyncio.Event()
        self.task = asyncio.create_task(self._do(handler, Request(scope, self._receive)))

    @property
    def deserted(self) -> bool:
        """Whether nobody waits for it now."""
        return self._alone.is_set()

    async def wait(self, request: Request) -> Answer:
        """Its answer.

        Raises:
            ClientDisconnect: if the client that waits has left.
        """
        self._waiting += 1
        self._alone.clear()
        try:
            return await unless_left(request, asyncio.shield(self.task))
        finally:
            self._waiting -= 1
            if not self._waiting:
                self._alone.set()

    async def _do(self, handler: Handler, request: Request) -> Answer:
        try:
            response = await handler(request)
        except HTTPException as refused:
            response = answer_refusal(request, refused)
        except ClientDisconnect:
            response = answer_left(request)
        return Answer(response.status_code, response.raw_headers, bytes(response.body))

    async def _receive(self) -> Message:
        if self._body is not None:
            body, self._body = self._body, None
            return {"type": "http.request", "body": body, "more_body": False}
        await self._alone.wait()
        self.given_up = True
        return {"type": "http.disconnect"}


class Idempotency:
    """Does each request once. Lives on the event loop."""

    def __init__(self, kept: KeptAnswers | None = None) -> None:
        self.kept = kept or KeptAnswers()
        self._working: dict[tuple[str, str], Work] = {}

    async def stop(self) -> None:
        """End what is still being worked on, though nobody waits for it."""
        tasks = [work.task for work in self._working.values()]
        for task in tasks:
            task.cancel()
        for task in tasks:
            with suppress(asyncio.CancelledError):
                await task

    async def answer(self, request: Request, key: str, body: bytes, handler: Handler) -> Response:
        """The answer to a request: that of the first one with this key.

        Args:
            request: whose body has been read.
            key: which it brought.
            body: its own.
            handler: answers it.

        Raises:
            Refusal: 422, if the key came with another request.
            ClientDisconnect: if the client left.
        """
        client = owner_of(request) or address_of(request)
        query = request.scope["query_string"].decode("latin-1")
        line = f"{request.method} {request.url.path}{'?' if query else ''}{query}"
        asked = Asked(line, sha256(body).digest())
        while True:
            kept, work = self.kept.get(client, key), self._working.get((client, key))
            if (before := kept or work) is not None and before.asked != asked:
                raise Refusal(422, REUSED.format(first=before.asked.line[:200]), kind="key-reused")
            if kept is not None:
                return kept.answer.sent(again=True)
            if first := work is None:
                work = self._working[client, key] = Work(asked, handler, request.scope, body)
                work.task.add_done_callback(partial(self._done, client, key))
            found = await work.wait(request)
            if not work.given_up:
                return found.sent(again=not first)

    def _done(self, client: str, key: str, task: "asyncio.Task[Answer]") -> None:
        work = self._working.pop((client, key))
        if task.cancelled() or work.given_up:
            return
        if (mistake := task.exception()) is not None:
            if work.deserted:
                log.error("%s, whose client has left", work.asked.line, exc_info=mistake)
            return
        answer = task.result()
        if answer.status < 500 and answer.status not in TRY_AGAIN:
            self.kept.put(client, key, work.asked, answer)


class IdempotentRoute(APIRoute):
    """A route that takes `Idempotency-Key`, if it takes POST."""

    def get_route_handler(self) -> Handler:
        """What answers a request."""
        plain = super().get_route_handler()
        if "POST" not in (self.methods or ()):
            return plain

        async def answer(request: Request) -> Response:
            key = _key_of(request.headers)
            if key is None:
                return await plain(request)
            body = await read_body(request, JSON, most=FLIGHTS)  # its route may take less
            idempotency: Idempotency = request.app.state.idempotency
            return await idempotency.answer(request, key, body, plain)

        return answer


def _key_of(headers: Headers) -> str | None:
    """The key that a request brings.

    Raises:
        Refusal: 422, if it is none.
    """
    given = headers.getlist(HEADER)
    if not given:
        return None
    if len(given) > 1 or len(given[0]) > LONGEST or not _sound.fullmatch(given[0]):
        raise Refusal(422, WRONG_KEY)
    return given[0]
