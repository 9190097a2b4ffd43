"""Headers that make a browser strict, on every answer."""

from importlib.metadata import version

from starlette.types import Message

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
_ALL = tuple(SECURITY_HEADERS.items())


def add_security_headers(message: Message) -> None:
    """Add to the start of an answer those of `SECURITY_HEADERS` that it does not set itself."""
    headers = message.get("headers", ())
    own = {name for name, _ in headers}
    missing = _ALL if own.isdisjoint(SECURITY_HEADERS) else [h for h in _ALL if h[0] not in own]
    message["headers"] = [*headers, *missing]
