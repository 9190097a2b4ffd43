"""Routes that plan: a situation in, a plan with its proof out."""

from collections.abc import AsyncIterator
from time import monotonic
from typing import Annotated, Any, Literal

import orjson
from fastapi import APIRouter, Query, Request
from pydantic import BaseModel, ConfigDict, Field, RootModel, create_model
from starlette.responses import Response, StreamingResponse

from relguide.contract.answers import INCLUDABLE, Form, read_include
from relguide.contract.bodies import NamedSituationBody, SituationBody
from relguide.contract.bulk import refused_line
from relguide.contract.document_models import PlanAnswer, model_of
from relguide.contract.messages import PlannerComparison
from relguide.flying.plan_documents import NoPlanCard, PlanCard
from relguide_server.http.bodies import (
    GEOJSON,
    JSON,
    address_of,
    content_type,
    json_answer,
    read_body,
    unless_left,
)
from relguide_server.http.errors import ProblemError, Refusal
from relguide_server.http.openapi import (
    BODY,
    WORK,
    list_schema,
    name_of,
    problem_responses,
    request_body,
    response,
    schema_of,
)
from relguide_server.http.query import KNOWN_PARAMETERS_ONLY, QueryRoute
from relguide_server.planning.plan_service import PlanService, Wish
from relguide_server.planning.tasks import MAX_BATCH
from relguide_server.shares.clients import client_of

MAX_BODY = 64 * 1024
"""Longest body with one situation [bytes]."""
MAX_BATCH_BODY = 4 * 1024 * 1024
"""Longest body of a batch [bytes]: 1,000 situations with 20 pieces of intent each fit in 3 MB."""
NDJSON = "application/x-ndjson"
"""A batch as lines, answered as lines."""
PlannerName = Literal["exact", "network"]
BUDGET_MS, LEAST_MS, MOST_MS = 250.0, 1.0, 10_000.0
"""How long planning a situation may take if the request does not say, and the range of what it may
say."""

_INCLUDED = f" *({'|'.join(INCLUDABLE)})? *"
INCLUDES = f"^{_INCLUDED}(,{_INCLUDED})*$"
"""What `read_include` takes, for the document."""

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
AMID = {
    **EXAMPLE,
    "id": "amid",
    "traffic": [
        {"ident": "BAW12", "x_m": -30000.0, "y_m": -70000.0, "heading_deg": 45.0, "tas_mps": 220.0}
    ],
    "cells": [
        {
            "ident": "CB1",
            "disc": {"x_m": 85000.0, "y_m": -70000.0, "radius_m": 12000.0},
            "velocity_mps": [8.0, 4.0],
            "growth_mps": 2.0,
        }
    ],
}
"""The same amid other traffic and weather."""


class Answer(RootModel[PlanAnswer]):
    """A plan, or why there is none."""


class PlanFeatures(BaseModel):
    """A plan on the earth (RFC 7946); all members of the plan are there as well."""

    model_config = ConfigDict(extra="allow")

    type: Literal["FeatureCollection"] = Field(description="Always the same.")
    features: list[dict[str, Any]] = Field(description="None where there is no plan.")
    status: Literal["planned", "no_plan"] = Field(description="Whether there is a plan.")


_ID: dict[str, Any] = {"id": (str | int, Field(default="", description="As in the request."))}
NamedPlan: type[BaseModel] = create_model(
    "NamedPlan", __base__=model_of(PlanCard), __doc__="A plan of a batch.", **_ID
)
NamedNoPlan: type[BaseModel] = create_model(
    "NamedNoPlan",
    __base__=model_of(NoPlanCard),
    __doc__="No plan for a situation of a batch, and why.",
    **_ID,
)


