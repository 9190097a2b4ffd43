"""How far the line of sight turns along two paths of arcs and straights, whole turns counted.

In steps of 0.9 d/(V_P + V_L) the relative position moves less than 0.9 d, so the line of sight
turns less than 65° in each: what is summed is its turn, not its turn up to 2π.
"""

from math import atan2

from numba import njit

from relguide.kernels.base.motion import advance, motion_along
from relguide.kernels.base.norm import norm
from relguide.kernels.base.roots import FloatArray

_STRIDE = 0.9


@njit(cache=True, nogil=True)
def sight_turn(path: FloatArray, leader_path: FloatArray, duration: float, nearest: float) -> float:
    """By how much the bearing θ from pursuer to leader changes, clockwise positive [rad].

    Args:
        path: the pursuer's, as `motion_along` takes it.
        leader_path: the leader's.
        duration: until when [s].
        nearest: where they are nearer than this, steps are as if they were not [m], > 0: it bounds
            the work, and the turn of aircraft that meet is not known.
    """
    px, py, ppsi, pv, pursuer_pieces = motion_along(path)
    lx, ly, lpsi, lv, leader_pieces = motion_along(leader_path)
    i, j = 0, 0
    p_left = pursuer_pieces[0, 0] if len(pursuer_pieces) > 0 else duration
    l_left = leader_pieces[0, 0] if len(leader_pieces) > 0 else duration
    left, turned = duration, 0.0
    dx, dy = px - lx, py - ly
    while left > 0.0:
        p_rate = pursuer_pieces[i, 1] if i < len(pursuer_pieces) else 0.0
        l_rate = leader_pieces[j, 1] if j < len(leader_pieces) else 0.0
        step = min(left, _STRIDE * max(norm(dx, dy), nearest) / (pv + lv))
        if i < len(pursuer_pieces):
            step = min(step, p_left)
        if j < len(leader_pieces):
            step = min(step, l_left)
        px, py, ppsi = advance(px, py, ppsi, pv, p_rate, step)
        lx, ly, lpsi = advance(lx, ly, lpsi, lv, l_rate, step)
        old_x, old_y = dx, dy
        dx, dy = px - lx, py - ly
        turned += atan2(old_y * dx - old_x * dy, old_x * dx + old_y * dy)
        left -= step
        p_left -= step
        l_left -= step
        while i < len(pursuer_pieces) and p_left <= 0.0:
            i += 1
            p_left = pursuer_pieces[i, 0] if i < len(pursuer_pieces) else 0.0
        while j < len(leader_pieces) and l_left <= 0.0:
            j += 1
            l_left = leader_pieces[j, 0] if j < len(leader_pieces) else 0.0
    return turned
