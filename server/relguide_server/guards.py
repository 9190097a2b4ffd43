"""What every request passes: a limit on its body, and headers that make a browser strict."""

from importlib.metadata import version

from starlette.datastructures import Headers
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from relguide_server.errors import Refusal, problem

VERSION = version("relguide")
"""Of the software; each answer says it."""
SECURITY_HEADERS = {
    b"x-content-type-options": b"nosniff",
    b"referrer-policy": b"no-referrer",
    # The cockpit embeds the 3D scene; nobody else embeds either.
    b"x-frame-options": b"SAMEORIGIN",
    b"content-security-policy": b"default-src 'self'; script-src 'self'; "
    b"style-src 'self' 'unsafe-inline'; img-src 'self' data:; frame-src 'self'; "
    b"frame-ancestors 'self'; base-uri 'self'; object-src 'none'; form-action 'self'",
    b"relguide-version": VERSION.encode(),
}


class StrictHeaders:
    """ASGI middleware: adds `SECURITY_HEADERS` to every answer that does not set its own."""

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one connection."""
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return

        async def send_strict(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = message.get("headers", [])
                own = {name for name, _ in headers}
                missing = [(k, v) for k, v in SECURITY_HEADERS.items() if k not in own]
                message["headers"] = [*headers, *missing]
            await send(message)

        await self.app(scope, receive, send_strict)


class BodyLimit:
    """ASGI middleware: answers 413 to a body above the limit, its size declared or not."""

    def __init__(self, app: ASGIApp, *, max_body: int) -> None:
        self.app = app
        self.max_body = max_body
        self.detail = f"A request body may have at most {max_body} bytes: send it in parts."

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one connection."""
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return
        declared = Headers(scope=scope).get("content-length", "0")
        if declared.isdecimal() and int(declared) > self.max_body:
            answer = problem(
                scope["path"],
                413,
                self.detail,
                root=scope.get("root_path", ""),
                headers={"Connection": "close"},
            )
            await answer(scope, receive, send)
            return
        seen = 0

        async def receive_limited() -> Message:
            nonlocal seen
            message = await receive()
            seen += len(message.get("body", b""))
            if seen > self.max_body:
                # Raised inside the route that reads the body, so the usual handler answers it.
                raise Refusal(413, self.detail, headers={"Connection": "close"})
            return message

        await self.app(scope, receive_limited, send)


class HeadAsGet:
    """ASGI middleware: answers HEAD as GET, without the body."""

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one connection."""
        if scope["type"] != "http" or scope["method"] != "HEAD":
            await self.app(scope, receive, send)
            return

        async def send_head(message: Message) -> None:
            if message["type"] == "http.response.body":
                message = {**message, "body": b""}
            await send(message)

        await self.app({**scope, "method": "GET"}, receive, send_head)
