"""Plans and their paths as outsiders read them: what documents and answers are made of.

Units, frames and times as in `documents`.
"""

from dataclasses import dataclass, field
from typing import Literal

from relguide.planning.outcome import Proof, Reason
from relguide.units import Metre, MetrePerSecond, Millisecond, Radian, Second

Direction = Literal["left", "right"]
Passes = Literal["behind", "ahead"]
ADDED = {"added": True}
"""Metadata of a field that documents did not always have: without it they read as its default."""
PROMISED = {"promised": True}
"""Metadata of such a field that all documents of this version's stream have."""
LEFT_OUT = {"left_out": True}
"""Metadata of a field that is written only where it is not its default: else there is nothing."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PathPoint:
    """A place and a heading along a path, over the ground."""

    t: Second
    """From the beginning of the path."""
    x: Metre
    """East."""
    y: Metre
    """North."""
    heading: Radian
    """Where the nose points."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TurnSegment:
    """A turn at constant bank. In wind its ground path is a trochoid: air-mass arc + wind × t."""

    direction: Direction
    """Which way round."""
    angle: Radian
    """How far it turns."""
    bank: Radian
    """|φ| [rad]."""
    radius: Metre
    """In the air mass."""
    duration: Second
    """How long it takes."""
    start: PathPoint
    """Where it begins."""
    end: PathPoint
    """Where it ends."""
    kind: Literal["turn"] = "turn"
    """A turn."""


@dataclass(frozen=True, slots=True, kw_only=True)
class StraightSegment:
    """A piece at constant heading."""

    length: Metre
    """In the air mass [m]."""
    duration: Second
    """How long it takes."""
    start: PathPoint
    """Where it begins."""
    end: PathPoint
    """Where it ends."""
    kind: Literal["straight"] = "straight"
    """A straight."""


@dataclass(frozen=True, slots=True, kw_only=True)
class BoundarySegment:
    """A boundary arc along d = d_min with less than full bank."""

    side: Direction
    """The side it turns to: left boundary arcs counter-clockwise round the leader."""
    duration: Second
    """How long it takes."""
    start: PathPoint
    """Where it begins."""
    end: PathPoint
    """Where it ends."""
    via: tuple[PathPoint, ...]
    """Points between, close enough to draw straight lines."""
    kind: Literal["boundary"] = "boundary"
    """A boundary arc."""


PathSegment = TurnSegment | StraightSegment | BoundarySegment


@dataclass(frozen=True, slots=True, kw_only=True)
class VerticalCard:
    """A time in which height keeps two aircraft apart: their separation does not count then."""

    from_: Second
    """Since when."""
    to: Second
    """Until when."""
    least: Metre
    """The least height between the two in between, to be sure of."""


@dataclass(frozen=True, slots=True, kw_only=True)
class OtherSeparationCard:
    """Least separation from another aircraft or a cell, until two minutes after joining."""

    ident: str
    """Of the aircraft or the cell."""
    least: Metre
    """The least distance to the aircraft, or to the edge of the cell: negative inside."""
    at: Second
    """When it is so."""
    proved_above: Metre
    """It is proved never to be less."""
    min_separation: Metre
    """What is to be kept; 0 of a cell."""
    vertical: tuple[VerticalCard, ...] = field(default=(), metadata=LEFT_OUT)
    """When height keeps it. Left out if it never does."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Separation:
    """Least separation along a plan, and what is proved of it."""

    least: Metre
    """The least distance between the two aircraft."""
    at: Second
    """When it is so."""
    proved_above: Metre
    """They are proved never to be closer."""
    vertical: tuple[VerticalCard, ...] = field(default=(), metadata=LEFT_OUT)
    """When height keeps it. Left out if it never does."""
    others: tuple[OtherSeparationCard, ...] = field(default=(), metadata=LEFT_OUT)
    """The same of other traffic and cells, least margin first. Left out if there are none."""


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
    """`relaxation`: it is the fastest. `certified`: within 0.1 s of it. `bound`: nothing is faster
    than the lower bound. `none`: nothing is known."""
    lower_bound: Second
    """No plan that keeps d_min is faster."""


@dataclass(frozen=True, slots=True, kw_only=True)
class AlternativeCard:
    """Another path to the slot that lost because it is no faster.

    `as_fast`: it arrives with the plan. `faster`: it keeps the limit and was not found, which only
    a planner that is not exact lets happen.
    """

    word: str
    """Its letters, e.g. `LSR`: L and R are turns, S a straight, B slides along d_min."""
    time_to_converge: Second
    """When the pursuer is at the slot, on the leader's heading."""
    turning: Radian
    """How much it turns in all, left and right added."""
    passes: Passes
    """Whether it crosses the line ahead of the leader on its final leg."""
    side: Direction
    """How it goes round the leader: left is counter-clockwise, with the leader on its left hand."""
    why: str
    """Why it is not flown, e.g. `38 s slower`."""
    rejected: Literal["slower", "as_fast", "faster"] = "slower"
    """Why, in a word."""


