"""What can be said to a flight while it flies, and what the leader makes of it."""

from collections.abc import Iterable
from dataclasses import dataclass
from math import isfinite, pi
from typing import Literal, assert_never

from relguide.flying.documents import LeaderChanged
from relguide.flying.leader import LeaderFlight, Way, at_speed, turned
from relguide.planning.situation import MAX_TAS, MIN_TAS
from relguide.units import DEG, KT, MetrePerSecond, Radian, Second


@dataclass(frozen=True, slots=True, kw_only=True)
class LeaderHeading:
    """The leader is told a heading. It drops the rest of its intent, or leaves its recording."""

    heading: Radian
    """To roll out on, clockwise from north [rad]."""
    turn: Way = "shorter"
    kind: Literal["leader_heading"] = "leader_heading"

    def __post_init__(self) -> None:
        """Refuse what is no heading."""
        if not isfinite(self.heading):
            raise ValueError(f"heading must be a finite number, not {self.heading}.")
        if self.turn not in ("left", "right", "shorter"):
            raise ValueError(f"turn must be left, right or shorter, not {self.turn!r}.")


@dataclass(frozen=True, slots=True, kw_only=True)
class LeaderSpeed:
    """The leader is told a speed. A recorded one leaves its recording."""

    tas: MetrePerSecond
    kind: Literal["leader_speed"] = "leader_speed"

    def __post_init__(self) -> None:
        """Refuse what no aircraft flies."""
        if not MIN_TAS <= self.tas <= MAX_TAS:
            raise ValueError(f"tas must lie in {MIN_TAS:g} … {MAX_TAS:g} m/s, not {self.tas:g}.")


@dataclass(frozen=True, slots=True, kw_only=True)
class IntentKnown:
    """The leader's intent is received (`True`) or withdrawn (`False`)."""

    known: bool
    kind: Literal["intent_known"] = "intent_known"


Command = LeaderHeading | LeaderSpeed | IntentKnown


def no_commands(t: Second) -> Iterable[Command]:
    """Nobody says anything."""
    return ()


def obey(
    command: Command, leader: LeaderFlight, known: bool, t: Second, bank: Radian
) -> tuple[LeaderFlight, bool, tuple[LeaderChanged, ...]]:
    """The leader, whether its intent is known, and what there is to say, after a command.

    Args:
        command: what is asked.
        leader: before.
        known: whether its intent was known before.
        t: flight time [s].
        bank: of the turns it is told to make [rad].
    """
    match command:
        case LeaderHeading(heading=heading, turn=way):
            degrees = round(heading / DEG) % 360
            message = f"The leader is told to turn to {degrees:03d}°."
            said = LeaderChanged(t=t, change="heading", message=message)
            return (
                turned(leader, t, heading=heading % (2.0 * pi), way=way, bank=bank),
                known,
                (said,),
            )
        case LeaderSpeed(tas=tas):
            message = f"The leader is told to fly {tas / KT:.0f} kt."
            said = LeaderChanged(t=t, change="speed", message=message)
            return at_speed(leader, t, tas), known, (said,)
        case IntentKnown(known=now) if now == known:
            return leader, known, ()
        case IntentKnown(known=True):
            message = "The leader's intent is received."
            return leader, True, (LeaderChanged(t=t, change="intent_received", message=message),)
        case IntentKnown():
            message = "The leader's intent is withdrawn."
            return leader, False, (LeaderChanged(t=t, change="intent_withdrawn", message=message),)
        case _:
            assert_never(command)
