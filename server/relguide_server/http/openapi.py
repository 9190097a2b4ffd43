"""The OpenAPI document: what a route takes and gives, and what is true of every answer.

A route names the model of each body, and the document holds the models that routes name. What every
request passes before its route, and every answer after it, stands here once. Examples of answers
are what the service sent (`emit_examples`).
"""

from collections.abc import Iterable, Iterator
from functools import cache
from importlib.resources import files
from typing import Any

import orjson
from fastapi import FastAPI, Request
from fastapi.openapi.utils import get_openapi
from fastapi.routing import APIRoute, iter_route_contexts
from pydantic import BaseModel
from pydantic.json_schema import models_json_schema
from starlette.responses import Response

from relguide_server.http.access import CALCULATIONS, OPEN, SAFE
from relguide_server.http.bodies import JSON
from relguide_server.http.errors import PROBLEM_JSON, Problem
from relguide_server.http.etags import tagged_answer
from relguide_server.http.idempotency import HEADER, LONGEST, SOUND, IdempotentRoute
from relguide_server.http.kept_answers import REPLAYED
from relguide_server.http.problem_kinds import KINDS, PAGE
from relguide_server.http.proxy import root_of
from relguide_server.http.query import refuse_unknown_parameters

EXAMPLES = "api_examples.json"
"""By operation, an answer to it."""
_SCHEMA, _HEADER = "#/components/schemas/{model}", "#/components/headers/{name}"
TAGS = {
    "plans": "Plans with their proof, of one situation or of many.",
    "areas": "How long it takes to converge, from all places round a leader.",
    "flights": "Flights that are watched and commanded, and flights flown to their end at once.",
    "clearances": "Manoeuvres that crews ask air traffic control for, and what becomes of them.",
    "picture": "Traffic and closed airspaces that others report.",
    "records": "What was flown and planned: to search, replay, export and remove.",
    "service": "Whether the service is well.",
}
BODY = ("not-json", "body-late", "body-too-long", "wrong-media-type", "invalid")
"""Problems of a route with a body."""
WORK = ("busy", "preparing", "stopping")
"""Problems of a route whose answer workers make, or that needs compiled kernels."""
HEADERS = {
    "X-Request-ID": "Of the request, if it brought one, or made for it: it stands in each line of "
    "the log that the request caused.",
    "Relguide-Version": "Of the software. With the same version and seed a request has the same "
    "answer, but for times of computing and for what a deadline cut short.",
    "Location": "Path of the flight.",
    "Relguide-Recorded": "Whether what is acknowledged is on record already: `yes` or `no`.",
    "Retry-After": "When to try again [s].",
    "WWW-Authenticate": "`Bearer`: how to show a token.",
    "ETag": "Names this very content: `If-None-Match` asks whether it is still the same.",
    "Cache-Control": "`no-cache`: it may be kept, and is asked for again by its `ETag`.",
    "Content-Disposition": "A name for the file.",
    REPLAYED: "`true` where the request had been answered before, and this is that answer.",
}
"""All headers of answers that the API gives a meaning, and what they say."""
TAGGED = ("ETag", "Cache-Control")
"""Headers of an answer with a tag."""
KEY = {
    "name": HEADER,
    "in": "header",
    "required": False,
    "description": "Chosen anew for each request. One that is sent again with the same key is not "
    "done again: for 24 hours it gets the first answer, if that was below 500.",
    "schema": {"type": "string", "minLength": 1, "maxLength": LONGEST, "pattern": SOUND},
}
_EVERY = ("X-Request-ID", "Relguide-Version")
_BY_STATUS = {"401": ("WWW-Authenticate",), "429": ("Retry-After",), "503": ("Retry-After",)}


class Shape(dict[str, Any]):
    """A schema that leads to models, which the document will hold."""

    def __init__(self, schema: dict[str, Any], models: tuple[type[BaseModel], ...]) -> None:
        super().__init__(schema)
        self.models = models


def schema_of(*models: type[BaseModel]) -> Shape:
    """A reference to the schema of a model, or of any of several."""
    references = [{"$ref": _SCHEMA.format(model=model.__name__)} for model in models]
    return Shape(references[0] if len(references) == 1 else {"anyOf": references}, models)


def list_schema(schema: Shape, *, most: int) -> Shape:
    """The schema of a list."""
    return Shape({"type": "array", "items": schema, "maxItems": most}, schema.models)


def request_body(schema: dict[str, Any], example: object) -> dict[str, Any]:
    """The `openapi_extra=` of a route that reads its body through the contract."""
    content = {JSON: {"schema": schema, "example": example}}
    return {"requestBody": {"required": True, "content": content}}


def response(
    status: int,
    description: str,
    schema: dict[str, Any],
    *,
    headers: Iterable[str] = (),
    media: str = JSON,
    leads_to: Iterable[str] = (),
) -> dict[int | str, dict[str, Any]]:
    """One entry of the `responses=` of a route.

    Args:
        status: of the answer.
        description: a sentence.
        schema: of its body.
        headers: of `HEADERS`, beyond those that all answers have.
        media: type of its body.
        leads_to: operations that take its `id` as `flight_id`.
    """
    said = {"description": description, "content": {media: {"schema": schema}}}
    flight = {"flight_id": "$response.body#/id"}
    links = {name: {"operationId": name, "parameters": flight} for name in leads_to}
    linked = {"links": links} if links else {}
    return {status: {**said, "headers": header_references(headers), **linked}}


