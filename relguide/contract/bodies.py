"""A situation as outsiders send it: strict shapes with units in their names, and their meaning.

Positions are x, y of the world frame or latitude, longitude (WGS84), in both aircraft alike, and in
all that they keep clear of. In the second case the world frame is the plane that touches the earth
at the leader, and headings, which are clockwise from true north where the aircraft is, are turned
by the angle between its meridian and the plane's north. Wind is taken at the leader.
"""

from collections.abc import Mapping
from itertools import pairwise
from math import degrees, radians
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import Discriminator, Field, Tag

from relguide.contract.accepted import Accepted
from relguide.contract.compass import compass, heading_of
from relguide.contract.intent_bodies import Bank, ClimbRate, Intent, intent_from_body
from relguide.contract.other_bodies import CellList, Distance, Tas, TrafficList, others_from_body
from relguide.contract.places import (
    Altitude,
    Anchor,
    Heading,
    Latitude,
    Longitude,
    Position,
    Unanchored,
    place_near,
    which_position,
)
from relguide.contract.refusal import ContractError, Strict, parse
from relguide.contract.wire import to_wire
from relguide.flying.plan_documents import (
    FlownCard,
    NotFlownCard,
    OtherPathCard,
    PlanCard,
)
from relguide.planning import limits
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.frames import LocalPlane
from relguide.planning.intent import LevelChange
from relguide.planning.situation import Situation
from relguide.planning.wind import CALM, Wind, wind_from

if TYPE_CHECKING:
    from relguide.flying.verdicts import PlannerVerdict

MAX_ID = 200
"""Longest accepted `id` [characters]."""
MAX_INTEGER = 2**53 - 1
"""Largest integer that every reader of JSON keeps exact."""


class PlannedLevel(Strict):
    """A climb or a descent of the pursuer."""

    at_s: Annotated[float, Accepted(limits.PIECE)]
    """When it begins."""
    to_altitude_m: Altitude
    """Pressure altitude to level off at."""
    rate_mps: ClimbRate
    """How fast to climb or to descend."""


PlannedLevels = Annotated[list[PlannedLevel], Field(max_length=limits.MAX_PIECES)]


class LocalPursuer(Strict):
    """The aircraft that is guided, at t = 0."""

    x_m: Position
    """East."""
    y_m: Position
    """North."""
    heading_deg: Heading
    """Clockwise from true north."""
    tas_mps: Tas
    """True airspeed, kept constant."""
    max_bank_deg: Bank
    """Bank of its turns."""
    altitude_m: Altitude | None = None
    """Pressure altitude; if left out it is not known, and height keeps nothing apart."""
    levels: Annotated[PlannedLevels, Field(default_factory=list)]
    """Changes of level that it will make, in order; if left out, the planner chooses them."""


class GeodeticPursuer(Strict):
    """The aircraft that is guided, at t = 0, placed on the earth (WGS84)."""

    lat_deg: Latitude
    """WGS84."""
    lon_deg: Longitude
    """WGS84."""
    heading_deg: Heading
    """Clockwise from true north."""
    tas_mps: Tas
    """True airspeed, kept constant."""
    max_bank_deg: Bank
    """Bank of its turns."""
    altitude_m: Altitude | None = None
    """Pressure altitude; if left out it is not known, and height keeps nothing apart."""
    levels: Annotated[PlannedLevels, Field(default_factory=list)]
    """Changes of level that it will make, in order; if left out, the planner chooses them."""


class LocalLeader(Strict):
    """The aircraft to be joined, at t = 0, with what it has declared it will do."""

    x_m: Position
    """East."""
    y_m: Position
    """North."""
    heading_deg: Heading
    """Clockwise from true north."""
    tas_mps: Tas
    """True airspeed, kept constant."""
    intent: Annotated[Intent, Field(default_factory=list)]
    """Pieces to come; what follows the last is flown for ever."""
    altitude_m: Altitude | None = None
    """Pressure altitude; if left out it is not known, and height keeps nothing apart."""


