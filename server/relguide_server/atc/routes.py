"""Routes of clearances: ask, try, answer, reply, read; and the controllers' stream."""

import asyncio
from typing import Annotated

import orjson
from fastapi import APIRouter, Path, Query, Request, WebSocket
from starlette.responses import Response

from relguide.atc.cards import track_card
from relguide.atc.clearances import State
from relguide.atc.phraseology import request_text
from relguide.contract.clearance_bodies import (
    ClearanceAnswer,
    ClearanceList,
    ClearanceModel,
    ClearanceReply,
    ClearanceTrial,
    SkyTraffic,
)
from relguide.contract.protocol import ATC_STREAM, PROTOCOL
from relguide.contract.refusal import ContractError, parse
from relguide.contract.upstream import Upstream
from relguide.contract.wire import placed_to_wire
from relguide_server.atc.cases import Case
from relguide_server.atc.desk import Desk, DeskOf
from relguide_server.atc.intents import traffic_body
from relguide_server.atc.requests import NewClearance, asked_for
from relguide_server.atc.skies import EARTH
from relguide_server.flights.frames import NOT_UNDERSTOOD, UnwelcomeFrame
from relguide_server.flights.live_fleet import FleetOf
from relguide_server.flights.stream import TOO_MANY, WRONG_PROTOCOL
from relguide_server.flights.watchers import TooManyWatch
from relguide_server.http.access import expect_owner, may_answer, owner_of
from relguide_server.http.bodies import address_of, json_answer, read_object
from relguide_server.http.errors import Refusal, refusal_of
from relguide_server.http.idempotency import IdempotentRoute
from relguide_server.http.openapi import BODY, problem_responses, request_body, response, schema_of
from relguide_server.http.proxy import root_of
from relguide_server.http.query import KNOWN_PARAMETERS_ONLY
from relguide_server.records.service import RecordsOf
from relguide_server.shares.clients import client_of

MOST = 500
"""Most clearances in an answer."""
NOT_YOURS = "This clearance is another's flight's: you do not answer it."
ONLY_LISTEN = "This stream is only listened to: answers and replies go by REST."
ASK = {"flight_id": "3f2a9c0d71be"}

router = APIRouter(
    prefix="/api/v1",
    tags=["clearances"],
    dependencies=[KNOWN_PARAMETERS_ONLY],
    route_class=IdempotentRoute,
)

ClearanceId = Annotated[
    str, Path(description="As `POST /clearances` gave it.", examples=["9c0d71be3f2a"])
]
RECORDED = ("Relguide-Recorded",)


@router.post(
    "/clearances",
    status_code=201,
    summary="Ask for a clearance",
    responses={
        **response(200, "With `dry_run`: what would be found.", schema_of(ClearanceTrial)),
        **response(
            201,
            "It is being validated.",
            schema_of(ClearanceModel),
            headers=("Location", *RECORDED),
        ),
        **problem_responses(*BODY, "not-allowed", "not-found", "conflict", "too-many-clearances"),
    },
    openapi_extra=request_body(schema_of(NewClearance), ASK),
)
async def ask_clearance(
    request: Request,
    desk: DeskOf,
    fleet: FleetOf,
    records: RecordsOf,
    dry_run: Annotated[
        bool, Query(description="Whether to say what would be found, and keep nothing of it.")
    ] = False,
) -> Response:
    """The answer comes at once, with the state `validating`; the stream says what becomes of it.

    A flight asks for what its guidance flies or proposes; any other aircraft for the intent that it
    declares, behind traffic of the picture. The words are those of interval management: capture the
    assigned spacing goal behind that traffic, then maintain it.
    """
    try:
        content = await read_object(request)
        body = parse(NewClearance, content).root
        asked = asked_for(body, desk, fleet, request, trial=dry_run)
    except ContractError as error:
        raise refusal_of(error) from None
    if dry_run:
        found = await desk.automation.try_out(
            asked.manoeuvre, asked.sky, flight_id=asked.flight_id, pursuer=asked.pursuer
        )
        plane = desk.skies.plane(asked.sky)
        place = None if plane is None else plane.to_geodetic
        return json_answer(
            {
                "text": request_text(asked.manoeuvre),
                "joins_s": asked.manoeuvre.joins,
                "route": placed_to_wire(track_card(asked.manoeuvre.path), place),
                "leader_route": placed_to_wire(track_card(asked.manoeuvre.leader_path), place),
                "validation": placed_to_wire(found, place),
            }
        )
    client = client_of(request.scope)
    desk.cases.expect_room(client)
    case = desk.ask(
        asked.manoeuvre,
        sky=asked.sky,
        flight_id=asked.flight_id,
        pursuer=asked.pursuer,
        request=orjson.dumps(content).decode(),
        client=client,
        owner=owner_of(request),
        asked_by=address_of(request),
    )
    place_of_it = f"{root_of(request.scope)}/api/v1/clearances/{case.clearance.id}"
    return await _answer(case, records, status=201, headers={"Location": place_of_it})


