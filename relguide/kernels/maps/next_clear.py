"""The fastest extremal that keeps its distance, where the fastest of all does not, for maps.

As the first of the rows of `solve` that clears, but roots are sought only before the best so far.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is a table as in
`Scene`.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.records import Pose, Scene, Start, Window
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.maps.final_leg import keeps_clear
from relguide.kernels.words.extremals import MAX_ROWS, solve
from relguide.kernels.words.fastest import LEAST_RATIO, ends_at_slot, word_before
from relguide.kernels.words.sooner import EARLY, Scratch

_SAME = 1e-9  # two roots of a word this close are one and the same path [R/V_P]


@njit(cache=True, nogil=True)
def next_clear(
    start: Start, scene: Scene, hint: int, longest: FloatArray, scratch: Scratch,
    tried: FloatArray, row: FloatArray,
) -> bool:  # fmt: skip
    """The first row of `solve` that clears, after a first one that does not.

    Args:
        start: the pursuer's pose, seen from the slot.
        scene: the leader and d_min.
        hint: number of the word that is likely to win: it is tried first, to be beaten.
        longest: of `final_leg.last_turns`.
        scratch: room to work in.
        tried: room too. shape (5,)
        row: the first row of `solve`, which does not clear; takes the one found. shape (5,)

    Returns:
        whether there is one.
    """
    alpha, found = scene.alpha, scratch.found
    if not LEAST_RATIO < alpha < 1.0:
        return _next_of_all(start, scene, longest, row)
    earliest, lost = row[0], int(row[1])
    best, best_word = inf, -1
    for turn in range(7):
        word = hint if turn == 0 else turn - 1
        if turn > 0 and word == hint:
            continue
        after = earliest
        while after < best:
            n = word_before(start, alpha, word, Window(after, best), True, scratch)
            for i in range(n):
                time = found[i, 0]
                if not earliest - EARLY <= time < best or (
                    word == lost and time <= earliest + _SAME
                ):
                    continue
                if not ends_at_slot(start, alpha, word, found[i]):
                    continue
                tried[0], tried[1] = time, word
                tried[2], tried[3], tried[4] = found[i, 1], found[i, 2], found[i, 3]
                if keeps_clear(start, 0.0, tried, alpha * time, scene, longest):
                    best, best_word = time, word
                    row[:] = tried
            if word >= 2 or n == 0:
                break
            # of LSL and RSR one path is given at a time
            after = found[0, 0] + 2.0 * EARLY
    return best_word >= 0


@njit(cache=True, nogil=True)
def _next_of_all(start: Start, scene: Scene, longest: FloatArray, row: FloatArray) -> bool:
    rows = np.empty((MAX_ROWS, 5))
    pose = Pose(start.x, start.y, start.h)
    for k in range(1, solve(pose, scene.alpha, row[0], rows)):
        if keeps_clear(start, 0.0, rows[k], scene.alpha * rows[k, 0], scene, longest):
            row[:] = rows[k]
            return True
    return False
