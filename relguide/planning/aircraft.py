"""Aircraft of a situation at t = 0: the pursuer, the leader, and other traffic."""

from dataclasses import dataclass, field

from relguide.kernels.base.turn import turn_radius
from relguide.planning.inputs import expect_within, number, text
from relguide.planning.intent import (
    IntentPiece,
    LevelChange,
    declared_path,
    expect_bank,
    expect_intent,
    expect_levels,
    final_heading,
    heading_in_degrees,
    settle,
)
from relguide.planning.limits import (
    ALTITUDE,
    DISTANCE,
    HEADING,
    MOST_MILES,
    POSITION,
    TAS,
    in_knots,
    in_miles,
)
from relguide.planning.reprs import as_code
from relguide.planning.trajectory import Segment, Trajectory
from relguide.units import DEG, KT, NM, Metre, MetrePerSecond, Radian

LONGEST_IDENT = 24
"""Longest ident of other traffic and of cells [characters]."""


def _settle_aircraft(name: str, aircraft: "Pursuer | Leader | Traffic") -> None:
    if aircraft.altitude is not None:
        altitude = expect_within(f"{name}.altitude", aircraft.altitude, *ALTITUDE)
        settle(aircraft, "altitude", altitude)
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
    settle(aircraft, "x", expect_within(f"{name}.x", aircraft.x, *POSITION))
    settle(aircraft, "y", expect_within(f"{name}.y", aircraft.y, *POSITION))
    settle(aircraft, "heading", expect_within(f"{name}.heading", aircraft.heading, *HEADING))
    tas = number(f"{name}.tas", tas)
    meant = in_knots(tas) if tas > TAS.high + 1.0 else ""  # closer to the bound m/s are meant
    settle(aircraft, "tas", expect_within(f"{name}.tas", tas, TAS.low, TAS.high, TAS.unit, meant))


def expect_ident(name: str, value: object) -> str:
    """A name for an aircraft or a cell: 1 to `LONGEST_IDENT` printable characters.

    Raises:
        ValueError: for anything else.
    """
    ident = text(name, value)
    if not (ident.isprintable() and 0 < len(ident.strip()) <= LONGEST_IDENT):
        raise ValueError(
            f"{name} must have 1 to {LONGEST_IDENT} printable characters, not {ident!r}."
        )
    return ident


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
    """The aircraft we guide, at t = 0.

    Examples:
        >>> own = rg.Pursuer(x=-40e3, y=40e3, heading=1.5, tas=240.0, max_bank=0.4)
        >>> round(own.turn_radius)  # [m]
        13892
    """

    x: Metre
    """East [m]."""
    y: Metre
    """North [m]."""
    heading: Radian
    """ψ_P, clockwise from north [rad]."""
    tas: MetrePerSecond
    """True airspeed V_P, kept constant [m/s]."""
    max_bank: Radian
    """φ_max of eq. (4), the bank its turns are flown at [rad]."""
    altitude: Metre | None = None
    """Pressure altitude [m]; `None` as in `Leader`."""
    levels: tuple[LevelChange, ...] = ()
    """Changes of level that it will make. `plan` chooses them where there are none and the leader
    is, or will be, at another level."""

    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse what cannot be flown."""
        _settle_aircraft("pursuer", self)
        settle(self, "max_bank", expect_bank("pursuer.max_bank", self.max_bank))
        if self.levels != ():
            settle(self, "levels", expect_levels("pursuer.levels", self.levels))

    @classmethod
    def from_display(
        cls, *, x_nm: float, y_nm: float, heading_deg: float, tas_kt: float, max_bank_deg: float
    ) -> "Pursuer":
        """In the units of aviation: nautical miles east and north, degrees, knots."""
        return cls(
            x=x_nm * NM,
            y=y_nm * NM,
            heading=heading_in_degrees("heading_deg", heading_deg),
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
class Leader:
    """The aircraft to be joined, at t = 0, with what it has declared it will do.

    Examples:
        >>> rg.Leader(x=0.0, y=0.0, heading=1.5, tas=200.0, intent=(rg.FlyStraight(duration=60.0),))
        Leader(x=0.0, y=0.0, heading=1.5, tas=200.0, intent=(FlyStraight(duration=60.0),))
    """

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
    altitude: Metre | None = None
    """Pressure altitude [m]; `None` where it is not known: then height keeps nothing apart."""
    _trajectory: Trajectory | None = field(default=None, init=False, compare=False)
    """`trajectory`, once it has been asked for."""

    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse what cannot be flown."""
        _settle_aircraft("leader", self)
        settle(self, "intent", expect_intent("leader.intent", self.intent))

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
            x=x_nm * NM,
            y=y_nm * NM,
            heading=heading_in_degrees("heading_deg", heading_deg),
            tas=tas_kt * KT,
            intent=intent,
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
        flown = declared_path(self.x, self.y, self.heading, self.tas, self.intent)
        settle(self, "_trajectory", flown)
        return flown


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class Traffic:
    """Another aircraft at t = 0, with what it has declared it will do, to be kept clear of.

    Examples:
        >>> rg.Traffic(ident="BAW12", x=0.0, y=-60e3, heading=0.8, tas=220.0, min_separation=9e3)
        Traffic(ident='BAW12', x=0.0, y=-60000.0, heading=0.8, tas=220.0, min_separation=9000.0)
    """

    ident: str
    """Its name in answers: 1 to 24 characters."""
    x: Metre
    """East [m]."""
    y: Metre
    """North [m]."""
    heading: Radian
    """Clockwise from north [rad]."""
    tas: MetrePerSecond
    """True airspeed, kept constant [m/s]."""
    min_separation: Metre
    """How near the pursuer may come to it [m]."""
    intent: tuple[IntentPiece, ...] = ()
    """Pieces to come; it keeps its heading behind the last one."""
    altitude: Metre | None = None
    """Pressure altitude [m]; `None` as in `Leader`."""
    _trajectory: Trajectory | None = field(default=None, init=False, compare=False)
    """`trajectory`, once it has been asked for."""

    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse what cannot be flown."""
        expect_ident("traffic.ident", self.ident)
        _settle_aircraft("traffic", self)
        distance = expect_distance("traffic.min_separation", self.min_separation)
        settle(self, "min_separation", distance)
        settle(self, "intent", expect_intent("traffic.intent", self.intent))

    @property
    def trajectory(self) -> Trajectory:
        """What it flies in the air mass; its last heading goes on for ever."""
        if self._trajectory is None:
            flown = declared_path(self.x, self.y, self.heading, self.tas, self.intent)
            settle(self, "_trajectory", flown)
            return flown
        return self._trajectory
