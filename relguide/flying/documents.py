"""What a flight says of itself: the documents of the recorder, the stream and the display alike.

Library units inside (SI, radians); `contract/wire.py` gives each its JSON form, in which every
field's name ends in the unit that its type names here. Positions are over the ground, headings
clockwise from north. `t` is the flight's own time [s] from its start; times inside a `PlanCard`
count from the instant the plan was made, as they do in the REST answer.

A flight has any number of aircraft, known by their idents, and of links, each a pursuer behind a
leader. What is new in a flight is a new kind of document, or one more member of a list in it.
"""

from dataclasses import dataclass, field
from typing import Literal

from relguide.flying.aircraft_documents import (
    AircraftCard,
    AircraftSample,
    AlertLevel,
    CellCard,
    GuidanceSample,
    LinkCard,
    LinkResult,
    WindCard,
)
from relguide.flying.engagement import Engagement as Engagement
from relguide.flying.guidance.announcements import AlertSubject as AlertSubject
from relguide.flying.guidance.announcements import PlanReason as PlanReason
from relguide.flying.guidance.announcements import UnableReason as UnableReason
from relguide.flying.modes import Mode as Mode
from relguide.flying.orders import Command
from relguide.flying.plan_documents import (
    ADDED,
    LEFT_OUT,
    NoPlanCard,
    OtherPathCard,
    PathAhead,
    PathPoint,
    PathSegment,
    PlanCard,
)
from relguide.planning.acceptance import Fault as Fault
from relguide.units import Metre, MetrePerSecond, Radian, Second

LeaderChange = Literal[
    "heading", "speed", "level", "intent_received", "intent_withdrawn", "intent_broken"
]
"""What is new of a leader; intent_broken: it does not fly what it declared."""
EndReason = Literal["joined", "time_over", "recording_over", "plane_left"]
"""Why a flight ends."""
ClearanceStatus = Literal[
    "sent", "standby", "validated", "unable", "wilco", "flying", "deviating", "over"
]
"""What became of a manoeuvre that was sent to air traffic control."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FlightStarted:
    """All that is known before the flight: the first document."""

    t: Second
    """Flight time [s]."""
    scenario: str
    title: str
    planner: str
    """Who makes the plans, as in `PlanCard`."""
    aircraft: tuple[AircraftCard, ...]
    """All that fly, each with an ident of its own."""
    links: tuple[LinkCard, ...]
    """Who is to join whom. Displays for one pair show the first."""
    wind: WindCard
    step: Second
    """Integration step [s]."""
    seed: int
    cells: tuple[CellCard, ...] = field(default=(), metadata=LEFT_OUT)
    """Weather to be kept out of."""
    kind: Literal["flight_started"] = "flight_started"


@dataclass(frozen=True, slots=True, kw_only=True)
class LeaderRoute:
    """What a pursuer expects its leader to fly from now on: its declared intent, or straight ahead.

    Times in the segments are flight times. The last segment is the final leg, cut short.
    """

    t: Second
    """Flight time [s]."""
    ident: str
    """The leader's."""
    expected_by: str
    """The pursuer's ident."""
    intent_known: bool
    segments: tuple[PathSegment, ...]
    kind: Literal["leader_route"] = "leader_route"


@dataclass(frozen=True, slots=True, kw_only=True)
class LeaderChanged:
    """The leader does something new, or its intent was received or withdrawn."""

    t: Second
    """Flight time [s]."""
    ident: str
    """The leader's."""
    change: LeaderChange
    message: str
    kind: Literal["leader_changed"] = "leader_changed"


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanChanged:
    """A new plan is flown."""

    t: Second
    """Flight time [s]."""
    ident: str
    """The pursuer's."""
    reason: PlanReason
    message: str
    plan: PlanCard
    leader_at_closest: PathPoint
    """Where the leader is when the separation is least; its t counts from the plan's start."""
    pursuer_at_closest: PathPoint
    """Where the pursuer is then."""
    announced: bool
    """Whether it is news for the crew; if not, its path is drawn and nothing is said."""
    promised: Second
    """How long until joined, braking included [s]: as forecast by flying the closed loop ahead."""
    tube: Metre
    """Largest distance of that forecast from the plan's ideal path [m]."""
    flown_least: Metre
    """Least separation of that forecast [m], which is what must keep d_min."""
    kind: Literal["plan_changed"] = "plan_changed"


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanProposed:
    """A path that could be flown from now on, if the crew accepts it. It is not flown."""

    t: Second
    """Flight time [s]."""
    ident: str
    """The pursuer's."""
    message: str
    plan: PlanCard
    leader_at_closest: PathPoint
    """Where the leader is when the separation is least; its t counts from the plan's start."""
    pursuer_at_closest: PathPoint
    """Where the pursuer is then."""
    promised: Second
    """How long until joined, braking included [s]: as forecast by flying the closed loop ahead."""
    flown_least: Metre
    """Least separation of that forecast [m], which is what must keep d_min."""
    others: tuple[OtherPathCard, ...]
    """Other paths to the slot that could be flown, fastest first: at most three."""
    ahead: tuple[PathAhead, ...] = field(default=(), metadata=LEFT_OUT)
    """What would be flown, as forecast; none in recordings of before."""
    kind: Literal["plan_proposed"] = "plan_proposed"


