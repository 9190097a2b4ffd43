"""Everything a plan depends on at one instant: both aircraft, the intent, D, d_min, the wind.

A `Situation` is data and its own judge: what cannot be flown is refused when it is made, with a
sentence that says what would be right, always by a `ValueError`. What may be flown is bounded on
all sides (see `limits`), and with it the work that a plan takes. Positions and headings are
of the world frame (x east, y north, heading clockwise from north), at t = 0, over the ground.
"""

from dataclasses import dataclass, field
from math import cos, fmod, hypot, sin
from typing import Literal

from relguide.kernels.base.angles import TWO_PI, turn_to
from relguide.kernels.base.turn import turn_radius
from relguide.planning.inputs import expect, expect_within, number, turn_sign
from relguide.planning.limits import (
    BANK,
    CLEARANCE,
    DISTANCE,
    HEADING,
    HEADWAY,
    MAX_PIECES,
    MOST_MILES,
    PIECE,
    POSITION,
    TAS,
    in_miles,
    no_headway,
    too_close_a_slot,
)
from relguide.planning.reprs import as_code
from relguide.planning.trajectory import LEFT, RIGHT, Arc, Segment, Straight, Trajectory, Turn
from relguide.planning.wind import CALM as CALM
from relguide.planning.wind import Wind as Wind
from relguide.planning.wind import wind_from as wind_from
from relguide.units import DEG, KT, NM, Metre, MetrePerSecond, Radian, Second

ROUNDED: Radian = 1e-6
"""A declared turn this close to a full one is none [rad]: headings that were kept as 32-bit numbers
are off by up to 3e-7. The rest is flown the other way round."""


def _settle(piece: object, name: str, value: object) -> None:
    """Set a field of a frozen dataclass while it is being made."""
    object.__setattr__(piece, name, value)


def _settle_aircraft(name: str, aircraft: "Pursuer | Leader") -> None:
    x, y, heading, tas = aircraft.x, aircraft.y, aircraft.heading, aircraft.tas
    if type(x) is type(y) is type(heading) is type(tas) is float and (
        abs(x) <= POSITION.high
        and abs(y) <= POSITION.high
        and abs(heading) <= HEADING.high
        and TAS.low <= tas <= TAS.high
        and x != 0.0
        and y != 0.0
        and heading != 0.0
    ):
        return  # nearly always: nothing to be made a float, nor −0 to be made 0
    _settle(aircraft, "x", expect_within(f"{name}.x", aircraft.x, *POSITION))
    _settle(aircraft, "y", expect_within(f"{name}.y", aircraft.y, *POSITION))
    _settle(aircraft, "heading", expect_within(f"{name}.heading", aircraft.heading, *HEADING))
    _settle(aircraft, "tas", expect_within(f"{name}.tas", aircraft.tas, *TAS))


def _heading(degrees: float) -> Radian:
    """A direction given in degrees, as often round as may be [rad]."""
    return fmod(degrees, 360.0) * DEG


def expect_bank(name: str, value: object) -> Radian:
    """A bank angle in `BANK` [rad].

    Raises:
        ValueError: for what is no number, or lies outside.
    """
    bank = number(name, value)
    expect_within(name, bank / DEG, *BANK)
    return bank


