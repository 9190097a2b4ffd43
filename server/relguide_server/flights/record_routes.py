"""Routes of what is on record: find flights, read, replay and remove them."""

from datetime import datetime
from itertools import tee
from typing import Annotated, Literal

from fastapi import APIRouter, Depends, Query, Request
from pydantic import AfterValidator, AwareDatetime, BeforeValidator
from starlette.responses import Response

from relguide.contract.document_models import from_wire
from relguide.contract.messages import FlightStatus
from relguide.contract.recorder import VERSION
from relguide.contract.refusal import ContractError, parse
from relguide_server.flights.live_fleet import FleetOf
from relguide_server.flights.recorded import (
    READING,
    RecordedId,
    anchor_of,
    expect_no_null,
    expect_open,
    find_recorded,
    not_on_record,
)
from relguide_server.flights.routes import status_of
from relguide_server.http.access import owner_of
from relguide_server.http.bodies import json_answer, read_object
from relguide_server.http.errors import Refusal, refusal_of
from relguide_server.http.etags import tagged_answer
from relguide_server.http.idempotency import IdempotentRoute
from relguide_server.http.openapi import (
    BODY,
    problem_responses,
    request_body,
    response,
    schema_of,
    tagged_response,
)
from relguide_server.http.proxy import root_of
from relguide_server.http.query import KNOWN_PARAMETERS_ONLY
from relguide_server.records.bodies import (
    RecordedDocuments,
    RecordedFlightDetails,
    RecordedFlightList,
    RecordedPlanList,
    ReplayRequest,
)
from relguide_server.records.cursors import place_of
from relguide_server.records.entries import Outcome, Place, RecordSearch
from relguide_server.records.recorder import Recorder
from relguide_server.records.service import RecordsOf
from relguide_server.shares.clients import client_of

MOST = 500
"""Most flights or plans in an answer."""
MOST_DOCUMENTS = 1000
"""Most documents in an answer."""


router = APIRouter(
    prefix="/api/v1/records",
    tags=["records"],
    dependencies=[KNOWN_PARAMETERS_ONLY, Depends(expect_open)],
    route_class=IdempotentRoute,
)


def _expect_no_number(text: str) -> str:
    """Pydantic takes numbers for seconds since 1970, which nobody who writes a year means."""
    try:
        float(text)
    except ValueError:
        return text
    raise ValueError(f"must be a time, as 2026-11-23T06:30:00Z, not {text[:40]}.")


Moment = Annotated[AwareDatetime, BeforeValidator(_expect_no_number)]
Since = Annotated[Moment | None, Query(description="Begun at this time or later.")]
Until = Annotated[Moment | None, Query(description="Begun before this time.")]
Limit = Annotated[int, Query(ge=1, le=MOST, description="How many at most.")]
Cursor = Annotated[
    str | None,
    Query(max_length=200, description="Go on where an answer ended: its `next`; else the newest."),
]


@router.get(
    "/flights",
    summary="Flights on record",
    responses={
        **tagged_response("The newest first.", schema_of(RecordedFlightList)),
        **problem_responses(*READING, "invalid"),
    },
)
async def list_recorded(
    request: Request,
    records: RecordsOf,
    since: Since = None,
    until: Until = None,
    scenario: Annotated[
        str | None,
        Query(max_length=100, description="Its name; empty: one's own situations."),
        AfterValidator(lambda name: name and expect_no_null(name)),
    ] = None,
    outcome: Annotated[Outcome | None, Query(description="What became of it.")] = None,
    limit: Limit = 100,
    cursor: Cursor = None,
) -> Response:
    """Those in the air as well; what is new of them is here within a second."""
    from relguide_server.records import queries

    search = RecordSearch(
        since=since.timestamp() if since else None,
        until=until.timestamp() if until else None,
        scenario=scenario,
        outcome=outcome,
        limit=limit,
        after=_place_of(cursor),
    )
    found = await records.read(lambda s: queries.find_flights(s, search))
    return tagged_answer(request, {"flights": found.rows, "next": found.next, "total": found.total})


@router.get(
    "/plans",
    summary="Plans on record",
    responses={
        **tagged_response("The newest first.", schema_of(RecordedPlanList)),
        **problem_responses(*READING, "invalid"),
    },
)
async def list_plans(
    request: Request,
    records: RecordsOf,
    since: Since = None,
    until: Until = None,
    status: Annotated[
        Literal["planned", "no_plan"] | None, Query(description="Of the answer.")
    ] = None,
    limit: Limit = 100,
    cursor: Cursor = None,
) -> Response:
    """The situations of `POST /plans`, at most as many a second as the service is set to keep."""
    from relguide_server.records import queries

    search = RecordSearch(
        since=since.timestamp() if since else None,
        until=until.timestamp() if until else None,
        outcome=status,
        limit=limit,
        after=_place_of(cursor),
    )
    found = await records.read(lambda s: queries.find_plans(s, search))
    return tagged_answer(request, {"plans": found.rows, "next": found.next, "total": found.total})


