"""A service to be measured: as `relguide serve`, and a clock that watches its event loop.

    python -m benchmarks.service.served PORT

`GET /blocked` gives how long the loop was held up at most since it was last asked, by the wall and
by the processor [ms]; `POST /constant` reads a body and answers as much as a plan, for nothing.
"""

import asyncio
import sys
from time import perf_counter, thread_time

from relguide_server.app import app_of
from relguide_server.http.bodies import JSON, json_answer, read_body
from relguide_server.serving import serve
from starlette.requests import Request
from starlette.responses import Response

LOOK = 0.002
"""How often the loop is looked at [s]."""
ANSWER = b'"' + b"x" * 1450 + b'"'
"""As long as a plan."""


class Watch:
    """How long the event loop was held up."""

    def __init__(self) -> None:
        self.wall = self.processor = 0.0
        self._task: asyncio.Task[None] | None = None

    async def look(self) -> None:
        while True:
            began, spent = perf_counter(), thread_time()
            await asyncio.sleep(LOOK)
            self.wall = max(self.wall, perf_counter() - began - LOOK)
            self.processor = max(self.processor, thread_time() - spent)

    async def report(self, request: Request) -> Response:
        del request
        if self._task is None:
            self._task = asyncio.create_task(self.look())
        answer = {"wall_ms": 1e3 * self.wall, "processor_ms": 1e3 * self.processor}
        self.wall = self.processor = 0.0
        return json_answer(answer)


async def answer_constant(request: Request) -> Response:
    await read_body(request, JSON)
    return json_answer(ANSWER)


if __name__ == "__main__":
    app = app_of()
    app.add_route("/blocked", Watch().report)
    app.add_route("/constant", answer_constant, methods=["POST"])
    serve(app, host="127.0.0.1", port=int(sys.argv[1]))