class GeodeticLeader(Strict):
    """The aircraft to be joined, at t = 0, placed on the earth (WGS84)."""

    lat_deg: Latitude
    """WGS84."""
    lon_deg: Longitude
    """WGS84."""
    heading_deg: Heading
    """Clockwise from true north."""
    tas_mps: Tas
    """True airspeed, kept constant."""
    intent: Annotated[Intent, Field(default_factory=list)]
    """Pieces to come; what follows the last is flown for ever."""
    altitude_m: Altitude | None = None
    """Pressure altitude; if left out it is not known, and height keeps nothing apart."""


class WindBody(Strict):
    """Uniform wind as reports give it."""

    from_deg: Heading
    """Where it comes from, clockwise from true north."""
    speed_mps: Annotated[float, Accepted(limits.WIND)]
    """How strong it is."""


class SituationBody(Strict):
    """Everything a plan depends on, at one instant."""

    pursuer: Annotated[
        Annotated[LocalPursuer, Tag("#local")] | Annotated[GeodeticPursuer, Tag("#geodetic")],
        Discriminator(which_position),
    ]
    """The aircraft that is guided."""
    leader: Annotated[
        Annotated[LocalLeader, Tag("#local")] | Annotated[GeodeticLeader, Tag("#geodetic")],
        Discriminator(which_position),
    ]
    """The aircraft to be joined."""
    slot_distance_m: Distance
    """D: how far behind the leader the pursuer is to be."""
    min_separation_m: Distance
    """d_min: how close the two may come; at most D."""
    wind: WindBody = WindBody(from_deg=0.0, speed_mps=0.0)
    """Left out: calm."""
    traffic: Annotated[TrafficList, Field(default_factory=list)]
    """Other aircraft, to be kept clear of until two minutes after joining."""
    cells: Annotated[CellList, Field(default_factory=list)]
    """Weather, to be kept out of as long."""


def _which_id(value: Any) -> str:
    return "#text" if isinstance(value, str) else "#number"


class NamedSituationBody(SituationBody):
    """A situation of a batch."""

    id: Annotated[
        Annotated[Annotated[str, Field(max_length=MAX_ID)], Tag("#text")]
        | Annotated[Annotated[int, Field(ge=-MAX_INTEGER, le=MAX_INTEGER)], Tag("#number")],
        Discriminator(_which_id),
    ] = ""
    """Given back with the answer."""


def situation_from_json(source: bytes | str | Mapping[str, object]) -> tuple[Situation, Anchor]:
    """Read a situation from JSON text, or from JSON already parsed.

    Returns:
        the situation, and how its world frame lies on the earth.

    Raises:
        ContractError: naming each field that is wrong.
    """
    return situation_from_body(parse(SituationBody, source))


def situation_from_body(body: SituationBody) -> tuple[Situation, Anchor]:
    """A situation whose shape is right, in library units.

    Raises:
        ContractError: for what a shape cannot rule out, like D < d_min.
    """
    pursuer, leader, anchor = _aircraft(body)
    if not limits.CLEARANCE.admits(body.slot_distance_m - body.min_separation_m):
        wrong = limits.too_close_a_slot(body.slot_distance_m, body.min_separation_m)
        raise ContractError([("slot_distance_m", wrong)])
    others = others_from_body(body.traffic, body.cells, anchor, body.min_separation_m)
    try:
        return (
            Situation(
                pursuer=pursuer,
                leader=leader,
                slot_distance=body.slot_distance_m,
                min_separation=body.min_separation_m,
                wind=wind_of(body.wind.from_deg, body.wind.speed_mps),
                others=others,
            ),
            anchor,
        )
    except ValueError as error:  # a rule of `Situation` that the shapes above do not know
        raise ContractError([("", str(error))]) from None