class BatchQuery(BaseModel):
    """How situations are to be planned."""

    include: str = Field(
        default="",
        max_length=100,
        description="What to add to the plan, with commas between. `alternatives`: the other "
        "paths to the slot, and why each is not flown. `paths`: the same as `others`, with the "
        "segments that draw them. `optimality`: how the plan meets "
        "Pontryagin's conditions, with H and the costates along it; where the path slides "
        "along the minimum separation that takes seconds more than `max_ms`. `flown`: the flight "
        "that guidance makes of it, engaged at once: rolls, a berth beside the minimum "
        "separation and braking included.",
        examples=["alternatives,optimality", "flown"],
        json_schema_extra={"pattern": INCLUDES},
    )
    max_ms: float = Field(
        default=BUDGET_MS,
        ge=LEAST_MS,
        le=MOST_MS,
        allow_inf_nan=False,
        description="How long planning may take, each situation of a batch. Then the answer is "
        "the best plan found, with its bound, or that none was found yet (`deadline`).",
    )
    planner: PlannerName | None = Field(
        default=None,
        description="Who plans; if left out, the one that the service was started with.",
    )

    def wish(self, form: Form = "json") -> Wish:
        """The same as the plan service takes it.

        Raises:
            Refusal: 422, for a word that `include` does not have.
        """
        try:
            included = read_include(self.include)
        except ValueError as error:
            wrong = [ProblemError(path="include", message=str(error))]
            raise Refusal(422, str(error), errors=wrong) from None
        return Wish(planner=self.planner, include=included, budget=self.max_ms * 1e-3, form=form)


class CompareQuery(BaseModel):
    """How planners are to be compared."""

    max_ms: float = Field(
        default=BUDGET_MS,
        ge=LEAST_MS,
        le=MOST_MS,
        allow_inf_nan=False,
        description="How long the exact planner may take.",
    )


class PlanQuery(BatchQuery):
    """How a situation is to be planned, and the plan written."""

    form: Form = Field(
        default="json",
        alias="format",
        description="`geojson`: a FeatureCollection with the path (`path`), that of the leader "
        "until it is joined (`leader`), where it is joined (`slot`), those of other traffic until "
        "then (`traffic-0` …) and, with `include=paths`, the other paths (`other-0` …), each point "
        "with its time (`t_s`); and cells as polygons at t = 0 (`cell-0` …), beside the members of "
        "the plan. For situations by latitude and longitude.",
    )


router = APIRouter(
    prefix="/api/v1",
    tags=["plans"],
    dependencies=[KNOWN_PARAMETERS_ONLY],
    route_class=QueryRoute,
    generate_unique_id_function=name_of,
)


@router.post(
    "/plans",
    summary="Plan a situation",
    responses={
        200: {
            "description": "A plan, or why there is none.",
            "content": {
                JSON: {"schema": schema_of(Answer)},
                GEOJSON: {"schema": schema_of(PlanFeatures)},
            },
        },
        **problem_responses(*BODY, *WORK),
    },
    openapi_extra=request_body(schema_of(SituationBody), EXAMPLE),
)
async def make_plan(request: Request, query: Annotated[PlanQuery, Query()]) -> Response:
    """The minimum-time plan with its proof, or the answer that there is no plan, and why.

    A plan depends on its situation alone: there is no seed.
    """
    wish = query.wish(query.form)
    end = monotonic() + wish.budget
    plan_service: PlanService = request.app.state.plan_service
    body = await read_body(request, JSON, most=MAX_BODY)
    client = client_of(request.scope)
    answered = plan_service.answer_at_once(body, wish, client=client)
    if answered is None:
        planning = plan_service.answer_by_worker(body, wish, end, client=client)
        answered = await unless_left(request, planning)
    request.app.state.records.note_plan(
        body,
        planner=wish.planner or "",
        status=answered.status,
        seconds=answered.seconds,
        asked_by=address_of(request),
    )
    media_type = GEOJSON if wish.form == "geojson" else JSON
    return json_answer(plan_service.count(answered), media_type=media_type)


