"""Who may ask: the names this server answers to, the pages that may command it, and tokens.

- A page of another site can make a browser send requests here. It cannot hide its `Origin`, which
  is refused wherever something is changed or streamed. By rebinding a name of its own to this
  machine it could hide that as well, so only names known here are answered; an address is no name.
- Programs send no `Origin`. With tokens, they and browsers must show one (`Authorization: Bearer`,
  or the cookie that `/?token=…` sets). Without tokens, who asks from another machine is a guest.
"""

import re
import secrets
from collections.abc import Mapping, Sequence
from hashlib import sha256
from http.cookies import CookieError, SimpleCookie
from ipaddress import ip_address
from typing import Literal, get_args
from urllib.parse import parse_qs, urlsplit

from starlette.datastructures import Headers
from starlette.requests import HTTPConnection
from starlette.responses import RedirectResponse, Response
from starlette.types import ASGIApp, Receive, Scope, Send

from relguide_server.http.errors import Refusal, problem
from relguide_server.http.proxy import header_of, path_of, root_of

Role = Literal["view", "fly", "atc", "control"]
"""What a token is for."""
Power = Literal["read", "fly", "answer", "picture", "command_all"]
"""`read`: read, plan and watch; `fly`: start flights, and command and end one's own; `answer`:
answer clearances; `picture`: say what traffic and airspace there is; `command_all`: command and end
every flight, and remove records."""
ROLES: tuple[Role, ...] = get_args(Role)
MAY: dict[str, tuple[Power, ...]] = {
    "view": ("read",),
    "fly": ("read", "fly"),
    "atc": ("read", "answer", "picture"),
    "control": get_args(Power),
    "guest": ("read", "fly", "answer"),
}
"""What each role may. A guest has no token where there are none, and asks, or can, from another
machine: it answers for its own flights alone (`may_answer`)."""
SHORTEST = 16
"""Characters of a token, at least."""
COOKIE = "relguide_token"
SAFE = ("GET", "HEAD", "OPTIONS")
PAGES = ("/", "/atc")
"""Opened with `?token=…`, they are given the cookie."""
OPEN = ("/healthz", "/readyz")
"""Answered without a token."""
CALCULATIONS = ("/api/v1/plans", "/api/v1/areas", "/api/v1/simulations")
"""What changes nothing, though it is posted."""
CLEARANCES = "/api/v1/clearances"
NEEDED: tuple[tuple[str, str, Power], ...] = (
    ("POST", rf"({'|'.join(CALCULATIONS)})(/.*)?", "read"),
    ("POST", rf"{CLEARANCES}/[^/]+/answers", "answer"),
    ("DELETE", r"/api/v1/records/.*", "command_all"),
    (".+", r"/api/v1/(traffic|airspaces|feeds)(/.*)?", "picture"),
    (".+", ".*", "fly"),
)
"""By method and path, what a request needs that is not safe: the first that fits."""
UNKNOWN_HOST = (
    "This server does not answer for the name {name!r}. If it is its name, start it with "
    "RELGUIDE_HOSTS={name}."
)
FOREIGN = "A page of {origin} may not do this: only pages of this server may."
NO_TOKEN = "This needs a token: send Authorization: Bearer …, or open /?token=… in a browser."
UNKNOWN_TOKEN = "This token is not one of the service's: ask whoever runs it for one."
NOT_YOURS = "This flight is another's: only who started it commands it."
NOT_YOUR_GUEST = f"{NOT_YOURS} RELGUIDE_OPEN_CONTROL=on lets everybody."
TOO_LITTLE = "This needs a token of {allowed}, not one of {role}."
GUEST = (
    "This service is open to other machines and has no tokens, so nobody may do this: "
    "RELGUIDE_TOKENS says who may, RELGUIDE_OPEN_CONTROL=on lets everybody."
)