def plan_to_wire(card: PlanCard, anchor: Anchor) -> dict[str, Any]:
    """A plan as a JSON object; every point with latitude and longitude if the situation came so."""
    return path_to_wire(card, anchor)


def path_to_wire(
    card: "PlanCard | OtherPathCard | PlannerVerdict", anchor: Anchor
) -> dict[str, Any]:
    """A card with segments as a JSON object, its points as above."""
    answer = to_wire(card)
    match anchor:
        case LocalPlane():
            _place_segments(answer, anchor)
        case Unanchored():
            pass
    return answer


def _place_segments(answer: dict[str, Any], plane: LocalPlane) -> None:
    for segment in answer["segments"]:
        segment["start"] = _point_to_wire(segment["start"], plane)
        segment["end"] = _point_to_wire(segment["end"], plane)


def flown_to_wire(card: FlownCard | NotFlownCard, anchor: Anchor) -> dict[str, Any]:
    """The flight of a plan as a JSON object, its points as above."""
    answer = to_wire(card)
    if isinstance(card, FlownCard) and isinstance(anchor, LocalPlane):
        answer["points"] = [_point_to_wire(point, anchor) for point in answer["points"]]
        _place_segments(answer, anchor)
    return answer


def _aircraft(body: SituationBody) -> tuple[Pursuer, Leader, Anchor]:
    match body.pursuer, body.leader:
        case LocalPursuer() as p, LocalLeader() as l:
            return (
                _pursuer(p, p.x_m, p.y_m, heading_of(p.heading_deg)),
                _leader(l, l.x_m, l.y_m, heading_of(l.heading_deg)),
                Unanchored(),
            )
        case GeodeticPursuer() as p, GeodeticLeader() as l:
            plane = LocalPlane(l.lat_deg, l.lon_deg)
            place = place_near(plane, p.lat_deg, p.lon_deg, "pursuer")
            heading = heading_of(p.heading_deg + place.turned_deg)
            return (
                _pursuer(p, place.x, place.y, heading),
                _leader(l, 0.0, 0.0, heading_of(l.heading_deg)),
                plane,
            )
        case _:
            message = "must have x_m, y_m or lat_deg, lon_deg in both aircraft alike."
            raise ContractError([("pursuer", message), ("leader", message)])


def _pursuer(body: LocalPursuer | GeodeticPursuer, x: float, y: float, heading: float) -> Pursuer:
    levels = tuple(
        LevelChange(at=level.at_s, to_altitude=level.to_altitude_m, rate=level.rate_mps)
        for level in body.levels
    )
    for index, (before, level) in enumerate(pairwise(levels), start=1):
        if level.at < before.at:
            said = "must not be before that of the level in front of it."
            raise ContractError([(f"pursuer.levels[{index}].at_s", said)])
    return Pursuer(
        x=x,
        y=y,
        heading=heading,
        tas=body.tas_mps,
        max_bank=radians(body.max_bank_deg),
        altitude=body.altitude_m,
        levels=levels,
    )


def _leader(body: LocalLeader | GeodeticLeader, x: float, y: float, heading: float) -> Leader:
    return Leader(
        x=x,
        y=y,
        heading=heading,
        tas=body.tas_mps,
        intent=intent_from_body(body.intent),
        altitude=body.altitude_m,
    )


def wind_of(from_deg: float, speed: float) -> Wind:
    """A wind as reports give it: from where [°], and its speed [m/s]."""
    return wind_from(heading_of(from_deg), speed) if speed != 0.0 else CALM


def _point_to_wire(point: dict[str, Any], plane: LocalPlane) -> dict[str, Any]:
    lat, lon = plane.to_geodetic(point["x_m"], point["y_m"])
    return {
        **point,
        "heading_deg": compass(point["heading_deg"] - degrees(plane.meridian(lat, lon))),
        "lat_deg": lat,
        "lon_deg": lon,
    }
