"""Routes that plan: a situation in, a plan with its proof out."""

import asyncio
from time import perf_counter
from typing import Annotated, Any

from fastapi import APIRouter, Depends, Query, Request
from pydantic import BaseModel, Field, RootModel, create_model
from starlette.responses import Response

from relguide.contract.answers import Include, answer, read_include
from relguide.contract.bodies import Anchor, NamedSituationBody, SituationBody, situation_from_body
from relguide.contract.messages import PlanAnswer, model_of
from relguide.contract.refusal import ContractError, parse
from relguide.flying.plan_documents import NoPlanCard, PlanCard
from relguide.planning.plan import Planner
from relguide.planning.situation import Situation
from relguide_server.errors import Refusal
from relguide_server.metrics import Metrics
from relguide_server.openapi import (
    KNOWN_PARAMETERS_ONLY,
    json_answer,
    list_schema,
    problem_of,
    problem_responses,
    read_json,
    request_body,
    response,
    schema_of,
)
from relguide_server.preparation import Preparation, PreparationOf

MAX_BATCH = 1000
"""Most situations in one request."""

EXAMPLE = {
    "pursuer": {
        "x_m": -40000.0,
        "y_m": 40000.0,
        "heading_deg": 90.0,
        "tas_mps": 240.0,
        "max_bank_deg": 25.0,
    },
    "leader": {
        "x_m": 0.0,
        "y_m": 0.0,
        "heading_deg": 90.0,
        "tas_mps": 200.0,
        "intent": [
            {"straight_s": 60.0},
            {"turn_to_heading_deg": 135.0, "direction": "right", "bank_deg": 20.0},
        ],
    },
    "slot_distance_m": 10000.0,
    "min_separation_m": 9260.0,
}
"""The paper's Fig. 6b, roughly."""


class Answer(RootModel[PlanAnswer]):
    """A plan, or why there is none."""


_ID: dict[str, Any] = {"id": (str | int, Field(default="", description="As in the request."))}
NamedPlan: type[BaseModel] = create_model("NamedPlan", __base__=model_of(PlanCard), **_ID)
NamedNoPlan: type[BaseModel] = create_model("NamedNoPlan", __base__=model_of(NoPlanCard), **_ID)
MODELS = (SituationBody, NamedSituationBody, Answer, NamedPlan, NamedNoPlan)
"""What the OpenAPI document needs for these routes."""


def _planner_of(request: Request) -> Planner:
    planner: Planner = request.app.state.planner
    return planner


def _metrics_of(request: Request) -> Metrics:
    metrics: Metrics = request.app.state.metrics
    return metrics


PlannerOf = Annotated[Planner, Depends(_planner_of)]
MetricsOf = Annotated[Metrics, Depends(_metrics_of)]
IncludeAsked = Annotated[
    str,
    Query(
        max_length=100,
        description="What to add to the plan, with commas between. `alternatives`: the other paths "
        "to the slot, and why each is not flown. `paths`: the same as `others`, with the segments "
        "that draw them. `optimality`: how the plan meets Pontryagin's "
        "conditions, with H and the costates along it. Each takes a millisecond or more.",
        examples=["alternatives,optimality"],
    ),
]
router = APIRouter(prefix="/api/v1", tags=["plans"], dependencies=[KNOWN_PARAMETERS_ONLY])


@router.post(
    "/plans",
    summary="Plan a situation",
    responses={
        **response(200, "A plan, or why there is none.", schema_of(Answer)),
        **problem_responses(400, 413, 415, 422, 503),
    },
    openapi_extra=request_body(schema_of(SituationBody), EXAMPLE),
)
async def make_plan(
    request: Request,
    planner: PlannerOf,
    metrics: MetricsOf,
    preparation: PreparationOf,
    include: IncludeAsked = "",
) -> Response:
    """The minimum-time plan with its proof, or the answer that there is no plan, and why."""
    included = _read_include(include, preparation)
    situation, anchor = _read(await read_json(request), SituationBody)
    # 0.1 ms as a rule, but tens where the limit binds: the streams must not wait for it
    given, seconds = await asyncio.to_thread(_answer, situation, anchor, planner, included)
    metrics.count_plan(given["status"], seconds)
    return json_answer(given)


@router.post(
    "/plans/batch",
    summary="Plan many situations",
    responses={
        **response(
            200,
            "An answer for each, in order.",
            list_schema(schema_of(NamedPlan, NamedNoPlan), most=MAX_BATCH),
        ),
        **problem_responses(400, 413, 415, 422, 503),
    },
    openapi_extra=request_body(
        list_schema(schema_of(NamedSituationBody), most=MAX_BATCH), [EXAMPLE]
    ),
)
async def make_plans(
    request: Request,
    planner: PlannerOf,
    metrics: MetricsOf,
    preparation: PreparationOf,
    include: IncludeAsked = "",
) -> Response:
    """Up to 1,000 situations; an answer for each, in order, with its `id` if it has one."""
    included = _read_include(include, preparation)
    bodies = await read_json(request)
    if not isinstance(bodies, list):
        raise Refusal(422, "The body must be a list of situations.")
    if len(bodies) > MAX_BATCH:
        raise Refusal(
            422,
            f"At most {MAX_BATCH} situations a request, not {len(bodies)}.",
        )
    answers = await asyncio.to_thread(_answer_all, bodies, planner, included)
    for given, seconds in answers:
        metrics.count_plan(given["status"], seconds)
    return json_answer([given for given, _ in answers])


def _read_include(text: str, preparation: Preparation) -> tuple[Include, ...]:
    try:
        included = read_include(text)
    except ValueError as error:
        raise Refusal(422, str(error)) from None
    if "optimality" in included:
        preparation.require("proofs")
    return included


def _answer_all(
    bodies: list[object], planner: Planner, included: tuple[Include, ...]
) -> list[tuple[dict[str, Any], float]]:
    # All are read before any is planned: a request is refused as a whole or served as a whole.
    read = [
        (_read(body, NamedSituationBody, under=f"[{index}]"), body)
        for index, body in enumerate(bodies)
    ]
    answers = []
    for (situation, anchor), body in read:
        given, seconds = _answer(situation, anchor, planner, included)
        if isinstance(body, dict) and "id" in body:
            given = {"id": body["id"], **given}
        answers.append((given, seconds))
    return answers


def _read(
    content: object, shape: type[SituationBody], *, under: str = ""
) -> tuple[Situation, Anchor]:
    if not isinstance(content, dict):
        raise Refusal(422, f"{under} must be an object with fields: a situation.".strip())
    try:
        return situation_from_body(parse(shape, content))
    except ContractError as error:
        raise problem_of(error, under=under) from None


def _answer(
    situation: Situation, anchor: Anchor, planner: Planner, included: tuple[Include, ...]
) -> tuple[dict[str, Any], float]:
    """The answer, and how long it took [s]; counted by the caller, on the loop's own thread."""
    started = perf_counter()
    given = answer(situation, anchor, planner, include=included)
    return given, perf_counter() - started
