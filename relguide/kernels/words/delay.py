"""Paths of an exact length to a slot that has yet to open: T = t_release, however short the way.

When the slot could be reached before it opens, every path of length exactly t_release is optimal.
Here they are made by one free amount put before or after a Dubins word to the slot's place at
t_release: a straight before, a straight after, both, or a turn before. For each the total length is
a scalar function of the free amount; its crossings of t_release are bracketed on a grid and
refined. The grid may miss a path: it is a choice among many, and never an argument for a time.
"""

from math import asin, atan2, cos, hypot, sin, sqrt

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, turn_to
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.words.extremals import SIGNS, fly_piece

MAX_DELAYS = 1024
"""Room for exact-length paths."""
DELAY_PIECES = 5
"""Pieces of a holding path: one before, three of the word, one after."""
_GRID = 96  # steps of the free amount: a straight of 30 R in steps of R/3 on average, a turn in 4°
_BRANCHES = 8  # the six words; LRL and RLR twice, with the long and the short middle arc


@njit(cache=True, nogil=True)
def word_to_point(
    x: float, y: float, h: float, end_x: float, branch: int, piece: FloatArray
) -> float:
    """One Dubins word from a pose to (end_x, 0) on heading 0.

    Args:
        x: start [R].
        y: start [R].
        h: start heading, counter-clockwise [rad].
        end_x: where to [R].
        branch: word number of `extremals.WORDS`; 6, 7 are LRL, RLR with the short middle arc.
        piece: takes the three amounts [rad or R]. shape (3,)

    Returns:
        the length [R]; negative if the word does not reach.
    """
    return word_headed(x, y, h, sin(h), cos(h), end_x, branch, piece)


@njit(cache=True, nogil=True)
def word_headed(
    x: float, y: float, h: float, sin_h: float, cos_h: float, end_x: float, branch: int,
    piece: FloatArray,
) -> float:  # fmt: skip
    """As `word_to_point`, with sine and cosine of the start heading, the same for a whole map."""
    word = branch if branch < 6 else branch - 2
    first, last = SIGNS[word, 0], SIGNS[word, 2]
    dx = end_x - (x - first * sin_h)
    dy = last - (y + first * cos_h)
    gap = hypot(dx, dy)
    bearing = atan2(dy, dx)
    if word < 2:
        course, middle = bearing, gap
        piece[0], piece[2] = turn_to(first * (course - h)), turn_to(-first * course)
    elif word < 4:
        if gap < 2.0:
            return -1.0
        course, middle = bearing + first * asin(2.0 / gap), sqrt(gap * gap - 4.0)
        piece[0], piece[2] = turn_to(first * (course - h)), turn_to(first * course)
    else:
        if gap > 4.0:
            return -1.0
        middle = 2.0 * asin(0.25 * gap)
        if branch < 6:
            middle = TWO_PI - middle
        crossing = bearing + 0.5 * first * middle
        piece[0], piece[2] = (
            turn_to(first * (crossing - h)),
            turn_to(-first * (crossing - first * middle)),
        )
    piece[1] = middle
    return float(piece[0] + middle + piece[2])


@njit(cache=True, nogil=True)
def _total(
    x: float, y: float, h: float, end_x: float, branch: int, before: float, amount: float,
    lead: float, piece: FloatArray,
) -> float:  # fmt: skip
    """Length with the free amount put first (before = ±1, 0) or last (2, with `lead` first)."""
    if before == 2.0:
        x, y, h = fly_piece(x, y, h, 0.0, lead)
        length = word_to_point(x, y, h, end_x - amount, branch, piece)
        return length if length < 0.0 else length + amount + lead
    x, y, h = fly_piece(x, y, h, before, amount)
    length = word_to_point(x, y, h, end_x, branch, piece)
    return length if length < 0.0 else length + amount


@njit(cache=True, nogil=True)
def holds(
    x: float, y: float, h: float, alpha: float, t_release: float, signs: FloatArray,
    amounts: FloatArray,
) -> int:  # fmt: skip
    """Paths of length exactly t_release from (x, y, h) to the slot's place when it opens.

    Args:
        x: pursuer ahead of the slot [R].
        y: pursuer left of it [R].
        h: its heading, counter-clockwise from the leader's [rad].
        alpha: V_L/V_P.
        t_release: the exact length [R].
        signs: takes ε of the pieces, 0 for straights. shape (MAX_DELAYS, DELAY_PIECES)
        amounts: takes the turn angles [rad] and lengths [R] of the pieces, same shape.

    Returns:
        how many paths.
    """
    n = 0
    if hypot(alpha * t_release - x, y) > t_release:
        return n
    for family in range(3 + 8):
        # three ways to put the amount first; eight leads before a straight that comes last
        before = 2.0
        lead = 0.0
        if family == 0:
            before = 0.0
        elif family == 1:
            before = 1.0
        elif family == 2:
            before = -1.0
        else:
            lead = t_release * ((family - 3) / 12.0)
        straight_amount = before == 0.0 or before == 2.0
        span = t_release if straight_amount else min(TWO_PI - 1e-6, t_release)
        for branch in range(4 if before == 2.0 else _BRANCHES):
            n = _cross(
                x, y, h, alpha * t_release, t_release, branch, before, lead, span, signs, amounts, n
            )
    return n


@njit(cache=True, nogil=True)
def _cross(
    x: float, y: float, h: float, end_x: float, length: float, branch: int, before: float,
    lead: float, span: float, signs: FloatArray, amounts: FloatArray, n: int,
) -> int:  # fmt: skip
    """Append the crossings of one family and one branch."""
    piece = np.empty(3)
    last_amount = 0.0
    last = 0.0
    for i in range(_GRID + 1):
        fraction = i / _GRID
        # straights: finer near 0, where the turns matter
        amount = span * fraction * fraction if before == 0.0 or before == 2.0 else span * fraction
        total = _total(x, y, h, end_x, branch, before, amount, lead, piece)
        gap = total - length if total >= 0.0 else np.nan
        if i > 0 and last * gap <= 0.0 and n < MAX_DELAYS:
            low, high, gap_low = last_amount, amount, last
            for _ in range(60):
                middle = 0.5 * (low + high)
                gap_middle = _total(x, y, h, end_x, branch, before, middle, lead, piece) - length
                if (gap_middle < 0.0) == (gap_low < 0.0):
                    low = middle
                else:
                    high = middle
            total = _total(x, y, h, end_x, branch, before, high, lead, piece)
            # a jump of a turn by 2π changes sign too: only a true crossing has the right length
            if total >= 0.0 and abs(total - length) < 1e-9:
                word = branch if branch < 6 else branch - 2
                signs[n, 0] = 0.0 if before == 2.0 else before
                amounts[n, 0] = lead if before == 2.0 else high
                for k in range(3):
                    signs[n, k + 1] = SIGNS[word, k]
                    amounts[n, k + 1] = piece[k]
                signs[n, 4] = 0.0
                amounts[n, 4] = high if before == 2.0 else 0.0
                n += 1
        last_amount, last = amount, gap
    return n
