"""Lets nobody but the service itself into the ports on which viser serves scenes.

Viser takes commands from all that connect, and every user of a machine reaches its ports. With this
each connection must show a secret at its handshake, which browsers cannot.
"""

import secrets
from collections.abc import Callable
from functools import cache
from http import HTTPStatus
from types import SimpleNamespace
from typing import Any

HEADER = "Relguide-Scene"
"""Shows the secret."""
SECRET = secrets.token_urlsafe(32)
"""Of this process, which serves scenes and relays them."""


@cache
def guard_viser() -> None:
    """Have viser's servers ask for the secret from now on; what they are built on does it."""
    import websockets.datastructures
    import websockets.exceptions
    from viser.infra import _infra
    from websockets.asyncio.server import ServerConnection, serve
    from websockets.http11 import Request, Response

    def serve_guarded(
        *arguments: Any,
        process_request: Callable[[ServerConnection, Request], Response | None],
        **options: Any,
    ) -> serve:
        def admit(connection: ServerConnection, request: Request) -> Response | None:
            shown = "".join(request.headers.get_all(HEADER))
            if not secrets.compare_digest(shown.encode(), SECRET.encode()):
                return connection.respond(HTTPStatus.FORBIDDEN, "This port is not for you.\n")
            return process_request(connection, request)

        return serve(*arguments, process_request=admit, **options)

    _infra.websockets = SimpleNamespace(  # type: ignore[assignment,attr-defined]
        asyncio=SimpleNamespace(server=SimpleNamespace(serve=serve_guarded)),
        datastructures=websockets.datastructures,
        exceptions=websockets.exceptions,
    )
