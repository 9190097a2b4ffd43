"""What to do where no plan keeps d_min: the turn that restores separation, or loses least of it."""

from dataclasses import dataclass
from math import inf

from relguide.kernels.base.angles import wrap
from relguide.kernels.base.motion import Motion
from relguide.kernels.separation.least_bad_turn import soonest_clear_turn, widest_miss
from relguide.planning.phrases import compass, distance
from relguide.planning.situation import Situation
from relguide.planning.slot import over_ground
from relguide.planning.tables import motion_of
from relguide.units import Metre, Radian, Second

HORIZON: Second = 900.0
"""How far ahead to look: two aircraft that have not parted by then fly together [s]."""
_LOOKED = f"{HORIZON / 60.0:.0f} minutes"


@dataclass(frozen=True, slots=True, kw_only=True)
class Recovery:
    """A full-bank turn to a heading, then straight."""

    heading: Radian
    """To roll out on, clockwise from north [rad]."""
    turn_angle: Radian
    """Signed, positive to the right [rad]."""
    least_separation: Metre
    """The least separation from now on; now, where it is already lost [m]."""
    at_time: Second
    """When separation is restored, or when it is least [s]; infinite if it is not restored within
    `HORIZON`, or still falls then."""
    leader_x: Metre
    """Where the leader is then, east over the ground; where it is now if never [m]."""
    leader_y: Metre
    """The same, north [m]."""


def restore(situation: Situation) -> Recovery:
    """Inside d_min: the turn and straight that brings the aircraft d_min apart soonest."""
    pursuer, rate, leader = _motions(situation)
    angle, time = soonest_clear_turn(pursuer, rate, leader, situation.min_separation, HORIZON)
    _, now, _ = widest_miss(pursuer, rate, leader, 0.0)
    return _recovery(situation, angle, now, time)


def least_bad(situation: Situation) -> Recovery:
    """Where d_min cannot be kept: the turn and straight whose least separation is largest."""
    angle, least, at = widest_miss(*_motions(situation), HORIZON)
    return _recovery(situation, angle, least, at)


def restore_sentence(recovery: Recovery) -> str:
    """What `restore` found, for people."""
    if recovery.at_time == inf:
        return f"No turn restores separation within {_LOOKED}: the leader would have to turn away."
    return f"Soonest out: {_turn(recovery)}; separation is restored in {recovery.at_time:.0f} s."


def least_bad_sentence(recovery: Recovery) -> str:
    """What `least_bad` found, for people."""
    if recovery.at_time == 0.0:
        return (
            "A smaller minimum separation or a larger slot distance would help; "
            f"{_turn(recovery)} keeps clear meanwhile."
        )
    when = (
        f"least in {recovery.at_time:.0f} s with the leader at "
        f"x {recovery.leader_x / 1000.0:.1f} km, y {recovery.leader_y / 1000.0:.1f} km"
        if recovery.at_time < inf
        else f"the aircraft still closing after {_LOOKED}"
    )
    return (
        f"Least bad: {_turn(recovery)}, which keeps {distance(recovery.least_separation)}, {when}. "
        "A smaller minimum separation would help."
    )


def _recovery(situation: Situation, angle: float, least: float, at: float) -> Recovery:
    at = at if at < HORIZON else inf
    t = at if at < inf else 0.0
    there = over_ground(situation.leader.trajectory.pose_at(t), t, situation.wind)
    return Recovery(
        heading=wrap(situation.pursuer.heading + angle),
        turn_angle=angle,
        least_separation=least,
        at_time=at,
        leader_x=there.x,
        leader_y=there.y,
    )


def _motions(situation: Situation) -> tuple[Motion, float, Motion]:
    """The pursuer, its turn rate at full bank [rad/s], and the leader."""
    pursuer = situation.pursuer
    rate = pursuer.tas / pursuer.turn_radius
    return motion_of(pursuer.flying(())), rate, motion_of(situation.leader.trajectory)


def _turn(recovery: Recovery) -> str:
    heading = f"heading {compass(recovery.heading)}"
    if recovery.turn_angle == 0.0:
        return f"hold {heading}"
    return f"turn {'right' if recovery.turn_angle > 0.0 else 'left'} to {heading}"
