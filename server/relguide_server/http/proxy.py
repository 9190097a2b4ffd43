"""The path below which a proxy serves the service, and the proxies that are believed.

A proxy may strip its path from what it passes on, or leave it there: both are understood. Every
address that the service gives of itself begins with it (`root_of`), and what the service looks at
is the path below it (`path_of`), as ASGI's `root_path` and `path` say.
"""

from collections.abc import Callable
from ipaddress import IPv4Network, IPv6Network, ip_address, ip_network

from starlette.responses import RedirectResponse
from starlette.types import ASGIApp, Receive, Scope, Send

from relguide_server.settings import PATH


class ProxyPath:
    """ASGI middleware: makes `root_path` and `path` what ASGI says, however a proxy passes them."""

    def __init__(self, app: ASGIApp, *, root_path: str, proxies: str) -> None:
        self.app = app
        self.root_path = root_path
        self.believes = believed(proxies)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one connection."""
        if scope["type"] not in ("http", "websocket"):
            await self.app(scope, receive, send)
            return
        path, root = scope["path"], self._said(scope)
        stripped = root is not None
        root = self.root_path if root is None else root
        if scope["type"] == "http" and root and path == root and not stripped:
            # addresses in the page are relative to its own
            query = scope["query_string"].decode("latin-1")
            where = f"{root}/?{query}" if query else f"{root}/"
            await RedirectResponse(where, 308)(scope, receive, send)
            return
        if stripped or not path.startswith(f"{root}/"):
            path = root + path
        await self.app({**scope, "root_path": root, "path": path}, receive, send)

    def _said(self, scope: Scope) -> str | None:
        """What a proxy has stripped, if one that is believed says so."""
        said = header_of(scope, b"x-forwarded-prefix")
        if said is None or not self.believes((scope.get("client") or ("",))[0]):
            return None
        said = said.rstrip("/")
        return said if PATH.fullmatch(said) else None


def believed(proxies: str) -> Callable[[str], bool]:
    """What says of an address whether it is a proxy that is believed.

    Args:
        proxies: as the setting has them; `*` for all.
    """
    anybody, networks = "*" in proxies, read_networks(proxies.replace("*", ""))

    def is_believed(host: str) -> bool:
        try:
            address = ip_address(host)
        except ValueError:
            return anybody
        return anybody or any(address in network for network in networks)

    return is_believed


def read_networks(text: str) -> list[IPv4Network | IPv6Network]:
    """Addresses and networks, with commas between.

    Raises:
        ValueError: if one is neither.
    """
    return [ip_network(part.strip(), strict=False) for part in text.split(",") if part.strip()]


def header_of(scope: Scope, name: bytes) -> str | None:
    """The first header of a name, in small letters; `None` if there is none."""
    for known, value in scope["headers"]:
        if known == name:
            said: str = value.decode("latin-1")
            return said
    return None


def root_of(scope: Scope) -> str:
    """The path below which the service was asked; empty at the root."""
    root: str = scope.get("root_path", "")
    return root


def path_of(scope: Scope) -> str:
    """The path that was asked for, below `root_of`."""
    path: str = scope["path"]
    return path.removeprefix(root_of(scope)) if root_of(scope) else path
