"""The fastest extremal alone, for maps: roots are sought only where one could win.

LSL and RSR cost a tenth of the others and come first; their time is to be beaten (see `sooner`).
"""

from math import inf, sqrt

import numpy as np
from numba import njit

from relguide.kernels.base.angles import mirror_heading
from relguide.kernels.base.records import Pose, Start, Window, start_at
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.words.extremals import CLOSURE, MAX_ROWS, SIGNS, solve
from relguide.kernels.words.sooner import EARLY, Scratch, lrl_before, lsl_before, lsr_before

LEAST_RATIO = 1e-6
"""The slot moves: what follows divides by its α, which is above this."""


@njit(cache=True, nogil=True)
def fastest(
    pose: Pose, alpha: float, t_release: float, hint: int, scratch: Scratch, row: FloatArray
) -> bool:
    """The first row of `solve`.

    Args:
        pose: as there.
        alpha: V_L/V_P.
        t_release: earliest arrival [R/V_P].
        hint: number of the word that is likely to win: it is tried early, to be beaten.
        scratch: room to work in.
        row: takes it. shape (5,)

    Returns:
        whether there is one.
    """
    best, found = scratch.lines[3], scratch.found
    best[0], best_word = inf, -1
    if LEAST_RATIO < alpha < 1.0:
        start = start_at(pose)
        for turn in range(7):
            word = turn if turn < 2 else hint if turn == 2 else turn - 1
            if turn >= 2 and (word < 2 or (turn > 2 and word == hint)):
                continue
            n = word_before(start, alpha, word, Window(t_release, best[0]), False, scratch)
            for i in range(n):
                if t_release - EARLY <= found[i, 0] < best[0]:
                    best[0], best[1] = found[i, 0], found[i, 1]
                    best[2], best[3] = found[i, 2], found[i, 3]
                    best_word = word
        # LSL and RSR end at the slot if their turns add up to the change of heading, as they do
        if best_word >= 2 and not ends_at_slot(start, alpha, best_word, best):
            best_word = -1
        if best_word >= 0:
            row[0], row[1], row[2], row[3], row[4] = best[0], best_word, best[1], best[2], best[3]
            return True
    # a root next to a tangency that is no path has won, or the slot is no slower
    rows = np.empty((MAX_ROWS, 5))
    if solve(pose, alpha, t_release, rows) == 0:
        return False
    row[:] = rows[0]
    return True


@njit(cache=True, nogil=True)
def may_arrive_before(pose: Pose, alpha: float, beat: float, scratch: Scratch) -> bool:
    """Whether any extremal may reach the slot before a time; a tenth of what `solve` takes if not.

    Args:
        pose: as in `extremals.solve`.
        alpha: V_L/V_P.
        beat: the time [R/V_P].
        scratch: room to work in.
    """
    if not LEAST_RATIO < alpha < 1.0:
        return True
    start, window = start_at(pose), Window(0.0, beat + EARLY)
    for word in range(6):
        if word_before(start, alpha, word, window, False, scratch) > 0:
            return True
    return False


@njit(cache=True, nogil=True)
def word_before(
    start: Start, alpha: float, word: int, window: Window, every: bool, scratch: Scratch
) -> int:
    """Paths of one word that arrive within a window, in no order.

    Args:
        start: the pursuer's pose, seen from the slot.
        alpha: above 0 and below 1.
        word: its number in `extremals.WORDS`.
        window: when they arrive; a few may arrive a little later.
        every: whether all of them are wanted, or only the first for sure.
        scratch: takes them in `found`: τ and the amounts of the three pieces.

    Returns:
        how many.
    """
    if word % 2 == 1:
        # RSR, RSL and RLR are mirror images
        start = Start(start.x, -start.y, mirror_heading(start.h), -start.sin_h, start.cos_h)
    if word < 2:
        return lsl_before(start, alpha, window, scratch)
    if word < 4:
        return lsr_before(start, alpha, window, every, scratch)
    return lrl_before(start, alpha, window, scratch)


@njit(cache=True, nogil=True)
def ends_at_slot(start: Start, alpha: float, word: int, found: FloatArray) -> bool:
    """As `extremals.closes`, for the slot itself.

    Args:
        start: the pursuer's pose, seen from the slot.
        alpha: V_L/V_P.
        word: its number.
        found: τ and the amounts of the three pieces. shape (≥ 4,)
    """
    x, y, h, sin_h, cos_h = start
    first_sign, sign, last_sign = SIGNS[word, 0], SIGNS[word, 1], SIGNS[word, 2]
    course = h + first_sign * found[1]
    s, c = sine_and_cosine(course)
    x += first_sign * (s - sin_h)
    y -= first_sign * (c - cos_h)
    if sign == 0.0:
        x += found[2] * c
        y += found[2] * s
    else:
        course += sign * found[2]
        next_s, next_c = sine_and_cosine(course)
        x += sign * (next_s - s)
        y -= sign * (next_c - c)
        s, c = next_s, next_c
    course += last_sign * found[3]
    next_s, next_c = sine_and_cosine(course)
    x += last_sign * (next_s - s) - alpha * found[0]
    y -= last_sign * (next_c - c)
    # far away the last digits of τ are worth more than CLOSURE
    return bool(sqrt(x * x + y * y) <= CLOSURE + 1e-12 * found[0])
