"""Commands to a flight in the air, whom they are for, and what a leader does with them."""

from collections.abc import Collection, Iterable
from dataclasses import dataclass
from typing import Literal, assert_never, get_args

from relguide.flying.documents import Engagement, LeaderChanged
from relguide.flying.envelope import flight_level
from relguide.flying.fleet import Fleet
from relguide.flying.leaders.declared import TurnChoice
from relguide.kernels.base.angles import wrap
from relguide.planning.inputs import expect_within, text, truth
from relguide.planning.limits import ALTITUDE, HEADING, TAS, VERTICAL_RATE
from relguide.planning.phrases import compass
from relguide.planning.reprs import as_code
from relguide.units import DEG, KT, Metre, MetrePerSecond, Radian, Second

ORDERED_BANK: Radian = 25.0 * DEG
"""Of the turns that a leader makes when ordered to [rad]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LeaderHeading:
    """An aircraft is to turn to a heading. It drops its intent, or leaves its recording."""

    heading: Radian
    """To roll out on, clockwise from north [rad]."""
    direction: TurnChoice = "shorter"
    ident: str = ""
    """Of the aircraft that is to do so; empty for the first link's leader."""
    kind: Literal["leader_heading"] = "leader_heading"
    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse a heading that is no number, and an unknown direction."""
        _settle_heading(self)
        text("ident", self.ident)
        if not isinstance(self.direction, str) or self.direction not in get_args(TurnChoice):
            raise ValueError(f"direction must be left, right or shorter, not {self.direction!r}.")


@dataclass(frozen=True, slots=True, kw_only=True)
class LeaderSpeed:
    """An aircraft is to fly at a true airspeed [m/s]. A recorded one leaves its recording."""

    tas: MetrePerSecond
    ident: str = ""
    """Of the aircraft that is to do so; empty for the first link's leader."""
    kind: Literal["leader_speed"] = "leader_speed"
    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse a speed outside the accepted range."""
        object.__setattr__(self, "tas", expect_within("tas", self.tas, *TAS))
        text("ident", self.ident)


@dataclass(frozen=True, slots=True, kw_only=True)
class LeaderLevel:
    """An aircraft is to climb or descend to a level. A recorded one leaves its recording."""

    altitude: Metre
    """Pressure altitude [m]."""
    rate: MetrePerSecond = 7.62
    """How fast [m/s], > 0; 1,500 ft/min."""
    ident: str = ""
    """Of the aircraft that is to do so; empty for the first link's leader."""
    kind: Literal["leader_level"] = "leader_level"
    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse a level or a rate outside the accepted range."""
        for name, accepted in (("altitude", ALTITUDE), ("rate", VERTICAL_RATE)):
            value = expect_within(name, getattr(self, name), *accepted)
            object.__setattr__(self, name, value)
        text("ident", self.ident)


@dataclass(frozen=True, slots=True, kw_only=True)
class IntentKnown:
    """The leader's intent is received (`True`) or withdrawn (`False`)."""

    known: bool
    ident: str = ""
    """Of the leader; empty for the first link's."""
    kind: Literal["intent_known"] = "intent_known"
    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse what is no truth value."""
        object.__setattr__(self, "known", truth("known", self.known))
        text("ident", self.ident)


@dataclass(frozen=True, slots=True, kw_only=True)
class LeaderData:
    """The leader's reports are received (`True`) or not (`False`)."""

    received: bool
    ident: str = ""
    """Of the pursuer that receives them; empty for the first link's."""
    kind: Literal["leader_data"] = "leader_data"
    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse what is no truth value."""
        object.__setattr__(self, "received", truth("received", self.received))
        text("ident", self.ident)


@dataclass(frozen=True, slots=True, kw_only=True)
class PursuerHeading:
    """The crew selects a heading, which is flown until guidance is engaged."""

    heading: Radian
    """Clockwise from north [rad]."""
    ident: str = ""
    """Of the pursuer whose crew does so; empty for the first link's."""
    kind: Literal["pursuer_heading"] = "pursuer_heading"
    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse a heading that is no number."""
        _settle_heading(self)
        text("ident", self.ident)


@dataclass(frozen=True, slots=True, kw_only=True)
class SetEngagement:
    """The crew engages guidance further, or less far."""

    engagement: Engagement
    ident: str = ""
    """Of the pursuer whose crew does so; empty for the first link's."""
    kind: Literal["set_engagement"] = "set_engagement"
    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse what is no engagement."""
        expect_engagement(self.engagement)
        text("ident", self.ident)


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
"""What a leader does, or any other aircraft that is not guided."""
CrewCommand = LeaderData | PursuerHeading | SetEngagement
"""What a pursuer's crew does, and what it receives."""
Command = LeaderCommand | CrewCommand


