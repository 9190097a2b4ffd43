"""What is asked for: from the body of a request to a manoeuvre in a sky."""

from math import radians
from typing import NamedTuple

from pydantic import RootModel
from starlette.requests import HTTPConnection

from relguide.atc.request import Manoeuvre
from relguide.atc.tracks import followed_track, intent_track, straight_track
from relguide.contract.bodies import wind_of
from relguide.contract.clearance_bodies import (
    ClearanceRequest,
    DistanceGoal,
    FlightClearanceRequest,
    GeodeticAircraft,
    IntentClearanceRequest,
    expect_goal,
)
from relguide.contract.compass import heading_of
from relguide.contract.intent_bodies import (
    LevelChangePiece,
    StraightPiece,
    TurnPiece,
    intent_from_body,
)
from relguide.contract.refusal import ContractError
from relguide.planning.aircraft import Leader
from relguide_server.atc.desk import Desk
from relguide_server.atc.skies import EARTH
from relguide_server.flights.live_fleet import LiveFleet
from relguide_server.http.access import expect_owner
from relguide_server.http.errors import Refusal


class NewClearance(RootModel[ClearanceRequest]):
    """A request for a clearance: by a flight of this service, or by an aircraft and its intent."""


class Asked(NamedTuple):
    """What is asked for."""

    manoeuvre: Manoeuvre
    sky: str
    flight_id: str = ""
    pursuer: str = ""
    """Its ident in its flight."""


def asked_for(
    body: FlightClearanceRequest | IntentClearanceRequest,
    desk: Desk,
    fleet: LiveFleet,
    connection: HTTPConnection,
    *,
    trial: bool,
) -> Asked:
    """What a request asks for.

    Args:
        body: of the request.
        desk: with all skies.
        fleet: all flights.
        connection: who asks.
        trial: whether nothing is kept of it: then anybody may ask for a flight.

    Raises:
        ContractError: for what the shapes do not rule out.
        Refusal: 403, if the flight is another's; 404, if there is none; 409, if it has nothing to
            ask for.
    """
    if isinstance(body, FlightClearanceRequest):
        flight = fleet.find(body.flight_id)
        if not trial:
            expect_owner(connection, flight.label.owner)
        if flight.over:
            raise Refusal(409, "This flight has ended and asks for nothing: start another one.")
        if flight.label.replay:
            raise Refusal(409, "This is a recording: what it flies was cleared, or not, before.")
        link = desk.skies.link(flight, body.aircraft)
        manoeuvre = desk.skies.manoeuvre(flight, link)
        return Asked(manoeuvre, desk.skies.of(flight), flight.label.id, link.pursuer)
    return _by_intent(body, desk)


def _by_intent(body: IntentClearanceRequest, desk: Desk) -> Asked:
    expect_goal(body)
    aircraft, skies, turned = body.aircraft, desk.skies, 0.0
    if isinstance(aircraft, GeodeticAircraft):
        if body.sky != EARTH:
            raise ContractError([("sky", "is that on the earth for who has lat_deg, lon_deg.")])
        x, y, turned = skies.place(aircraft.lat_deg, aircraft.lon_deg, "aircraft")
    else:
        flight = skies.flight(body.sky)
        if flight is None or skies.of(flight) != body.sky:
            said = "must be a flight with a sky of its own, for who is placed by x_m, y_m."
            raise ContractError([("sky", said)])
        x, y = aircraft.x_m, aircraft.y_m
    now = skies.now(body.sky)
    leader = skies.picture(body.sky, desk.cases.cleared(body.sky)).find(body.traffic_id)
    if leader is None:
        raise ContractError([("traffic_id", f"{body.traffic_id} is not in the picture.")])
    try:
        flown = Leader(
            x=x,
            y=y,
            heading=heading_of(aircraft.heading_deg + turned),
            tas=aircraft.tas_mps,
            intent=intent_from_body(body.intent, turned_deg=turned),
            altitude=aircraft.altitude_m,
        )
    except ValueError as error:
        raise ContractError([("aircraft", str(error))]) from None
    joins = now + flown.trajectory.duration
    until = joins + desk.rules.followed
    goal = body.assigned_spacing_goal
    wind = wind_of(body.wind.from_deg + turned, body.wind.speed_mps)
    turns = [radians(one.bank_deg) for one in body.intent if isinstance(one, TurnPiece)]
    leader_path = leader.path or straight_track(leader, until=until, settings=desk.rules)
    flies = intent_track(flown, start=now, until=max(joins, now + 1.0), wind=wind)
    manoeuvre = Manoeuvre(
        ident=aircraft.ident,
        leader=body.traffic_id,
        spacing_type=goal.type,
        spacing=goal.value_m if isinstance(goal, DistanceGoal) else goal.value_s,
        min_separation=body.min_separation_m,
        path=followed_track(flies, leader_path, until),
        joins=joins,
        leader_path=leader_path,
        word="".join(map(_letter, body.intent)),
        bank=max(turns, default=0.0),
        max_bank=radians(aircraft.max_bank_deg),
    )
    return Asked(manoeuvre, body.sky)


def _letter(piece: StraightPiece | TurnPiece | LevelChangePiece) -> str:
    match piece:
        case TurnPiece(direction=direction):
            return "L" if direction == "left" else "R"
        case StraightPiece():
            return "S"
        case LevelChangePiece():
            return ""
