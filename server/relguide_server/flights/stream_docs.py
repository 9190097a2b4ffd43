"""The sockets described: AsyncAPI at `/asyncapi.json`, and a page of it to read."""

from functools import cache
from html import escape
from typing import Any

from fastapi import APIRouter, Request
from pydantic.json_schema import models_json_schema
from starlette.responses import HTMLResponse, Response

from relguide.contract.messages import Tick
from relguide.contract.protocol import PROTOCOL, STREAM
from relguide_server.flights.stream import CLOSE_CODES
from relguide_server.http.bodies import json_answer
from relguide_server.http.page_style import STYLE, prose
from relguide_server.http.proxy import root_of
from relguide_server.http.security_headers import VERSION

DESCRIPTION = f"""A flight's stream sends a tick each twentieth of a second. The first holds a
snapshot: all that is needed to draw the flight so far. Clients only listen; a client that is slow
misses samples, and gets a snapshot where it missed more. Ask for the sub-protocol `{STREAM}`: under
this name fields are added, but none is taken away or changed. Names end with their unit. Headings
count clockwise from north of the plane in which x is east and y is north; of a flight whose
situation came with latitudes, each point has `lat_deg` and `lon_deg` as well, and that plane's
north is true north at the leader's first place."""
LISTEN = "What a flight does, as it does it."

router = APIRouter(include_in_schema=False)


@router.get("/asyncapi.json")
async def asyncapi(request: Request) -> Response:
    """The document, for programs."""
    host = request.headers.get("host", "localhost")
    scheme = "wss" if request.url.scheme == "https" else "ws"
    server = {"host": host, "protocol": scheme, "pathname": root_of(request.scope) or "/"}
    return json_answer({**asyncapi_document(), "servers": {"this": server}})


@router.get("/docs/stream")
async def stream_page(request: Request) -> HTMLResponse:
    """The same, to read."""
    return HTMLResponse(_page(root_of(request.scope)))


@cache
def asyncapi_document() -> dict[str, Any]:
    """The sockets in AsyncAPI 3, without the server's address."""
    _, schemas = models_json_schema(
        [(Tick, "validation")], ref_template="#/components/schemas/{model}"
    )
    codes = "\n".join(f"- {code}: {meaning}" for code, meaning in CLOSE_CODES.items())
    return {
        "asyncapi": "3.0.0",
        "info": {"title": "relguide", "version": VERSION, "description": DESCRIPTION},
        "defaultContentType": "application/json",
        "channels": {
            "stream": {
                "address": "/api/v1/flights/{flight_id}/stream",
                "title": "A flight's stream",
                "description": f"Closed with one of these codes, and a sentence:\n{codes}",
                "parameters": {"flight_id": {"description": "`id` of `POST /api/v1/flights`."}},
                "messages": {"tick": {"$ref": "#/components/messages/tick"}},
                "bindings": {
                    "ws": {
                        "method": "GET",
                        "headers": {
                            "type": "object",
                            "properties": {
                                "Sec-WebSocket-Protocol": {
                                    "type": "string",
                                    "enum": [STREAM, PROTOCOL],
                                }
                            },
                        },
                    }
                },
            }
        },
        "operations": {
            "watch": {
                "action": "send",
                "summary": LISTEN,
                "channel": {"$ref": "#/channels/stream"},
                "messages": [{"$ref": "#/channels/stream/messages/tick"}],
            }
        },
        "components": {
            "messages": {
                "tick": {
                    "name": "tick",
                    "title": "What happened since the last one",
                    "contentType": "application/json",
                    "payload": {"$ref": "#/components/schemas/Tick"},
                }
            },
            "schemas": schemas["$defs"],
        },
    }


def _page(root: str) -> str:
    document = asyncapi_document()
    schemas = document["components"]["schemas"]
    order = ["Tick", *sorted(name for name in schemas if name != "Tick")]
    parts = "".join(_section(name, schemas[name]) for name in order)
    codes = "".join(
        f"<tr><td><code>{code}</code><td>{escape(meaning)}" for code, meaning in CLOSE_CODES.items()
    )
    return (
        '<!doctype html><html lang="en"><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width"><title>relguide streams</title>'
        f"<style>{STYLE}</style><body><main><h1>relguide streams</h1>"
        f"<p>{prose(DESCRIPTION)}<p>"
        f'<a href="{root}/asyncapi.json">AsyncAPI</a> · <a href="{root}/docs">REST</a>'
        "<h2><code>/api/v1/flights/{flight_id}/stream</code></h2>"
        f"<p>{LISTEN} A WebSocket that sends a <a href='#Tick'>Tick</a> at a time."
        f"<table><caption>Why it is closed</caption>{codes}</table>{parts}</main>"
    )


def _section(name: str, schema: dict[str, Any]) -> str:
    needed = schema.get("required", ())
    rows = "".join(
        f"<tr><td><code>{escape(field)}</code><td>{_kind(about)}"
        f"<td>{'' if field in needed else 'if known. '}{prose(about.get('description', ''))}"
        for field, about in schema.get("properties", {}).items()
    )
    said = prose(schema.get("description", ""))
    return f'<h2 id="{name}">{name}</h2><p>{said}<table>{rows}</table>'


def _kind(about: dict[str, Any]) -> str:
    """A type as a person writes it."""
    match about:
        case {"$ref": str(reference)}:
            name = reference.rpartition("/")[2]
            return f'<a href="#{name}">{name}</a>'
        case {"const": value}:
            return f"<code>{escape(str(value))}</code>"
        case {"enum": values}:
            return " | ".join(f"<code>{escape(str(value))}</code>" for value in values)
        case {"type": "array", "items": items}:
            return f"list of {_kind(items)}"
        case {"oneOf": parts} | {"anyOf": parts}:
            return " | ".join(map(_kind, parts))
        case {"type": kind}:
            return escape(str(kind))
        case _:
            return "any"
