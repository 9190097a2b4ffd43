"""What the controllers' stream and REST say of clearances: units, frames as in `flying.documents`.

Times are of the sky: UTC [s] in the one on the earth, flight time in that of a flight.
"""

from dataclasses import dataclass, field
from typing import Literal

from relguide.atc.clearances import Actor, State
from relguide.atc.request import SpacingType
from relguide.flying.plan_documents import LEFT_OUT
from relguide.units import Metre, MetrePerSecond, Radian, Second

Verdict = Literal["acceptable", "unable", "standby"]
ReasonCode = Literal[
    "separation", "airspace", "bank", "speed", "leader_disagrees", "traffic_without_intent",
    "stale_picture", "expired", "horizon", "slot_taken", "conformance", "crew", "controller",
]  # fmt: skip
DeviationKind = Literal["across", "along", "spacing", "level", "turn"]
DeviationLevel = Literal["none", "caution", "alert"]


@dataclass(frozen=True, slots=True, kw_only=True)
class TrackCard:
    """A track in columns of equal length: straight lines between knots."""

    t: tuple[Second, ...]
    """Of its knots, ascending."""
    x: tuple[Metre, ...]
    """East."""
    y: tuple[Metre, ...]
    """North."""
    altitude: tuple[Metre, ...] = field(default=(), metadata=LEFT_OUT)
    """Pressure altitude in the middle of what is possible; left out where it is not known."""
    low: tuple[Metre, ...] = field(default=(), metadata=LEFT_OUT)
    """It is at least this high …"""
    high: tuple[Metre, ...] = field(default=(), metadata=LEFT_OUT)
    """… and at most this; both are left out with the altitude."""
    error: Metre = field(default=0.0, metadata=LEFT_OUT)
    """What is flown strays from these lines by no more than this, at its time."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PlaceAt:
    """A place at a time."""

    t: Second
    """When."""
    x: Metre
    """East."""
    y: Metre
    """North."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PairCard:
    """How near a manoeuvre comes to another aircraft."""

    ident: str
    """The other aircraft."""
    at: Second
    """When they are closest, as both are expected to fly."""
    least: Metre
    """How close."""
    proved_above: Metre
    """They are proved never to be closer while both stay on their tracks."""
    bound: Metre
    """What is added then for what may differ."""
    minimum: Metre
    """What is to be kept."""
    vertical: tuple[Metre, ...] = field(default=(), metadata=LEFT_OUT)
    """Least height between the two then; left out where it is not known."""
    certainty: Literal["certain", "possible", "clear"]
    """certain: too close as both are expected to fly; possible: by what may differ."""
    own: PlaceAt
    """Where the manoeuvre is when they are closest."""
    other: PlaceAt
    """Where the other aircraft is then."""
    since: Second
    """From when they are too close, by what may differ …"""
    until: Second
    """… until when; both are `at` where they are clear."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Finding:
    """Why a manoeuvre is not acceptable."""

    reason: ReasonCode
    """In a word."""
    text: str
    """In the words of data link, e.g. UNABLE DUE TO TRAFFIC BAW12."""
    message: str
    """In a sentence, with what would help."""
    idents: tuple[str, ...] = field(default=(), metadata=LEFT_OUT)
    """Of the aircraft or airspaces that it is about."""


@dataclass(frozen=True, slots=True, kw_only=True)
class AlternativeManoeuvre:
    """A manoeuvre that is acceptable, tried as the one that was asked for was."""

    change: Literal["later", "word", "spacing", "level"]
    """What is different."""
    message: str
    """In a sentence."""
    begins: Second
    """How much later it begins."""
    word: str
    """Letters of its plan."""
    spacing: Metre
    """D."""
    joins: Second
    """When it is in its place."""
    least: Metre
    """How near it comes to any aircraft but its leader."""
    route: TrackCard
    """What is flown."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ValidationCard:
    """What automation finds of a manoeuvre. It advises: the controller decides."""

    verdict: Verdict
    """In a word."""
    findings: tuple[Finding, ...]
    """None where it is acceptable."""
    pairs: tuple[PairCard, ...]
    """Those that matter, least margin first."""
    alternatives: tuple[AlternativeManoeuvre, ...]
    """Acceptable ones, soonest first; only where it is not."""
    valid_until: Second
    """It holds until then if nobody leaves what conformance allows."""
    computed: Second
    """When it was computed."""
    picture_as_of: Second
    """How old the picture was that it was computed on."""
    aircraft: int
    """How many others were looked at."""


