"""Delays: paths of an exact length to a slot that has yet to open, T = t_release.

When the slot could be reached before it opens, every path of length exactly t_release is optimal.
Here they are made by one free amount put before or after a Dubins word to the slot's place at
t_release: a straight before, a straight after, both, or a turn before. For each the total length is
a scalar function of the free amount; its crossings of t_release are bracketed on a grid and
refined; those of a straight and a word with a straight in its middle come one to each piece of it.
The grid may miss a path: these are some of many, and no proof rests on them.
"""

from math import sqrt
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI
from relguide.kernels.base.false_position import Bracket, secant, tightened
from relguide.kernels.base.norm import norm
from relguide.kernels.base.records import Pose
from relguide.kernels.base.roots import FloatArray, insert_cut
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.words.branches import TO_POINT, WORD_OF
from relguide.kernels.words.extremals import SIGNS, fly_piece
from relguide.kernels.words.to_point import word_between, word_to_point

MAX_DELAYS = 1024
"""Room for exact-length paths."""
DELAY_PIECES = 5
"""Pieces of such a path: one before, three of the word, one after."""
CSC = 4
"""The first of `branches.TO_POINT`, 0 to 3: words with a straight in the middle."""
_LEADS = 8  # lengths of the straight before a word that another straight follows
_SAME = 1e-9  # lengths closer than this are one [R]; ≈ 1e-5 m at R = 12 km
_BESIDE = 1e-6  # so far from where a word jumps or ends it is looked at [R]: `turn_to` rounds
_EXACT = 1e-13  # a length so near is met, and an amount is known [R]
_GRID = 96  # steps of the free amount: a straight of 30 R in steps of R/3 on average, a turn in 4°


class _Family(NamedTuple):
    """Where a straight of free length is put."""

    lead: float
    """Length of another one, before the word [R]."""
    last: bool
    """Whether it comes after the word; else it comes first."""


@njit(cache=True, nogil=True)
def _total(
    pose: Pose, end_x: float, branch: int, sign: float, amount: float, piece: FloatArray
) -> float:
    """Length of a path that begins with so much of a piece; negative if there is none."""
    length = word_to_point(fly_piece(pose, sign, amount), end_x, branch, piece)
    return length if length < 0.0 else length + amount


@njit(cache=True, nogil=True)
def straight_delays(pose: Pose, alpha: float, t_release: float, paths: FloatArray) -> int:
    """Paths of length exactly t_release to the slot's place when it opens, with two turns at most.

    And words that have this length as they are. All of their families are found: along a straight
    put before or after it, a word with a straight in its middle grows longer at a rate of
    1 − cos(turn between the two), never shorter.

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
    if norm(end_x - pose.x, pose.y) > t_release + _SAME:
        return n
    n = _put_exact_words(pose, end_x, t_release, paths)
    for branch in range(CSC):
        n = _cross_once(pose, end_x, t_release, branch, _Family(0.0, False), paths, n)
    for k in range(_LEADS):
        family = _Family(t_release * (k / 12.0), True)
        for branch in range(CSC):
            n = _cross_once(pose, end_x, t_release, branch, family, paths, n)
    return n


@njit(cache=True, nogil=True)
def turning_delays(pose: Pose, alpha: float, t_release: float, paths: FloatArray, n: int) -> int:
    """Append to the n paths of `straight_delays` those with three turns or more: how many then."""
    end_x = alpha * t_release
    if norm(end_x - pose.x, pose.y) > t_release + _SAME:
        return n
    for branch in TO_POINT[CSC:]:
        n = _cross(pose, end_x, t_release, branch, 0.0, paths, n)
    for sign in (1.0, -1.0):
        for branch in TO_POINT:
            # a turn before another to the same side adds nothing
            if SIGNS[WORD_OF[branch], 0] != sign:
                n = _cross(pose, end_x, t_release, branch, sign, paths, n)
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
def _cross_once(
    pose: Pose, end_x: float, length: float, branch: int, family: _Family, paths: FloatArray, n: int
) -> int:
    """Append the crossings of a straight and a word with a straight in its middle.

    Between the free amounts at which a turn of the word passes a full one, or the word ceases to
    exist, the total never falls: it crosses the length once at most.
    """
    cuts, piece = np.empty(6), np.empty(3)
    span, h, lead = length - family.lead, pose.h, family.lead
    between = _centres(pose, end_x, branch, family)
    px, py, wx, wy = between
    n_cuts = _put_cuts(between, h, branch, span, cuts)
    for i in range(n_cuts - 1):
        low = cuts[i] + (_BESIDE if i > 0 else 0.0)
        high = cuts[i + 1] - (_BESIDE if i + 2 < n_cuts else 0.0)
        if high <= low or n == MAX_DELAYS:
            continue
        word = word_between(px - low * wx, py - low * wy, h, branch, piece)
        gap_low = lead + low + word - length
        if word < 0.0 or gap_low > 0.0:
            continue
        word = word_between(px - high * wx, py - high * wy, h, branch, piece)
        gap_high = lead + high + word - length
        if word < 0.0 or gap_high < 0.0:
            continue
        amount, gap = high, gap_high
        bracket = Bracket(low, high, gap_low, gap_high, 0)
        for _ in range(60):
            if abs(gap) <= _EXACT or bracket.high - bracket.low <= _EXACT * span:
                break
            amount = secant(bracket)
            word = word_between(px - amount * wx, py - amount * wy, h, branch, piece)
            gap = lead + amount + word - length
            bracket = tightened(bracket, amount, gap)
        if abs(gap) < _SAME:
            before, after = (lead, amount) if family.last else (amount, 0.0)
            n = _put_path(0.0, before, branch, piece, after, paths, n)
    return n


class _Centres(NamedTuple):
    """From the centre of a word's first circle to that of its last one, by the free amount a."""

    px: float
    """p − a w: without a delay, ahead [R]."""
    py: float
    """… and left."""
    wx: float
    """How it moves with a."""
    wy: float


