"""Clearances as outsiders ask for them, answer them and reply to them; and the controllers' stream.

The words are those of interval management: who asks captures an assigned spacing goal behind its
traffic, and maintains it.
"""

from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import Discriminator, Field, Tag, model_validator

from relguide.atc.documents import ClearanceCard, ReasonCode, TrackCard, ValidationCard
from relguide.contract.bodies import WindBody
from relguide.contract.document_models import AtcDocumentModel, model_of
from relguide.contract.intent_bodies import Bank, Piece
from relguide.contract.messages import SpacingTime
from relguide.contract.other_bodies import AnyTraffic, Distance, Ident, Tas
from relguide.contract.places import (
    Altitude,
    Heading,
    Latitude,
    Longitude,
    Position,
    which_position,
)
from relguide.contract.refusal import ContractError, Strict
from relguide.planning import limits

MAX_MESSAGE = 200
"""Longest sentence that goes with an answer or a reply [characters]."""
Message = Annotated[str, Field(max_length=MAX_MESSAGE)]
Capture = Literal["capture_then_maintain"]
FlightId = Annotated[str, Field(max_length=100)]

ClearanceModel: Any = model_of(ClearanceCard)
"""A clearance as it is read."""


class DistanceGoal(Strict):
    """A distance to keep behind the traffic."""

    type: Literal["distance"]
    """What is kept."""
    value_m: Distance
    """D, along the traffic's route behind it."""


class TimeGoal(Strict):
    """A time to keep behind the traffic."""

    type: Literal["time"]
    """What is kept."""
    value_s: SpacingTime
    """How long after the traffic the aircraft is where it was."""


SpacingGoal = Annotated[DistanceGoal | TimeGoal, Field(discriminator="type")]


class LocalAircraft(Strict):
    """Who asks, now, in the sky of a flight."""

    ident: Ident
    """Its name in the picture."""
    x_m: Position
    """East."""
    y_m: Position
    """North."""
    heading_deg: Heading
    """Clockwise from true north."""
    tas_mps: Tas
    """True airspeed, kept constant."""
    max_bank_deg: Bank
    """The bank that it has."""
    altitude_m: Altitude | None = None
    """Pressure altitude; if left out it is not known, and height keeps nothing apart."""


class GeodeticAircraft(Strict):
    """Who asks, now, placed on the earth (WGS84)."""

    ident: Ident
    """Its name in the picture."""
    lat_deg: Latitude
    """WGS84."""
    lon_deg: Longitude
    """WGS84."""
    heading_deg: Heading
    """Clockwise from true north."""
    tas_mps: Tas
    """True airspeed, kept constant."""
    max_bank_deg: Bank
    """The bank that it has."""
    altitude_m: Altitude | None = None
    """Pressure altitude; if left out it is not known, and height keeps nothing apart."""


class FlightClearanceRequest(Strict):
    """A flight of this service asks for what its guidance flies or proposes."""

    flight_id: FlightId
    """As `POST /flights` gave it."""
    aircraft: Annotated[str, Field(max_length=100)] = ""
    """Ident of its pursuer; if left out, the first link's."""
    clearance_type: Capture = "capture_then_maintain"
    """What is asked for."""


class IntentClearanceRequest(Strict):
    """An aircraft asks for what it declares that it will fly."""

    aircraft: Annotated[
        Annotated[LocalAircraft, Tag("#local")] | Annotated[GeodeticAircraft, Tag("#geodetic")],
        Discriminator(which_position),
    ]
    """Who asks."""
    intent: Annotated[list[Piece], Field(min_length=1, max_length=limits.MAX_PIECES)]
    """What it flies from now on, until it is in its place behind its traffic."""
    clearance_type: Capture = "capture_then_maintain"
    """What is asked for."""
    traffic_id: Ident
    """Behind whom: its ident in the picture."""
    assigned_spacing_goal: SpacingGoal
    """What it keeps there."""
    min_separation_m: Distance
    """How near it may come to that traffic; at most the goal."""
    wind: WindBody = WindBody(from_deg=0.0, speed_mps=0.0)
    """Left out: calm."""
    sky: FlightId = ""
    """The flight whose sky it is, for who is placed by x, y; empty for the one on the earth."""

    @model_validator(mode="before")
    @classmethod
    def _expect_a_request(cls, value: Any) -> Any:
        if isinstance(value, Mapping) and "aircraft" not in value and "intent" not in value:
            raise ValueError("must have a flight_id, or an aircraft and its intent.")
        return value


def _which_request(value: Any) -> str:
    if isinstance(value, Mapping):
        return "#flight" if "flight_id" in value else "#intent"
    return "#flight" if isinstance(value, FlightClearanceRequest) else "#intent"


ClearanceRequest = Annotated[
    Annotated[FlightClearanceRequest, Tag("#flight")]
    | Annotated[IntentClearanceRequest, Tag("#intent")],
    Discriminator(_which_request),
]
"""A request for a clearance."""


class ClearanceAnswer(Strict):
    """What the controller says to a request, or does with a clearance."""

    answer: Literal["accepted", "unable", "standby", "cancelled", "terminated"]
    """cancelled: the clearance is taken back; terminated: who deviates is cleared no more."""
    reason: Literal[ReasonCode, ""] = ""
    """Why, of unable; if left out, the controller's own."""
    message: Message = ""
    """In words; if left out, those of data link."""


class ClearanceReply(Strict):
    """What the crew says to its clearance."""

    reply: Literal["WILCO", "UNABLE", "CANCEL"]
    """WILCO: it will comply, if the clearance is still acceptable; UNABLE: it does not take what
    was accepted; CANCEL: it withdraws."""
    message: Message = ""
    """In words."""


class ClearanceTrial(Strict):
    """What a request would be found to be; nothing is kept of it."""

    text: str
    """The request in the words of data link."""
    joins_s: float
    """When it would be in its place, in the time of its sky."""
    route: model_of(TrackCard)  # type: ignore[valid-type]
    """What would be flown."""
    leader_route: model_of(TrackCard)  # type: ignore[valid-type]
    """What its traffic is expected to fly."""
    validation: model_of(ValidationCard)  # type: ignore[valid-type]
    """What automation finds."""


class ClearanceList(Strict):
    """Clearances."""

    clearances: list[ClearanceModel]
    """Those that live first, then those that are over; the newest first."""


class SkyTraffic(Strict):
    """A sky as traffic that a plan keeps clear of."""

    sky: str
    """Empty: the one on the earth; else the flight whose sky it is."""
    t_s: float
    """The time of the sky that this holds for."""
    traffic: list[AnyTraffic]
    """As `POST /plans` takes it, in still air: where each is now, and what it intends."""


class AtcFrame(Strict):
    """A frame of the controllers' stream: what happened since the last one, in order."""

    kind: Literal["atc"]
    """Which frame it is."""
    number: int
    """Of its last document. To ask for what follows: `?from=` this number and one."""
    snapshot: bool
    """Whether it is all that stands now, in place of what is not known here any more."""
    documents: list[AtcDocumentModel]
    """Of traffic only the newest of each sky."""


def expect_goal(request: IntentClearanceRequest) -> None:
    """Refuse a goal that is nearer than the minimum.

    Raises:
        ContractError: for a distance below `min_separation_m`.
    """
    goal = request.assigned_spacing_goal
    if isinstance(goal, DistanceGoal) and goal.value_m < request.min_separation_m:
        wrong = limits.too_close_a_slot(goal.value_m, request.min_separation_m)
        raise ContractError([("assigned_spacing_goal.value_m", wrong)])
