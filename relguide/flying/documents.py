"""What a flight says of itself: the documents of the recorder, the stream and the display alike.

Library units inside (SI, radians); `contract/wire.py` gives each its JSON form, in which every
field's name ends in the unit that its type names here. Positions are over the ground, headings
clockwise from north. `t` is the flight's own time [s] from its start; times inside a `PlanCard`
count from the instant the plan was made, as they do in the REST answer.
"""

from dataclasses import dataclass
from typing import Literal

from relguide.flying.announcements import Mode as Mode
from relguide.flying.announcements import PlanReason as PlanReason
from relguide.planning.acceptance import Fault as Fault
from relguide.planning.plan import Proof, Reason
from relguide.units import (
    Metre,
    MetrePerSecond,
    Millisecond,
    Radian,
    RadianPerSecond,
    Second,
)

Direction = Literal["left", "right"]
Passes = Literal["behind", "ahead"]
LeaderChange = Literal["heading", "speed", "intent_received", "intent_withdrawn"]


@dataclass(frozen=True, slots=True, kw_only=True)
class PathPoint:
    """A place and a heading along a path, over the ground."""

    t: Second
    x: Metre
    y: Metre
    heading: Radian


@dataclass(frozen=True, slots=True, kw_only=True)
class TurnSegment:
    """A turn at constant bank. In wind its ground path is a trochoid: air-mass arc + wind × t."""

    direction: Direction
    angle: Radian
    bank: Radian
    """|φ| [rad]."""
    radius: Metre
    duration: Second
    start: PathPoint
    end: PathPoint
    kind: Literal["turn"] = "turn"


@dataclass(frozen=True, slots=True, kw_only=True)
class StraightSegment:
    """A piece at constant heading."""

    length: Metre
    """In the air mass [m]."""
    duration: Second
    start: PathPoint
    end: PathPoint
    kind: Literal["straight"] = "straight"


@dataclass(frozen=True, slots=True, kw_only=True)
class BoundarySegment:
    """A boundary arc along d = d_min with less than full bank."""

    side: Direction
    """The side it turns to: left boundary arcs counter-clockwise round the leader."""
    duration: Second
    start: PathPoint
    end: PathPoint
    via: tuple[PathPoint, ...]
    """Points between, close enough to draw straight lines."""
    kind: Literal["boundary"] = "boundary"


PathSegment = TurnSegment | StraightSegment | BoundarySegment


@dataclass(frozen=True, slots=True, kw_only=True)
class Separation:
    """Least separation along a plan, and what is proved of it."""

    least: Metre
    at: Second
    proved_above: Metre


@dataclass(frozen=True, slots=True, kw_only=True)
class ArrivalCard:
    """How a plan's end meets eq. (7): the pursuer at the slot, on the leader's heading, it open."""

    slot_error: Metre
    """Distance from the slot when the plan ends."""
    heading_error: Radian
    """Between its last heading and the leader's final one."""
    early: Second
    """How long before the slot opens it ends; 0 if the slot is open then."""


@dataclass(frozen=True, slots=True, kw_only=True)
class OptimalityCard:
    """What is proved of a plan's time; and, if asked for, how it meets Pontryagin's conditions."""

    proof: Proof
    lower_bound: Second


@dataclass(frozen=True, slots=True, kw_only=True)
class AlternativeCard:
    """Another path to the slot that lost because it is no faster.

    `as_fast`: it arrives with the plan. `faster`: it keeps the limit and was not found, which only
    a planner that is not exact lets happen.
    """

    word: str
    time_to_converge: Second
    turning: Radian
    """How much it turns in all, left and right added."""
    passes: Passes
    """Whether it crosses the line ahead of the leader on its final leg."""
    side: Direction
    """How it goes round the leader: left is counter-clockwise, with the leader on its left hand."""
    why: str
    """Why it is not flown, e.g. `38 s slower`."""
    rejected: Literal["slower", "as_fast", "faster"] = "slower"


@dataclass(frozen=True, slots=True, kw_only=True)
class UnsafeAlternativeCard:
    """Another path to the slot that lost because it comes too close."""

    word: str
    time_to_converge: Second
    turning: Radian
    """How much it turns in all, left and right added."""
    passes: Passes
    """Whether it crosses the line ahead of the leader on its final leg."""
    side: Direction
    """How it goes round the leader: left is counter-clockwise, with the leader on its left hand."""
    least_separation: Metre
    at: Second
    why: str
    """Why it is not flown, e.g. `comes within 4.22 NM at 212 s`."""
    rejected: Literal["separation"] = "separation"


@dataclass(frozen=True, slots=True, kw_only=True)
class EarlyAlternativeCard:
    """A word that reaches the place of the slot before it opens."""

    word: str
    time_to_converge: Second
    release_time: Second
    """When the slot opens."""
    why: str
    rejected: Literal["not_open"] = "not_open"


@dataclass(frozen=True, slots=True, kw_only=True)
class MissingAlternativeCard:
    """A word of which no path reaches the slot."""

    word: str
    why: str
    rejected: Literal["no_root"] = "no_root"


AnyAlternativeCard = (
    AlternativeCard | UnsafeAlternativeCard | EarlyAlternativeCard | MissingAlternativeCard
)


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanCard:
    """A plan as outsiders read it: the answer of REST, of the command line, and of the display."""

    planner: str
    """Who made it: `exact`, `network`, `regular_dp`, or the name of a planner of one's own."""
    word: str
    time_to_converge: Second
    length: Metre
    """Path length in the air mass [m]."""
    segments: tuple[PathSegment, ...]
    separation: Separation
    arrival: ArrivalCard
    optimality: OptimalityCard
    alternatives: tuple[AnyAlternativeCard, ...] = ()
    """By time; words without any path last. In an answer only if asked for."""
    compute: Millisecond
    status: Literal["planned"] = "planned"


