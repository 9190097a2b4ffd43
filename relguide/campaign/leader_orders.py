"""What a leader is ordered to do in flight, drawn at random."""

from math import pi

from relguide.campaign.starts import Draw
from relguide.flying.leaders.declared import TurnChoice
from relguide.flying.orders import Command, IntentKnown, LeaderHeading, LeaderSpeed
from relguide.kernels.base.angles import wrap
from relguide.planning.aircraft import Leader
from relguide.units import DEG, Second

SLOWEST = 60.0
"""Slowest leader on command [m/s]: about to land."""


def draw_command(rng: Draw, leader: Leader) -> Command:
    """A turn, a turn back, another speed, or whether the intent is known."""
    drawn = rng.random()
    if drawn < 0.4:
        return LeaderHeading(heading=float(rng.uniform(0.0, 2.0 * pi)), direction=_direction(rng))
    if drawn < 0.5:
        return LeaderHeading(heading=wrap(leader.heading + pi), direction=_direction(rng))
    if drawn < 0.9:
        return LeaderSpeed(tas=max(leader.tas * float(rng.uniform(0.4, 1.15)), SLOWEST))
    return IntentKnown(known=bool(rng.random() < 0.5))


def _direction(rng: Draw) -> TurnChoice:
    choices: tuple[TurnChoice, ...] = ("left", "right", "shorter")
    return choices[rng.integers(3)]


def draw_manoeuvre(rng: Draw, leader: Leader, t: Second) -> tuple[tuple[Second, Command], ...]:
    """What a leader that is followed does from a time on: one of five."""
    t = float(round(t))
    match rng.integers(5):
        case 0:
            return ((t, _speed(leader, rng.uniform(0.5, 0.95))),)
        case 1:
            back = wrap(leader.heading + float(rng.uniform(150.0, 210.0)) * DEG)
            return ((t, LeaderHeading(heading=back, direction=_direction(rng))),)
        case 2:  # as to land
            onto = wrap(leader.heading + float(rng.uniform(-90.0, 90.0)) * DEG)
            return (
                (t, _speed(leader, 0.75)),
                (t + 90.0, LeaderHeading(heading=onto)),
                (t + 180.0, _speed(leader, 0.55)),
                (t + 330.0, _speed(leader, 0.4)),
            )
        case 3:  # slow, and on again
            return (
                (t, _speed(leader, rng.uniform(0.7, 0.9))),
                (t + float(round(rng.uniform(60.0, 300.0))), _speed(leader, 1.0)),
            )
        case _:  # a turn across the wind
            aside = wrap(leader.heading + float(rng.choice([-90.0, 90.0])) * DEG)
            return ((t, LeaderHeading(heading=aside)),)


def _speed(leader: Leader, share: float) -> LeaderSpeed:
    return LeaderSpeed(tas=max(leader.tas * float(share), SLOWEST))