@router.get(
    "/flights/{flight_id}",
    summary="One flight on record",
    responses={
        **tagged_response("All but its documents.", schema_of(RecordedFlightDetails)),
        **problem_responses(*READING),
    },
)
async def show_recorded(flight_id: RecordedId, request: Request, records: RecordsOf) -> Response:
    """What was asked, by whom, with which settings; the commands given; and how it went."""
    return tagged_answer(request, await find_recorded(flight_id, records))


@router.get(
    "/flights/{flight_id}/documents",
    summary="Documents of a flight",
    responses={
        **tagged_response("In order.", schema_of(RecordedDocuments)),
        **problem_responses(*READING, "invalid"),
    },
)
async def list_documents(
    flight_id: RecordedId,
    request: Request,
    records: RecordsOf,
    first: Annotated[int, Query(ge=0, le=10**9, description="From this number on.")] = 0,
    limit: Annotated[
        int, Query(ge=1, le=MOST_DOCUMENTS, description="How many at most.")
    ] = MOST_DOCUMENTS,
) -> Response:
    """As the stream sends them, each with its number; of samples one a second of flight."""
    from relguide_server.records import queries

    await find_recorded(flight_id, records)
    found = await records.read(lambda s: queries.read_documents(s, flight_id, first, limit))
    following = found[-1][0] + 1 if found else first
    listed = b",".join(b'{"number":%d,"document":%s}' % (n, line.strip()) for n, line in found)
    return tagged_answer(request, b'{"documents":[%s],"next":%d}' % (listed, following))


@router.post(
    "/flights/{flight_id}/replay",
    status_code=201,
    summary="Fly a recording again",
    responses={
        **response(
            201,
            "It is in the air.",
            schema_of(FlightStatus),
            headers=("Location",),
            leads_to=("show_flight", "command_flight", "end_flight"),
        ),
        **problem_responses(*BODY, *READING, "conflict", "too-many-flights", "mistake"),
    },
    openapi_extra=request_body(schema_of(ReplayRequest), {"rate": 10.0}),
)
async def replay_flight(
    flight_id: RecordedId, request: Request, records: RecordsOf, fleet: FleetOf
) -> Response:
    """A flight with a stream and a scene of its own, which takes `play`, `pause` and `set_rate`."""
    from relguide_server.records import queries

    try:
        wanted = parse(ReplayRequest, await read_object(request))
    except ContractError as error:
        raise refusal_of(error) from None
    about = await find_recorded(flight_id, records)
    if about["form"] != VERSION:
        raise Refusal(409, f"It was recorded by relguide {about['version']}, in another form.")
    read, kept = await records.read(lambda s: tee(queries.each_chunk(s, flight_id)))
    if not any(line.startswith(b'{"kind":"sample"') for lines in read for line in lines):
        raise Refusal(409, "Nothing of this flight was kept that could be shown.")
    del read
    flight = await fleet.launch(
        about["scenario"],
        about["title"],
        lambda commands: (from_wire(line) for lines in kept for line in lines),
        rate=wanted.rate,
        paused=wanted.paused,
        record=lambda _: Recorder(datetime.fromisoformat(about["started_at"]).timestamp()),
        replay=True,
        owner=owner_of(request),
        client=client_of(request.scope),
        anchor=anchor_of(about["request"]),
        seed=about["seed"],
    )
    headers = {"Location": f"{root_of(request.scope)}/api/v1/flights/{flight.label.id}"}
    return json_answer(status_of(flight, request).model_dump(), 201, headers=headers)


@router.delete(
    "/flights/{flight_id}",
    status_code=204,
    summary="Remove a flight from the records",
    responses={
        204: {"description": "It is removed."},
        **problem_responses(*READING, "conflict"),
    },
)
async def remove_recorded(flight_id: RecordedId, records: RecordsOf) -> Response:
    """With its documents and commands; one that flies must be ended first."""
    from relguide_server.records import queries

    match await records.read(lambda s: queries.remove_flight(s, flight_id)):
        case None:
            raise not_on_record(flight_id)
        case "flying":
            raise Refusal(409, "It is in the air: end it first (DELETE /api/v1/flights/…).")
    return Response(status_code=204)


def _place_of(cursor: str | None) -> Place | None:
    """Where a list goes on; `None` for its beginning."""
    try:
        return None if cursor is None else place_of(cursor)
    except ValueError as error:
        raise refusal_of(ContractError([("cursor", str(error))])) from None