@dataclass(frozen=True, slots=True, kw_only=True)
class NoPlanCard:
    """No plan, why, and what would help."""

    reason: Reason
    message: str
    status: Literal["no_plan"] = "no_plan"


@dataclass(frozen=True, slots=True, kw_only=True)
class WindCard:
    """Uniform wind as reports give it."""

    from_: Radian
    """Where it comes from, clockwise from north [rad]. JSON name: from_deg."""
    speed: MetrePerSecond


@dataclass(frozen=True, slots=True, kw_only=True)
class AircraftCard:
    """Who an aircraft is."""

    ident: str
    aircraft_type: str
    max_bank: Radian


@dataclass(frozen=True, slots=True, kw_only=True)
class AircraftSample:
    """One aircraft at one instant, as it flies (roll dynamics included)."""

    x: Metre
    y: Metre
    heading: Radian
    track: Radian
    """Direction of the ground velocity."""
    bank: Radian
    """Positive right wing down."""
    turn_rate: RadianPerSecond
    """Positive to the right."""
    tas: MetrePerSecond
    ground_speed: MetrePerSecond
    altitude: Metre


@dataclass(frozen=True, slots=True, kw_only=True)
class FlightStarted:
    """All that is known before the flight: the first document."""

    t: Second
    scenario: str
    title: str
    planner: str
    """Who makes the plans, as in `PlanCard`."""
    pursuer: AircraftCard
    leader: AircraftCard
    slot_distance: Metre
    min_separation: Metre
    wind: WindCard
    step: Second
    """Integration step [s]."""
    seed: int
    kind: Literal["flight_started"] = "flight_started"


@dataclass(frozen=True, slots=True, kw_only=True)
class LeaderRoute:
    """What guidance expects the leader to fly from now on: its declared intent, or straight ahead.

    Times in the segments are flight times. The last segment is the final leg, cut short.
    """

    t: Second
    intent_known: bool
    segments: tuple[PathSegment, ...]
    kind: Literal["leader_route"] = "leader_route"


@dataclass(frozen=True, slots=True, kw_only=True)
class LeaderChanged:
    """The leader does something new, or its intent was received or withdrawn."""

    t: Second
    change: LeaderChange
    message: str
    kind: Literal["leader_changed"] = "leader_changed"


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanChanged:
    """A new plan is flown."""

    t: Second
    reason: PlanReason
    message: str
    plan: PlanCard
    leader_at_closest: PathPoint
    """Where the leader is when the separation is least; its t counts from the plan's start."""
    pursuer_at_closest: PathPoint
    """Where the pursuer is then."""
    kind: Literal["plan_changed"] = "plan_changed"


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanUnavailable:
    """Guidance asked for a plan and there is none."""

    t: Second
    answer: NoPlanCard
    kind: Literal["plan_unavailable"] = "plan_unavailable"


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanRefused:
    """The planner's own plan may not be flown; the exact plan, if there is one, takes its place.

    Said once while the fault stays the same.
    """

    t: Second
    planner: str
    """Who made it; empty if the answer was no plan."""
    fault: Fault
    message: str
    kind: Literal["plan_refused"] = "plan_refused"


@dataclass(frozen=True, slots=True, kw_only=True)
class ModeChanged:
    """Guidance went from one mode to another."""

    t: Second
    mode: Mode
    previous: Mode
    message: str
    kind: Literal["mode_changed"] = "mode_changed"


@dataclass(frozen=True, slots=True, kw_only=True)
class HeadingReference:
    """Guidance asks the autopilot to hold a heading."""

    heading: Radian
    kind: Literal["hold_heading"] = "hold_heading"


@dataclass(frozen=True, slots=True, kw_only=True)
class TurnRateReference:
    """Guidance asks the autopilot for a turn rate."""

    turn_rate: RadianPerSecond
    kind: Literal["turn_rate"] = "turn_rate"


ReferenceCard = HeadingReference | TurnRateReference


@dataclass(frozen=True, slots=True, kw_only=True)
class Sample:
    """The flight at one instant."""

    t: Second
    pursuer: AircraftSample
    leader: AircraftSample
    mode: Mode
    reference: ReferenceCard
    commanded_tas: MetrePerSecond
    """What guidance asks of the autothrust."""
    separation: Metre
    closure: MetrePerSecond
    """Rate at which the separation shrinks, positive when closing."""
    least_separation: Metre
    """Least separation so far."""
    slot: PathPoint
    """The slot now (with turns to come: on the backward extension of the leader's final leg)."""
    slot_open: bool
    spacing_error: Metre
    """Distance still to close along the leader's route to be at D: positive when too far behind."""
    cross_track: Metre
    """Offset from the leader's final route, positive to its right."""
    time_to_go: Second
    """Until the slot is reached by the plan flown; 0 when there is none or it is joined."""
    joined: bool
    kind: Literal["sample"] = "sample"


@dataclass(frozen=True, slots=True, kw_only=True)
class FlightEnded:
    """How the flight went: the last document."""

    t: Second
    joined: bool
    join_time: Second
    """When eq. (7) first held within tolerance; the flight's duration if it never did."""
    planned_time: Second
    """Time to converge of the plan at engagement; 0 if there was none."""
    least_separation: Metre
    heading_swing: Radian
    """Total variation of the pursuer's heading until joined."""
    bank_reversals: int
    replans: int
    fallbacks: int
    track: Metre
    """Distance flown over the ground until joined."""
    kind: Literal["flight_ended"] = "flight_ended"


Document = (
    FlightStarted
    | LeaderRoute
    | LeaderChanged
    | PlanChanged
    | PlanUnavailable
    | PlanRefused
    | ModeChanged
    | Sample
    | FlightEnded
)
