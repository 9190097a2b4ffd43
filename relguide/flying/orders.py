"""Commands to a flight in the air, and what the leader does with them."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal, assert_never, get_args

from relguide.flying.documents import Engagement, LeaderChanged
from relguide.flying.envelope import flight_level
from relguide.flying.fleet import Fleet
from relguide.flying.leaders.declared import TurnChoice
from relguide.kernels.base.angles import wrap
from relguide.planning.inputs import expect_within, truth
from relguide.planning.limits import ALTITUDE, HEADING, TAS, VERTICAL_RATE
from relguide.planning.phrases import compass
from relguide.units import DEG, KT, Metre, MetrePerSecond, Radian, Second

ORDERED_BANK: Radian = 25.0 * DEG
"""Of the turns that a leader makes when ordered to [rad]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LeaderHeading:
    """The leader is to turn to a heading. It drops its intent, or leaves its recording."""

    heading: Radian
    """To roll out on, clockwise from north [rad]."""
    direction: TurnChoice = "shorter"
    kind: Literal["leader_heading"] = "leader_heading"

    def __post_init__(self) -> None:
        """Refuse a heading that is no number, and an unknown direction."""
        _settle_heading(self)
        if not isinstance(self.direction, str) or self.direction not in get_args(TurnChoice):
            raise ValueError(f"direction must be left, right or shorter, not {self.direction!r}.")


@dataclass(frozen=True, slots=True, kw_only=True)
class LeaderSpeed:
    """The leader is to fly at a true airspeed [m/s]. A recorded leader leaves its recording."""

    tas: MetrePerSecond
    kind: Literal["leader_speed"] = "leader_speed"

    def __post_init__(self) -> None:
        """Refuse a speed outside the accepted range."""
        object.__setattr__(self, "tas", expect_within("tas", self.tas, *TAS))


@dataclass(frozen=True, slots=True, kw_only=True)
class LeaderLevel:
    """The leader is to climb or descend to a level. A recorded leader leaves its recording."""

    altitude: Metre
    """Pressure altitude [m]."""
    rate: MetrePerSecond = 7.62
    """How fast [m/s], > 0; 1,500 ft/min."""
    kind: Literal["leader_level"] = "leader_level"

    def __post_init__(self) -> None:
        """Refuse a level or a rate outside the accepted range."""
        for name, accepted in (("altitude", ALTITUDE), ("rate", VERTICAL_RATE)):
            value = expect_within(name, getattr(self, name), *accepted)
            object.__setattr__(self, name, value)


@dataclass(frozen=True, slots=True, kw_only=True)
class IntentKnown:
    """The leader's intent is received (`True`) or withdrawn (`False`)."""

    known: bool
    kind: Literal["intent_known"] = "intent_known"

    def __post_init__(self) -> None:
        """Refuse what is no truth value."""
        object.__setattr__(self, "known", truth("known", self.known))


@dataclass(frozen=True, slots=True, kw_only=True)
class LeaderData:
    """The leader's reports are received (`True`) or not (`False`)."""

    received: bool
    kind: Literal["leader_data"] = "leader_data"

    def __post_init__(self) -> None:
        """Refuse what is no truth value."""
        object.__setattr__(self, "received", truth("received", self.received))


@dataclass(frozen=True, slots=True, kw_only=True)
class PursuerHeading:
    """The crew selects a heading, which is flown until guidance is engaged."""

    heading: Radian
    """Clockwise from north [rad]."""
    kind: Literal["pursuer_heading"] = "pursuer_heading"

    def __post_init__(self) -> None:
        """Refuse a heading that is no number."""
        _settle_heading(self)


@dataclass(frozen=True, slots=True, kw_only=True)
class SetEngagement:
    """The crew engages guidance further, or less far."""

    engagement: Engagement
    kind: Literal["set_engagement"] = "set_engagement"

    def __post_init__(self) -> None:
        """Refuse what is no engagement."""
        expect_engagement(self.engagement)


def expect_engagement(value: object) -> None:
    """Refuse what is no engagement.

    Raises:
        ValueError: naming those that there are.
    """
    if not isinstance(value, str) or value not in get_args(Engagement):
        choices = ", ".join(get_args(Engagement))
        raise ValueError(f"engagement must be one of {choices}, not {value!r}.")


def _settle_heading(order: LeaderHeading | PursuerHeading) -> None:
    object.__setattr__(order, "heading", expect_within("heading", order.heading, *HEADING))


LeaderCommand = LeaderHeading | LeaderSpeed | LeaderLevel | IntentKnown
"""What the leader does."""
CrewCommand = LeaderData | PursuerHeading | SetEngagement
"""What the pursuer's crew does, and what it receives."""
Command = LeaderCommand | CrewCommand


def no_commands(t: Second) -> Iterable[Command]:
    """No commands at all."""
    return ()


def obey(
    command: LeaderCommand, fleet: Fleet, i: int, known: bool, t: Second
) -> tuple[bool, tuple[LeaderChanged, ...]]:
    """Carry out a command: whether the leader's intent is known then, and what is said of it.

    Args:
        command: what is asked.
        fleet: the leader is one of it, and does as it is ordered.
        i: which of the fleet.
        known: whether its intent was known before.
        t: flight time [s].
    """
    ident = fleet.world.aircraft[i].ident
    match command:
        case LeaderHeading(heading=heading, direction=direction):
            fleet.turn(i, wrap(heading), direction, ORDERED_BANK)
            message = f"The leader is instructed to turn to {compass(heading)}."
            return known, (LeaderChanged(t=t, ident=ident, change="heading", message=message),)
        case LeaderSpeed(tas=tas):
            fleet.set_speed(i, tas)
            message = f"The leader is instructed to fly {tas / KT:.0f} kt."
            return known, (LeaderChanged(t=t, ident=ident, change="speed", message=message),)
        case LeaderLevel(altitude=altitude, rate=rate):
            below = altitude < fleet.verticals[i].altitude
            fleet.change_level(i, altitude, rate, "cas")
            way, level = "descend" if below else "climb", flight_level(altitude)
            message = f"The leader is instructed to {way} to {level}."
            return known, (LeaderChanged(t=t, ident=ident, change="level", message=message),)
        case IntentKnown(known=now) if now == known:
            return known, ()
        case IntentKnown(known=True):
            message = "The leader's intent is received."
            said = LeaderChanged(t=t, ident=ident, change="intent_received", message=message)
            return True, (said,)
        case IntentKnown():
            message = "The leader's intent is withdrawn."
            said = LeaderChanged(t=t, ident=ident, change="intent_withdrawn", message=message)
            return False, (said,)
        case _:
            assert_never(command)
