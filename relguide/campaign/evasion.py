"""What any turn begun at once would keep of d_min: whether a loss could have been avoided."""

from math import hypot, inf

from relguide.flying.airframe_files import airframe
from relguide.kernels.base.turn import turn_rate
from relguide.kernels.flight.flight_records import (
    HOLD_HEADING,
    TURN_RATE,
    Body,
    Control,
    Drift,
    Limits,
)
from relguide.kernels.flight.lateral import lateral_step
from relguide.planning.situation import Situation
from relguide.units import DEG, Metre, Radian, Second

AHEAD: Second = 150.0
"""How long a turn must keep clear; a later loss is not one of the start."""
EVERY: Radian = 10.0 * DEG
"""Between the turns that are tried, to each side up to a full circle."""
STEP: Second = 0.1
STILL = Drift(0.0, 0.0)


def best_turn(situation: Situation) -> Metre:
    """The most that one turn of any angle, at full bank and begun at once, keeps of separation [m].

    The leader flies its true intent; the aircraft rolls as an A300.
    """
    path = situation.leader.trajectory
    leader = [(pose.x, pose.y) for pose in (path.pose_at(i * STEP) for i in range(_steps()))]
    most = 0.0
    for side in (1.0, -1.0):
        for k in range(round(360.0 * DEG / EVERY) + 1):
            most = max(most, _kept_separation(situation, leader, side, k * EVERY, most))
    return most


def _kept_separation(
    situation: Situation,
    leader: list[tuple[Metre, Metre]],
    side: float,
    angle: Radian,
    enough: Metre,
) -> Metre:
    """What one turn keeps; less than `enough` is not looked at to its end."""
    begun = situation.pursuer
    limits = _limits(begun.max_bank)
    out = begun.heading + side * angle
    turning = Control(TURN_RATE, side * turn_rate(begun.tas, begun.max_bank), begun.tas)
    straight = Control(HOLD_HEADING, out, begun.tas)
    body = Body(begun.x, begun.y, begun.heading, 0.0, 0.0, begun.tas, 0.0)
    roll_out = 0.5 * begun.max_bank / limits.max_roll_rate  # turned at full rate while rolling out
    least = hypot(begun.x - leader[0][0], begun.y - leader[0][1])
    for x, y in leader:
        least = min(least, hypot(body.x - x, body.y - y))
        if least < enough:
            break
        to_go = side * (out - body.heading)
        flown = turning if to_go > turn_rate(begun.tas, begun.max_bank) * roll_out else straight
        body = lateral_step(body, flown, limits, STILL, STEP)
    return least


def _limits(max_bank: Radian) -> Limits:
    """Of an A300 that keeps its speed."""
    kind = airframe("A306")
    rolls = max_bank, kind.max_roll_rate, kind.roll_time_constant, kind.speed_time_constant
    thrust = 1.0, 0.0, 0.0
    return Limits(*rolls, *thrust, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, inf)


def _steps() -> int:
    return round(AHEAD / STEP)
