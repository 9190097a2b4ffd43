"""Routes of flights: start one, watch it, command it, end it."""

import asyncio
from functools import partial
from typing import Annotated, Any

from fastapi import APIRouter, Path, Request, WebSocket
from pydantic import RootModel
from starlette.responses import Response

from relguide.contract.commands import (
    Command,
    PauseCommand,
    PlayCommand,
    SetRateCommand,
)
from relguide.contract.messages import FlightList, FlightRequest, FlightStatus, ScenarioList
from relguide.contract.protocol import PROTOCOL, STREAM
from relguide.contract.refusal import ContractError, parse
from relguide_server.flights.catalogue import CatalogueOf
from relguide_server.flights.flight_commands import give_command, guidance_of
from relguide_server.flights.flight_requests import kept_request
from relguide_server.flights.live_fleet import FleetOf
from relguide_server.flights.live_flight import LiveFlight
from relguide_server.flights.peers import Peers
from relguide_server.flights.reported_leader import begun_at_report
from relguide_server.flights.stream import TOO_MANY, UNKNOWN_FLIGHT, WRONG_PROTOCOL
from relguide_server.flights.watchers import TooManyWatch
from relguide_server.http.access import expect_owner, may_command, owner_of
from relguide_server.http.bodies import (
    address_of,
    expect_object,
    json_answer,
    read_flights,
    read_object,
)
from relguide_server.http.errors import Refusal, refusal_of
from relguide_server.http.etags import tagged_answer
from relguide_server.http.idempotency import IdempotentRoute
from relguide_server.http.openapi import (
    BODY,
    header_references,
    problem_responses,
    request_body,
    response,
    schema_of,
    tagged_response,
)
from relguide_server.http.proxy import root_of
from relguide_server.http.query import KNOWN_PARAMETERS_ONLY
from relguide_server.http.security_headers import VERSION
from relguide_server.readiness import PreparationOf
from relguide_server.records.entries import FlightCard
from relguide_server.records.recorder import Recorder
from relguide_server.records.service import RecordsOf
from relguide_server.shares.clients import client_of


class NewFlight(RootModel[FlightRequest]):
    """A request for a new flight: the name of a scenario, or a situation of your own."""


class FlightCommand(RootModel[Command]):
    """A command to a flight."""


FlightId = Annotated[
    str, Path(description="As `POST /flights` gave it.", examples=["3f2a9c0d71be"])
]
ENDED: dict[int | str, dict[str, Any]] = {
    204: {"description": "It is over.", "headers": header_references(["Relguide-Recorded"])}
}

router = APIRouter(
    prefix="/api/v1",
    tags=["flights"],
    dependencies=[KNOWN_PARAMETERS_ONLY],
    route_class=IdempotentRoute,
)


@router.get(
    "/scenarios",
    summary="Scenarios that can be flown",
    responses=tagged_response("All scenarios.", schema_of(ScenarioList)),
)
async def list_scenarios(request: Request, catalogue: CatalogueOf) -> Response:
    """The paper's cases and ours; one whose data are missing says what to install."""
    return tagged_answer(request, (await asyncio.to_thread(catalogue.scenarios)).model_dump())


