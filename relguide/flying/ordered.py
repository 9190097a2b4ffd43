"""What an aircraft that is not guided does when it is ordered to."""

from typing import assert_never

from relguide.flying.documents import LeaderChanged
from relguide.flying.envelope import flight_level
from relguide.flying.fleet import Fleet
from relguide.flying.orders import (
    IntentKnown,
    LeaderCommand,
    LeaderHeading,
    LeaderLevel,
    LeaderReport,
    LeaderSpeed,
)
from relguide.flying.tracks import TrackState
from relguide.kernels.base.angles import wrap
from relguide.planning.phrases import compass
from relguide.units import DEG, KT, Radian, Second

ORDERED_BANK: Radian = 25.0 * DEG
"""Of the turns that an aircraft makes when ordered to [rad]."""


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
        case LeaderReport(x=x, y=y, track=track, ground_speed=speed, altitude=altitude):
            fleet.fly_to(i, TrackState(x, y, track, speed, altitude), t)
            if not known:
                return False, ()  # what it does is seen as it does it
            message = f"{who} flies as it is reported: its intent is not known."
            said = LeaderChanged(t=t, ident=ident, change="intent_withdrawn", message=message)
            return False, (said,)
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
