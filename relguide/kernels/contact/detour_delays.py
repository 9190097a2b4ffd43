"""A path amid others that arrives just as the slot opens. No path is faster, so any one will do.

A first turn and a straight on a grid, the shortest first, and from there a path of just the length
that is left, as without others.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI
from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.norm import norm
from relguide.kernels.base.records import Pose
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.others import Others, broken_by, may_arrive_at
from relguide.kernels.words.delay import DELAY_PIECES, MAX_DELAYS, straight_delays, turning_delays
from relguide.kernels.words.extremals import fly_piece

RELEASE_PIECES = 2 + DELAY_PIECES
"""Pieces of such a path: a turn and a straight before those of a delay."""
_TURNS = 24  # steps of a full turn
_STEP = 0.5  # from one straight to the next [R]


@njit(cache=True, nogil=True)
def clear_until_release(start: Pose, others: Others, pieces: FloatArray) -> bool:
    """Find a path that keeps clear of all and arrives at t_release.

    Args:
        start: where it begins, at t = 0.
        others: what it keeps clear of, with t_release.
        pieces: takes ε, 0 for straights, and turn angle [rad] or length [R].
            shape (RELEASE_PIECES, 2)

    Returns:
        whether there is one.
    """
    if not may_arrive_at(others.t_release, others):
        return False
    paths = np.empty((2, MAX_DELAYS, DELAY_PIECES))
    pieces[:] = 0.0
    for side in range(2):
        sign = 1.0 - 2.0 * side
        pose, t = start, 0.0
        for j in range(_TURNS):
            if j > 0:
                if broken_by(pose, sign, t, TWO_PI / _TURNS, others) >= 0:
                    break
                pose, t = fly_piece(pose, sign, TWO_PI / _TURNS), t + TWO_PI / _TURNS
            pieces[0, 0], pieces[0, 1], pieces[1, 1] = sign, t, 0.0
            here, now = pose, t
            while _is_in_reach(here, now, others) and not time_is_up(others.until):
                if _put_clear_delay(here, now, others, paths, pieces[2:]):
                    return True
                if broken_by(here, 0.0, now, _STEP, others) >= 0:
                    break
                here, now = fly_piece(here, 0.0, _STEP), now + _STEP
                pieces[1, 1] += _STEP
    return False


@njit(cache=True, nogil=True)
def _is_in_reach(pose: Pose, t: float, others: Others) -> bool:
    """Whether a straight from there is not too long to be at the slot as it opens."""
    opens = others.t_release
    return bool(norm(others.alpha * opens - pose.x, pose.y) <= opens - t)


@njit(cache=True, nogil=True)
def _put_clear_delay(
    pose: Pose, t: float, others: Others, paths: FloatArray, pieces: FloatArray
) -> bool:
    """Put down the first path of just the length that is left and keeps clear of all."""
    seen, left = Pose(pose.x - others.alpha * t, pose.y, pose.h), others.t_release - t
    n = straight_delays(seen, others.alpha, left, paths)
    if t == 0.0:
        n = turning_delays(seen, others.alpha, left, paths, n)
    for k in range(n):
        here, now, clear = pose, t, True
        for piece in range(DELAY_PIECES):
            sign, amount = paths[0, k, piece], paths[1, k, piece]
            if amount > 0.0:
                if broken_by(here, sign, now, amount, others) >= 0:
                    clear = False
                    break
                here, now = fly_piece(here, sign, amount), now + amount
        if clear:
            pieces[:, 0], pieces[:, 1] = paths[0, k], paths[1, k]
            return True
    return False
