"""Headers that make a browser strict, on every answer."""

from importlib.metadata import version

from starlette.types import ASGIApp, Message, Receive, Scope, Send

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


class SecurityHeaders:
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
