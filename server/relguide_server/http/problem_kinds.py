"""Kinds of problems: what the `type` of a problem document names, and what is to be done."""

from typing import NamedTuple


class Kind(NamedTuple):
    """A kind of problem."""

    status: int
    title: str
    advice: str
    """What it means, and what helps."""


KINDS = {
    "not-json": Kind(400, "Not JSON", "The body is no JSON. `errors` says where it ends to be."),
    "not-http": Kind(400, "Not HTTP", "What came is no request of HTTP/1.1, or is too long."),
    "token-missing": Kind(
        401, "Token missing or unknown", "This server asks for a token: `Authorization: Bearer …`."
    ),
    "not-allowed": Kind(
        403, "Not allowed", "The token may less than this, or the flight is another's."
    ),
    "foreign-page": Kind(
        403, "Foreign page", "A page of another site asked. Only pages of this server may."
    ),
    "not-found": Kind(404, "Not found", "There is nothing at this address, or it was removed."),
    "wrong-method": Kind(405, "Wrong method", "The address takes other methods: see `Allow`."),
    "body-late": Kind(408, "Body too slow", "The body did not come in time: send it at once."),
    "conflict": Kind(
        409, "Conflict", "What is asked does not fit what the flight or the record is doing now."
    ),
    "body-too-long": Kind(413, "Body too long", "`detail` says how long it may be."),
    "wrong-media-type": Kind(
        415, "Wrong media type", "`Content-Type` must be one of those that `detail` names."
    ),
    "unknown-host": Kind(
        421, "Unknown host", "The server does not answer for this name: see `RELGUIDE_HOSTS`."
    ),
    "invalid": Kind(
        422, "Invalid", "A field or parameter is wrong: `errors` has the path of each, and why."
    ),
    "unknown-parameter": Kind(
        422, "Unknown parameter", "The query has a parameter that the route does not have."
    ),
    "key-reused": Kind(
        422, "Key reused", "The `Idempotency-Key` came with another request: take a new one."
    ),
    "stream": Kind(426, "A stream", "The address is one of WebSocket: `ws://…`, see /docs/stream."),
    "too-many-flights": Kind(
        429, "Too many flights", "End a flight, or try again after `Retry-After` seconds."
    ),
    "too-many-clearances": Kind(
        429, "Too many clearances", "Cancel one, or wait until one is over."
    ),
    "too-many-sources": Kind(
        429, "Too many sources", "Take back what one of them said: `DELETE`, with its name."
    ),
    "mistake": Kind(
        500, "A mistake of the server", "Its log has the details, by the answer's `X-Request-ID`."
    ),
    "not-installed": Kind(501, "Not installed", "An extra is missing: `detail` names it."),
    "busy": Kind(
        503, "Busy", "Too much waits, or it took too long: try again after `Retry-After` seconds."
    ),
    "preparing": Kind(
        503, "Preparing", "The first start compiles: try again after `Retry-After` seconds."
    ),
    "stopping": Kind(503, "Stopping", "The service ends: it may be back in a moment."),
    "records-unavailable": Kind(
        503, "Records unavailable", "The database cannot be reached; plans and flights go on."
    ),
}
"""The first of a status is what is meant if nothing else is said."""
BY_STATUS = {kind.status: name for name, kind in reversed(KINDS.items())}
"""The first kind of each status."""
PAGE = "/docs/problems"
"""Where all kinds are listed, each under its name."""
