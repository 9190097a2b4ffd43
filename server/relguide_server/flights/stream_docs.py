"""The sockets described: AsyncAPI at `/asyncapi.json`, and a page of it to read."""

from collections.abc import Iterable
from functools import cache
from html import escape
from typing import Any

from fastapi import APIRouter, Request
from pydantic import BaseModel
from pydantic.json_schema import GenerateJsonSchema, JsonSchemaValue, models_json_schema
from pydantic_core.core_schema import TaggedUnionSchema
from starlette.responses import HTMLResponse, Response

from relguide.contract.clearance_bodies import AtcFrame
from relguide.contract.messages import Tick
from relguide.contract.protocol import ATC_STREAM, PROTOCOL, STREAM
from relguide.contract.upstream import ControlAnswer, GiveBack, StickMove, TakeControl
from relguide_server.flights.control import MOST_RATE
from relguide_server.flights.frames import LONGEST, MOST
from relguide_server.flights.hands import SILENCE
from relguide_server.flights.stream import CLOSE_CODES
from relguide_server.http.etags import tagged_answer
from relguide_server.http.page_style import STYLE, prose
from relguide_server.http.proxy import root_of
from relguide_server.http.security_headers import VERSION

DESCRIPTION = f"""A flight's stream sends a tick each twentieth of a second. The first holds a
snapshot: all that is needed to draw the flight so far. A client that is slow misses samples, and
gets a snapshot where it missed more. Ask for the sub-protocol `{STREAM}`: under this name fields
are added, but none is taken away or changed. Names end with their unit. Headings count clockwise
from north of the plane in which x is east and y is north; of a flight whose situation came with
latitudes, each point has `lat_deg` and `lon_deg` as well, and that plane's north is true north at
the leader's first place. Clients need not send anything. Who may command the flight may fly it by
hand here, one client at a time, at a rate of {MOST_RATE:g} at most: it takes control, which it has
from the next second of flight on, and says where its stick is. Each step of the flight is then sent
at once. After {SILENCE:g} s without a frame the stick is neutral. When the client gives control
back or is gone, the autopilot flies again. A frame is JSON in text of {LONGEST} bytes at most, and
{MOST} of them may come a second."""
ATC_DESCRIPTION = f"""What happens at air traffic control's desk: clearances as they change, what is
found of them anew, deviations, and once a second the traffic of each sky. Ask for the sub-protocol
`{ATC_STREAM}`. Documents are numbered, and the numbers of a later start of the service are higher.
The first frame holds all that stands (`snapshot`), or, with the query `from`, all after that number
but traffic, if that is still known. While such a stream is open of who may answer, the automation
does not answer in the controller's place, unless the query says `answers=false`. Clients send
nothing."""
LISTEN = "What a flight does, as it does it."
FLY = "A crew flies it by hand."
OVERSEE = "What happens at air traffic control's desk."
SENT: dict[str, tuple[type[BaseModel], str]] = {
    "tick": (Tick, "What happened since the last one"),
    "control": (ControlAnswer, "What became of asking for control"),
}
HEARD: dict[str, tuple[type[BaseModel], str]] = {
    "take_control": (TakeControl, "Take control from the autopilot"),
    "stick": (StickMove, "Move the stick"),
    "give_back": (GiveBack, "Give control back"),
}
OVERSEEN: dict[str, tuple[type[BaseModel], str]] = {
    "atc": (AtcFrame, "What happened at the desk since the last one"),
}
"""Messages by name: their shape, and what they say."""
ALL = SENT | HEARD | OVERSEEN

ATC_QUERY = {
    "type": "object",
    "properties": {
        "from": {
            "type": "integer",
            "minimum": 0,
            "description": "Number of the first document that is wanted.",
        },
        "answers": {
            "type": "boolean",
            "description": "Whether a controller answers from here, who is not only to look on.",
        },
    },
}

router = APIRouter(include_in_schema=False)


class AsyncApiSchema(GenerateJsonSchema):
    """Schemas without `discriminator`, which AsyncAPI takes for the name of a parent's property.

    Each shape of a union has its kind as a constant, so the union says as much without it.
    """

    def tagged_union_schema(self, schema: TaggedUnionSchema) -> JsonSchemaValue:
        """Any of some shapes."""
        made = super().tagged_union_schema(schema)
        made.pop("discriminator", None)
        return made