@router.post(
    "/plans/compare",
    summary="Compare planners",
    responses={
        **response(200, "What each would fly.", schema_of(PlannerComparison)),
        **problem_responses(*BODY, *WORK),
    },
    openapi_extra=request_body(schema_of(SituationBody), EXAMPLE),
)
async def compare_planners(request: Request, query: Annotated[CompareQuery, Query()]) -> Response:
    """What four planners would fly in a situation, what that costs, and where each fails.

    `exact` solves all words; `network` asks networks which to solve; `regular_dp` asks the paper's
    tree; `printed_network` flies what the paper's network gives, as the paper prints it. Each is
    judged alike. One whose kernels are being compiled says so (`preparing`): ask again.
    """
    plan_service: PlanService = request.app.state.plan_service
    body = await read_body(request, JSON, most=MAX_BODY)
    compared = plan_service.compare(body, query.max_ms * 1e-3, client=client_of(request.scope))
    return json_answer(await unless_left(request, compared))


@router.post(
    "/plans/batch",
    summary="Plan many situations",
    responses={
        200: {
            "description": "An answer for each, in order.",
            "content": {
                JSON: {"schema": list_schema(schema_of(NamedPlan, NamedNoPlan), most=MAX_BATCH)},
                NDJSON: {"schema": {"type": "string", "description": "An answer a line."}},
            },
        },
        **problem_responses(*BODY, *WORK),
    },
    openapi_extra={
        "requestBody": {
            "required": True,
            "content": {
                JSON: {
                    "schema": list_schema(schema_of(NamedSituationBody), most=MAX_BATCH),
                    "example": [EXAMPLE | {"id": "a"}, AMID],
                },
                NDJSON: {
                    "schema": {"type": "string", "description": "A situation a line."},
                    "example": orjson.dumps(EXAMPLE).decode() + "\n",
                },
            },
        }
    },
)
async def make_plans(request: Request, query: Annotated[BatchQuery, Query()]) -> Response:
    """Up to 1,000 situations; an answer for each, in order, with its `id` if it has one.

    A list is answered by a list, or refused as a whole if one situation is wrong. Lines
    (`application/x-ndjson`) are answered by lines as they are planned, and a wrong one by a line
    with the status `invalid`; should the service stop meanwhile, or a worker end, the rest are
    answered by lines with the status `refused`.
    """
    wish = query.wish()
    plan_service: PlanService = request.app.state.plan_service
    body = await read_body(request, JSON, NDJSON, most=MAX_BATCH_BODY)
    if content_type(request) == NDJSON:
        lines = [line for line in body.splitlines() if line.strip()]
        if len(lines) > MAX_BATCH:
            raise Refusal(422, f"At most {MAX_BATCH} situations a request, not {len(lines)}.")
        answers = plan_service.answer_batch(lines, wish, client=client_of(request.scope))
        first = await unless_left(request, anext(answers, []))
        return StreamingResponse(_write_lines(lines, first, answers), media_type=NDJSON)
    listed = _answer_list(body, plan_service, wish, client_of(request.scope))
    return json_answer(await unless_left(request, listed))


async def _write_lines(
    lines: list[bytes], first: list[bytes], others: AsyncIterator[list[bytes]]
) -> AsyncIterator[bytes]:
    written = len(first)
    yield b"".join(text + b"\n" for text in first)
    try:
        async for answers in others:
            written += len(answers)
            yield b"".join(text + b"\n" for text in answers)
    except Refusal as refusal:  # the answer has begun: what is left of it says so
        yield b"".join(refused_line(line, refusal.detail) + b"\n" for line in lines[written:])


async def _answer_list(body: bytes, plan_service: PlanService, wish: Wish, client: str) -> bytes:
    lines = await plan_service.split(body, client=client)
    batch = plan_service.answer_batch(lines, wish, client=client)
    answers = [text async for texts in batch for text in texts]
    return b"[" + b",".join(answers) + b"]"
