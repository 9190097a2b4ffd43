"""Files that a build made: read once, packed, named by a tag, and answered with."""

import gzip
import mimetypes
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

from starlette.datastructures import Headers
from starlette.responses import Response

from relguide_server.http.etags import ASK_AGAIN, has, tag_of

FOR_EVER = "public, max-age=31536000, immutable"
WORTH_PACKING = 1024
"""Smaller files [bytes] are not compressed."""
PACKED = ("text/", "application/json", "application/javascript", "image/svg+xml")


@dataclass(frozen=True, slots=True, kw_only=True)
class BuiltFile:
    """A file, ready to be sent."""

    body: bytes
    packed: bytes
    """The same, gzipped; empty if that is not worth it."""
    media_type: str
    tag: str
    cache: str
    for_all: bool
    """Whether pages of other sites may load it."""


def read(path: Path) -> BuiltFile:
    """Read a file and pack it."""
    body = path.read_bytes()
    media_type = mimetypes.guess_type(path.name)[0] or "application/octet-stream"
    pack = len(body) > WORTH_PACKING and media_type.startswith(PACKED)
    return BuiltFile(
        body=body,
        packed=gzip.compress(body, 9) if pack else b"",
        media_type=media_type,
        tag=tag_of(body),
        # Vite writes the hash of the content into the names of what it puts into assets/.
        cache=FOR_EVER if path.parent.name == "assets" else ASK_AGAIN,
        for_all=path.parent.name == "embed",
    )


def answer(
    file: BuiltFile, request: Headers, *, more: Mapping[str, str] = MappingProxyType({})
) -> Response:
    """The file, or 304 to a client that has it.

    Args:
        file: to send.
        request: headers of the request.
        more: further headers of the answer.
    """
    headers = {"ETag": file.tag, "Cache-Control": file.cache, "Vary": "Accept-Encoding", **more}
    if file.for_all:
        headers["Access-Control-Allow-Origin"] = "*"
    if has(request, file.tag):
        return Response(status_code=304, headers=headers)
    if file.packed and "gzip" in request.get("accept-encoding", ""):
        headers["Content-Encoding"] = "gzip"
        return Response(file.packed, headers=headers, media_type=file.media_type)
    return Response(file.body, headers=headers, media_type=file.media_type)