@dataclass(frozen=True, slots=True, kw_only=True)
class UnsafeAlternativeCard:
    """Another path to the slot that lost because it comes too close."""

    word: str
    """Its letters, e.g. `LSR`: L and R are turns, S a straight, B slides along d_min."""
    time_to_converge: Second
    """When the pursuer is at the slot, on the leader's heading."""
    turning: Radian
    """How much it turns in all, left and right added."""
    passes: Passes
    """Whether it crosses the line ahead of the leader on its final leg."""
    side: Direction
    """How it goes round the leader: left is counter-clockwise, with the leader on its left hand."""
    least_separation: Metre
    """How close it comes."""
    at: Second
    """When it is closest."""
    ident: str = field(default="", metadata=LEFT_OUT)
    """To whom: other traffic, or a cell. Left out for the leader."""
    why: str
    """Why it is not flown, e.g. `comes within 4.22 NM at 212 s`."""
    rejected: Literal["separation"] = "separation"
    """It loses the separation."""


@dataclass(frozen=True, slots=True, kw_only=True)
class EarlyAlternativeCard:
    """A word that reaches the place of the slot before it opens."""

    word: str
    """Its letters, e.g. `LSR`: L and R are turns, S a straight, B slides along d_min."""
    time_to_converge: Second
    """When it is there."""
    release_time: Second
    """When the slot opens."""
    why: str
    """Why it is not flown."""
    rejected: Literal["not_open"] = "not_open"
    """The slot is not open then."""


@dataclass(frozen=True, slots=True, kw_only=True)
class MissingAlternativeCard:
    """A word of which no path reaches the slot, or none within 12 hours."""

    word: str
    """Its letters, e.g. `LSR`: L and R are turns, S a straight, B slides along d_min."""
    why: str
    """Why there is none."""
    rejected: Literal["no_root"] = "no_root"
    """No root."""


AnyAlternativeCard = (
    AlternativeCard | UnsafeAlternativeCard | EarlyAlternativeCard | MissingAlternativeCard
)


