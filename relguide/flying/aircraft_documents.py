"""Aircraft and the links between them as outsiders read them: what documents are made of.

Units, frames and times as in `documents`. Every aircraft has an ident, which is its alone in a
flight. A link is what one aircraft is to do behind another: one pursuer has one link; a leader may
have several pursuers, and may be a pursuer itself.
"""

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Literal, Protocol, TypeVar

from relguide.flying.engagement import Engagement as Engagement
from relguide.flying.guidance.announcements import AlertLevel as AlertLevel
from relguide.flying.guidance.announcements import AlertState as AlertState
from relguide.flying.modes import Mode as Mode
from relguide.flying.plan_documents import LEFT_OUT, PROMISED, PathPoint
from relguide.units import Metre, MetrePerSecond, Radian, RadianPerSecond, Second

Spacing = Literal["distance", "time"]
"""What a link keeps once joined: the distance D, or the time that the leader takes to fly it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class WindCard:
    """Uniform wind as reports give it."""

    from_: Radian
    """Where it comes from, clockwise from north [rad]."""
    speed: MetrePerSecond


@dataclass(frozen=True, slots=True, kw_only=True)
class AircraftCard:
    """Who an aircraft is."""

    ident: str
    """Its name in all documents of the flight."""
    aircraft_type: str
    max_bank: Radian
    autopilot_bank: Radian = field(default=0.0, metadata=LEFT_OUT)
    """Most that its autopilot banks, to stay on a path that turns at the bank above; left out of an
    aircraft that is not guided, and in older recordings."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LinkCard:
    """What a pursuer is to do: join its leader, and stay behind it."""

    pursuer: str
    """Its ident."""
    leader: str
    """Its ident."""
    slot_distance: Metre
    """D, along the leader's route behind it; with spacing by time, as it is at the start."""
    min_separation: Metre
    """d_min, to be kept at all times."""
    spacing: Spacing
    spacing_time: Second
    """Time behind the leader to keep once joined; 0 where the distance is kept."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CellCard:
    """A weather cell: all places no farther than `radius` from the convex hull of its corners.

    A disc has one corner, its middle; a polygon has radius 0. Given as it is at t = 0, in columns
    of equal length; it moves over the ground, and its radius grows.
    """

    ident: str
    """Its name in all documents of the flight."""
    x: tuple[Metre, ...]
    """Of its corners, counter-clockwise, east."""
    y: tuple[Metre, ...]
    """… and north."""
    radius: Metre
    east: MetrePerSecond
    """How fast it moves toward the east."""
    north: MetrePerSecond
    """… and toward the north."""
    growth: MetrePerSecond
    """How fast its radius grows."""


@dataclass(frozen=True, slots=True, kw_only=True)
class AircraftSample:
    """One aircraft at one instant, as it flies (roll dynamics included)."""

    ident: str
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
class Bars:
    """The flight director's bars at one instant: what is commanded less what is flown."""

    roll: Radian
    """Commanded bank less bank, smoothed over half a second: positive asks to roll right."""
    pitch: Radian
    """Commanded flight path angle less the one flown: positive asks to pull up."""
    commanded_bank: Radian
    """What the autopilot would go for, or does, positive right wing down."""
    commanded_climb: MetrePerSecond
    """The same of the rate of climb."""