def no_commands(t: Second) -> Iterable[Command]:
    """No commands at all."""
    return ()


def order_fault(
    command: Command, aircraft: Collection[str], links: Collection[tuple[str, str]]
) -> str:
    """Why the aircraft that a command names cannot be given it, in a sentence; empty if it can.

    Args:
        command: what is asked.
        aircraft: idents of all that fly.
        links: idents of each pursuer and its leader, the first link first.
    """
    ident, pursuers = command.ident, [pursuer for pursuer, _ in links]
    if ident and ident not in aircraft:
        return f"There is no aircraft {ident!r} to order: there are {', '.join(aircraft)}."
    match command:
        case LeaderHeading() | LeaderSpeed() | LeaderLevel():
            ordered = ident or next((leader for _, leader in links), "")
            if ordered in pursuers:
                return (
                    f"{ordered} joins a leader, and its guidance flies it: order its crew to "
                    "disconnect guidance and to select a heading."
                )
        case IntentKnown():
            leaders = list(dict.fromkeys(leader for _, leader in links))
            if ident and ident not in leaders:
                followed = ", ".join(leaders) or "none of them"
                return f"No pursuer follows {ident}: followed is {followed}."
        case _:
            if ident and ident not in pursuers:
                those = ", ".join(pursuers) or "none of them"
                return f"{ident} is no pursuer, so it has no crew to order: {those} is."
    return ""


def obey(
    command: LeaderCommand, fleet: Fleet, i: int, known: bool, t: Second
) -> tuple[bool, tuple[LeaderChanged, ...]]:
    """Carry out a command: whether the intent is known then, and what is said of it.

    Args:
        command: what is asked.
        fleet: does as it is ordered.
        i: which of the fleet is ordered.
        known: whether its intent was known before.
        t: flight time [s].
    """
    ident = fleet.world.aircraft[i].ident
    who = command.ident or "The leader"
    match command:
        case LeaderHeading(heading=heading, direction=direction):
            fleet.turn(i, wrap(heading), direction, ORDERED_BANK)
            message = f"{who} is instructed to turn to {compass(heading)}."
            return known, (LeaderChanged(t=t, ident=ident, change="heading", message=message),)
        case LeaderSpeed(tas=tas):
            fleet.set_speed(i, tas)
            message = f"{who} is instructed to fly {tas / KT:.0f} kt."
            return known, (LeaderChanged(t=t, ident=ident, change="speed", message=message),)
        case LeaderLevel(altitude=altitude, rate=rate):
            below = altitude < fleet.verticals[i].altitude
            fleet.change_level(i, altitude, rate, "cas")
            way, level = "descend" if below else "climb", flight_level(altitude)
            message = f"{who} is instructed to {way} to {level}."
            return known, (LeaderChanged(t=t, ident=ident, change="level", message=message),)
        case IntentKnown(known=now) if now == known:
            return known, ()
        case IntentKnown(known=True):
            message = f"{who}'s intent is received."
            said = LeaderChanged(t=t, ident=ident, change="intent_received", message=message)
            return True, (said,)
        case IntentKnown():
            message = f"{who}'s intent is withdrawn."
            said = LeaderChanged(t=t, ident=ident, change="intent_withdrawn", message=message)
            return False, (said,)
        case _:
            assert_never(command)
