"""A limit on the body of every request."""

from starlette.types import ASGIApp, Message, Receive, Scope, Send

from relguide_server.http.errors import Refusal, problem
from relguide_server.http.proxy import header_of


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
        declared = header_of(scope, b"content-length") or "0"
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
