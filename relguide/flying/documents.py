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
from relguide.flying.plan_documents import NoPlanCard, PathPoint, PathSegment, PlanCard
from relguide.planning.acceptance import Fault as Fault
from relguide.units import (
    Metre,
    MetrePerSecond,
    Radian,
    RadianPerSecond,
    Second,
)

LeaderChange = Literal["heading", "speed", "intent_received", "intent_withdrawn"]


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