@dataclass(frozen=True, slots=True, kw_only=True)
class StateChange:
    """A step in the life of a clearance."""

    state: State
    """It is from then on."""
    t: Second
    """When, in the time of its sky."""
    at: str
    """Wall clock, UTC, ISO 8601."""
    by: Actor
    """Who brought it there."""
    reason: str = field(default="", metadata=LEFT_OUT)
    """A `ReasonCode`, where there is one."""
    message: str
    """In a sentence, or in the words of data link."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Deviation:
    """How far an aircraft is from what it is cleared to fly, of one kind."""

    subject: DeviationKind
    """In what."""
    level: DeviationLevel
    """How far."""
    amount: float
    """Beside the path, from D, from the level [m]; before or behind [s]; of a turn how late [s]."""
    unit: Literal["m", "s"]
    """Of the amount."""
    since: Second
    """Since when it is at this level or above."""
    message: str
    """In a sentence."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ClearanceCard:
    """A clearance: what is asked for, what automation finds, what was answered."""

    id: str
    """To ask for it by."""
    sky: str
    """Empty: the one on the earth; else the flight whose sky it is."""
    flight_id: str = field(default="", metadata=LEFT_OUT)
    """The flight that flies it, if it is one of this service."""
    clearance_type: Literal["capture_then_maintain"] = "capture_then_maintain"
    """What is asked for."""
    aircraft: str
    """Who asks."""
    traffic_id: str
    """Behind whom."""
    spacing_type: SpacingType
    """What is kept behind the traffic."""
    slot_distance: Metre = 0.0
    """D; 0 with spacing by time."""
    spacing_time: Second = 0.0
    """Time behind the leader; 0 with spacing by distance."""
    min_separation: Metre
    """From the leader."""
    word: str
    """Letters of the plan; empty where they are not known."""
    text: str
    """The request in the words of data link."""
    state: State
    """How far it has come."""
    due: Second
    """When it expires if nothing happens; 0 where nothing expires."""
    joins: Second
    """When it is in its place."""
    route: TrackCard
    """What is to be flown."""
    leader_route: TrackCard
    """What its traffic is expected to fly."""
    bank: Radian = field(default=0.0, metadata=LEFT_OUT)
    """That its turns need; left out where it is not known."""
    max_bank: Radian = field(default=0.0, metadata=LEFT_OUT)
    """That the aircraft has; left out where it is not known."""
    validation: tuple[ValidationCard, ...]
    """The last one; none before the first."""
    deviations: tuple[Deviation, ...]
    """Those that stand now."""
    history: tuple[StateChange, ...]
    """Oldest first."""
    auto_answer: bool
    """Whether the automation answers in the controller's place, as in a demonstration."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TrafficCard:
    """An aircraft of the picture, for a controller's label."""

    ident: str
    x: Metre
    """East."""
    y: Metre
    """North."""
    track: Radian
    """Direction of its ground velocity."""
    ground_speed: MetrePerSecond
    altitude: Metre = field(default=0.0, metadata=LEFT_OUT)
    """Pressure altitude; left out where it is not known."""
    climb: MetrePerSecond = field(default=0.0, metadata=LEFT_OUT)
    age: Second
    """How long ago it was seen."""
    intends: bool
    """Whether its intent is known."""
    source: str
    """Who reports it: a flight of this service, `traffic` (put by REST), or a feed."""
    flight_id: str = field(default="", metadata=LEFT_OUT)


@dataclass(frozen=True, slots=True, kw_only=True)
class AirspaceCard:
    """A closed part of the sky."""

    ident: str
    x: tuple[Metre, ...]
    y: tuple[Metre, ...]
    text: str
    """Its levels and times, e.g. FL200–FL310 until 14:30."""
    closed: bool
    """Whether it is closed now."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SkyCard:
    """A sky: one plane, one clock. Flights without a place on the earth have one each."""

    id: str
    """Empty: the one on the earth."""
    title: str
    airspaces: tuple[AirspaceCard, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class ClearanceChanged:
    """A clearance is new, or something of it is."""

    t: Second
    clearance: ClearanceCard
    kind: Literal["clearance_changed"] = "clearance_changed"


@dataclass(frozen=True, slots=True, kw_only=True)
class TrafficSeen:
    """A sky at one instant: once a second."""

    t: Second
    sky: SkyCard
    aircraft: tuple[TrafficCard, ...]
    kind: Literal["traffic"] = "traffic"


@dataclass(frozen=True, slots=True, kw_only=True)
class ProbeChanged:
    """What is accepted or flown was validated again, and the verdict is another."""

    t: Second
    id: str
    """The clearance."""
    validation: ValidationCard
    kind: Literal["probe_changed"] = "probe_changed"


@dataclass(frozen=True, slots=True, kw_only=True)
class ConformanceChanged:
    """A deviation begins, changes its level, or ends."""

    t: Second
    id: str
    """The clearance."""
    aircraft: str
    deviations: tuple[Deviation, ...]
    """All that stand now."""
    message: str
    kind: Literal["conformance"] = "conformance"


@dataclass(frozen=True, slots=True, kw_only=True)
class Expired:
    """A clearance was not answered, or not begun, in time."""

    t: Second
    id: str
    """The clearance."""
    message: str
    kind: Literal["expired"] = "expired"


AtcDocument = ClearanceChanged | TrafficSeen | ProbeChanged | ConformanceChanged | Expired
"""What the controllers' stream brings."""
