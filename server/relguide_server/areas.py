"""The route of convergence areas: lines of equal time-to-converge round a leader."""

import asyncio
from functools import cache
from typing import Annotated, Any, Literal

from fastapi import APIRouter, Query
from starlette.responses import Response

from relguide.contract.area_bodies import AreaAnswer, area_to_wire
from relguide.contract.bodies import Anchor, Unanchored, situation_from_json
from relguide.contract.refusal import ContractError
from relguide.flying.present import situation_now
from relguide.learn.words.area_words import area_words
from relguide.learn.words.branch_network import BranchNetwork, load_network
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
    isochrones,
    times_around,
)
from relguide.planning.limits import POSITION
from relguide.planning.situation import Situation
from relguide.planning.words import HORIZON
from relguide.units import Second
from relguide_server.errors import Refusal
from relguide_server.live_fleet import Fleet, FleetOf
from relguide_server.openapi import (
    KNOWN_PARAMETERS_ONLY,
    json_answer,
    problem_of,
    problem_responses,
    response,
    schema_of,
)
from relguide_server.preparation import PreparationOf

MOST_SEARCHED = 1_200
"""Most nodes of a grid that is searched exactly: some seconds of work."""

MODELS = (AreaAnswer,)
"""What the OpenAPI document needs for this route."""
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
Extent = Annotated[float, Query(ge=MIN_EXTENT, le=MAX_EXTENT, allow_inf_nan=False)]
Count = Annotated[int, Query(ge=2, le=MAX_NODES)]
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
        **problem_responses(404, 409, 422, 503),
    },
)
async def draw_area(
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
    preparation.require("areas", *(["bulk"] if exact else []))
    asked, anchor = _situation_of(fleet, flight, situation)
    try:
        grid = Grid(
            x=asked.leader.x if x_m is None else x_m,
            y=asked.leader.y if y_m is None else y_m,
            width=width_m,
            height=height_m,
            columns=columns,
            rows=rows,
        )
    except ValueError as error:
        raise Refusal(422, str(error)) from None
    if exact:
        _refuse_long(asked, grid)
    return json_answer(
        await asyncio.to_thread(
            _draw, asked, anchor, grid, level_s, planner=planner, exact=exact, times=times
        )
    )


def _situation_of(
    fleet: Fleet, flight: str | None, situation: str | None
) -> tuple[Situation, Anchor]:
    if flight is not None and situation is None:
        past = fleet.find(flight).history
        try:
            started, newest = past.started[0], past.newest[0]
            return situation_now(started, started.links[0], past.routes(), newest), Unanchored()
        except ValueError as error:  # e.g. slower than what is planned for
            raise Refusal(409, f"This flight cannot be planned for now: {error}") from None
    if situation is not None and flight is None:
        try:
            return situation_from_json(situation)
        except ContractError as error:
            raise problem_of(error, under="situation") from None
    raise Refusal(422, "Give either flight or situation, and not both: whose area is it?")


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


def _draw(
    situation: Situation,
    anchor: Anchor,
    grid: Grid,
    levels: list[Second],
    *,
    planner: Literal["exact", "network"],
    exact: bool,
    times: bool,
) -> dict[str, Any]:
    words = area_words(_network(), situation, grid) if planner == "network" else None
    evaluate = times_around(situation, words=words)
    area = isochrones(situation, grid, levels, evaluate=evaluate, exact=exact)
    return area_to_wire(area, situation, anchor, exact=exact, times=times)


@cache
def _network() -> BranchNetwork:
    """The network that comes with the program, read once."""
    return load_network()
