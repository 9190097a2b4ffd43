"""The route of scenarios flown to their end at once: recordings, to be replayed and compared."""

import gzip
from collections import OrderedDict
from dataclasses import dataclass
from typing import Annotated, Literal

from fastapi import APIRouter, Path, Query, Request
from starlette.responses import Response

from relguide.contract.messages import ScenarioFlightRequest, Seed
from relguide.flying.scenarios import SCENARIOS, no_scenario
from relguide_server.http.bodies import unless_left
from relguide_server.http.errors import Refusal
from relguide_server.http.etags import has, headers_of, tag_of
from relguide_server.http.openapi import (
    NOT_MODIFIED,
    TAGGED,
    WORK,
    header_references,
    problem_responses,
)
from relguide_server.http.query import KNOWN_PARAMETERS_ONLY
from relguide_server.jobs.worker_pool import WorkerPool
from relguide_server.planning.plan_service import PlanService
from relguide_server.planning.simulations import LONGEST
from relguide_server.planning.tasks import record_flight
from relguide_server.readiness import PreparationOf
from relguide_server.shares.clients import client_of

LINES = "application/x-ndjson"
KEPT = 16 * 1024 * 1024
"""So much of recordings is kept, packed [bytes]: some hundred flights."""

router = APIRouter(prefix="/api/v1", tags=["flights"], dependencies=[KNOWN_PARAMETERS_ONLY])

Asked = tuple[str, int, str]
"""Name of a scenario, seed, and name of the planner."""


@dataclass(frozen=True, slots=True)
class Recording:
    """A flight as a file."""

    packed: bytes
    """Gzipped."""
    tag: str
    """Its `ETag`."""


class KeptRecordings:
    """The recordings asked for last. Lives on the event loop."""

    def __init__(self, most: int = KEPT) -> None:
        """Keep nothing yet.

        Args:
            most: how much is kept [bytes].
        """
        self._most, self._size = most, 0
        self._kept: OrderedDict[Asked, Recording] = OrderedDict()

    def get(self, asked: Asked) -> Recording | None:
        """What was flown, if it is kept."""
        found = self._kept.get(asked)
        if found is not None:
            self._kept.move_to_end(asked)
        return found

    def put(self, asked: Asked, packed: bytes) -> Recording:
        """Keep what was flown; those not asked for longest make room for it."""
        before = self._kept.pop(asked, None)
        made = Recording(packed, tag_of(packed))
        self._kept[asked] = made
        self._size += len(packed) - (len(before.packed) if before else 0)
        while self._size > self._most:
            self._size -= len(self._kept.popitem(last=False)[1].packed)
        return made


@router.get(
    "/scenarios/{name}/flight",
    summary="A scenario flown at once",
    responses={
        200: {
            "description": "Its recording: a line that says what it is, then a document a line.",
            "content": {LINES: {"schema": {"type": "string"}}},
            "headers": header_references(TAGGED),
        },
        **NOT_MODIFIED,
        **problem_responses("not-found", "invalid", "not-installed", *WORK),
    },
)
async def fly_scenario(
    name: Annotated[str, Path(max_length=100, description="Of the scenario.", examples=["fig_6b"])],
    request: Request,
    preparation: PreparationOf,
    seed: Annotated[Seed, Query(description="Of its random numbers.")] = 0,
    planner: Annotated[
        Literal["exact", "network"] | None,
        Query(description="Who plans; if left out, the one that the service was started with."),
    ] = None,
) -> Response:
    """As `relguide fly NAME --record` writes it: engaged from the start, samples once a second.

    It ends two minutes after it has joined, or when its time is over.
    """
    _expect_known(name)
    plan_service: PlanService = request.app.state.plan_service
    kept: KeptRecordings = request.app.state.recordings
    preparation.require_planner(planner or plan_service.name)
    asked = (name, seed, planner or plan_service.name)
    found = kept.get(asked)
    if found is None:
        workers: WorkerPool = request.app.state.workers
        flying = workers.do(
            "simulations",
            record_flight,
            ScenarioFlightRequest(scenario=name, seed=seed),
            plan_service.planner_for(planner),
            patience=LONGEST,
            client=client_of(request.scope),
        )
        found = kept.put(asked, await unless_left(request, flying))
    return _answer(found, request)


def _expect_known(name: str) -> None:
    if name not in SCENARIOS:
        raise Refusal(404, no_scenario(name, SCENARIOS))
    if missing := SCENARIOS[name].missing():
        raise Refusal(501, missing)


def _answer(found: Recording, request: Request) -> Response:
    headers = {**headers_of(found.tag), "Vary": "Accept-Encoding"}
    if has(request.headers, found.tag):
        return Response(status_code=304, headers=headers)
    if "gzip" in request.headers.get("accept-encoding", ""):
        headers["Content-Encoding"] = "gzip"
        return Response(found.packed, headers=headers, media_type=LINES)
    return Response(gzip.decompress(found.packed), headers=headers, media_type=LINES)
