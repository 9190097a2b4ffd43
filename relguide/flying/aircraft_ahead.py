"""In a queue guidance goes by the head; here it minds the aircraft ahead, which is nearer.

The aircraft ahead shares where its own guidance takes it: that is its intent, and is drawn.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import cos, hypot, sin

from relguide.flying.belief import Belief
from relguide.flying.documents import LeaderRoute
from relguide.flying.guidance.memory import Advice
from relguide.flying.logbook import leader_route
from relguide.flying.pursuit import Pursuit
from relguide.flying.seen_others import SeenOther
from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.flight.energy import regained
from relguide.kernels.flight.laws import closing_tas, ground_track, tas_for_ground_speed
from relguide.planning.aircraft import Leader
from relguide.planning.intent import final_heading
from relguide.units import DEG, Metre, MetrePerSecond, Radian, Second

ROUTE_OFF: Metre = 500.0
"""A route is drawn anew once its aircraft is so far from where that has it [m]."""
ROUTE_TURNED: Radian = 2.0 * DEG
"""… or once it ends on another heading [rad]."""
IS_AHEAD = 0.5
"""An aircraft farther off the nose than 60° is not ahead: cos 60°."""
IN_TRAIL = 0.94
"""One within 20° of it, on a heading within 20°, is followed in trail: cos 20°."""
IS_BEHIND = -0.34
"""One farther off the nose than 110° is behind: cos 110°."""


def to_keep_clear_of(one: Pursuit, belief: Belief) -> Belief:
    """What a pursuer knows, without those that it need not turn away from.

    Those that follow it mind it, while they are behind. In trail, its own speed minds the aircraft
    ahead.

    Args:
        one: a pursuer.
        belief: with all others.
    """
    if not (one.queued or one.behind):
        return belief
    others = tuple(other for other in belief.others if not _is_minded(one, belief, other))
    return belief if len(others) == len(belief.others) else replace(belief, others=others)


def _is_minded(one: Pursuit, belief: Belief, other: SeenOther) -> bool:
    own, there = belief.own, other.body
    east, north = there.x - own.x, there.y - own.y
    apart = hypot(east, north)
    if apart < one.assignment.kept_separation + other.margin:
        return False
    along = (east * sin(own.heading) + north * cos(own.heading)) / apart
    if other.ident in one.behind:
        return along < IS_BEHIND
    aligned = cos(there.heading - own.heading) > IN_TRAIL
    in_trail = one.queued and one.memory.mode in ("capture", "follow")
    return in_trail and other.ident == one.link.leader and along > IN_TRAIL and aligned


def mind_ahead(one: Pursuit, pursuits: Sequence[Pursuit], belief: Belief, advice: Advice) -> Advice:
    """What guidance asks, but no faster than the aircraft ahead allows; nor joined before it.

    Args:
        one: a pursuer.
        pursuits: all of them.
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
        tas = min(advice.control.tas, _allowed(one, belief))
        control = advice.control._replace(tas=max(tas, belief.limits.min_tas))
        return replace(advice, joined=joined, control=control)
    return replace(advice, joined=joined)


def watch_ahead(one: Pursuit, belief: Belief) -> Iterator[LeaderRoute]:
    """In a queue, draw where the aircraft ahead will fly, and anew where that has changed."""
    if not one.queued:
        return
    now = _seen(one)
    if one.shown_ahead is not None and not _is_elsewhere(*one.shown_ahead, now, belief.t):
        return
    one.shown_ahead = belief.t, now
    there = now.traffic
    expected = Leader(x=there.x, y=there.y, heading=there.heading, tas=there.tas, intent=now.intent)
    yield leader_route(belief.t, one.names, expected, intent_known=now.declared, wind=belief.wind)


def _seen(one: Pursuit) -> SeenOther:
    """The aircraft ahead, as the pursuer last saw it."""
    (ahead,) = (other for other in one.seen_others if other.ident == one.link.leader)
    return ahead


def _is_elsewhere(t: Second, shown: SeenOther, now: SeenOther, then: Second) -> bool:
    """Whether an aircraft is not where its drawn route has it, or will not stay on that."""
    expected, there = shown.after(then - t), now.traffic
    if shown.declared != now.declared:
        return True
    before, after = (final_heading(one.heading, one.intent) for one in (expected, there))
    if abs(wrap_signed(after - before)) > ROUTE_TURNED:
        return True
    return hypot(expected.x - there.x, expected.y - there.y) > ROUTE_OFF


def _allowed(one: Pursuit, belief: Belief) -> MetrePerSecond:
    """How fast the pursuer may fly behind the aircraft ahead [m/s]."""
    own, ahead, asked = belief.own, _seen(one).body, one.assignment
    east, north = ahead.x - own.x, ahead.y - own.y
    apart = hypot(east, north)
    if east * sin(own.heading) + north * cos(own.heading) < IS_AHEAD * apart:
        return belief.limits.max_tas
    _, speed = ground_track(ahead, belief.drift)
    keeping = tas_for_ground_speed(own.heading, speed, belief.drift)
    room = apart - asked.buffered_separation
    return float(
        closing_tas(room, keeping, asked.planned_tas, regained(belief.limits, own), asked.gains)
    )
