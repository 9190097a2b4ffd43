"""The fastest extremal that keeps its distance, where the fastest of all does not, for maps.

As the first of the rows of `solve` that clears, but roots are sought only before the best so far.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is a table as in
`clearance`.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.maps.final_leg import keeps_clear
from relguide.kernels.words.extremals import MAX_ROWS, solve
from relguide.kernels.words.fastest import LEAST_RATIO, ends_at_slot, word_before
from relguide.kernels.words.sooner import EARLY

_SAME = 1e-9  # two roots of a word this close are one and the same path [R/V_P]


@njit(cache=True, nogil=True)
def next_clear(
    x: float, y: float, h: float, sin_h: float, cos_h: float, alpha: float, hint: int,
    leader: FloatArray, limit: float, longest: FloatArray, room: FloatArray, found: FloatArray,
    tried: FloatArray, row: FloatArray,
) -> bool:  # fmt: skip
    """The first row of `solve` after one that does not clear that does.

    Args:
        x: pursuer ahead of the slot [R].
        y: pursuer left of it [R].
        h: its heading, counter-clockwise from the leader's [rad], in [0, 2π).
        sin_h: its sine, the same for a whole map.
        cos_h: and cosine.
        alpha: V_L/V_P.
        hint: number of the word that is likely to win: it is tried first, to be beaten.
        leader: table of its pieces. shape (k, 5)
        limit: least allowed separation [R].
        longest: of `final_leg.last_turns`.
        room: of `sooner.work_room`.
        found: room too. shape (MOST_ROOTS, 4)
        tried: room too. shape (5,)
        row: the first row of `solve`, which does not clear; takes the one found. shape (5,)

    Returns:
        whether there is one.
    """
    if not LEAST_RATIO < alpha < 1.0:
        return _next_of_all(x, y, h, sin_h, cos_h, alpha, leader, limit, longest, row)
    earliest, lost = row[0], int(row[1])
    best, best_word = inf, -1
    for turn in range(7):
        word = hint if turn == 0 else turn - 1
        if turn > 0 and word == hint:
            continue
        after = earliest
        while after < best:
            n = word_before(x, y, h, sin_h, cos_h, alpha, after, word, best, True, room, found)
            for i in range(n):
                time = found[i, 0]
                if not earliest - EARLY <= time < best or (
                    word == lost and time <= earliest + _SAME
                ):
                    continue
                if not ends_at_slot(x, y, h, sin_h, cos_h, alpha, word, found[i]):
                    continue
                tried[0], tried[1] = time, word
                tried[2], tried[3], tried[4] = found[i, 1], found[i, 2], found[i, 3]
                if keeps_clear(
                    x, y, h, sin_h, cos_h, 0.0, tried, alpha * time, leader, alpha, limit, longest
                ):
                    best, best_word = time, word
                    row[:] = tried
            if word >= 2 or n == 0:
                break
            # of LSL and RSR one path is given at a time
            after = found[0, 0] + 2.0 * EARLY
    return best_word >= 0


@njit(cache=True, nogil=True)
def _next_of_all(
    x: float, y: float, h: float, sin_h: float, cos_h: float, alpha: float, leader: FloatArray,
    limit: float, longest: FloatArray, row: FloatArray,
) -> bool:  # fmt: skip
    rows = np.empty((MAX_ROWS, 5))
    for k in range(1, solve(x, y, h, alpha, row[0], rows)):
        if keeps_clear(
            x, y, h, sin_h, cos_h, 0.0, rows[k], alpha * rows[k, 0], leader, alpha, limit, longest
        ):
            row[:] = rows[k]
            return True
    return False
