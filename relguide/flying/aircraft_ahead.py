"""In a queue guidance goes by the head; here it minds the aircraft ahead, which is nearer."""

from collections.abc import Sequence
from dataclasses import replace
from math import cos, hypot, sin

from relguide.flying.belief import Belief
from relguide.flying.fleet import Fleet
from relguide.flying.guidance.memory import Advice
from relguide.flying.pursuit import Pursuit
from relguide.kernels.flight.energy import regained
from relguide.kernels.flight.laws import closing_tas, ground_track, tas_for_ground_speed
from relguide.units import MetrePerSecond

IS_AHEAD = 0.5
"""An aircraft farther off the nose than 60° is not ahead: cos 60°."""


def mind_ahead(
    one: Pursuit, pursuits: Sequence[Pursuit], fleet: Fleet, belief: Belief, advice: Advice
) -> Advice:
    """What guidance asks, but no faster than the aircraft ahead allows; nor joined before it.

    Args:
        one: a pursuer.
        pursuits: all of them.
        fleet: all aircraft.
        belief: what the pursuer knows.
        advice: of its guidance.
    """
    if not one.queued:
        return advice
    joined = advice.joined and any(
        other.metrics.joined and other.memory.mode in ("capture", "follow")
        for other in pursuits
        if other.pursuer == one.ahead
    )
    if advice.mode in ("capture", "follow"):
        tas = min(advice.control.tas, _allowed(one, fleet, belief))
        control = advice.control._replace(tas=max(tas, belief.limits.min_tas))
        return replace(advice, joined=joined, control=control)
    return replace(advice, joined=joined)


def _allowed(one: Pursuit, fleet: Fleet, belief: Belief) -> MetrePerSecond:
    """How fast the pursuer may fly behind the aircraft ahead [m/s]."""
    own, ahead, asked = belief.own, fleet.body(one.ahead), one.assignment
    east, north = ahead.x - own.x, ahead.y - own.y
    apart = hypot(east, north)
    if east * sin(own.heading) + north * cos(own.heading) < IS_AHEAD * apart:
        return belief.limits.max_tas
    _, speed = ground_track(ahead, belief.drift)
    keeping = tas_for_ground_speed(own.heading, speed, belief.drift)
    room = apart - asked.buffered_separation
    return float(closing_tas(room, keeping, asked.tas, regained(belief.limits, own), asked.gains))
