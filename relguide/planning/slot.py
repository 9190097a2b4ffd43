"""The slot, and a situation without its dimensions: world → air mass → slot frame.

Air mass. In a uniform wind both aircraft drift alike: planning is done in the frame that moves with
the air, which is the world frame at t = 0. A point of the air mass is over the ground at
p + wind·t.

Slot frame. Extend the leader's final leg backward: from t = 0 on, the slot is a point in uniform
straight motion. Put the origin there at t = 0, the x axis along the leader's final heading, count
angles counter-clockwise from it, lengths in R and times in R/V_P. What remains of a situation is
(x, y, h, α) and the time t_release before which the slot may not be taken.
"""

from dataclasses import dataclass
from math import cos, sin

from relguide.kernels.base import records
from relguide.kernels.base import slot_frame as kernel
from relguide.kernels.base.angles import wrap
from relguide.kernels.base.slot_frame import to_slot
from relguide.planning.situation import Situation
from relguide.planning.trajectory import Arc, Pose, Trajectory
from relguide.planning.wind import Wind


@dataclass(frozen=True, slots=True, kw_only=True)
class SlotFrame:
    """A situation without its dimensions."""

    x: float
    """Pursuer along the leader's final heading, relative to the slot at t = 0 [R]."""
    y: float
    """Pursuer to the left of it [R]."""
    h: float
    """Pursuer's heading, counter-clockwise from the leader's final heading [rad], in [0, 2π)."""
    alpha: float
    """Speed ratio V_L/V_P."""
    t_release: float
    """When the slot opens [R/V_P]; 0 when it is open from the start."""
    radius: float
    """R [m]."""
    heading: float
    """The leader's final heading, clockwise from north [rad]."""
    origin_x: float
    """The slot at t = 0, east [m]."""
    origin_y: float
    """The slot at t = 0, north [m]."""

    @property
    def pose(self) -> records.Pose:
        """The pursuer's pose at t = 0, as kernels take it."""
        return records.Pose(self.x, self.y, self.h)

    def to_slot(self, x: float, y: float) -> tuple[float, float]:
        """A point of the air mass [m] in this frame [R]."""
        return to_slot(x - self.origin_x, y - self.origin_y, self.heading, self.radius)


def slot_frame(situation: Situation, leader: Trajectory) -> SlotFrame:
    """Reduce a situation to its slot frame.

    Args:
        situation: what is to be planned.
        leader: `situation.leader.trajectory`, which callers have at hand.
    """
    pursuer = situation.pursuer
    radius = pursuer.turn_radius
    end, flown = leader.breakpoints()[-1], leader.duration
    turns = any(isinstance(s, Arc) and s.turn_angle > 0.0 for s in leader.segments)
    offset_x, offset_y, ground_speed = slot_offset(end.heading, leader.tas, situation)
    t_release = flown + situation.slot_distance / ground_speed if turns else 0.0
    origin_x = end.x - leader.tas * flown * sin(end.heading) + offset_x
    origin_y = end.y - leader.tas * flown * cos(end.heading) + offset_y
    x, y = to_slot(pursuer.x - origin_x, pursuer.y - origin_y, end.heading, radius)
    return SlotFrame(
        x=x,
        y=y,
        h=wrap(end.heading - pursuer.heading),
        alpha=leader.tas / pursuer.tas,
        t_release=t_release * pursuer.tas / radius,
        radius=radius,
        heading=end.heading,
        origin_x=origin_x,
        origin_y=origin_y,
    )


def slot_offset(heading: float, tas: float, situation: Situation) -> tuple[float, float, float]:
    """From the leader to the slot: D back along the leader's ground track.

    Args:
        heading: the leader's heading on the final leg, clockwise from north [rad].
        tas: its true airspeed [m/s].
        situation: gives D and the wind.

    Returns:
        offset east and north [m], and the leader's ground speed [m/s].
    """
    wind = situation.wind
    return kernel.slot_offset(heading, tas, wind.east, wind.north, situation.slot_distance)


def over_ground(pose: Pose, t: float, wind: Wind) -> Pose:
    """A pose of the air mass, seen over the ground at time t [s]."""
    return Pose(x=pose.x + wind.east * t, y=pose.y + wind.north * t, heading=pose.heading)
