"""Every error as a problem document (RFC 9457), and the only place that catches `Exception`.

- `Refusal`: a request that is understood and not served; routes raise it with a sentence.
- `HTTPException`: starlette's own 404 and 405; `RequestValidationError`: query parameters, told in
  the contract's words.
- `Exception`: a mistake of ours; the traceback goes to the log, a sentence to the client.
"""

import logging
import re
import traceback
from collections.abc import Callable, Iterator, Sequence
from functools import cache
from http import HTTPStatus
from typing import Any

import orjson
from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.routing import RouteContext, iter_route_contexts
from pydantic import BaseModel, Field
from starlette.exceptions import HTTPException
from starlette.requests import ClientDisconnect
from starlette.responses import Response
from starlette.routing import compile_path

from relguide.contract.refusal import ContractError, refuse_parameters
from relguide_server.http.logs import SeldomLine, request_id
from relguide_server.http.problem_kinds import BY_STATUS, KINDS, PAGE

log = logging.getLogger("relguide.server")

PROBLEM_JSON = "application/problem+json"


class ProblemError(BaseModel):
    """One thing wrong with a request, and where."""

    path: str = Field(description="Where in the request, e.g. `leader.intent[1].bank_deg`.")
    message: str = Field(description="What is wrong, and what would be right.")


class Problem(BaseModel):
    """A problem document, RFC 9457."""

    type: str = Field(description="Leads to what is known of this kind of problem.")
    title: str = Field(description="Of the kind.")
    status: int = Field(description="Of HTTP.")
    detail: str = Field(description="What is wrong here, and what would be right.")
    instance: str = Field(description="What was asked for.")
    errors: list[ProblemError] = Field(default=[], description="Each thing wrong, twenty at most.")


class Refusal(HTTPException):
    """A request that is understood and not served."""

    def __init__(
        self,
        status: int,
        detail: str,
        *,
        kind: str = "",
        errors: Sequence[ProblemError] = (),
        headers: dict[str, str] | None = None,
    ) -> None:
        """Refuse.

        Args:
            status: of the answer.
            detail: what is wrong, and what would be right.
            kind: one of `KINDS`; the usual one of the status if left out.
            errors: each thing wrong.
            headers: more of them.
        """
        super().__init__(status, detail, headers)
        self.kind = kind
        self.errors = tuple(errors)


class ServiceStopping(Refusal):
    """What waits is answered no more, since the service stops."""

    def __init__(self) -> None:
        """With when to try again."""
        detail = "The service is stopping: it may be back in a moment."
        super().__init__(503, detail, kind="stopping", headers={"Retry-After": "5"})