@router.get("/asyncapi.json")
async def asyncapi(request: Request) -> Response:
    """The document, for programs."""
    host = request.headers.get("host", "localhost")
    scheme = "wss" if request.url.scheme == "https" else "ws"
    server = {"host": host, "protocol": scheme, "pathname": root_of(request.scope) or "/"}
    return tagged_answer(request, {**asyncapi_document(), "servers": {"this": server}})


@router.get("/docs/stream")
async def stream_page(request: Request) -> HTMLResponse:
    """The same, to read."""
    return HTMLResponse(_page(root_of(request.scope)))


@cache
def asyncapi_document() -> dict[str, Any]:
    """The sockets in AsyncAPI 3, without the server's address."""
    _, schemas = models_json_schema(
        [(shape, "validation") for shape, _ in ALL.values()],
        ref_template="#/components/schemas/{model}",
        schema_generator=AsyncApiSchema,
    )
    codes = "\n".join(f"- {code}: {meaning}" for code, meaning in CLOSE_CODES.items())
    return {
        "asyncapi": "3.1.0",
        "info": {"title": "relguide", "version": VERSION, "description": DESCRIPTION},
        "defaultContentType": "application/json",
        "channels": {
            "stream": {
                "address": "/api/v1/flights/{flight_id}/stream",
                "title": "A flight's stream",
                "description": f"Closed with one of these codes, and a sentence:\n{codes}",
                "parameters": {"flight_id": {"description": "`id` of `POST /api/v1/flights`."}},
                "messages": _references(SENT | HEARD),
                "bindings": {"ws": _binding(STREAM)},
            },
            "atc_stream": {
                "address": "/api/v1/atc/stream",
                "title": "The controllers' stream",
                "description": ATC_DESCRIPTION,
                "messages": _references(OVERSEEN),
                "bindings": {"ws": {**_binding(ATC_STREAM), "query": ATC_QUERY}},
            },
        },
        "operations": {
            "watch": _operation("send", LISTEN, SENT),
            "fly": _operation("receive", FLY, HEARD),
            "oversee": _operation("send", OVERSEE, OVERSEEN, channel="atc_stream"),
        },
        "components": {
            "messages": {
                name: {
                    "name": name,
                    "title": title,
                    "contentType": "application/json",
                    "payload": {"$ref": f"#/components/schemas/{shape.__name__}"},
                }
                for name, (shape, title) in ALL.items()
            },
            "schemas": schemas["$defs"],
        },
    }


def _references(messages: Iterable[str]) -> dict[str, Any]:
    return {name: {"$ref": f"#/components/messages/{name}"} for name in messages}


def _binding(protocol: str) -> dict[str, Any]:
    """How a socket is opened, by one of two sub-protocols."""
    names = {"Sec-WebSocket-Protocol": {"type": "string", "enum": [protocol, PROTOCOL]}}
    return {"method": "GET", "headers": {"type": "object", "properties": names}}


def _operation(
    action: str, summary: str, messages: Iterable[str], *, channel: str = "stream"
) -> dict[str, Any]:
    return {
        "action": action,
        "summary": summary,
        "channel": {"$ref": f"#/channels/{channel}"},
        "messages": [{"$ref": f"#/channels/{channel}/messages/{name}"} for name in messages],
    }


def _page(root: str) -> str:
    document = asyncapi_document()
    schemas = document["components"]["schemas"]
    first = [shape.__name__ for shape, _ in ALL.values()]
    order = [*first, *sorted(name for name in schemas if name not in first)]
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
        f"<p>{LISTEN} A WebSocket that sends {_links(SENT)} and hears {_links(HEARD)}."
        f"<table><caption>Why it is closed</caption>{codes}</table>"
        f"<h2><code>/api/v1/atc/stream</code></h2><p>{prose(ATC_DESCRIPTION)}"
        f"<p>A WebSocket that sends {_links(OVERSEEN)}.{parts}</main>"
    )


def _links(messages: dict[str, tuple[type[BaseModel], str]]) -> str:
    names = [shape.__name__ for shape, _ in messages.values()]
    return ", ".join(f"<a href='#{name}'>{name}</a>" for name in names)


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
