"""Staying clear of the leader where no plan says how: judged by the same certificate as plans."""

from math import pi

from relguide.flying.capture import Offsets
from relguide.planning.certificate import certify
from relguide.planning.situation import Situation
from relguide.planning.trajectory import LEFT, RIGHT, Arc, Straight, Trajectory
from relguide.units import DEG, Metre, Radian, Second

LOOK_AHEAD: Second = 180.0  # DAIDALUS looks as far; a full half turn at 240 m/s takes 170 s
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
            away = _path(situation, arc, pursuer.tas * LOOK_AHEAD - arc.length)
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
    left = min(until, LOOK_AHEAD) * situation.pursuer.tas - arc.length
    return certify(_path(situation, arc, max(left, 0.0)), situation).holds


def _path(situation: Situation, arc: Arc, straight: Metre) -> Trajectory:
    return situation.pursuer.flying((arc, Straight(length=straight)))
