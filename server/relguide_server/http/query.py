"""The query of an address: parameters that a route has, each of them once."""

from typing import Any, get_origin

from fastapi import Depends, Request
from fastapi.dependencies.models import Dependant
from fastapi.routing import APIRoute, APIWebSocketRoute
from pydantic import BaseModel, ValidationError
from starlette.requests import HTTPConnection
from starlette.responses import Response
from starlette.types import Receive, Scope, Send

from relguide.contract.refusal import refuse_parameters
from relguide_server.http.errors import Refusal, refusal_of


class QueryRoute(APIRoute):
    """A route whose endpoint takes the request and one model of its query.

    What it depends on takes the request alone. To look up each parameter, and what depends on it,
    takes the framework longer than most plans. So the framework only describes this route.
    """

    def __init__(self, *args: Any, **options: Any) -> None:
        super().__init__(*args, **options)
        (field,) = self.dependant.query_params
        model: type[BaseModel] = field.field_info.annotation  # type: ignore[assignment]
        checks: list[Any] = [part.call for part in self.dependant.dependencies]
        usual = model()

        async def answer(scope: Scope, receive: Receive, send: Send) -> None:
            request = Request(scope, receive, send)
            for check in checks:
                await check(request)
            query = _read(model, request) if scope["query_string"] else usual
            found: Response = await self.endpoint(request, query)
            await found(scope, receive, send)

        self.app = answer


async def refuse_unknown_parameters(connection: HTTPConnection) -> None:
    """Refuse query parameters that the route does not have, or that are given twice.

    Raises:
        Refusal: 422, for the first of them.
    """
    if not connection.scope["query_string"]:
        return
    match connection.scope["route"]:
        case (
            APIRoute(path=path, dependant=dependant)
            | APIWebSocketRoute(path=path, dependant=dependant)
        ):
            known = _parameters(dependant)
            given = [name for name, _ in connection.query_params.multi_items()]
            for name in given:
                if name not in known:
                    has = f"It has {', '.join(sorted(known))}." if known else "It has none."
                    wrong = f"{path} has no parameter {name[:100]!r}. {has}"
                    raise Refusal(422, wrong, kind="unknown-parameter")
                if given.count(name) > 1 and not known[name]:
                    raise Refusal(422, f"{name} is given more than once: give it once.")
        case _:
            return


KNOWN_PARAMETERS_ONLY = Depends(refuse_unknown_parameters)
"""What a router depends on."""


def _parameters(dependant: Dependant) -> dict[str, bool]:
    """The query parameters of a route, and whether each is a list."""
    known: dict[str, bool] = {}
    for field in dependant.query_params:
        annotation = field.field_info.annotation
        if isinstance(annotation, type) and issubclass(annotation, BaseModel):
            for name, about in annotation.model_fields.items():
                known[about.alias or name] = get_origin(about.annotation) is list
        else:
            known[field.alias] = get_origin(annotation) is list
    for part in dependant.dependencies:
        known |= _parameters(part)
    return known


def _read(model: type[BaseModel], request: Request) -> BaseModel:
    try:
        return model.model_validate(dict(request.query_params))
    except ValidationError as error:
        found = [{**e, "loc": ("query", *e["loc"])} for e in error.errors(include_url=False)]
        raise refusal_of(refuse_parameters(found)) from None
