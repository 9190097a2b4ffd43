"""The fastest path to the slot of a leader that keeps straight, in one call from the world frame.

Most plans are of this kind, and a call into compiled code with the conversions around it takes as
long as the search itself. So `slot_frame` and `fastest` are called together here.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.angles import wrap
from relguide.kernels.base.records import Pose
from relguide.kernels.base.slot_frame import slot_offset, to_slot
from relguide.kernels.words.fastest import fastest
from relguide.kernels.words.sooner import make_scratch


@njit(cache=True, nogil=True)
def fastest_to_slot(
    x: float, y: float, heading: float, tas: float, radius: float, leader_x: float,
    leader_y: float, leader_heading: float, leader_tas: float, slot_distance: float,
    wind_east: float, wind_north: float,
) -> tuple[float, int, float, float, float]:  # fmt: skip
    """The first row of `solve`, for a slot that is open from the start.

    Args:
        x: the pursuer at t = 0, east [m].
        y: the same, north [m].
        heading: its heading, clockwise from north [rad].
        tas: V_P [m/s].
        radius: R [m].
        leader_x: the leader at t = 0, east [m].
        leader_y: the same, north [m].
        leader_heading: its heading, which it keeps, clockwise from north [rad].
        leader_tas: V_L [m/s].
        slot_distance: D [m].
        wind_east: the air mass over the ground [m/s].
        wind_north: the same, north [m/s].

    Returns:
        arrival [R/V_P], infinite if there is none; the word's number; its three amounts [rad or R].
    """
    east, north, _ = slot_offset(leader_heading, leader_tas, wind_east, wind_north, slot_distance)
    along, left = to_slot(x - leader_x - east, y - leader_y - north, leader_heading, radius)
    h, alpha = wrap(leader_heading - heading), leader_tas / tas
    row = np.empty(5)
    if not fastest(Pose(along, left, h), alpha, 0.0, 0, make_scratch(), row):
        return inf, 0, 0.0, 0.0, 0.0
    return row[0], int(row[1]), row[2], row[3], row[4]