@router.post(
    "/flights",
    status_code=201,
    summary="Start a flight",
    responses={
        **response(
            201,
            "It is in the air.",
            schema_of(FlightStatus),
            headers=("Location", "Relguide-Recorded"),
            leads_to=("show_flight", "command_flight", "end_flight", "show_recorded"),
        ),
        **problem_responses(*BODY, "too-many-flights", "mistake", "preparing"),
    },
    openapi_extra=request_body(schema_of(NewFlight), {"scenario": "fig_6b", "rate": 10.0}),
)
async def start_flight(
    request: Request,
    fleet: FleetOf,
    catalogue: CatalogueOf,
    preparation: PreparationOf,
    records: RecordsOf,
) -> Response:
    """It flies at `rate` simulated seconds per second, until it is ended or no longer watched.

    Guidance is engaged unless `engagement` says otherwise. The header `Relguide-Recorded` says
    whether it is on record already (`yes`) or not, or not yet (`no`).
    """
    try:
        asked = await read_flights(request, _read)
        wanted = begun_at_report(asked, request.app.state.reported_place)
        # A recorded leader is read from a file: not on the event loop.
        departure = await asyncio.to_thread(catalogue.find, wanted)
        kept = await asyncio.to_thread(kept_request, wanted)
    except ContractError as error:
        raise refusal_of(error) from None
    if departure.first is not None:
        await asyncio.to_thread(
            preparation.admit, departure.first, request.app.state.settings.planner
        )

    def record(flight_id: str) -> Recorder:
        card = FlightCard(
            id=flight_id,
            scenario=departure.scenario,
            title=departure.title,
            request=kept,
            settings=request.app.state.settings.text_for_records(),
            seed=wanted.seed,
            requested_by=address_of(request),
        )
        return records.begin(card)

    flight = await fleet.launch(
        departure.scenario,
        departure.title,
        departure.source,
        rate=wanted.rate,
        paused=wanted.paused,
        record=record,
        modelled=wanted.by_hand is not False,
        reported_leader=getattr(wanted, "reported_leader", None) or "",
        owner=owner_of(request),
        client=client_of(request.scope),
        anchor=departure.anchor,
        seed=wanted.seed,
    )
    status = status_of(flight, request)
    headers = {
        "Location": f"{root_of(request.scope)}/api/v1/flights/{status.id}",
        "Relguide-Recorded": "yes" if await records.saved() else "no",
    }
    return json_answer(status.model_dump(), 201, headers=headers)


@router.get(
    "/flights",
    summary="All flights",
    responses=response(200, "All flights.", schema_of(FlightList)),
)
async def list_flights(request: Request, fleet: FleetOf) -> Response:
    """Those in the air, and those that ended a short while ago; of all processes, if several fly.

    Which of these did not answer, `missing` says, if any. `Relguide-Process: a` asks for those of
    process a alone.
    """
    peers: Peers = request.app.state.peers
    others, missing = await peers.flights(request)
    own = [status_of(flight, request) for flight in fleet]
    listed = FlightList(flights=own + others, missing=missing)
    return json_answer(listed.model_dump(exclude=None if missing else {"missing"}))


@router.get(
    "/flights/{flight_id}",
    summary="One flight",
    responses={
        **response(200, "Where it stands.", schema_of(FlightStatus)),
        **problem_responses("not-found"),
    },
)
async def show_flight(flight_id: FlightId, request: Request, fleet: FleetOf) -> Response:
    """Where it stands now."""
    return json_answer(status_of(fleet.find(flight_id), request).model_dump())


@router.delete(
    "/flights/{flight_id}",
    status_code=204,
    summary="End a flight",
    responses=ENDED | problem_responses("not-allowed", "not-found"),
)
async def end_flight(
    flight_id: FlightId, request: Request, fleet: FleetOf, records: RecordsOf
) -> Response:
    """Its streams and its scene close with it.

    Where the header `Relguide-Recorded` says `yes`, what is read of its record then is all of it;
    `no`: not yet, or it is not recorded.
    """
    expect_owner(request, fleet.find(flight_id).label.owner)
    await fleet.remove(flight_id)
    is_whole = await records.saved(to_the_end=True)
    return Response(status_code=204, headers={"Relguide-Recorded": "yes" if is_whole else "no"})


