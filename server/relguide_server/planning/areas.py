"""The route of convergence areas: lines of equal time-to-converge round a leader."""

from typing import Annotated, Literal

from fastapi import APIRouter, Query, Request
from starlette.responses import Response

from relguide.contract.area_bodies import AreaAnswer, AreaRequest
from relguide.contract.bodies import SituationBody, situation_from_body
from relguide.contract.places import Anchor
from relguide.contract.refusal import ContractError, parse
from relguide.flying.present import situation_now
from relguide.maps.isochrones import (
    COLUMNS,
    HEIGHT,
    MAX_EXTENT,
    MAX_LEVELS,
    MAX_NODES,
    MIN_EXTENT,
    ROWS,
    WIDTH,
    Grid,
)
from relguide.planning.limits import POSITION
from relguide.planning.situation import Situation
from relguide.planning.words import HORIZON
from relguide_server.flights.live_fleet import FleetOf, LiveFleet
from relguide_server.http.bodies import (
    JSON,
    json_answer,
    parse_json,
    read_body,
    unless_left,
)
from relguide_server.http.errors import Refusal, refusal_of
from relguide_server.http.openapi import (
    BODY,
    WORK,
    problem_responses,
    request_body,
    response,
    schema_of,
)
from relguide_server.http.query import KNOWN_PARAMETERS_ONLY
from relguide_server.jobs.worker_pool import WorkerPool
from relguide_server.planning.plans import EXAMPLE
from relguide_server.planning.tasks import draw_area
from relguide_server.readiness import Preparation, PreparationOf
from relguide_server.shares.clients import client_of

MOST_SEARCHED = 1_200
"""Most nodes of a grid that is searched exactly: some seconds of work."""

ONE_OF_BOTH = "Give either flight or situation, and not both: whose area is it?"
LONGEST = 20.0
"""An area that takes longer is ended [s]."""

router = APIRouter(prefix="/api/v1", tags=["areas"], dependencies=[KNOWN_PARAMETERS_ONLY])

FlightAsked = Annotated[
    str | None, Query(max_length=100, description="Id of a flight: the area for its situation now.")
]
SituationAsked = Annotated[
    str | None,
    Query(
        max_length=20_000,
        description="Instead of a flight: a situation as `POST /plans` takes it, as JSON text.",
        examples=[
            '{"pursuer": {"x_m": -40000, "y_m": 40000, "heading_deg": 90, "tas_mps": 240, '
            '"max_bank_deg": 25}, "leader": {"x_m": 0, "y_m": 0, "heading_deg": 90, '
            '"tas_mps": 200}, "slot_distance_m": 12000, "min_separation_m": 9260}'
        ],
    ),
]
Place = Annotated[
    float | None, Query(ge=POSITION.low, le=POSITION.high, allow_inf_nan=False,
                        description="Centre of the grid; if left out, the leader."),
]  # fmt: skip
Extent = Annotated[
    float,
    Query(ge=MIN_EXTENT, le=MAX_EXTENT, allow_inf_nan=False,
          description="From the first column or row of the grid to the last."),
]  # fmt: skip
Count = Annotated[int, Query(ge=2, le=MAX_NODES, description="Columns or rows of the grid.")]
Levels = Annotated[
    list[Annotated[float, Query(ge=0.0, le=HORIZON, allow_inf_nan=False)]],
    Query(max_length=MAX_LEVELS, description="Times of the lines; if left out, some round ones."),
]
Exact = Annotated[
    bool,
    Query(
        description="Whether to search the paths that touch the minimum separation as well. Takes "
        f"seconds; for at most {MOST_SEARCHED} nodes, and a leader without turns to come."
    ),
]
PlannerAsked = Annotated[
    Literal["exact", "network"],
    Query(
        description="`network`: a network of branches says where it is enough to solve one word; "
        "all words are solved where it is not sure, and where the word changes."
    ),
]
TimesAsked = Annotated[bool, Query(description="Whether to give the times of all nodes.")]


