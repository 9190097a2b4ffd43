"""The lane of plans: `POST /api/v1/plans`, asked without parameters, past the framework.

To find a route, read parameters and stack up what depends on them takes the framework as long as
the planner takes for most plans. What this lane answers is what the route of `plans.py` answers.
"""

from starlette.requests import ClientDisconnect, Request
from starlette.responses import Response
from starlette.types import ASGIApp, Receive, Scope, Send

from relguide_server.errors import Refusal, answer_left, answer_refusal
from relguide_server.mount import path_of
from relguide_server.plans import PATH, USUAL, answer_situation, router

ROUTE = next(route for route in router.routes if getattr(route, "path", "") == PATH)
"""The framework's own."""


class PlanLane:
    """ASGI middleware: plans what is asked for as usual; everything else goes on to the app."""

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one connection."""
        if (
            scope["type"] != "http"
            or scope["method"] != "POST"
            or scope["query_string"]
            or path_of(scope) != PATH
        ):
            await self.app(scope, receive, send)
            return
        scope["route"] = ROUTE  # what is counted of it is counted of the route
        request = Request(scope, receive)
        answer = await self._answer(request)
        await answer(scope, receive, send)

    async def _answer(self, request: Request) -> Response:
        try:
            return await answer_situation(request, request.app.state.desk, USUAL)
        except Refusal as error:
            return answer_refusal(request, error)
        except ClientDisconnect:
            return answer_left(request)
