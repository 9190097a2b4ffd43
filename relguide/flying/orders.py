"""Commands to a flight in the air, and whom they are for."""

from collections.abc import Collection, Iterable
from dataclasses import dataclass
from math import degrees, radians
from typing import Literal, get_args

from relguide.flying.engagement import Engagement
from relguide.flying.leaders.declared import TurnChoice
from relguide.planning.inputs import Range, expect_within, number, text, truth
from relguide.planning.limits import (
    ALTITUDE,
    BANK,
    DISTANCE,
    HEADING,
    POSITION,
    TAS,
    VERTICAL_RATE,
)
from relguide.planning.reprs import as_code
from relguide.units import DEG, Metre, MetrePerSecond, Radian, Second

DEFLECTION = Range(-1.0, 1.0, "of full deflection")
"""Of a stick."""
GROUND_SPEED = Range(0.0, 600.0, "m/s")
"""Of an aircraft that is reported."""


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
    """True airspeed [m/s]."""
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
class LeaderReport:
    """Where an aircraft is reported to be, a second from now: it flies there.

    It drops its intent, or leaves its recording. Without another report in the next second it
    flies on as it then flies.
    """

    x: Metre
    """East [m]."""
    y: Metre
    """North [m]."""
    track: Radian
    """Direction of its ground velocity, clockwise from north [rad]."""
    ground_speed: MetrePerSecond
    """[m/s]."""
    altitude: Metre
    """Pressure altitude [m]."""
    ident: str = ""
    """Of the aircraft; empty for the first link's leader."""
    kind: Literal["leader_report"] = "leader_report"
    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse what no aircraft flies."""
        accepted = {
            "x": POSITION,
            "y": POSITION,
            "ground_speed": GROUND_SPEED,
            "altitude": ALTITUDE,
        }
        for name, bounds in accepted.items():
            object.__setattr__(self, name, expect_within(name, getattr(self, name), *bounds))
        track = expect_within("track", self.track, *HEADING)
        object.__setattr__(self, "track", _as_recorded(track))
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


@dataclass(frozen=True, slots=True, kw_only=True)
class PursuerBank:
    """The crew selects the bank that plans turn with."""

    bank: Radian
    """φ_max [rad], > 0."""
    ident: str = ""
    """Of the pursuer whose crew does so; empty for the first link's."""
    kind: Literal["pursuer_bank"] = "pursuer_bank"
    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse a bank outside the accepted range."""
        bank = number("bank", self.bank)
        expect_within("bank", bank / DEG, *BANK)
        object.__setattr__(self, "bank", _as_recorded(bank))
        text("ident", self.ident)


@dataclass(frozen=True, slots=True, kw_only=True)
class PursuerSpeed:
    """The crew selects a speed in place of the one that guidance asks for."""

    tas: MetrePerSecond
    """True airspeed [m/s]; 0 leaves the speed to guidance again."""
    ident: str = ""
    """Of the pursuer whose crew does so; empty for the first link's."""
    kind: Literal["pursuer_speed"] = "pursuer_speed"
    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse a speed outside the accepted range."""
        if number("tas", self.tas) != 0.0:
            object.__setattr__(self, "tas", expect_within("tas", self.tas, *TAS))
        text("ident", self.ident)


@dataclass(frozen=True, slots=True, kw_only=True)
class SetSpacing:
    """The crew changes D, d_min or both in flight."""

    slot_distance: Metre = 0.0
    """D [m]; 0 leaves it as it is."""
    min_separation: Metre = 0.0
    """d_min [m]; 0 leaves it as it is."""
    ident: str = ""
    """Of the pursuer whose crew does so; empty for the first link's."""
    kind: Literal["set_spacing"] = "set_spacing"
    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse distances outside the accepted range, and none at all."""
        for name in ("slot_distance", "min_separation"):
            value = expect_within(name, getattr(self, name), *DISTANCE)
            object.__setattr__(self, name, value)
        if self.slot_distance == self.min_separation == 0.0:
            raise ValueError("Give slot_distance or min_separation, or both.")
        text("ident", self.ident)


@dataclass(frozen=True, slots=True, kw_only=True)
class SetAutopilot:
    """The crew takes control from the autopilot (`False`), or gives it back (`True`)."""

    on: bool
    ident: str = ""
    """Of the pursuer whose crew does so; empty for the first link's."""
    kind: Literal["set_autopilot"] = "set_autopilot"
    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse what is no truth value."""
        object.__setattr__(self, "on", truth("on", self.on))
        text("ident", self.ident)


@dataclass(frozen=True, slots=True, kw_only=True)
class SetDirector:
    """The crew switches the flight director's bars on (`True`) or off."""

    on: bool
    ident: str = ""
    """Of the pursuer whose crew does so; empty for the first link's."""
    kind: Literal["set_director"] = "set_director"
    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse what is no truth value."""
        object.__setattr__(self, "on", truth("on", self.on))
        text("ident", self.ident)


@dataclass(frozen=True, slots=True, kw_only=True)
class Stick:
    """The crew moves the stick, which stays there until the next such order.

    Deflections ask for rates: neutral keeps the bank, and the rate of climb.
    """

    roll: float
    """1 asks for the type's full rate of roll to the right, −1 to the left."""
    pitch: float = 0.0
    """1 pulls up with 0.1 g, −1 pushes down with as much."""
    ident: str = ""
    """Of the pursuer whose crew does so; empty for the first link's."""
    kind: Literal["stick"] = "stick"
    __repr__ = as_code

    def __post_init__(self) -> None:
        """Refuse more than full deflection."""
        for name in ("roll", "pitch"):
            object.__setattr__(self, name, expect_within(name, getattr(self, name), *DEFLECTION))
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
    heading = expect_within("heading", order.heading, *HEADING)
    object.__setattr__(order, "heading", _as_recorded(heading))


def _as_recorded(angle: Radian) -> Radian:
    """An angle in [0, 2π) that is read back to the bit from a recording, which has degrees [rad].

    It is within rounding of the one given: a flight is flown again with the very same orders.
    """
    while (read := radians(degrees(angle) % 360.0 % 360.0)) != angle:  # −1e-17 % 360 is 360
        angle = read
    return angle


NewTask = PursuerBank | PursuerSpeed | SetSpacing
"""What a crew asks of its guidance."""
LeaderCommand = LeaderHeading | LeaderSpeed | LeaderLevel | LeaderReport | IntentKnown
"""What a leader does, or any other aircraft that is not guided."""
CrewCommand = (
    LeaderData
    | PursuerHeading
    | PursuerBank
    | PursuerSpeed
    | SetSpacing
    | SetEngagement
    | SetAutopilot
    | SetDirector
    | Stick
)
"""What a pursuer's crew does, and what it receives."""
Command = LeaderCommand | CrewCommand
"""An order to a flight: `fly` polls for them."""


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
        case LeaderHeading() | LeaderSpeed() | LeaderLevel() | LeaderReport():
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
