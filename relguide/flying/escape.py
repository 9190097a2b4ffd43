"""Staying clear of the leader where no plan says how: judged by the same certificate as plans."""

from math import pi

from relguide.flying.capture import Offsets
from relguide.planning.certificate import certify
from relguide.planning.situation import Situation
from relguide.planning.trajectory import LEFT, RIGHT, Arc, Straight, Trajectory
from relguide.units import DEG, Metre, Radian, Second

LOOK_AHEAD: Second = 180.0  # DAIDALUS looks as far; a half turn at 240 m/s and 25° takes 165 s
TRIED_EVERY: Radian = 10.0 * DEG  # finer than a crew would be told
ON_ROUTE: Radian = 15.0 * DEG  # so aligned, speed alone keeps the spacing


def safe_heading(situation: Situation) -> Radian:
    """The heading nearest to the present one that keeps d_min for three minutes [rad].

    If none does, the one that stays farthest away.
    """
    pursuer = situation.pursuer
    best, best_bound = pursuer.heading, -1.0
    for turn_angle in (k * TRIED_EVERY for k in range(round(pi / TRIED_EVERY) + 1)):
        for turn in (LEFT, RIGHT):
            arc = Arc(turn=turn, turn_angle=turn_angle, radius=pursuer.turn_radius)
            away = _path(situation, arc, LOOK_AHEAD)
            certificate = certify(away, situation)
            heading = (pursuer.heading - turn * turn_angle) % (2.0 * pi)
            if certificate.holds:
                return heading
            if certificate.lower_bound > best_bound:
                best, best_bound = heading, certificate.lower_bound
    return best


def keeps_clear(seen: Offsets, to_slot: Metre, situation: Situation) -> bool:
    """Whether the turn onto the route and on to the slot keeps d_min.

    On the route itself the answer to too little spacing is speed, not another way round.
    """
    if abs(seen.heading) < ON_ROUTE:
        return True
    turn = RIGHT if seen.heading < 0.0 else LEFT
    arc = Arc(turn=turn, turn_angle=abs(seen.heading), radius=situation.pursuer.turn_radius)
    closing = situation.pursuer.tas - situation.leader.tas
    until = to_slot / closing if closing > 0.0 and to_slot > 0.0 else 0.0
    return certify(_path(situation, arc, min(until, LOOK_AHEAD)), situation).holds


def _path(situation: Situation, arc: Arc, until: Second) -> Trajectory:
    """A turn, and straight on until then; at a gentle bank the turn itself may take longer."""
    straight = max(situation.pursuer.tas * until - arc.length, 0.0)
    return situation.pursuer.flying((arc, Straight(length=straight)))