@router.get(
    "/clearances",
    summary="All clearances",
    responses={
        **response(200, "Those that live first.", schema_of(ClearanceList)),
        **problem_responses("invalid"),
    },
)
async def list_clearances(
    desk: DeskOf,
    records: RecordsOf,
    state: Annotated[State | None, Query(description="How far it has come.")] = None,
    limit: Annotated[int, Query(ge=1, le=MOST, description="How many at most.")] = 100,
) -> Response:
    """Those that are over too, as far as they are on record, and other runs' of the service."""
    known = sorted(desk.cases, key=lambda case: (not case.lives, -case.asked_at))
    found = [case.as_json() for case in known if state in (None, case.state)][:limit]
    if len(found) < limit and records.opened():
        from relguide_server.records import queries

        ids = {case.clearance.id for case in known}
        most = limit + len(ids)
        recorded = await records.read(lambda s: queries.find_clearances(s, state, most))
        found += [one for one in recorded if one["id"] not in ids][: limit - len(found)]
    return json_answer({"clearances": found})


@router.get(
    "/clearances/{clearance_id}",
    summary="One clearance",
    responses={
        **response(200, "All of it.", schema_of(ClearanceModel)),
        **problem_responses("not-found"),
    },
)
async def show_clearance(clearance_id: ClearanceId, desk: DeskOf, records: RecordsOf) -> Response:
    """As it is now; one of another run of the service as it was recorded last."""
    case = desk.cases.get(clearance_id)
    if case is not None:
        return json_answer(case.as_json())
    if records.opened():
        from relguide_server.records import queries

        found = await records.read(lambda s: queries.read_clearance(s, clearance_id))
        if found is not None:
            return json_answer(found)
    return json_answer(desk.find(clearance_id).as_json())  # refuses


@router.post(
    "/clearances/{clearance_id}/answers",
    summary="Answer as its controller",
    responses={
        **response(200, "What it is now.", schema_of(ClearanceModel), headers=RECORDED),
        **problem_responses(*BODY, "not-allowed", "not-found", "conflict"),
    },
    openapi_extra=request_body(schema_of(ClearanceAnswer), {"answer": "accepted"}),
)
async def answer_clearance(
    clearance_id: ClearanceId, request: Request, desk: DeskOf, records: RecordsOf
) -> Response:
    """Automation only advises: the controller accepts, refuses, or tells the crew to stand by."""
    case = desk.find(clearance_id)
    if not may_answer(request, case.owner):
        raise Refusal(403, NOT_YOURS)
    try:
        said = parse(ClearanceAnswer, await read_object(request))
    except ContractError as error:
        raise refusal_of(error) from None
    desk.answer(case, said)
    return await _answer(case, records)


