"""Bodies in and out by the contract's own reader, and their place in the OpenAPI document.

The contract reads the bytes itself, so REST, command line and files refuse with the same words.
"""

from collections.abc import Sequence
from typing import Any

import orjson
from fastapi import Depends, FastAPI, Request
from fastapi.openapi.utils import get_openapi
from fastapi.routing import APIRoute
from pydantic import BaseModel
from pydantic.json_schema import JsonSchemaMode, models_json_schema
from starlette.requests import HTTPConnection
from starlette.responses import Response

from relguide.contract.refusal import ContractError, loads
from relguide_server.errors import PROBLEM_JSON, Problem, ProblemError, Refusal

_REF = "#/components/schemas/{model}"


async def read_json(request: Request) -> object:
    """The parsed body of a request.

    Raises:
        Refusal: if it is not declared to be JSON, or is no JSON.
    """
    declared = request.headers.get("content-type", "").partition(";")[0].strip().lower()
    # A page of another site can send any other type here without the browser's permission.
    if declared != "application/json":
        raise Refusal(415, "The body must be JSON, sent with Content-Type: application/json.")
    try:
        return loads(await request.body())
    except ContractError as error:
        raise problem_of(error, 400) from None


async def refuse_unknown_parameters(connection: HTTPConnection) -> None:
    """Refuse query parameters that the route does not have, and name those it has.

    Raises:
        Refusal: 422, for the first of them.
    """
    match connection.scope["route"]:
        case APIRoute(path=path, dependant=dependant):
            known = {field.alias for field in dependant.query_params}
            for name in connection.query_params:
                if name not in known:
                    has = f"It has {', '.join(sorted(known))}." if known else "It has none."
                    raise Refusal(422, f"{path} has no parameter {name[:100]!r}. {has}")
        case _:
            return


KNOWN_PARAMETERS_ONLY = Depends(refuse_unknown_parameters)
"""What a router depends on."""


def problem_of(error: ContractError, status: int = 422, *, under: str = "") -> Refusal:
    """What the contract refuses, as a problem document.

    Args:
        error: what is wrong.
        status: 422, or 400 for a body that is no JSON at all.
        under: where in the body the refused part is, e.g. `[3]`.
    """
    errors = [
        ProblemError(path=f"{under}.{path}".strip(".") if under else path, message=message)
        for path, message in error.problems
    ]
    first = f"{errors[0].path}: {errors[0].message}" if errors[0].path else errors[0].message
    more = f" (and {len(errors) - 1} more)" if len(errors) > 1 else ""
    return Refusal(status, first + more, errors=errors)


def json_answer(
    content: object, status: int = 200, *, headers: dict[str, str] | None = None
) -> Response:
    """An answer in JSON; content that is already encoded goes out as it is."""
    body = content if isinstance(content, bytes) else orjson.dumps(content)
    return Response(body, status, headers, media_type="application/json")


def request_body(schema: dict[str, Any], example: object) -> dict[str, Any]:
    """The `openapi_extra=` of a route that reads its body through the contract."""
    content = {"application/json": {"schema": schema, "example": example}}
    return {"requestBody": {"required": True, "content": content}}


def response(
    status: int, description: str, schema: dict[str, Any]
) -> dict[int | str, dict[str, Any]]:
    """One entry of the `responses=` of a route."""
    return {
        status: {"description": description, "content": {"application/json": {"schema": schema}}}
    }


def problem_responses(*statuses: int) -> dict[int | str, dict[str, Any]]:
    """The entries of `responses=` for the problems a route may answer."""
    content = {PROBLEM_JSON: {"schema": schema_of(Problem)}}
    return {
        status: {"description": "A problem document.", "content": content} for status in statuses
    }


def schema_of(*models: type[BaseModel]) -> dict[str, Any]:
    """A reference to the schema of a model, or of any of several."""
    references = [{"$ref": _REF.format(model=model.__name__)} for model in models]
    return references[0] if len(references) == 1 else {"anyOf": references}


def list_schema(schema: dict[str, Any], *, most: int) -> dict[str, Any]:
    """The schema of a list."""
    return {"type": "array", "items": schema, "maxItems": most}


def describe(app: FastAPI, models: Sequence[type[BaseModel]]) -> None:
    """Give the app an OpenAPI document that holds these models."""

    def openapi() -> dict[str, Any]:
        if app.openapi_schema is None:
            document = get_openapi(
                title=app.title,
                version=app.version,
                summary=app.summary,
                description=app.description,
                routes=app.routes,
            )
            mode: JsonSchemaMode = "validation"
            shapes: tuple[type[BaseModel], ...] = (*models, Problem)
            wanted = [(shape, mode) for shape in shapes]
            _, schemas = models_json_schema(wanted, ref_template=_REF)
            components = document.setdefault("components", {}).setdefault("schemas", {})
            components.update(schemas["$defs"])
            app.openapi_schema = document
        return app.openapi_schema

    app.openapi = openapi  # type: ignore[method-assign]