@router.get(
    "/areas",
    summary="Lines of equal time-to-converge",
    responses={
        **response(200, "Lines, and regions of words.", schema_of(AreaAnswer)),
        **problem_responses("not-found", "conflict", "invalid", *WORK),
    },
)
async def show_area(
    request: Request,
    fleet: FleetOf,
    preparation: PreparationOf,
    flight: FlightAsked = None,
    situation: SituationAsked = None,
    x_m: Place = None,
    y_m: Place = None,
    width_m: Extent = WIDTH,
    height_m: Extent = HEIGHT,
    columns: Count = COLUMNS,
    rows: Count = ROWS,
    level_s: Levels = [],  # noqa: B006 (FastAPI makes a new one each time)
    exact: Exact = False,
    planner: PlannerAsked = "exact",
    times: TimesAsked = False,
) -> Response:
    """How long it takes to converge from places round the leader, on the pursuer's present heading.

    The pursuer is put on every node of a grid; everything else stays as in the situation.
    """
    if (flight is None) == (situation is None):
        raise Refusal(422, ONE_OF_BOTH)
    given: SituationBody | None = None
    if situation is not None:
        try:
            given = parse(SituationBody, situation)
        except ContractError as error:
            raise refusal_of(error, under="situation") from None
    asked = AreaRequest(
        flight=flight,
        situation=given,
        x_m=x_m,
        y_m=y_m,
        width_m=width_m,
        height_m=height_m,
        columns=columns,
        rows=rows,
        levels_s=level_s,
        exact=exact,
        planner=planner,
        times=times,
    )
    return await _draw(asked, request, fleet, preparation)


@router.post(
    "/areas",
    summary="Lines of equal time-to-converge",
    responses={
        **response(200, "Lines, and regions of words.", schema_of(AreaAnswer)),
        **problem_responses(*BODY, "not-found", "conflict", *WORK),
    },
    openapi_extra=request_body(schema_of(AreaRequest), {"situation": EXAMPLE, "levels_s": [600.0]}),
)
async def draw_area_of_body(
    request: Request, fleet: FleetOf, preparation: PreparationOf
) -> Response:
    """As `GET /areas`, with the situation in the body as `POST /plans` takes it."""
    content = parse_json(await read_body(request, JSON))
    if not isinstance(content, dict):
        raise Refusal(422, "The body must be an object with fields.")
    try:
        asked = parse(AreaRequest, content)
    except ContractError as error:
        raise refusal_of(error) from None
    return await _draw(asked, request, fleet, preparation)


async def _draw(
    asked: AreaRequest, request: Request, fleet: LiveFleet, preparation: Preparation
) -> Response:
    preparation.require("areas", *(["bulk"] if asked.exact else []))
    if asked.planner == "network":
        preparation.require_planner("network")
    situation, anchor = _situation_of(fleet, asked.flight, asked.situation)
    try:
        grid = Grid(
            x=situation.leader.x if asked.x_m is None else asked.x_m,
            y=situation.leader.y if asked.y_m is None else asked.y_m,
            width=asked.width_m,
            height=asked.height_m,
            columns=asked.columns,
            rows=asked.rows,
        )
    except ValueError as error:
        raise Refusal(422, str(error)) from None
    if asked.exact:
        _refuse_long(situation, grid)
    workers: WorkerPool = request.app.state.workers
    drawing = workers.do(
        "areas",
        draw_area,
        situation,
        anchor,
        grid,
        asked.levels_s,
        asked.planner,
        asked.exact,
        asked.times,
        patience=LONGEST,
        client=client_of(request.scope),
    )
    return json_answer(await unless_left(request, drawing))


def _situation_of(
    fleet: LiveFleet, flight: str | None, situation: SituationBody | None
) -> tuple[Situation, Anchor]:
    if flight is not None and situation is None:
        found = fleet.find(flight)
        past = found.history
        try:
            started, newest = past.started[0], past.newest[0]
            situation_then = situation_now(started, started.links[0], past.routes(), newest)
            return situation_then, found.label.anchor
        except ValueError as error:  # e.g. slower than what is planned for
            raise Refusal(409, f"This flight cannot be planned for now: {error}") from None
    if situation is not None and flight is None:
        try:
            return situation_from_body(situation)
        except ContractError as error:
            raise refusal_of(error, under="situation") from None
    raise Refusal(422, ONE_OF_BOTH)


def _refuse_long(situation: Situation, grid: Grid) -> None:
    if situation.leader.intent:
        raise Refusal(
            422,
            "exact is only for a leader without intent: with one, each node takes up to a second. "
            "Leave exact out: the times are then those of certified plans, with a lower bound.",
        )
    if grid.columns * grid.rows > MOST_SEARCHED:
        raise Refusal(
            422,
            f"An exact area may have at most {MOST_SEARCHED:,} nodes (columns times rows), not "
            f"{grid.columns * grid.rows:,}.",
        )
