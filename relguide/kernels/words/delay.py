"""Delays: paths of an exact length to a slot that has yet to open, T = t_release.

When the slot could be reached before it opens, every path of length exactly t_release is optimal.
Here they are made by one free amount put before or after a Dubins word to the slot's place at
t_release: a straight before, a straight after, both, or a turn before. For each the total length is
a scalar function of the free amount; its crossings of t_release are bracketed on a grid and
refined. The grid may miss a path: these are some of many, and no proof rests on them.
"""

from math import asin, atan2, hypot, sqrt
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, turn_to
from relguide.kernels.base.records import Pose, Start, start_at
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.words.branches import SIZE, TO_POINT, WORD_OF
from relguide.kernels.words.extremals import SIGNS, fly_piece

MAX_DELAYS = 1024
"""Room for exact-length paths."""
DELAY_PIECES = 5
"""Pieces of such a path: one before, three of the word, one after."""
_FIRST = (0.0, 1.0, -1.0)  # ε of a piece put first
_LEADS = 8  # lengths of the straight before a word that another straight follows
_SAME = 1e-9  # lengths closer than this are one [R]; ≈ 1e-5 m at R = 12 km
_GRID = 96  # steps of the free amount: a straight of 30 R in steps of R/3 on average, a turn in 4°


class _Family(NamedTuple):
    """Where the free amount is put."""

    sign: float
    """ε of the piece that takes it: a turn or, with 0, a straight."""
    lead: float
    """Length of a straight before the word [R]; 0 where the free amount comes first."""
    last: bool
    """Whether it is a straight after the word."""


@njit(cache=True, nogil=True)
def word_to_point(pose: Pose, end_x: float, branch: int, piece: FloatArray) -> float:
    """One Dubins word from a pose to (end_x, 0) on heading 0.

    Args:
        pose: where it starts.
        end_x: where to [R].
        branch: number of `branches.BRANCHES`.
        piece: takes the three amounts [rad or R]. shape (3,)

    Returns:
        the length [R]; negative if the word does not reach.
    """
    return word_from(start_at(pose), end_x, branch, piece)


@njit(cache=True, nogil=True)
def word_from(start: Start, end_x: float, branch: int, piece: FloatArray) -> float:
    """As `word_to_point`, for maps."""
    x, y, h, sin_h, cos_h = start
    word = WORD_OF[branch]
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
        if branch % 2 == 1:
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
    pose: Pose, end_x: float, branch: int, family: _Family, amount: float, piece: FloatArray
) -> float:
    """Length of a path with this free amount; negative if there is none."""
    before, after = (family.lead, amount) if family.last else (amount, 0.0)
    on = fly_piece(pose, family.sign, before)
    length = word_to_point(on, end_x - after, branch, piece)
    return length if length < 0.0 else length + after + before


@njit(cache=True, nogil=True)
def delay_paths(pose: Pose, alpha: float, t_release: float, paths: FloatArray) -> int:
    """Paths of length exactly t_release to the slot's place when it opens.

    Args:
        pose: the pursuer's, seen from the slot.
        alpha: V_L/V_P.
        t_release: the exact length [R].
        paths: takes the pieces: first ε, 0 for straights, of all paths, then turn angles [rad] and
            lengths [R]. shape (2, MAX_DELAYS, DELAY_PIECES)

    Returns:
        how many paths.
    """
    n, end_x = 0, alpha * t_release
    if hypot(end_x - pose.x, pose.y) > t_release + _SAME:
        return n
    n = _put_exact_words(pose, end_x, t_release, paths)
    for k in range(len(_FIRST) + _LEADS):
        if k < len(_FIRST):
            family = _Family(_FIRST[k], 0.0, False)
        else:
            family = _Family(0.0, t_release * ((k - len(_FIRST)) / 12.0), True)
        for j in range(4 if family.last else SIZE):
            n = _cross(pose, end_x, t_release, TO_POINT[j], family, paths, n)
    return n


@njit(cache=True, nogil=True)
def _put_exact_words(pose: Pose, end_x: float, length: float, paths: FloatArray) -> int:
    """Put down the words that have this length as they are; how many.

    Of a pursuer that already is in the slot, and as fast, the last piece has no room for a delay.
    """
    n, piece = 0, np.empty(3)
    for branch in TO_POINT:
        total = word_to_point(pose, end_x, branch, piece)
        if total >= 0.0 and abs(total - length) < _SAME:
            paths[:, n] = 0.0
            for k in range(3):
                paths[0, n, k + 1] = SIGNS[WORD_OF[branch], k]
                paths[1, n, k + 1] = piece[k]
            n += 1
    return n


@njit(cache=True, nogil=True)
def _cross(
    pose: Pose, end_x: float, length: float, branch: int, family: _Family, paths: FloatArray, n: int
) -> int:
    """Append the crossings of one family and one branch."""
    straight = family.last or family.sign == 0.0
    span = length if straight else min(TWO_PI - 1e-6, length)
    piece = np.empty(3)
    last_amount = 0.0
    last = 0.0
    for i in range(_GRID + 1):
        fraction = i / _GRID
        # straights: finer near 0, where the turns matter
        amount = span * fraction * fraction if straight else span * fraction
        total = _total(pose, end_x, branch, family, amount, piece)
        gap = total - length if total >= 0.0 else np.nan
        if i > 0 and last * gap <= 0.0 and n < MAX_DELAYS:
            low, high, gap_low = last_amount, amount, last
            for _ in range(60):
                middle = 0.5 * (low + high)
                gap_middle = _total(pose, end_x, branch, family, middle, piece) - length
                if (gap_middle < 0.0) == (gap_low < 0.0):
                    low = middle
                else:
                    high = middle
            total = _total(pose, end_x, branch, family, high, piece)
            # a jump of a turn by 2π changes sign too: only a true crossing has the right length
            if total >= 0.0 and abs(total - length) < _SAME:
                signs, amounts = paths[0, n], paths[1, n]
                signs[0] = family.sign
                amounts[0] = family.lead if family.last else high
                for k in range(3):
                    signs[k + 1] = SIGNS[WORD_OF[branch], k]
                    amounts[k + 1] = piece[k]
                signs[4] = 0.0
                amounts[4] = high if family.last else 0.0
                n += 1
        last_amount, last = amount, gap
    return n
