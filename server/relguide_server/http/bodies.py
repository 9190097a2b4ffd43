"""Bodies in and out by the contract's own reader.

The contract reads the bytes itself, so REST, command line and files refuse with the same words.
"""

import asyncio
from collections.abc import Awaitable, Callable
from contextlib import nullcontext
from typing import TypeVar

import orjson
from fastapi import Request
from starlette.requests import ClientDisconnect
from starlette.responses import Response

from relguide.contract.refusal import ContractError, loads
from relguide_server.http.errors import Refusal, refusal_of
from relguide_server.http.proxy import header_of

T = TypeVar("T")
SMALL = 16 * 1024
"""Bodies of at most so many bytes are read on the event loop: some milliseconds, whatever they
hold."""
FLIGHTS = 3 * 1024 * 1024
"""Most bytes of a request for flights: as many sticks as one may have, with all their digits."""
BODY_PATIENCE = 15.0
"""How long a body may take to come [s]."""
STOPPING = "The service is stopping, and waits for the rest of the body no longer."
PACKED = "Packed bodies are not unpacked here: send it as it is, without Content-Encoding."
JSON = "application/json"
GEOJSON = "application/geo+json"


class Bodies:
    """Bodies that are still to come. Lives on the event loop."""

    def __init__(self) -> None:
        self.coming: set[asyncio.Timeout] = set()
        self.stopped = False
        self.reading = asyncio.Lock()
        """Held while a long one is read: each takes memory and a second of a core."""

    def stop(self) -> None:
        """Wait for none of them any more."""
        self.stopped = True
        now = asyncio.get_running_loop().time()
        for patience in self.coming:
            patience.reschedule(now)


async def read_body(request: Request, *types: str, most: int = SMALL) -> bytes:
    """The body of a request.

    Args:
        request: of a route.
        types: what it may be declared to be.
        most: how long it may be [bytes].

    Raises:
        Refusal: 415, if it is declared to be something else, or packed; 413, if it is longer; 408,
            if it does not come; 503, if the service stops before it has come.
    """
    # A page of another site can send most other types without the browser's permission.
    if content_type(request) not in types:
        raise Refusal(415, f"The body must be sent with Content-Type: {' or '.join(types)}.")
    packed = header_of(request.scope, b"content-encoding")
    if packed is not None and packed.strip().lower() != "identity":
        raise Refusal(415, PACKED)
    declared = header_of(request.scope, b"content-length") or "0"
    if declared.isdecimal() and int(declared) > most:
        raise _too_long(most)
    parts, size, more = [], 0, True
    bodies: Bodies = request.app.state.bodies
    patience = asyncio.timeout(0.0 if bodies.stopped else BODY_PATIENCE)
    bodies.coming.add(patience)
    try:
        async with patience:
            while more:
                message = await request.receive()
                if message["type"] == "http.disconnect":
                    raise ClientDisconnect
                part = message.get("body", b"")
                more = message.get("more_body", False)
                size += len(part)
                if size > most:
                    raise _too_long(most)
                parts.append(part)
    except TimeoutError:
        if bodies.stopped:
            again = {"Retry-After": "5", "Connection": "close"}
            raise Refusal(503, STOPPING, kind="stopping", headers=again) from None
        late = f"The body did not come within {BODY_PATIENCE:.0f} s."
        raise Refusal(408, late, headers={"Connection": "close"}) from None
    finally:
        bodies.coming.discard(patience)
    return parts[0] if len(parts) == 1 else b"".join(parts)


def _too_long(most: int) -> Refusal:
    detail = f"The body of this request may have at most {most:,} bytes."
    return Refusal(413, detail, headers={"Connection": "close"})


async def unless_left(request: Request, work: Awaitable[T]) -> T:
    """What some work gives, whose request has been read; it is cancelled if the client leaves.

    Raises:
        ClientDisconnect: if the client left.
    """
    working, is_over, has_left = asyncio.current_task(), False, False
    assert working is not None

    def leave(leaving: "asyncio.Task[None]") -> None:
        nonlocal has_left
        if not is_over and not leaving.cancelled():
            has_left = True
            working.cancel()

    leaving = asyncio.create_task(_wait_until_left(request))
    leaving.add_done_callback(leave)
    try:
        return await work
    except asyncio.CancelledError:
        if has_left and working.uncancel() == 0:
            raise ClientDisconnect from None
        raise
    finally:
        is_over = True
        leaving.cancel()


async def _wait_until_left(request: Request) -> None:
    while (await request.receive())["type"] != "http.disconnect":
        pass


def address_of(request: Request) -> str:
    """Address of the client; empty if it is not known."""
    client: tuple[str, int] | None = request.scope.get("client")
    return client[0][:255] if client else ""


def content_type(request: Request) -> str:
    """The declared type of a body, without parameters."""
    declared = header_of(request.scope, b"content-type") or ""
    return declared.partition(";")[0].strip().lower()


def parse_json(body: bytes) -> object:
    """The content of a body.

    Raises:
        Refusal: if it is no JSON.
    """
    try:
        return loads(body)
    except ContractError as error:
        raise refusal_of(error, 400) from None


async def read_flights(request: Request, work: Callable[[object], T]) -> T:
    """What some work makes of the content of a request for flights, one body at a time.

    An hour of flying by hand takes a second to read: that is done by a thread.

    Args:
        request: of a route.
        work: is given the content.

    Raises:
        Refusal: if it is not declared to be JSON, or is no JSON; or what the work raises.
    """
    body = await read_body(request, JSON, most=FLIGHTS)
    bodies: Bodies = request.app.state.bodies
    async with bodies.reading if len(body) > SMALL else nullcontext():
        return await asyncio.to_thread(lambda: work(parse_json(body)))


async def read_object(request: Request) -> dict[str, object]:
    """The body of a request, for a route that takes a small object.

    Raises:
        Refusal: if it is not declared to be JSON, or is no JSON.
        ContractError: if it is no object.
    """
    return expect_object(parse_json(await read_body(request, JSON)))


def expect_object(content: object) -> dict[str, object]:
    """The content of a body that is an object.

    Raises:
        ContractError: if it is none.
    """
    if isinstance(content, dict):
        return content
    raise ContractError([("", "The body must be an object with fields.")])


def json_answer(
    content: object,
    status: int = 200,
    *,
    headers: dict[str, str] | None = None,
    media_type: str = JSON,
) -> Response:
    """An answer in JSON; content that is already encoded goes out as it is."""
    body = content if isinstance(content, bytes) else orjson.dumps(content)
    return Response(body, status, headers, media_type=media_type)