@dataclass(frozen=True, slots=True, kw_only=True)
class EngagementChanged:
    """The crew has engaged guidance further, or less far; or what it ordered could not be done."""

    t: Second
    """Flight time [s]."""
    ident: str
    """The pursuer's."""
    engagement: Engagement
    previous: Engagement
    """The same, if the order was refused."""
    message: str
    kind: Literal["engagement_changed"] = "engagement_changed"


@dataclass(frozen=True, slots=True, kw_only=True)
class CommandGiven:
    """An aircraft is ordered to do something, by its crew or by others.

    A flight is flown again to the bit from its scenario, its seed and these.
    """

    t: Second
    """Flight time [s]."""
    command: Command
    kind: Literal["command_given"] = "command_given"


@dataclass(frozen=True, slots=True, kw_only=True)
class ControlChanged:
    """The crew has taken control or given it back, or switched the flight director; or could not.

    Guidance goes on in all cases: the autopilot follows it, or the crew does.
    """

    t: Second
    """Flight time [s]."""
    ident: str
    """The pursuer's."""
    autopilot: bool
    """Whether the autopilot flies now."""
    director: bool
    """Whether the flight director is on now."""
    message: str
    kind: Literal["control_changed"] = "control_changed"


@dataclass(frozen=True, slots=True, kw_only=True)
class AssignmentChanged:
    """The crew has changed what its guidance is to do; or what it ordered could not be done."""

    t: Second
    """Flight time [s]."""
    ident: str
    """The pursuer's."""
    slot_distance: Metre
    """D from now on."""
    min_separation: Metre
    """d_min from now on."""
    max_bank: Radian
    """What plans turn with from now on."""
    selected_tas: tuple[MetrePerSecond, ...]
    """The speed that the crew has selected; none while guidance sets the speed."""
    message: str
    kind: Literal["assignment_changed"] = "assignment_changed"


@dataclass(frozen=True, slots=True, kw_only=True)
class ClearanceNews:
    """What air traffic control says of the manoeuvre that a crew has sent it.

    It comes from outside the flight, which flies the same without it.
    """

    t: Second
    """Flight time [s]."""
    ident: str
    """The pursuer's."""
    clearance_id: str
    clearance: ClearanceStatus
    level: Literal["none", "advisory", "caution", "warning"]
    """caution: something is to be seen to; warning: it is no longer cleared, or far off its path.
    """
    reason: str = field(default="", metadata=LEFT_OUT)
    """Why, in a word: `separation`, `airspace`, `across` …; left out where nothing is wrong."""
    message: str
    """In a sentence."""
    automated: bool
    """Whether the automation answered in the controller's place."""
    kind: Literal["clearance_news"] = "clearance_news"


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanUnavailable:
    """Guidance asked for a plan and there is none."""

    t: Second
    """Flight time [s]."""
    ident: str
    """The pursuer's."""
    answer: NoPlanCard
    kind: Literal["plan_unavailable"] = "plan_unavailable"


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanRefused:
    """The planner's own plan may not be flown; the exact plan, if there is one, takes its place.

    Said once while the fault stays the same.
    """

    t: Second
    """Flight time [s]."""
    ident: str
    """The pursuer's."""
    planner: str
    """Who made it; empty if the answer was no plan."""
    fault: Fault
    message: str
    kind: Literal["plan_refused"] = "plan_refused"


@dataclass(frozen=True, slots=True, kw_only=True)
class ModeChanged:
    """Guidance went from one mode to another."""

    t: Second
    """Flight time [s]."""
    ident: str
    """The pursuer's."""
    mode: Mode
    previous: Mode
    message: str
    kind: Literal["mode_changed"] = "mode_changed"


@dataclass(frozen=True, slots=True, kw_only=True)
class PromiseChanged:
    """The pursuer will join at another time than was last said, on the path that it flies."""

    t: Second
    """Flight time [s]."""
    ident: str
    """The pursuer's."""
    promised: Second
    """How long until joined, braking included [s]: as forecast by flying the closed loop ahead."""
    was: Second = field(default=0.0, metadata=ADDED)
    """The same as was last said, counted from now [s]; negative if that instant has passed."""
    message: str
    kind: Literal["promise_changed"] = "promise_changed"


@dataclass(frozen=True, slots=True, kw_only=True)
class Alert:
    """Something a crew has to know of, or that it need no longer know of.

    One is given when its subject's level rises or falls, not each second that it stands.
    """

    t: Second
    """Flight time [s]."""
    ident: str
    """The aircraft whose crew is alerted."""
    other: str
    """The aircraft that it is about, which need not be the leader."""
    level: AlertLevel
    """Of the alert that begins or, when cleared, ends."""
    subject: AlertSubject
    message: str
    predicted_least: Metre
    """Least separation from the other ahead, flying on as now [m]."""
    predicted_at: Second
    """Flight time at which the minimum is lost or, where it is kept, the least comes [s]."""
    cleared: bool
    """Whether the alert ends: nothing stands on this subject any more."""
    kind: Literal["alert"] = "alert"