@njit(cache=True, nogil=True)
def _centres(pose: Pose, end_x: float, branch: int, family: _Family) -> _Centres:
    word = WORD_OF[branch]
    first, last = SIGNS[word, 0], SIGNS[word, 2]
    sin_h, cos_h = sine_and_cosine(pose.h)
    px = end_x - pose.x - family.lead * cos_h + first * sin_h
    py = last - pose.y - family.lead * sin_h - first * cos_h
    return _Centres(px, py, 1.0, 0.0) if family.last else _Centres(px, py, cos_h, sin_h)


@njit(cache=True, nogil=True)
def _put_cuts(between: _Centres, h: float, branch: int, span: float, cuts: FloatArray) -> int:
    """Where the total of a straight and a word may jump, from 0 to the span, rising; how many.

    The word's first turn is a full one where p − a w is along the first heading, or 2 beside it
    between circles of opposite sides; its last turn where the same holds of the last heading, 0.
    """
    px, py, wx, wy = between
    word = WORD_OF[branch]
    beside = SIGNS[word, 0] - SIGNS[word, 2]  # 2ε between opposite sides, else 0
    sin_h, cos_h = sine_and_cosine(h)
    n, cuts[0], cuts[1] = 2, 0.0, span
    if wy != 0.0:
        n = insert_cut(cuts, n, (py + beside) / wy)
    across = sin_h * wx - cos_h * wy
    if across != 0.0:
        n = insert_cut(cuts, n, (sin_h * px - cos_h * py - beside) / across)
    if beside != 0.0:  # circles that overlap have no straight between them
        along, off = px * wx + py * wy, px * wy - py * wx
        if abs(off) < 2.0:
            half = sqrt(4.0 - off * off)
            n = insert_cut(cuts, n, along - half)
            n = insert_cut(cuts, n, along + half)
    return n


@njit(cache=True, nogil=True)
def _put_path(
    sign: float, before: float, branch: int, piece: FloatArray, after: float, paths: FloatArray,
    n: int,
) -> int:  # fmt: skip
    """Append a path: what is put before the word, the word, and a straight after it."""
    signs, amounts = paths[0, n], paths[1, n]
    signs[0], amounts[0] = sign, before
    for k in range(3):
        signs[k + 1] = SIGNS[WORD_OF[branch], k]
        amounts[k + 1] = piece[k]
    signs[4], amounts[4] = 0.0, after
    return n + 1


@njit(cache=True, nogil=True)
def _cross(
    pose: Pose, end_x: float, length: float, branch: int, sign: float, paths: FloatArray, n: int
) -> int:
    """Append the crossings of a turn, or a straight, and one branch."""
    span = length if sign == 0.0 else min(TWO_PI - 1e-6, length)
    piece = np.empty(3)
    last_amount = 0.0
    last = 0.0
    for i in range(_GRID + 1):
        fraction = i / _GRID
        # straights: finer near 0, where the turns matter
        amount = span * fraction * fraction if sign == 0.0 else span * fraction
        total = _total(pose, end_x, branch, sign, amount, piece)
        gap = total - length if total >= 0.0 else np.nan
        if i > 0 and last * gap <= 0.0 and n < MAX_DELAYS:
            low, high, gap_low = last_amount, amount, last
            for _ in range(60):
                middle = 0.5 * (low + high)
                gap_middle = _total(pose, end_x, branch, sign, middle, piece) - length
                if (gap_middle < 0.0) == (gap_low < 0.0):
                    low = middle
                else:
                    high = middle
            total = _total(pose, end_x, branch, sign, high, piece)
            # a jump of a turn by 2π changes sign too: only a true crossing has the right length
            if total >= 0.0 and abs(total - length) < _SAME:
                n = _put_path(sign, high, branch, piece, 0.0, paths, n)
        last_amount, last = amount, gap
    return n
