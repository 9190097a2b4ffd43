"""A trajectory as the kernels take it: the leader's intent above all, in one home.

Three forms, for three uses:

- `path_of`: lengths and curvatures after the start, for the certificate and for how the leader is
  passed. Every plan needs it, so it is a flat array of what the segments contain already, and the
  kernels make times of it (`motion_along`).
- `motion_of`: durations and turn rates with the start, in the world frame, for all other kernels
  that fly both aircraft there.
- `scene_of`: the leader's pieces as a table in the slot frame, with d_min and the release time, for
  the searches.
"""

from itertools import chain
from math import inf

import numpy as np

from relguide.kernels.base.motion import Motion
from relguide.kernels.base.records import Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.path_pieces import NO_TURN
from relguide.planning.situation import Situation
from relguide.planning.slot import SlotFrame
from relguide.planning.trajectory import Trajectory


def leader_path(situation: Situation) -> FloatArray:
    """`path_of` what the leader flies before its final leg."""
    leader = situation.leader
    if leader.intent:
        return path_of(leader.trajectory)
    return np.array((leader.x, leader.y, leader.heading, leader.tas))


def path_of(trajectory: Trajectory) -> FloatArray:
    """Its start, then length [m] and curvature [rad/m, right positive] of each piece in turn.

    x, y [m], heading [rad] and speed [m/s] come first. shape (4 + 2·pieces,)
    """
    path = [trajectory.x, trajectory.y, trajectory.heading, trajectory.tas]
    for segment in trajectory.segments:
        path.extend(chain.from_iterable(segment.bends))
    return np.array(path)


def motion_of(trajectory: Trajectory) -> Motion:
    """Where it starts, and how long it turns how fast."""
    bends = trajectory.bends()
    pieces = np.array(bends) if bends else np.empty((0, 2))
    return Motion(trajectory.x, trajectory.y, trajectory.heading, trajectory.tas, pieces)


def scene_of(situation: Situation, frame: SlotFrame) -> Scene:
    """What a path has to reckon with, in the slot frame."""
    leader, d_min = leader_table(situation, frame), situation.min_separation / frame.radius
    return Scene(leader, frame.alpha, d_min, frame.t_release)


def leader_table(situation: Situation, frame: SlotFrame) -> FloatArray:
    """The leader's pieces in the slot frame: see `pieces_table`."""
    return pieces_table(situation.leader.trajectory, situation, frame)


def pieces_table(flown: Trajectory, situation: Situation, frame: SlotFrame) -> FloatArray:
    """Pieces of any aircraft in the slot frame, a row each: start time, x, y, heading, turn rate.

    Lengths in R, times in R/V_P, angles counter-clockwise; the last row is its endless final leg.
    shape (pieces, 5)
    """
    tas = situation.pursuer.tas
    table: list[tuple[float, ...]] = []
    t = 0.0
    pieces = zip((*flown.durations(), inf), (*flown.turn_rates(), 0.0), strict=True)
    for pose, (duration, rate) in zip(flown.breakpoints(), pieces, strict=True):
        if duration * tas / frame.radius > NO_TURN:  # shorter pieces are rounding
            x, y = frame.to_slot(pose.x, pose.y)
            turning = -rate * frame.radius / tas
            table.append((t * tas / frame.radius, x, y, frame.heading - pose.heading, turning))
        t += duration
    return np.array(table)