@router.post(
    "/clearances/{clearance_id}/replies",
    summary="Reply as its crew",
    responses={
        **response(200, "What it is now.", schema_of(ClearanceModel), headers=RECORDED),
        **problem_responses(*BODY, "not-allowed", "not-found", "conflict"),
    },
    openapi_extra=request_body(schema_of(ClearanceReply), {"reply": "WILCO"}),
)
async def reply_clearance(
    clearance_id: ClearanceId, request: Request, desk: DeskOf, records: RecordsOf
) -> Response:
    """WILCO is validated once more: what is not acceptable any more becomes `unable`."""
    case = desk.find(clearance_id)
    expect_owner(request, case.owner)
    try:
        said = parse(ClearanceReply, await read_object(request))
    except ContractError as error:
        raise refusal_of(error) from None
    await desk.reply(case, said)
    return await _answer(case, records)


@router.get(
    "/atc/traffic",
    summary="A sky as traffic to keep clear of",
    responses={
        **response(200, "Who flies, and what each intends.", schema_of(SkyTraffic)),
        **problem_responses("invalid", "not-found"),
    },
)
async def show_sky(
    desk: DeskOf,
    sky: Annotated[
        str, Query(max_length=100, description="Empty: that on the earth; else a flight's.")
    ] = EARTH,
) -> Response:
    """What is cleared, filed or declared is intended; `traffic` is as `POST /plans` takes it.

    All keep the controller's minimum. A plan takes a hundred at most: choose those that matter.
    """
    if sky != EARTH and desk.skies.flight(sky) is None:
        raise Refusal(404, f"There is no sky {sky!r}: it is a flight's, or empty.")
    await desk.skies.prepare(sky)
    now, plane = desk.skies.now(sky), desk.skies.plane(sky)
    seen = desk.skies.picture(sky, desk.cases.cleared(sky)).aircraft
    minimum = desk.rules.minimum

    def gather() -> list[dict[str, object]]:
        bodies = (traffic_body(one, now, plane, minimum) for one in seen)
        return [body for body in bodies if body is not None]

    return json_answer({"sky": sky, "t_s": now, "traffic": await asyncio.to_thread(gather)})


@router.websocket("/atc/stream")
async def atc_stream(
    websocket: WebSocket,
    desk: DeskOf,
    first: Annotated[int | None, Query(alias="from", ge=0)] = None,
    answers: bool = True,
) -> None:
    """What happens at the desk; the first frame is a snapshot, or what is new since `?from=`.

    While one is open of who may answer, and `?answers=false` does not say that it only looks on,
    the automation does not answer in the controller's place.
    """
    offered = websocket.scope["subprotocols"]
    spoken = [name for name in offered if name in (PROTOCOL, ATC_STREAM)]
    if not spoken:
        await websocket.accept(next(iter(offered), None))
        page = f"The service's own page speaks {PROTOCOL}: load it again."
        await websocket.close(WRONG_PROTOCOL, f"Name the sub-protocol {ATC_STREAM}. {page}")
        return
    await websocket.accept(spoken[0])
    try:
        with desk.listeners.joined_by(websocket):
            await _oversee(desk, websocket, first, answers=answers and may_answer(websocket, ""))
    except TooManyWatch as refused:
        await websocket.close(TOO_MANY, str(refused))


async def _oversee(desk: Desk, websocket: WebSocket, first: int | None, *, answers: bool) -> None:
    """Send what happens until either side ends it."""
    client = desk.journal.join(first)
    desk.answering += answers
    try:
        await client.pump(websocket, _refuse_frame)
    finally:
        desk.answering -= answers
        desk.journal.leave(client)


def _refuse_frame(frame: Upstream) -> None:
    raise UnwelcomeFrame(NOT_UNDERSTOOD, ONLY_LISTEN)


async def _answer(
    case: Case,
    records: RecordsOf,
    *,
    status: int = 200,
    headers: dict[str, str] | None = None,
) -> Response:
    """A clearance as it is now, once that is on record."""
    content = case.as_json()
    recorded = {"Relguide-Recorded": "yes" if await records.saved() else "no"}
    return json_answer(content, status, headers={**(headers or {}), **recorded})
