"""What to do where no plan keeps d_min: the turn that restores separation, or loses least of it."""

from dataclasses import dataclass
from math import inf, pi

import numpy as np

from relguide.kernels.recovery import soonest_apart, widest_miss
from relguide.planning.certificate import kernel_arrays
from relguide.planning.situation import Situation
from relguide.planning.slot import over_ground
from relguide.units import Metre, Radian, Second

HORIZON: Second = 900.0
"""How far ahead it is looked: two aircraft that have not parted by then fly together [s]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Recovery:
    """A full-bank turn to a heading, then straight."""

    heading: Radian
    """To roll out on, clockwise from north [rad]."""
    turn_angle: Radian
    """Signed, positive to the right [rad]."""
    least_separation: Metre
    """The least separation on the way; now, where it is already lost [m]."""
    at_time: Second
    """When separation is restored, or when it is least [s]; infinite if it is never restored."""
    leader_x: Metre
    """Where the leader is then, east over the ground; where it is now if never [m]."""
    leader_y: Metre
    """The same, north [m]."""


def restore(situation: Situation) -> Recovery:
    """Inside d_min: the turn and straight that brings the aircraft d_min apart soonest."""
    pursuer, rate, leader, pieces = _arrays(situation)
    angle, time = soonest_apart(pursuer, rate, leader, pieces, situation.min_separation, HORIZON)
    _, now, _ = widest_miss(pursuer, rate, leader, pieces, 0.0)
    return _recovery(situation, angle, now, time)


def least_bad(situation: Situation) -> Recovery:
    """Where d_min cannot be kept: the turn and straight whose least separation is largest."""
    angle, least, at = widest_miss(*_arrays(situation), HORIZON)
    return _recovery(situation, angle, least, at)


def _recovery(situation: Situation, angle: float, least: float, at: float) -> Recovery:
    at = at if at < HORIZON else inf
    t = at if at < inf else 0.0
    there = over_ground(situation.leader.trajectory.pose_at(t), t, situation.wind)
    return Recovery(
        heading=(situation.pursuer.heading + angle) % (2.0 * pi),
        turn_angle=angle,
        least_separation=least,
        at_time=at,
        leader_x=there.x,
        leader_y=there.y,
    )


def _arrays(situation: Situation) -> tuple[np.ndarray, float, np.ndarray, np.ndarray]:
    pursuer = situation.pursuer
    start, _ = kernel_arrays(pursuer.flying(()))
    leader, pieces = kernel_arrays(situation.leader.trajectory)
    return start, pursuer.tas / pursuer.turn_radius, leader, pieces
