"""`ETag`: an answer names its content, and is not sent again to a client that has it."""

from collections.abc import Mapping
from hashlib import sha256
from types import MappingProxyType

import orjson
from starlette.datastructures import Headers
from starlette.requests import Request
from starlette.responses import Response

ASK_AGAIN = "no-cache"
"""`Cache-Control` of what has a tag and may change: kept, and asked for each time."""


def tag_of(content: bytes) -> str:
    """A strong tag: of other content it differs."""
    return f'"{sha256(content).hexdigest()[:20]}"'


def has(headers: Headers, tag: str) -> bool:
    """Whether a request says that its client has what a tag names."""
    said = ",".join(headers.getlist("if-none-match"))
    known = [part.strip().removeprefix("W/") for part in said.split(",")]
    return tag in known or "*" in known


def headers_of(tag: str) -> dict[str, str]:
    """The headers of an answer with a tag."""
    return {"ETag": tag, "Cache-Control": ASK_AGAIN}


def tagged_answer(
    request: Request, content: object, *, headers: Mapping[str, str] = MappingProxyType({})
) -> Response:
    """An answer in JSON with its tag, or 304 to a client that has it.

    Args:
        request: for it.
        content: of the answer, encoded already or not.
        headers: more of them.
    """
    body = content if isinstance(content, bytes) else orjson.dumps(content)
    tag = tag_of(body)
    all_headers = {**headers, **headers_of(tag)}
    if has(request.headers, tag):
        return Response(status_code=304, headers=all_headers)
    return Response(body, headers=all_headers, media_type="application/json")
