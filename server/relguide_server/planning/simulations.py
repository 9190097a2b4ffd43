"""The route of simulations: flights flown to their end by workers, faster than real time."""

import asyncio
from typing import Annotated, Any, Literal

from fastapi import APIRouter, Query, Request
from starlette.responses import Response

from relguide.contract.messages import FlightRequest
from relguide.contract.refusal import ContractError, parse
from relguide.contract.simulation_bodies import (
    MAX_SIMULATIONS,
    SimulationAnswer,
    SimulationRequest,
    expect_unwatched,
)
from relguide_server.flights.flight_requests import ordered_in, scenario_of
from relguide_server.http.bodies import json_answer, read_flights, unless_left
from relguide_server.http.errors import refusal_of
from relguide_server.http.idempotency import IdempotentRoute
from relguide_server.http.openapi import (
    BODY,
    WORK,
    list_schema,
    problem_responses,
    request_body,
    response,
    schema_of,
)
from relguide_server.http.query import KNOWN_PARAMETERS_ONLY
from relguide_server.jobs.worker_pool import WorkerPool
from relguide_server.planning.plan_service import PlanService
from relguide_server.planning.tasks import simulate
from relguide_server.readiness import PreparationOf
from relguide_server.shares.clients import client_of

LONGEST = 60.0
"""A flight that takes longer is ended [s]; most take a second."""
AT_A_TIME = 4
"""Most flights of a request that wait or fly at once."""
EXAMPLE: list[dict[str, Any]] = [{"scenario": "fig_6b"}, {"scenario": "fig_6b", "seed": 7}]

router = APIRouter(
    prefix="/api/v1",
    tags=["flights"],
    dependencies=[KNOWN_PARAMETERS_ONLY],
    route_class=IdempotentRoute,
)


@router.post(
    "/simulations",
    summary="Fly to the end at once",
    responses={
        **response(
            200,
            "The figures of each, in order.",
            list_schema(schema_of(SimulationAnswer), most=MAX_SIMULATIONS),
        ),
        **problem_responses(*BODY, *WORK),
    },
    openapi_extra=request_body(schema_of(SimulationRequest), EXAMPLE),
)
async def simulate_flights(
    request: Request,
    preparation: PreparationOf,
    planner: Annotated[
        Literal["exact", "network"] | None,
        Query(description="Who plans; if left out, the one that the service was started with."),
    ] = None,
) -> Response:
    """Flights as `POST /flights` takes them, as fast as they go; nothing of them is streamed.

    `orders` and a `crew` that reacts take the place of commands.

    Each ends two minutes after it has joined, or when its time is over, as in `relguide fly`.
    """
    plan_service: PlanService = request.app.state.plan_service
    workers: WorkerPool = request.app.state.workers
    preparation.require_planner(planner or plan_service.name)
    # a recorded leader is read from a file, too
    wanted = await read_flights(request, _read)
    room = asyncio.Semaphore(AT_A_TIME)

    async def fly(one: str) -> bytes:
        async with room:
            figures: bytes = await workers.do(
                "simulations",
                simulate,
                one,
                plan_service.planner_for(planner),
                patience=LONGEST,
                client=client_of(request.scope),
            )
            return figures

    flying = [asyncio.ensure_future(fly(one)) for one in wanted]
    try:
        texts = await unless_left(request, asyncio.gather(*flying))
    finally:
        for other in flying:  # where one is refused, nobody waits for the others
            other.cancel()
    return json_answer(b"[" + b",".join(texts) + b"]")


def _read(content: object) -> list[str]:
    """What is to be flown, each as JSON.

    Raises:
        Refusal: naming each field that is wrong.
    """
    try:
        if not isinstance(content, list):
            raise ContractError([("", "The body must be a list of flights.")])
        flights = parse(SimulationRequest, content)
        expect_unwatched(flights)
        wanted: list[FlightRequest] = flights.root
        for index, one in enumerate(wanted):
            _expect_flyable(index, one)
    except ContractError as error:
        raise refusal_of(error) from None
    return [one.model_dump_json(exclude_unset=True) for one in wanted]


def _expect_flyable(index: int, wanted: FlightRequest) -> None:
    try:
        _, flown, _ = scenario_of(wanted)
        ordered_in(wanted, flown)
    except ContractError as error:
        under = [(f"[{index}].{path}", said) for path, said in error.problems]
        raise ContractError(under, count=error.count) from None