def refusal_of(error: ContractError, status: int = 422, *, under: str = "") -> Refusal:
    """What the contract refuses.

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
    more = f" (and {error.count - 1} more)" if error.count > 1 else ""
    return Refusal(status, first + more, errors=errors)


def problem(
    instance: str,
    status: int,
    detail: str,
    *,
    kind: str = "",
    root: str = "",
    errors: Sequence[ProblemError] = (),
    headers: dict[str, str] | None = None,
) -> Response:
    """The answer that carries a problem document.

    Args:
        instance: what was asked.
        status: of the answer.
        detail: what is wrong, and what would be right.
        kind: one of `KINDS`; the usual one of the status if left out.
        root: the path below which the service is served.
        errors: each thing wrong.
        headers: more of them.
    """
    kind = kind or BY_STATUS.get(status, "")
    document = Problem(
        type=f"{root}{PAGE}#{kind}" if kind else "about:blank",
        title=KINDS[kind].title if kind else HTTPStatus(status).phrase,
        status=status,
        detail=detail,
        instance=instance,
        errors=list(errors),
    )
    return Response(
        orjson.dumps(document.model_dump()),
        status_code=status,
        media_type=PROBLEM_JSON,
        headers=headers,
    )


def install_handlers(app: FastAPI) -> None:
    """Make every error of the app a problem document."""
    app.state.left = SeldomLine()
    app.add_exception_handler(HTTPException, _answer_refusal)
    app.add_exception_handler(RequestValidationError, _answer_invalid)
    app.add_exception_handler(ClientDisconnect, _note_left)
    app.add_exception_handler(Exception, _answer_broken)


async def _answer_refusal(request: Request, error: Exception) -> Response:
    assert isinstance(error, HTTPException)
    return answer_refusal(request, error)


def answer_refusal(request: Request, error: HTTPException) -> Response:
    """The problem document of what is refused."""
    path, status = request.url.path, error.status_code
    errors = error.errors if isinstance(error, Refusal) else ()
    detail, headers = error.detail, error.headers
    if not isinstance(error, Refusal) and detail == HTTPStatus(status).phrase:
        if status == 404 and any(route.methods is None for route in _routes_at(request)):
            status, headers = 426, {"Upgrade": "websocket", "Connection": "Upgrade"}
        elif status == 405:
            headers = {"Allow": ", ".join(_methods_at(request))}
        detail = _sentence(request, status)
    return problem(
        path,
        status,
        detail,
        kind=error.kind if isinstance(error, Refusal) else "",
        root=request.scope.get("root_path", ""),
        errors=errors,
        headers=dict(headers) if headers else None,
    )


def _routes_at(request: Request) -> Iterator[RouteContext]:
    """The routes at the path of a request, whatever its method; those of WebSocket have none."""
    path = request.scope["path"].removeprefix(request.scope.get("root_path", ""))
    for route in iter_route_contexts(request.app.routes):
        if _pattern_of(route.path or "").match(path):
            yield route


@cache
def _pattern_of(path: str) -> re.Pattern[str]:
    """What a route's path matches."""
    return compile_path(path)[0]


def _methods_at(request: Request) -> list[str]:
    """The methods that are answered at the path of a request; HEAD is answered as GET."""
    found = {method for route in _routes_at(request) for method in route.methods or ()}
    return sorted(found | ({"HEAD"} if "GET" in found else set()))


def _sentence(request: Request, status: int) -> str:
    match status:
        case 404:
            return f"There is nothing at {request.url.path}. The API is described at /docs."
        case 405:
            takes = " or ".join(_methods_at(request))
            return f"{request.url.path} takes {takes}, not {request.method}: see /docs."
        case 426:
            return f"{request.url.path} is a stream: ask for it by WebSocket, see /docs/stream."
        case _:
            return f"{HTTPStatus(status).description or HTTPStatus(status).phrase}."


async def _answer_invalid(request: Request, error: Exception) -> Response:
    assert isinstance(error, RequestValidationError)
    return answer_refusal(request, refusal_of(refuse_parameters(error.errors())))


async def _note_left(request: Request, error: Exception) -> Response:
    del error
    return answer_left(request)


def answer_left(request: Request) -> Response:
    """The answer to a client that left, which nobody reads; it is noted."""
    left: SeldomLine = request.app.state.left
    left.write("A client left before %s %s was answered.", request.method, request.url.path)
    return Response(status_code=400)


async def _answer_broken(request: Request, error: Exception) -> Response:
    # Starlette raises the error again after this answer, so that the server logs its traceback.
    del error
    return problem(
        request.url.path,
        500,
        "The server made a mistake: its log has the details. The request may be right.",
        root=request.scope.get("root_path", ""),
        headers={"X-Request-ID": request_id.get()},
    )


def attempt(job: Callable[..., Any], arguments: tuple[Any, ...]) -> tuple[Any, str]:
    """Do a job; of a mistake of ours, give the traceback.

    Returns:
        What it returned, and nothing; or nothing, and the traceback.

    Raises:
        Refusal: what the job refuses.
    """
    try:
        return job(*arguments), ""
    except Refusal:
        raise
    except Exception:
        return None, traceback.format_exc()


def run_logged(name: str, work: Callable[[], None]) -> bool:
    """Run the work of a thread; an error in it goes to the log and does not end the process.

    Returns:
        Whether it ran to its end, or until the service stopped.
    """
    try:
        work()
    except ServiceStopping:
        return True
    except Exception:
        log.exception("%s stopped by a mistake of ours", name)
        return False
    return True