@dataclass(frozen=True, slots=True, kw_only=True)
class OtherPathCard:
    """Another path to the slot, to be drawn beside a proposal."""

    word: str
    """Its letters, e.g. `LSR`: L and R are turns, S a straight, B slides along d_min."""
    time_to_converge: Second
    """When the pursuer is at the slot, on the leader's heading."""
    segments: tuple[PathSegment, ...]
    """Times count from the instant of the proposal."""
    why: str
    """Why it is not proposed, e.g. `38 s slower`."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PathAhead:
    """A path as an aircraft would really fly it, rolls and braking included.

    Columns of equal length; points close enough to draw straight lines between.
    """

    times: tuple[Second, ...]
    """Flight times, ascending."""
    x: tuple[Metre, ...]
    """East."""
    y: tuple[Metre, ...]
    """North."""
    heading: tuple[Radian, ...]
    """Where the nose points."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LevelChangeCard:
    """A climb or a descent that the pursuer makes on its way."""

    at: Second
    """When it begins."""
    to_altitude: Metre
    """Pressure altitude to level off at."""
    rate: MetrePerSecond
    """How fast."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanCard:
    """A plan as outsiders read it: the answer of REST, of the command line, and of the display."""

    planner: str
    """Who made it: `exact`, `network`, `regular_dp`, or the name of a planner of one's own."""
    word: str
    """Its letters, e.g. `LSR`: L and R are turns, S a straight, B slides along d_min."""
    time_to_converge: Second
    """When the pursuer is at the slot, on the leader's heading."""
    length: Metre
    """Path length in the air mass [m]."""
    segments: tuple[PathSegment, ...]
    """In the order they are flown."""
    levels: tuple[LevelChangeCard, ...] = field(default=(), metadata=LEFT_OUT)
    """Changes of level on the way. Left out if there is none."""
    separation: Separation
    """From the leader, along the path."""
    arrival: ArrivalCard
    """How its end meets the slot."""
    optimality: OptimalityCard
    """What is proved of its time."""
    alternatives: tuple[AnyAlternativeCard, ...] = ()
    """By time; words without any path last. In an answer only if asked for."""
    compute: Millisecond
    """How long planning took."""
    status: Literal["planned"] = "planned"
    """There is a plan."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FlownPoint:
    """A place along a path as an aircraft will fly it, over the ground."""

    t: Second
    """From the beginning of the path."""
    x: Metre
    """East."""
    y: Metre
    """North."""
    heading: Radian
    """Where the nose points."""
    tas: MetrePerSecond
    """True airspeed."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FlownCard:
    """The flight of a plan's situation, guidance engaged at once: rolls and braking included."""

    join: Second
    """When it has joined, from the situation on."""
    least: Metre
    """How close it comes until then."""
    at: Second
    """When it is closest."""
    word: str
    """Of the path that guidance flies: it may be another than the plan's."""
    reason: str
    """Why it takes another time than the plan, in sentences; empty if it does not."""
    segments: tuple[PathSegment, ...]
    """What guidance plans to fly: straight until it can turn, and without rolls and braking."""
    points: tuple[FlownPoint, ...]
    """Where it goes, until it has joined: to be drawn with straight lines between them."""
    status: Literal["flown"] = "flown"
    """It joins."""


@dataclass(frozen=True, slots=True, kw_only=True)
class NotFlownCard:
    """A plan that no aircraft flies, and why."""

    reason: str
    """In a sentence."""
    status: Literal["not_flown"] = "not_flown"
    """It does not join, or is not begun."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ConflictCard:
    """What the best path that was found comes too close to."""

    ident: str
    """Of other traffic, or of a cell."""
    at: Second
    """When it is nearest."""
    least: Metre
    """How near it comes; negative inside a cell."""
    min_separation: Metre
    """What is to be kept; 0 of a cell."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SlotDistanceRemedy:
    """With another D there is a plan."""

    slot_distance: Metre
    """D."""
    time_to_converge: Second
    """T of that plan."""
    message: str
    """The same in a sentence."""
    kind: Literal["slot_distance"] = "slot_distance"
    """Another D."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LevelRemedy:
    """At another level there is a plan."""

    altitude: Metre
    """The level."""
    time_to_converge: Second
    """T of that plan."""
    message: str
    """The same in a sentence."""
    kind: Literal["level"] = "level"
    """Another level."""


RemedyCard = SlotDistanceRemedy | LevelRemedy


@dataclass(frozen=True, slots=True, kw_only=True)
class NoPlanCard:
    """No plan, why, and what would help."""

    reason: Reason
    """In a word."""
    message: str
    """A sentence that says what would help."""
    lower_bound: Second = 0.0
    """No plan that keeps d_min is faster than this [s]; 0 where nothing is known."""
    conflict: ConflictCard | None = field(default=None, metadata=LEFT_OUT)
    """With the reason `traffic`: what is in the way, when, and how near. Else left out."""
    remedies: tuple[RemedyCard, ...] = field(default=(), metadata=LEFT_OUT)
    """With the reason `traffic`: what would help, each of it tried. Left out if there is none."""
    status: Literal["no_plan"] = "no_plan"
    """There is none."""