class HostNames:
    """The names that this server answers for."""

    def __init__(self, hosts: Sequence[str]) -> None:
        """Take those of the settings; addresses and `localhost` are always among them."""
        self._hosts = frozenset(name.lower() for name in hosts)
        self._last = "localhost"
        """The last `Host` that was one of them: most requests name the same."""

    def include(self, host: str) -> bool:
        """Whether a `Host` is one of them."""
        if host != self._last:
            if not self._looked_up(host):
                return False
            self._last = host
        return True

    def _looked_up(self, host: str) -> bool:
        name = _name(host)
        if name == "localhost" or name.endswith(".localhost") or "*" in self._hosts:
            return True
        return name in self._hosts or _is_address(name)


class Access:
    """ASGI middleware: refuses unknown hosts, foreign pages, and who may not do what it asks for.

    Who asks is noted in the scope, for `owner_of`.
    """

    def __init__(
        self,
        app: ASGIApp,
        *,
        hosts: Sequence[str],
        tokens: Mapping[str, Role],
        open_control: bool,
        exposed: bool,
    ) -> None:
        """Take the settings.

        Args:
            app: what is asked by who may.
            hosts: names that this server answers for.
            tokens: each with its role; if there are none, nobody needs one.
            open_control: whether everybody may do everything then, from other machines as well.
            exposed: whether the service listens to other machines.
        """
        self.app = app
        self.names = HostNames(hosts)
        self.tokens = tokens
        self.open_control, self.exposed = open_control, exposed

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one connection."""
        if scope["type"] not in ("http", "websocket"):
            await self.app(scope, receive, send)
            return
        answer = self._judge(scope)
        if answer is None:
            await self.app(scope, receive, send)
        elif scope["type"] == "http":
            await answer(scope, receive, send)
        elif "websocket.http.response" in scope.get("extensions", {}):
            await receive()  # what asks to be accepted
            await answer(scope, receive, send)
        else:
            await receive()
            await send({"type": "websocket.close", "code": 1008, "reason": ""})

    def _judge(self, scope: Scope) -> Response | None:
        """The answer that refuses; `None` for what may pass."""
        host = header_of(scope, b"host") or ""
        if not self.names.include(host):
            return _refuse(scope, 421, UNKNOWN_HOST.format(name=_name(host)[:100]))
        origin = header_of(scope, b"origin")
        changes = scope["type"] == "websocket" or scope["method"] not in SAFE
        if changes and origin is not None and not self._is_own_page(origin, host):
            return _refuse(scope, 403, FOREIGN.format(origin=origin[:100]), kind="foreign-page")
        if path_of(scope) in OPEN:
            return None
        if self.tokens:
            return self._judge_token(scope, Headers(scope=scope))
        address = (scope.get("client") or ("127.0.0.1",))[0]  # none: a socket of this machine
        if self.open_control or not (self.exposed or not is_loopback(address)):
            return None
        _note(scope, "guest", f"address {address}")
        return None if _needed(scope) in MAY["guest"] else _refuse(scope, 403, GUEST)

    def _is_own_page(self, origin: str, host: str) -> bool:
        try:
            parts = urlsplit(origin)
            return parts.scheme in ("http", "https") and parts.netloc.lower() == host.lower()
        except ValueError:
            return False

    def _judge_token(self, scope: Scope, headers: Headers) -> Response | None:
        path = path_of(scope)
        if path in PAGES and scope["type"] == "http":
            shown = parse_qs(scope["query_string"].decode("latin-1")).get("token", [""])[0]
            if self._role(shown) is not None:
                return _remember(shown, scope)
        token = _token(headers)
        role = self._role(token)
        if role is None:
            why = UNKNOWN_TOKEN if token else NO_TOKEN
            return _refuse(scope, 401, why, headers={"WWW-Authenticate": "Bearer"})
        needed = _needed(scope)
        if needed not in MAY[role]:
            allowed = " or ".join(one for one in ROLES if needed in MAY[one])
            return _refuse(scope, 403, TOO_LITTLE.format(role=role, allowed=allowed))
        shown = sha256(token.encode()).hexdigest()
        _note(scope, role, "" if "command_all" in MAY[role] else shown)
        scope["state"]["token"] = shown  # for `client_of`
        return None

    def _role(self, token: str) -> Role | None:
        found: Role | None = None
        for known, role in self.tokens.items():  # all of them, so that time tells nothing
            if secrets.compare_digest(known.encode(), token.encode()):
                found = role
        return found


def _refuse(
    scope: Scope,
    status: int,
    detail: str,
    *,
    kind: str = "",
    headers: dict[str, str] | None = None,
) -> Response:
    return problem(scope["path"], status, detail, kind=kind, root=root_of(scope), headers=headers)


def _note(scope: Scope, role: str, owner: str) -> None:
    scope.setdefault("state", {})
    scope["state"]["role"], scope["state"]["owner"] = role, owner


def role_of(connection: HTTPConnection) -> str:
    """The role of who asks, of `MAY`."""
    role: str = getattr(connection.state, "role", "control")
    return role


def owner_of(connection: HTTPConnection) -> str:
    """Who asks, as flights note their owners; empty for who may command all of them."""
    owner: str = getattr(connection.state, "owner", "")
    return owner


def may_command(connection: HTTPConnection, owner: str) -> bool:
    """Whether who asks may command a flight of that owner."""
    return owner_of(connection) in ("", owner)


def may_answer(connection: HTTPConnection, owner: str) -> bool:
    """Whether who asks may answer, as its controller, a flight of that owner."""
    role = role_of(connection)
    return "answer" in MAY[role] and (role != "guest" or owner_of(connection) == owner)


def expect_owner(connection: HTTPConnection, owner: str) -> None:
    """Refuse who is not the owner of a flight.

    Raises:
        Refusal: 403.
    """
    if not may_command(connection, owner):
        raise Refusal(403, NOT_YOUR_GUEST if role_of(connection) == "guest" else NOT_YOURS)


def read_tokens(text: str) -> dict[str, Role]:
    """Tokens from their setting, `view:abc,fly:def`.

    Raises:
        ValueError: if a part is no role and a token of 16 characters or more.
    """
    tokens: dict[str, Role] = {}
    for part in filter(None, text.split(",")):
        name, _, token = part.strip().partition(":")
        role = next((role for role in ROLES if role == name), None)
        if role is None or len(token) < SHORTEST:
            raise ValueError(
                f"tokens must be a list such as {','.join(f'{role}:TOKEN' for role in ROLES)}, "
                f"each TOKEN of {SHORTEST} characters or more."
            )
        tokens[token] = role
    return tokens


def _needed(scope: Scope) -> Power:
    if scope["type"] == "websocket" or scope["method"] in SAFE:
        return "read"
    path = path_of(scope)
    if path == CLEARANCES:
        query = parse_qs(scope["query_string"].decode("latin-1"))
        if query.get("dry_run") == ["true"]:
            return "read"  # a trial, of which nothing is kept
    asked = f"{scope['method']} {path}"
    return next(power for asking, power in _NEEDED if asking.fullmatch(asked))


_NEEDED = [(re.compile(f"{m} {path}", re.DOTALL), power) for m, path, power in NEEDED]


def _token(headers: Headers) -> str:
    scheme, _, token = headers.get("authorization", "").partition(" ")
    if scheme.lower() == "bearer":
        return token.strip()
    try:
        cookie = SimpleCookie(headers.get("cookie", "")).get(COOKIE)
    except CookieError:
        return ""
    return cookie.value if cookie else ""


def _remember(token: str, scope: Scope) -> Response:
    """The page without the token in its address, which a browser's history would keep.

    What was kept over https, browsers send over https alone.
    """
    root, safe = root_of(scope), scope["scheme"] == "https"
    answer = RedirectResponse(root + path_of(scope), 303)
    answer.set_cookie(COOKIE, token, path=f"{root}/", secure=safe, httponly=True, samesite="strict")
    return answer


def _name(host: str) -> str:
    """The name in a `Host`, without the port."""
    if host.startswith("["):
        return host[1:].partition("]")[0].lower()
    return host.rpartition(":")[0].lower() if ":" in host else host.lower()


def _is_address(name: str) -> bool:
    try:
        ip_address(name)
    except ValueError:
        return False
    return True


def is_loopback(host: str) -> bool:
    """Whether a host is this machine, which others cannot ask there: an address or `localhost`."""
    if not _is_address(host):
        return host == "localhost"
    address = ip_address(host)
    return (getattr(address, "ipv4_mapped", None) or address).is_loopback
