"""From a pose to the slot just as it opens, clear of the leader: a path of one exact length.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

import numpy as np
from numba import njit

from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.clear_words import pieces_clear
from relguide.kernels.words.delay import DELAY_PIECES, MAX_DELAYS, delay_paths


@njit(cache=True, nogil=True)
def delay_until_release(pose: Pose, t: float, scene: Scene, pieces: FloatArray) -> bool:
    """Find a path that keeps d_min and arrives at t_release, with as few turns as there are.

    Args:
        pose: where it starts.
        t: start time, before t_release [R/V_P].
        scene: the leader, d_min and t_release.
        pieces: takes ε, 0 for straights, and turn angle [rad] or length [R]. shape
            (DELAY_PIECES, 2)

    Returns:
        whether there is one.
    """
    paths = np.empty((2, MAX_DELAYS, DELAY_PIECES))
    fewest = DELAY_PIECES + 1
    seen = Pose(pose.x - scene.alpha * t, pose.y, pose.h)
    n = delay_paths(seen, scene.alpha, scene.t_release - t, paths)
    for j in range(n):
        signs, amounts = paths[0, j], paths[1, j]
        turns = 0
        for k in range(DELAY_PIECES):
            if signs[k] != 0.0 and amounts[k] > 0.0:
                turns += 1
        if turns < fewest and pieces_clear(pose, t, signs, amounts, scene):
            fewest = turns
            pieces[:, 0] = signs
            pieces[:, 1] = amounts
    return fewest <= DELAY_PIECES