@dataclass(frozen=True, slots=True, kw_only=True)
class GuidanceSample:
    """What the guidance of one pursuer does at one instant, and how it stands to its leader."""

    ident: str
    """The pursuer's."""
    leader: str
    """Its leader's ident."""
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
    alert: AlertState
    leader_age: Second = 0.0
    """How long ago the leader was last heard of."""
    engagement: Engagement = "engaged"
    """How far the crew has engaged it."""
    margin: Metre = field(default=0.0, metadata=PROMISED)
    """What guidance keeps beside d_min for what it is not certain of, and while the crew flies by
    hand; 0 where all is exact."""
    autopilot: bool = field(default=True, metadata=LEFT_OUT)
    """Whether the autopilot flies the pursuer; if not, its crew does by hand."""
    director: bool = field(default=False, metadata=LEFT_OUT)
    """Whether the flight director is on."""
    least_tas: MetrePerSecond = field(default=0.0, metadata=LEFT_OUT)
    """The slowest that its aircraft can fly at its level, wings level; left out in older
    recordings."""
    bars: tuple[Bars, ...] = field(default=(), metadata=LEFT_OUT)
    """Its bars; none while they are out of view: it is off, or guidance is."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Loss:
    """A loss of separation: from when the separation fell below d_min until it was d_min again."""

    t: Second
    """When it fell below."""
    separation: Metre
    """The least while it was lost."""
    cause: str
    """Why, in a sentence."""
    announced: tuple[Second, ...]
    """When the first alert or `Unable` that came before it was given; empty if there was none."""
    other: str = field(default="", metadata=LEFT_OUT)
    """Ident of the aircraft or cell that it came too close to; empty for the leader."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ClosestOther:
    """How near a pursuer came to one other aircraft, or to the edge of a cell."""

    ident: str
    separation: Metre
    """The least; negative inside a cell."""
    t: Second
    """When."""
    min_separation: Metre
    """What was to be kept; 0 for a cell."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FlownByHand:
    """How a crew flew by hand."""

    time: Second
    """For how long."""
    with_bars: Second
    """… of that with the flight director's bars in view …"""
    within_bar: Second
    """… and of that with the bank within 2° of the commanded one."""
    tube: Metre
    """Largest distance beside the path of the plan that was flown."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LinkResult:
    """How the flight of one pursuer behind its leader went."""

    ident: str
    """The pursuer's."""
    leader: str
    """Its leader's ident."""
    joined: bool
    join_time: Second
    """When eq. (7) first held within tolerance; the flight's duration if it never did."""
    planned_time: Second
    """Time to converge of the plan at engagement, from then on; 0 if there was none."""
    promised: Second
    """Time until joined that the plan at engagement promised, braking included; 0 as above."""
    least_separation: Metre
    heading_swing: Radian
    """Total variation of the pursuer's heading until joined."""
    bank_reversals: int
    replans: int
    """Plans after the one at engagement, announced or not."""
    replans_announced: int
    """Those of them that the crew was shown."""
    fallbacks: int
    """How often the exact plan took the place of a planner's."""
    track: Metre
    """Distance flown over the ground until joined."""
    losses: tuple[Loss, ...]
    optimum: Second = field(default=0.0, metadata=PROMISED)
    """Time to converge of the fastest plan from the start, with the bank that was asked for and all
    that the leader was to fly; 0 where there is none, or the leader is recorded."""
    along_error: Metre = field(default=0.0, metadata=PROMISED)
    """Largest distance along the route from where it should be, while it followed."""
    across_error: Metre = field(default=0.0, metadata=PROMISED)
    """Largest distance beside the route, while it followed."""
    least_other: tuple[ClosestOther, ...] = field(default=(), metadata=LEFT_OUT)
    """Of all others the one that it came nearest to, measured by what was to be kept; none where
    there are no others."""
    by_hand: tuple[FlownByHand, ...] = field(default=(), metadata=LEFT_OUT)
    """How it was flown by hand; none where the autopilot flew all the while."""


class _HasIdent(Protocol):
    @property
    def ident(self) -> str: ...


Member = TypeVar("Member", bound=_HasIdent)


def find_by_ident(members: Iterable[Member], ident: str) -> Member:
    """The aircraft, guidance or result of that ident.

    Raises:
        ValueError: if there is none.
    """
    known = []
    for member in members:
        if member.ident == ident:
            return member
        known.append(member.ident)
    raise ValueError(f"There is no aircraft {ident!r} here; there are {', '.join(known)}.")