@dataclass(frozen=True, slots=True, kw_only=True)
class Unable:
    """Guidance cannot do what it is to do, and the crew is informed. Holds until the next plan."""

    t: Second
    """Flight time [s]."""
    ident: str
    """The pursuer's."""
    reason: UnableReason
    message: str
    kind: Literal["unable"] = "unable"


@dataclass(frozen=True, slots=True, kw_only=True)
class SeparationLost:
    """The separation fell below d_min: once for each time it does."""

    t: Second
    """Flight time [s]."""
    ident: str
    """The pursuer's."""
    other: str
    """The aircraft that it came too close to."""
    separation: Metre
    """At this instant [m]."""
    x: Metre
    """Where the pursuer is, east [m]."""
    y: Metre
    """… and north [m]."""
    cause: str
    """Why, in a sentence."""
    announced: tuple[Second, ...]
    """Flight time [s] of the first alert or `Unable` that came before it; empty without one."""
    kind: Literal["separation_lost"] = "separation_lost"


@dataclass(frozen=True, slots=True, kw_only=True)
class ForecastChanged:
    """The path that an aircraft will really fly: the closed loop flown ahead, without planning.

    Columns of equal length; points close enough to draw straight lines between.
    """

    t: Second
    """Flight time [s]."""
    ident: str
    times: tuple[Second, ...]
    """Flight times, ascending [s]."""
    x: tuple[Metre, ...]
    """East of each point [m]."""
    y: tuple[Metre, ...]
    """North of each point [m]."""
    heading: tuple[Radian, ...]
    """Clockwise from north at each point: radians in Python, degrees in JSON."""
    least_separation: Metre
    """From its leader on the way [m], the leader flying as expected."""
    pursuer_at_closest: PathPoint
    """Where the aircraft is when the separation is least."""
    leader_at_closest: PathPoint
    """Where its leader is then."""
    aside: tuple[Metre, ...] = field(default=(), metadata=ADDED)
    """How far to either side of the line it may come at each point [m], by what is not certain of
    the leader's track and of the wind (2 σ of what is believed now); none where all is exact."""
    kind: Literal["forecast_changed"] = "forecast_changed"


@dataclass(frozen=True, slots=True, kw_only=True)
class FanJoin:
    """Where a pursuer would join if its leader began a turn now."""

    turn: Radian
    """To the right of where the leader flies now; negative to the left."""
    joins: Second
    """When, flight time."""
    x: Metre
    """East."""
    y: Metre
    """North."""
    least: Metre
    """Least separation on the way, as forecast."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FanChanged:
    """Where a pursuer would join after turns that its leader may begin and has not announced.

    Said to viewers, while the leader's intent is not known and a path is proposed or
    flown. What is saved is how much sooner it joins if it knows of a turn a minute before it begins
    than if it learns of it as it begins; both are forecast by flying the closed loop ahead.
    """

    t: Second
    """Flight time [s]."""
    ident: str
    """The pursuer's."""
    joins: tuple[FanJoin, ...]
    """For turns of −30°, −20° … 30°; those after which there is no path are left out. None at all
    once the intent is known, or the pursuer has joined: the fan is closed."""
    most_saved: Second
    """By knowing the turn for which that saves the most [s]; 0 where nothing is saved."""
    mean_saved: Second
    """On average of all these turns [s]."""
    kind: Literal["fan_changed"] = "fan_changed"


@dataclass(frozen=True, slots=True, kw_only=True)
class Sample:
    """The flight at one instant."""

    t: Second
    """Flight time [s]."""
    aircraft: tuple[AircraftSample, ...]
    """In the order of `FlightStarted.aircraft`."""
    guidance: tuple[GuidanceSample, ...]
    """In the order of `FlightStarted.links`."""
    kind: Literal["sample"] = "sample"


@dataclass(frozen=True, slots=True, kw_only=True)
class FlightEnded:
    """How the flight went: the last document."""

    t: Second
    """Flight time [s]."""
    reason: EndReason
    message: str
    """The same in a sentence."""
    results: tuple[LinkResult, ...]
    """In the order of `FlightStarted.links`."""
    kind: Literal["flight_ended"] = "flight_ended"


Document = (
    FlightStarted
    | LeaderRoute
    | LeaderChanged
    | PlanChanged
    | PlanProposed
    | EngagementChanged
    | CommandGiven
    | ControlChanged
    | AssignmentChanged
    | ClearanceNews
    | PlanUnavailable
    | PlanRefused
    | ModeChanged
    | PromiseChanged
    | Alert
    | Unable
    | SeparationLost
    | ForecastChanged
    | FanChanged
    | Sample
    | FlightEnded
)
"""What a flight says, in order of time: `fly` and `replay` yield them."""