@router.post(
    "/flights/{flight_id}/commands",
    status_code=202,
    summary="Tell a flight something",
    responses={
        **response(
            202,
            "The command was passed on.",
            schema_of(FlightStatus),
            headers=("Relguide-Recorded",),
        ),
        **problem_responses(*BODY, "not-allowed", "not-found", "conflict"),
    },
    openapi_extra=request_body(
        schema_of(FlightCommand), {"command": "leader_heading", "heading_deg": 135.0}
    ),
)
async def command_flight(
    flight_id: FlightId, request: Request, fleet: FleetOf, records: RecordsOf
) -> Response:
    """Pause, go on, another rate; what the leader flies and tells; and what the crew engages.

    A crew that takes control (`set_autopilot` off) flies by hand, by `stick`.

    Commands to a paused flight take effect when it continues, within a second of flight. The
    header `Relguide-Recorded` says whether the command is on record already.
    """
    flight = fleet.find(flight_id)
    expect_owner(request, flight.label.owner)
    try:
        command = parse(FlightCommand, await read_object(request)).root
    except ContractError as error:
        raise refusal_of(error) from None
    if flight.over:
        raise Refusal(409, "This flight has ended and takes no commands: start another one.")
    if flight.label.replay and not isinstance(command, PlayCommand | PauseCommand | SetRateCommand):
        raise Refusal(409, "This is a recording: it takes play, pause and set_rate only.")
    give_command(flight, command)
    unnamed = {"ident"} if getattr(command, "ident", None) == "" else None
    body = command.model_dump_json(exclude=unnamed)
    records.note_command(flight_id, t=flight.t, body=body, sent_by=address_of(request))
    headers = {"Relguide-Recorded": "yes" if await records.saved() else "no"}
    return json_answer(status_of(flight, request).model_dump(), 202, headers=headers)


@router.websocket("/flights/{flight_id}/stream")
async def stream(websocket: WebSocket, flight_id: str, fleet: FleetOf) -> None:
    """Ticks of a flight; the sub-protocol says for which form of them the client was built.

    A client that may command the flight may fly it by hand over this socket as well.
    """
    offered = websocket.scope["subprotocols"]
    spoken = [name for name in offered if name in (PROTOCOL, STREAM)]
    if not spoken:
        # a browser hears the reason only where one of those that it offered is taken
        await websocket.accept(next(iter(offered), None))
        page = f"The service's own page speaks {PROTOCOL}: load it again."
        await websocket.close(WRONG_PROTOCOL, f"Name the sub-protocol {STREAM}. {page}")
        return
    await websocket.accept(spoken[0])
    if not fleet.knows(flight_id):
        await websocket.close(UNKNOWN_FLIGHT, "There is no such flight: it has been removed.")
        return
    flight = fleet.find(flight_id)
    try:
        with flight.watchers.joined_by(websocket):
            await _show(flight, websocket)
    except TooManyWatch as refused:
        await websocket.close(TOO_MANY, str(refused))


async def _show(flight: LiveFlight, websocket: WebSocket) -> None:
    """Send ticks, and hear frames, until either side ends it."""
    client = flight.join()
    hear = partial(flight.hear, client, may_command=may_command(websocket, flight.label.owner))
    try:
        await client.pump(websocket, hear)
    finally:
        flight.leave(client)


def _read(content: object) -> FlightRequest:
    """What is asked to be flown.

    Raises:
        ContractError: naming each field that is wrong.
    """
    wanted: FlightRequest = parse(NewFlight, expect_object(content)).root
    return wanted


def status_of(flight: LiveFlight, request: Request) -> FlightStatus:
    """Where a flight stands, for who asks."""
    guidance = guidance_of(flight)
    label, pace, root = flight.label, flight.pace, root_of(request.scope)
    return FlightStatus(
        id=label.id,
        scenario=label.scenario,
        title=label.title,
        t_s=flight.t,
        rate=pace.rate,
        paused=pace.paused,
        ended=flight.over,
        outcome=flight.outcome,
        started_at=flight.started_at,
        mode=guidance.mode,
        engagement=guidance.engagement,
        joined=guidance.joined,
        separation_m=guidance.separation,
        stream_url=f"{root}/api/v1/flights/{label.id}/stream",
        scene_url=f"{root}/scene/{label.id}/",
        seed=label.seed,
        version=VERSION,
        recorded=flight.recorded,
    )
