"""The fastest extremal alone, for maps: roots are sought only where one could win.

LSL and RSR cost a tenth of the others and come first; their time is to be beaten (see `sooner`).
"""

from math import cos, inf, sin, sqrt

import numpy as np
from numba import njit

from relguide.kernels.base.angles import mirror_heading
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.words.extremals import CLOSURE, MAX_ROWS, SIGNS, solve
from relguide.kernels.words.sooner import EARLY, lrl_before, lsl_before, lsr_before

LEAST_RATIO = 1e-6
"""The slot moves: what follows divides by its α, which is above this."""


@njit(cache=True, nogil=True)
def fastest(
    x: float, y: float, h: float, alpha: float, t_release: float, hint: int, room: FloatArray,
    found: FloatArray, row: FloatArray,
) -> bool:  # fmt: skip
    """The first row of `solve`.

    Args:
        x: pursuer ahead of the slot [R].
        y: pursuer left of it [R].
        h: its heading, counter-clockwise from the leader's [rad], in [0, 2π).
        alpha: V_L/V_P.
        t_release: earliest arrival [R/V_P].
        hint: number of the word that is likely to win: it is tried early, to be beaten.
        room: of `sooner.work_room`.
        found: room too. shape (MOST_ROOTS, 4)
        row: takes it. shape (5,)

    Returns:
        whether there is one.
    """
    best = room[3]
    best[0], best_word = inf, -1
    if LEAST_RATIO < alpha < 1.0:
        sin_h, cos_h = sin(h), cos(h)
        for turn in range(7):
            word = turn if turn < 2 else hint if turn == 2 else turn - 1
            if turn >= 2 and (word < 2 or (turn > 2 and word == hint)):
                continue
            n = word_before(
                x, y, h, sin_h, cos_h, alpha, t_release, word, best[0], False, room, found
            )
            for i in range(n):
                if t_release - EARLY <= found[i, 0] < best[0]:
                    best[0], best[1] = found[i, 0], found[i, 1]
                    best[2], best[3] = found[i, 2], found[i, 3]
                    best_word = word
        # two turns the same way that add up to the change of heading end at the slot by themselves
        if best_word >= 2 and not ends_at_slot(x, y, h, sin_h, cos_h, alpha, best_word, best):
            best_word = -1
        if best_word >= 0:
            row[0], row[1], row[2], row[3], row[4] = best[0], best_word, best[1], best[2], best[3]
            return True
    # a root next to a tangency that is no path has won, or the slot is no slower
    rows = np.empty((MAX_ROWS, 5))
    if solve(x, y, h, alpha, t_release, rows) == 0:
        return False
    row[:] = rows[0]
    return True


@njit(cache=True, nogil=True)
def word_before(
    x: float, y: float, h: float, sin_h: float, cos_h: float, alpha: float, t_release: float,
    word: int, beat: float, every: bool, room: FloatArray, found: FloatArray,
) -> int:  # fmt: skip
    """Paths of one word that arrive before a given time, in no order.

    Args:
        x: as in `fastest`.
        y: as there.
        h: as there.
        sin_h: its sine, the same for a whole map.
        cos_h: and cosine.
        alpha: above 0 and below 1.
        t_release: as there.
        word: its number in `extremals.WORDS`.
        beat: they arrive before, or hardly later [R/V_P].
        every: whether all of them are wanted, or only the first for sure.
        room: as there.
        found: takes them: τ and the amounts of the three pieces. shape (MOST_ROOTS, 4)

    Returns:
        how many.
    """
    if word % 2 == 1:
        # RSR, RSL and RLR are mirror images
        y, h, sin_h = -y, mirror_heading(h), -sin_h
    if word < 2:
        return lsl_before(x, y, h, sin_h, cos_h, alpha, t_release, beat, found)
    if word < 4:
        return lsr_before(x, y, h, sin_h, cos_h, alpha, t_release, beat, every, room, found)
    return lrl_before(x, y, h, sin_h, cos_h, alpha, t_release, beat, room, found)


@njit(cache=True, nogil=True)
def ends_at_slot(
    x: float, y: float, h: float, sin_h: float, cos_h: float, alpha: float, word: int,
    found: FloatArray,
) -> bool:  # fmt: skip
    """As `extremals.closes`, for the slot itself.

    Args:
        x: as in `fastest`.
        y: as there.
        h: as there.
        sin_h: as in `word_before`.
        cos_h: as there.
        alpha: as there.
        word: its number.
        found: τ and the amounts of the three pieces. shape (≥ 4,)
    """
    first_sign, sign, last_sign = SIGNS[word, 0], SIGNS[word, 1], SIGNS[word, 2]
    course = h + first_sign * found[1]
    s, c = sin(course), cos(course)
    x += first_sign * (s - sin_h)
    y -= first_sign * (c - cos_h)
    if sign == 0.0:
        x += found[2] * c
        y += found[2] * s
    else:
        course += sign * found[2]
        next_s, next_c = sin(course), cos(course)
        x += sign * (next_s - s)
        y -= sign * (next_c - c)
        s, c = next_s, next_c
    course += last_sign * found[3]
    x += last_sign * (sin(course) - s) - alpha * found[0]
    y -= last_sign * (cos(course) - c)
    # far away the last digits of τ are worth more than CLOSURE
    return bool(sqrt(x * x + y * y) <= CLOSURE + 1e-12 * found[0])
