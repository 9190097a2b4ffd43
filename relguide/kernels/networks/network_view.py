"""A situation behind a leader that keeps straight, as networks see it, and whether the limit binds.

One call from the world frame: a call into compiled code with the conversions around it takes as
long as the work done here (see `straight_leader`).
"""

from numba import njit

from relguide.kernels.base.angles import mirror_heading, wrap
from relguide.kernels.base.records import Pose, straight_scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.slot_frame import slot_offset, to_slot
from relguide.kernels.contact.constrained_rows import breaks_limit
from relguide.kernels.separation.clearance import SLACK
from relguide.kernels.words.branches import needs_mirror

_ASIDE = 1e-9  # the slot counts as straight behind the leader [R]: 10 µm for an airliner


Where = tuple[float, float, float, float, float, float]
"""A situation in its slot frame: pursuer ahead of the slot and left of it [R], its heading [rad] in
[0, 2π), the leader ahead of the slot [R], V_L/V_P, d_min [R]."""


@njit(cache=True, nogil=True)
def mirror_to_left(pose: Pose) -> tuple[Pose, bool]:
    """The pose on the left of the route that networks look at, and whether that is mirrored."""
    if needs_mirror(pose.y, pose.h):
        return Pose(pose.x, -pose.y, mirror_heading(pose.h)), True
    return pose, False


@njit(cache=True, nogil=True)
def view(
    x: float, y: float, heading: float, tas: float, radius: float, leader_x: float,
    leader_y: float, leader_heading: float, leader_tas: float, slot_distance: float,
    min_separation: float, wind_east: float, wind_north: float, free: FloatArray,
) -> tuple[bool, Where]:  # fmt: skip
    """Where pursuer, slot and leader are, and whether the fastest path without the limit breaks it.

    Arguments as of `straight_leader.fastest_to_slot`; besides, `min_separation` is d_min [m], and
    `free`, of shape (5,), takes the fastest extremal, a row of `solve`: that of the mirror image
    where the situation `needs_mirror`; nothing where the slot lies aside.

    Returns:
        whether the limit binds: never where the slot lies aside of the leader's route, as it does
        in a cross wind, which is no case for networks; and where all are.
    """
    east, north, _ = slot_offset(leader_heading, leader_tas, wind_east, wind_north, slot_distance)
    along, left = to_slot(x - leader_x - east, y - leader_y - north, leader_heading, radius)
    slot, aside = to_slot(-east, -north, leader_heading, radius)
    h, alpha, d_min = wrap(leader_heading - heading), leader_tas / tas, min_separation / radius
    binds = False
    if abs(aside) <= _ASIDE:
        pose, _ = mirror_to_left(Pose(along, left, h))
        binds = breaks_limit(pose, straight_scene(alpha, slot, d_min - SLACK), free)
    return binds, (along, left, h, slot, alpha, d_min)