def expect_distance(name: str, value: object) -> Metre:
    """A distance between aircraft in `DISTANCE` [m].

    Raises:
        ValueError: for what is no number, lies outside, or was meant in nautical miles.
    """
    if type(value) is int and 0 < value <= MOST_MILES:  # what programs compute is a float
        raise ValueError(f"{name} {in_miles(value)}")
    return expect_within(name, value, *DISTANCE)


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class Pursuer:
    """The aircraft we guide, at t = 0."""

    x: Metre
    """East [m]."""
    y: Metre
    """North [m]."""
    heading: Radian
    """ψ_P, clockwise from north [rad]."""
    tas: MetrePerSecond
    """True airspeed V_P, kept constant [m/s]."""
    max_bank: Radian
    """φ_max, the bank its turns are flown at [rad]."""

    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse what cannot be flown."""
        _settle_aircraft("pursuer", self)
        _settle(self, "max_bank", expect_bank("pursuer.max_bank", self.max_bank))

    @classmethod
    def from_display(
        cls, *, x_nm: float, y_nm: float, heading_deg: float, tas_kt: float, max_bank_deg: float
    ) -> "Pursuer":
        """In the units of aviation: nautical miles east and north, degrees, knots."""
        return cls(
            x=x_nm * NM,
            y=y_nm * NM,
            heading=_heading(heading_deg),
            tas=tas_kt * KT,
            max_bank=max_bank_deg * DEG,
        )

    @property
    def turn_radius(self) -> float:
        """R at φ_max [m]."""
        return turn_radius(self.tas, self.max_bank)

    def flying(self, segments: tuple[Segment, ...]) -> Trajectory:
        """Segments flown from its present state, in the air mass."""
        return Trajectory(x=self.x, y=self.y, heading=self.heading, tas=self.tas, segments=segments)


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class FlyStraight:
    """A piece of intent: keep the heading for a while."""

    duration: Second
    """How long [s], ≥ 0."""
    kind: Literal["straight"] = "straight"

    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse a duration that is not one."""
        _settle(self, "duration", expect_within("intent straight.duration", self.duration, *PIECE))


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class TurnTo:
    """A piece of intent: turn at constant bank to a heading, the way round that `turn` says."""

    heading: Radian
    """Heading to roll out on, clockwise from north [rad]."""
    turn: Turn
    """`LEFT` or `RIGHT`."""
    bank: Radian
    """|φ| of the turn [rad]."""
    kind: Literal["turn"] = "turn"

    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse a turn that cannot be flown."""
        _settle(self, "heading", expect_within("intent turn.heading", self.heading, *HEADING))
        _settle(self, "turn", turn_sign("intent turn.turn", self.turn))
        _settle(self, "bank", expect_bank("intent turn.bank", self.bank))

    @classmethod
    def from_display(
        cls, *, heading_deg: float, direction: Literal["left", "right"], bank_deg: float
    ) -> "TurnTo":
        """In degrees, with the direction as a word.

        Raises:
            ValueError: for what cannot be flown, or a direction that is neither.
        """
        if direction not in ("left", "right"):
            raise ValueError(f"direction must be 'left' or 'right', not {direction!r}.")
        turn = LEFT if direction == "left" else RIGHT
        return cls(heading=_heading(heading_deg), turn=turn, bank=bank_deg * DEG)


IntentPiece = FlyStraight | TurnTo


def expect_intent(name: str, value: object) -> tuple[IntentPiece, ...]:
    """The pieces of an intent, a list of them as well.

    Raises:
        ValueError: for anything else, and for more than `MAX_PIECES`.
    """
    if not isinstance(value, tuple | list):
        raise ValueError(f"{name} must be a tuple of FlyStraight and TurnTo.")
    if len(value) > MAX_PIECES:
        raise ValueError(f"{name} must have at most {MAX_PIECES} pieces, not {len(value)}.")
    for i, piece in enumerate(value):
        if not isinstance(piece, FlyStraight | TurnTo):
            raise ValueError(f"{name}[{i}] must be a FlyStraight or a TurnTo.")
    return tuple(value)


def final_heading(heading: Radian, intent: tuple[IntentPiece, ...]) -> Radian:
    """Where an intent leads from a heading, clockwise from north [rad]."""
    turns = [piece.heading for piece in intent if isinstance(piece, TurnTo)]
    return turns[-1] if turns else heading


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class Leader:
    """The aircraft to be joined, at t = 0, with what it has declared it will do."""

    x: Metre
    """East [m]."""
    y: Metre
    """North [m]."""
    heading: Radian
    """ψ_L, clockwise from north [rad]."""
    tas: MetrePerSecond
    """True airspeed V_L, kept constant [m/s]."""
    intent: tuple[IntentPiece, ...] = ()
    """Pieces to come; what follows the last one is the endless final leg."""
    _trajectory: Trajectory | None = field(default=None, init=False, compare=False)
    """`trajectory`, once it has been asked for."""

    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse what cannot be flown."""
        _settle_aircraft("leader", self)
        _settle(self, "intent", expect_intent("leader.intent", self.intent))

    @classmethod
    def from_display(
        cls,
        *,
        x_nm: float = 0.0,
        y_nm: float = 0.0,
        heading_deg: float,
        tas_kt: float,
        intent: tuple[IntentPiece, ...] = (),
    ) -> "Leader":
        """In the units of aviation: nautical miles east and north, degrees, knots."""
        return cls(
            x=x_nm * NM, y=y_nm * NM, heading=_heading(heading_deg), tas=tas_kt * KT, intent=intent
        )

    @property
    def final_heading(self) -> float:
        """Heading of the final leg, clockwise from north [rad]."""
        return final_heading(self.heading, self.intent)

    @property
    def trajectory(self) -> Trajectory:
        """What the leader flies in the air mass; its last heading goes on for ever."""
        if self._trajectory is not None:
            return self._trajectory
        segments: list[Arc | Straight] = []
        heading = self.heading
        for piece in self.intent:
            match piece:
                case FlyStraight():
                    segments.append(Straight(length=self.tas * piece.duration))
                case TurnTo():
                    # LEFT (+1) lowers the compass heading; to the present heading is no turn
                    turn, angle = piece.turn, turn_to(-piece.turn * (piece.heading - heading))
                    if TWO_PI - angle < ROUNDED:
                        turn, angle = RIGHT if turn == LEFT else LEFT, TWO_PI - angle
                    radius = turn_radius(self.tas, piece.bank)
                    segments.append(Arc(turn=turn, turn_angle=angle, radius=radius))
                    heading = piece.heading
        flown = Trajectory(
            x=self.x, y=self.y, heading=self.heading, tas=self.tas, segments=tuple(segments)
        )
        _settle(self, "_trajectory", flown)
        return flown


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class Situation:
    """Everything a plan depends on, at one instant (t = 0)."""

    pursuer: Pursuer
    leader: Leader
    slot_distance: Metre
    """D, along the leader's ground track of the final leg behind it [m]."""
    min_separation: Metre
    """d_min [m], 0 ≤ d_min ≤ D."""
    wind: Wind = CALM

    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse distances that contradict each other."""
        expect("pursuer", self.pursuer, Pursuer)
        expect("leader", self.leader, Leader)
        expect("wind", self.wind, Wind)
        for name in ("slot_distance", "min_separation"):
            _settle(self, name, expect_distance(name, getattr(self, name)))
        if not CLEARANCE.admits(self.slot_distance - self.min_separation):
            wrong = too_close_a_slot(self.slot_distance, self.min_separation)
            raise ValueError(f"slot_distance {wrong}")
        heading = self.leader.final_heading
        headway = hypot(
            self.leader.tas * sin(heading) + self.wind.east,
            self.leader.tas * cos(heading) + self.wind.north,
        )
        if not HEADWAY.admits(headway):
            raise ValueError(f"The leader {no_headway(headway)}")

    @classmethod
    def from_display(
        cls,
        *,
        pursuer: Pursuer,
        leader: Leader,
        slot_distance_nm: float,
        min_separation_nm: float,
        wind_from_deg: float = 0.0,
        wind_kt: float = 0.0,
    ) -> "Situation":
        """In the units of aviation: nautical miles, knots, and where the wind comes from."""
        return cls(
            pursuer=pursuer,
            leader=leader,
            slot_distance=slot_distance_nm * NM,
            min_separation=min_separation_nm * NM,
            wind=wind_from(_heading(wind_from_deg), wind_kt * KT) if wind_kt else CALM,
        )
