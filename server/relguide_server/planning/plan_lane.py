"""The lane of plans: `POST /api/v1/plans`, past the framework.

To find a route, read parameters and stack up what depends on them takes the framework as long as
the planner takes for most plans. What this lane answers is what the route of `plans.py` answers;
parameters that are wrong, or not written plainly, go on to the route, which says so.
"""

import re
from dataclasses import replace
from typing import get_args

from starlette.requests import ClientDisconnect, Request
from starlette.responses import Response
from starlette.types import ASGIApp, Receive, Scope, Send

from relguide.contract.answers import Form, read_include
from relguide_server.http.errors import Refusal, answer_left, answer_refusal
from relguide_server.http.proxy import path_of
from relguide_server.planning.plan_service import Wish
from relguide_server.planning.plans import (
    LEAST_MS,
    MOST_MS,
    PATH,
    PLANNERS,
    USUAL,
    answer_situation,
    router,
)

ROUTE = next(route for route in router.routes if getattr(route, "path", "") == PATH)
"""The framework's own."""
NUMBER = re.compile(r"\d{1,5}(\.\d{1,6})?")
WORDS = re.compile(r"[a-z,]+")
LONGEST = 100
"""A longer query goes to the route [bytes]."""
FORMS: dict[str, Form] = {form: form for form in get_args(Form)}


class PlanLane:
    """ASGI middleware: plans what is asked for as usual; everything else goes on to the app."""

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one connection."""
        if (
            scope["type"] != "http"
            or scope["method"] != "POST"
            or path_of(scope) != PATH
            or (wish := wish_of(scope["query_string"])) is None
        ):
            await self.app(scope, receive, send)
            return
        scope["route"] = ROUTE  # what is counted of it is counted of the route
        request = Request(scope, receive)
        answer = await self._answer(request, wish)
        await answer(scope, receive, send)

    async def _answer(self, request: Request, wish: Wish) -> Response:
        try:
            return await answer_situation(request, request.app.state.plan_service, wish)
        except Refusal as error:
            return answer_refusal(request, error)
        except ClientDisconnect:
            return answer_left(request)


def wish_of(query: bytes) -> Wish | None:
    """What is wished by a query; `None` where that is wrong, or not written plainly."""
    if not query:
        return USUAL
    if len(query) > LONGEST:
        return None
    wish, named = USUAL, set[str]()
    for part in query.decode("latin-1").replace("%2C", ",").split("&"):
        name, _, value = part.partition("=")
        if name in named:
            return None
        named.add(name)
        match name:
            case "max_ms" if NUMBER.fullmatch(value) and LEAST_MS <= float(value) <= MOST_MS:
                wish = replace(wish, budget=float(value) * 1e-3)
            case "include" if WORDS.fullmatch(value):
                try:
                    wish = replace(wish, include=read_include(value))
                except ValueError:
                    return None
            case "planner" if value in PLANNERS:
                wish = replace(wish, planner=value)
            case "format" if value in FORMS:
                wish = replace(wish, form=FORMS[value])
            case _:
                return None
    return wish
