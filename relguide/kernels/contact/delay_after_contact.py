"""From a pose to the slot just as it opens, clear of the leader: a path of one exact length.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is a table as in
`clearance`.
"""

import numpy as np
from numba import njit

from relguide.kernels.base.records import Pose
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.passage import pieces_clear
from relguide.kernels.words.delay import DELAY_PIECES, MAX_DELAYS, delay_paths


@njit(cache=True, nogil=True)
def delay_until_release(
    x: float, y: float, h: float, t: float, leader: FloatArray, alpha: float, limit: float,
    t_release: float, pieces: FloatArray,
) -> bool:  # fmt: skip
    """Find a clear path that arrives at t_release, with as few turns as there are.

    Args:
        x: start, slot frame [R].
        y: start [R].
        h: start heading [rad].
        t: start time [R/V_P].
        leader: table of its pieces. shape (k, 5)
        alpha: V_L/V_P.
        limit: least allowed separation [R].
        t_release: when the slot opens [R/V_P], after t.
        pieces: takes ε, 0 for straights, and turn angle [rad] or length [R]. shape
            (DELAY_PIECES, 2)

    Returns:
        whether there is one.
    """
    paths = np.empty((2, MAX_DELAYS, DELAY_PIECES))
    signs, amounts = paths[0], paths[1]
    fewest = DELAY_PIECES + 1
    n = delay_paths(Pose(x - alpha * t, y, h), alpha, t_release - t, paths)
    for j in range(n):
        turns = 0
        for k in range(DELAY_PIECES):
            if signs[j, k] != 0.0 and amounts[j, k] > 0.0:
                turns += 1
        if turns < fewest and pieces_clear(x, y, h, t, signs[j], amounts[j], leader, alpha, limit):
            fewest = turns
            pieces[:, 0] = signs[j]
            pieces[:, 1] = amounts[j]
    return fewest <= DELAY_PIECES
