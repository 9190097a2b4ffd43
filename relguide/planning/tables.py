"""A trajectory as the kernels take it: the leader's intent above all, in one home.

Two forms, for two uses:

- `bends_of`: lengths and curvatures, for the certificate. Every plan needs it, so it is a flat
  array of what the segments contain already, and `least_on_paths` makes times of it.
- `motion_of`: durations and turn rates with the start, in the world frame, for all other kernels
  that fly both aircraft there.
"""

from itertools import chain

import numpy as np

from relguide.kernels.base.motion import Motion
from relguide.kernels.base.roots import FloatArray
from relguide.planning.situation import Situation
from relguide.planning.trajectory import Trajectory

_STRAIGHT = np.empty(0)


def leader_bends(situation: Situation) -> FloatArray:
    """`bends_of` what the leader flies before its final leg."""
    return bends_of(situation.leader.trajectory) if situation.leader.intent else _STRAIGHT


def bends_of(trajectory: Trajectory) -> FloatArray:
    """Length [m] and curvature [rad/m, right positive] of each piece in turn.

    shape (2·pieces,)
    """
    bends: list[float] = []
    for segment in trajectory.segments:
        bends.extend(chain.from_iterable(segment.bends))
    return np.array(bends)


def motion_of(trajectory: Trajectory) -> Motion:
    """Where it starts, and how long it turns how fast."""
    bends = trajectory.bends()
    pieces = np.array(bends) if bends else np.empty((0, 2))
    return Motion(trajectory.x, trajectory.y, trajectory.heading, trajectory.tas, pieces)