def tagged_response(description: str, schema: dict[str, Any]) -> dict[int | str, dict[str, Any]]:
    """The entries of `responses=` of a route that answers by `tagged_answer`."""
    return {**response(200, description, schema, headers=TAGGED), **NOT_MODIFIED}


def header_references(names: Iterable[str]) -> dict[str, Any]:
    """Headers of an answer, of `HEADERS`."""
    return {name: {"$ref": _HEADER.format(name=name)} for name in names}


NOT_MODIFIED: dict[int | str, dict[str, Any]] = {
    304: {
        "description": "It is the one that you have.",
        "headers": header_references(TAGGED),
    }
}


def problem_responses(*kinds: str) -> dict[int | str, dict[str, Any]]:
    """The entries of `responses=` for the problems a route may answer, of `KINDS`."""
    found: dict[int | str, dict[str, Any]] = {}
    for name in kinds:
        kind = KINDS[name]
        example = Problem(
            type=f"{PAGE}#{name}",
            title=kind.title,
            status=kind.status,
            detail=kind.advice,
            instance="/api/v1/…",
        )
        here = found.setdefault(kind.status, _no_problem())
        examples = here["content"][PROBLEM_JSON]["examples"]
        examples[name] = {"summary": kind.title, "value": example.model_dump()}
        here["description"] = ", or ".join(said["summary"] for said in examples.values())
    return found


def _no_problem() -> dict[str, Any]:
    return {"content": {PROBLEM_JSON: {"schema": schema_of(Problem), "examples": {}}}}


def name_of(route: APIRoute) -> str:
    """The name of an operation: that of the function."""
    return route.name


def describe(app: FastAPI) -> None:
    """Give the app its OpenAPI document, at `/openapi.json`."""

    def openapi() -> dict[str, Any]:
        if app.openapi_schema is None:
            app.openapi_schema = _document(app)
        return app.openapi_schema

    @cache
    def written(root: str) -> bytes:
        servers = {"servers": [{"url": root}]} if root else {}
        return orjson.dumps({**openapi(), **servers})

    async def show(request: Request) -> Response:
        return tagged_answer(request, written(root_of(request.scope)))

    app.openapi = openapi  # type: ignore[method-assign]
    app.add_route("/openapi.json", show, include_in_schema=False)


def _document(app: FastAPI) -> dict[str, Any]:
    document = get_openapi(
        title=app.title,
        version=app.version,
        summary=app.summary,
        description=app.description,
        routes=app.routes,
        tags=[{"name": name, "description": said} for name, said in TAGS.items()],
    )
    models: set[type[BaseModel]] = {Problem}
    for route in iter_route_contexts(app.routes):
        if getattr(route, "include_in_schema", False) and hasattr(route, "dependant"):
            models.update(_models_in([route.responses, route.openapi_extra]))
            for method in route.methods or ():
                operation = document["paths"][route.path_format][method.lower()]
                _complete(operation, method, route)
    components = document.setdefault("components", {})
    ordered = sorted(models, key=lambda model: model.__name__)
    _, schemas = models_json_schema(
        [(model, "validation") for model in ordered], ref_template=_SCHEMA
    )
    components["schemas"] = schemas["$defs"]
    components["headers"] = {
        name: {"description": said, "schema": {"type": "string"}} for name, said in HEADERS.items()
    }
    components["securitySchemes"] = {
        "token": {
            "type": "http",
            "scheme": "bearer",
            "description": "Asked for where the operator has set tokens.",
        }
    }
    document["security"] = [{}, {"token": []}]
    return document


def _models_in(said: object) -> Iterator[type[BaseModel]]:
    if isinstance(said, Shape):
        yield from said.models
    match said:
        case dict():
            yield from _models_in(list(said.values()))
        case list():
            for part in said:
                yield from _models_in(part)


def _complete(operation: dict[str, Any], method: str, route: Any) -> None:
    """Add what is true of every route."""
    kinds = ["unknown-host"]
    if route.path not in OPEN:
        kinds.append("token-missing")
    if method not in SAFE:
        kinds.append("foreign-page")
        if not route.path.startswith(CALCULATIONS):
            kinds.append("not-allowed")
    takes_key = method == "POST" and isinstance(route.original_route, IdempotentRoute)
    if takes_key:
        kinds.append("key-reused")
        operation["parameters"] = [*operation.get("parameters", []), KEY]
    asked = [part.call for part in route.dependant.dependencies]
    if refuse_unknown_parameters in asked:
        kinds.append("unknown-parameter")
    answers = operation["responses"]
    if JSON in answers.get("422", {}).get("content", {}):
        del answers["422"]  # the framework's own words for what it refuses, which are not sent
    for status, refused in problem_responses(*kinds).items():
        known = answers.setdefault(str(status), refused)
        examples = known["content"][PROBLEM_JSON]["examples"]
        examples |= refused["content"][PROBLEM_JSON]["examples"]
        known["description"] = ", or ".join(said["summary"] for said in examples.values())
    operation["responses"] = dict(sorted(answers.items()))
    for status, answer in operation["responses"].items():
        replayed = (REPLAYED,) if takes_key and status < "5" else ()
        names = (*_EVERY, *_BY_STATUS.get(status, ()), *replayed)
        answer["headers"] = {**answer.get("headers", {}), **header_references(names)}
        usual = str(route.original_route.status_code or 200)
        if (example := _examples().get(operation["operationId"])) and status == usual:
            answer["content"][JSON]["example"] = example


@cache
def _examples() -> dict[str, Any]:
    found = files(__package__).joinpath(EXAMPLES)
    examples: dict[str, Any] = orjson.loads(found.read_bytes()) if found.is_file() else {}
    return examples
