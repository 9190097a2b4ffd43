"""Words to a contact with d = d_min while the leader turns: the contact moves on a circle.

A word arrives when its length to where the contact then is equals the time for it. That is looked
at on a grid of times, for all branches at once; for its roots between two times see
`arrivals_while_turning`.

A word is no shorter than the straight between its first and its last circle and the change of
heading. So most looks see at once that it comes too late, until the next look and often for longer.
"""

from math import asin, atan2, ceil, inf, isnan, pi, sqrt
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, turn_to, wrap, wrap_signed
from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.norm import norm
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.contact.arrivals_while_turning import JUMP, Seen, append_arrivals
from relguide.kernels.contact.moving_contact import (
    Passage,
    distance_at,
    earliest_while_turning,
    leader_heading,
    speed_of,
)
from relguide.kernels.words.branches import SIZE, TO_POINT
from relguide.kernels.words.extremals import SIGNS

_STEP = 0.15  # the leader turns by some 10° in it [R/V_P]
_LONGEST_DETOUR = 24.0  # 6π + 4, rounded up
_PAIRS = 4  # of first and last circles, in the order of the words with a straight between them


class _Length(NamedTuple):
    """What a look at one branch says."""

    excess: float
    """As in `Seen`; infinite if it arrives neither within a step before nor within one after."""
    first: float
    """First turn [rad] …"""
    last: float
    """… and last one [rad]."""
    free: float
    """For how long from then on it does not arrive [R/V_P], if that is a step or more."""


class _Circles(NamedTuple):
    """The first and the last circle of a word at one time."""

    first: float
    """ε of the first."""
    dx: float
    """From one centre to the other [R]."""
    dy: float
    """[R]."""
    gap: float
    """How far that is [R]."""
    swept: float
    """How far the last one moves in a step [R]."""
    sway: float
    """How much the contact's heading changes in a step [rad]."""
    course: float
    """That heading [rad]."""
    h: float
    """Heading of the start [rad]."""
    elapsed: float
    """The time there is for the word [R/V_P]."""
    step: float
    """From one look to the next [R/V_P]."""


@njit(cache=True, nogil=True)
def paths_while_turning(passage: Passage, words: int, beat: float, rows: FloatArray) -> int:
    """Some words to the contact, in no order. As `paths_to_contact.paths_by_words`.

    One of three turns comes with that which has the same first and last turn.
    """
    begin, end = passage.begin, passage.end
    first = earliest_while_turning(passage, beat)
    if first >= beat:
        return 0
    steps = ceil((end - begin) / _STEP) + 1
    step = (end - begin) / steps
    # a word is hardly longer than three full turns more than the contact is far
    slack = _LONGEST_DETOUR + (1.0 + speed_of(passage)) * step
    centres = _centres_of(passage, step)
    # of each branch excess, first and last turn; then how fast the circles of each pair part
    looks = np.full((2, SIZE + _PAIRS, 3), np.nan)
    n, last_t, follows, now, piece = 0, begin, False, 0, np.empty(3)
    k = int((first - begin) / step)
    while k <= steps:
        t = begin + step * k
        elapsed = t - passage.t_start
        if elapsed > slack and elapsed > slack + distance_at(passage, t):
            follows = False
            k += 1
            continue
        if time_is_up(passage.until):
            break
        last, here = looks[1 - now], looks[now]
        free = _look(passage, centres, words, t, step, here)
        if follows:
            for branch in TO_POINT:
                before, after = last[branch, 0], here[branch, 0]
                if before == inf or after == inf:
                    continue
                if isnan(before) and isnan(after):
                    # it may exist between them where its circles are farthest, or, for three turns,
                    # nearest
                    pair = SIZE + (branch if branch < 4 else (branch - 4) // 2)
                    begun, ended = last[pair, 0], here[pair, 0]
                    if not (begun > 0.0 > ended if branch < 4 else begun < 0.0 < ended):
                        continue
                elif (
                    before * after > 0.0
                    and abs(before + after) > JUMP
                    and abs(last[branch, 1] - here[branch, 1]) < pi
                    and abs(last[branch, 2] - here[branch, 2]) < pi
                ):
                    continue
                begun = Seen(last_t, before, last[branch, 1], last[branch, 2])
                ended = Seen(t, after, here[branch, 1], here[branch, 2])
                n = append_arrivals(passage, branch, begun, ended, rows, n, piece)
        if t >= beat:
            break
        now, last_t, follows = 1 - now, t, True
        k += max(int(min(free, end - t) / step), 1)
    return n


@njit(cache=True, nogil=True)
def _centres_of(passage: Passage, step: float) -> FloatArray:
    """Where the centres of first and last circles are.

    Returns:
        for each pair x, y of the first one from that of the leader's turn; the last one from there
        ahead and to the left as the leader heads; how far that moves in a step [R]. shape
        (_PAIRS, 5)
    """
    centres = np.empty((_PAIRS, 5))
    s, c = passage.sin_h, passage.cos_h
    end_s, end_c = passage.sin_heading, passage.cos_heading
    for pair in range(_PAIRS):
        first, last = SIGNS[pair, 0], SIGNS[pair, 2]
        ahead, left = passage.ahead - last * end_s, passage.left + last * end_c
        centres[pair, 0], centres[pair, 1] = -passage.x - first * s, first * c - passage.y
        centres[pair, 2], centres[pair, 3] = ahead, left
        centres[pair, 4] = abs(passage.turning) * step * norm(ahead, left)
    return centres


@njit(cache=True, nogil=True)
def _look(
    passage: Passage, centres: FloatArray, words: int, t: float, step: float, look: FloatArray
) -> float:
    """Look at all branches of some words at one time.

    Args:
        passage: to the contact.
        centres: of `_centres_of`.
        words: as in `passing`.
        t: when [R/V_P].
        step: from one look to the next [R/V_P].
        look: takes what is seen, as `paths_while_turning` keeps it. shape (SIZE + _PAIRS, 3)

    Returns:
        for how long from then on none of them arrives [R/V_P], if that is a step or more.
    """
    h, elapsed = passage.pose.h, t - passage.t_start
    lh = leader_heading(passage, t)
    s, c = sine_and_cosine(lh)
    course, sway = lh + passage.heading, abs(passage.turning) * step
    free = inf
    for pair in range(_PAIRS):
        if not words & (1 << pair):
            continue
        ahead, left = centres[pair, 2], centres[pair, 3]
        ex, ey = ahead * c - left * s, ahead * s + left * c
        dx, dy = ex - centres[pair, 0], ey - centres[pair, 1]
        look[SIZE + pair, 0] = passage.turning * (dy * ex - dx * ey)
        gap, first = sqrt(dx * dx + dy * dy), SIGNS[pair, 0]
        circles = _Circles(first, dx, dy, gap, centres[pair, 4], sway, course, h, elapsed, step)
        if pair >= 2:
            seen = _look_at_opposite(circles)
            look[pair, 0], look[pair, 1], look[pair, 2] = seen.excess, seen.first, seen.last
            free = min(free, seen.free)
            continue
        change = wrap(first * (course - h))
        seen = _look_at_same(circles, change)
        look[pair, 0], look[pair, 1], look[pair, 2] = seen.excess, seen.first, seen.last
        free = min(free, seen.free)
        least = most = inf
        if gap - circles.swept <= 4.0:
            least = 2.0 * asin(0.25 * max(gap - circles.swept, 0.0))
            most = 2.0 * asin(0.25 * min(gap + circles.swept, 4.0))
        for way in range(2):
            seen, at = _look_at_middle(circles, change, way, least, most), 4 + 2 * pair + way
            look[at, 0], look[at, 1], look[at, 2] = seen.excess, seen.first, seen.last
            free = min(free, seen.free)
    return free


@njit(cache=True, nogil=True)
def _look_at_same(circles: _Circles, change: float) -> _Length:
    """Look at LSL or RSR; `change` is that of the heading, in [0, 2π).

    The turns add up to that, or to a full turn more: so the length changes no faster than the
    circles part and the heading changes, but for full turns.
    """
    gap, step = circles.gap, circles.step
    late, fastest = gap + change - circles.elapsed, step + circles.swept + circles.sway
    free = abs(wrap_signed(late)) / fastest
    if late > 0.0:
        free = max(free, min(late / fastest, (TWO_PI - change) / circles.sway))
    if free > 1.0:
        return _Length(inf, 0.0, 0.0, free * step)
    bearing = atan2(circles.dy, circles.dx)
    return _length_of(circles, circles.first, bearing, bearing, gap)


@njit(cache=True, nogil=True)
def _look_at_middle(
    circles: _Circles, change: float, way: int, least: float, most: float
) -> _Length:
    """Look at LRL or RLR, one way round the middle circle, 1 the longer; `change` as before.

    The first and the last turn less the middle one add up to the change of heading, but for full
    turns. The shorter middle one is from `least` to `most` a step before and after; infinite if
    there is none.
    """
    gap, swept, step = circles.gap, circles.swept, circles.step
    if least == inf:
        return _Length(inf, 0.0, 0.0, (gap - 4.0) / swept * step if swept > 0.0 else inf)
    twice = least + most if way == 0 else -least - most
    if abs(wrap_signed(change - circles.elapsed + twice)) > most - least + circles.sway + step:
        return _Length(inf, 0.0, 0.0, step)
    if gap > 4.0:
        return _Length(np.nan, 0.0, 0.0, 0.0)
    bearing, middle = atan2(circles.dy, circles.dx), 2.0 * asin(0.25 * gap)
    half = 0.5 * circles.first * middle
    if way == 1:
        middle, half = TWO_PI - middle, circles.first * pi - half
    return _length_of(circles, circles.first, bearing + half, bearing - half, middle)


@njit(cache=True, nogil=True)
def _look_at_opposite(circles: _Circles) -> _Length:
    """Look at LSR or RSL.

    One turn less the other is the change of heading, but for full turns.
    """
    gap, step, first = circles.gap, circles.step, circles.first
    change, nearest = abs(wrap_signed(circles.course - circles.h)), gap - circles.swept
    straight = sqrt(nearest * nearest - 4.0) if nearest > 2.0 else 0.0
    if straight + max(change - circles.sway, 0.0) > circles.elapsed + step:
        late = (gap - 2.0 + change - circles.elapsed) / (step + circles.swept + circles.sway)
        return _Length(inf, 0.0, 0.0, step * max(late, 1.0))
    if gap < 2.0:
        return _Length(np.nan, 0.0, 0.0, 0.0)
    bearing = atan2(circles.dy, circles.dx) + first * asin(2.0 / gap)
    return _length_of(circles, -first, bearing, bearing, sqrt(gap * gap - 4.0))


@njit(cache=True, nogil=True)
def _length_of(
    circles: _Circles, last: float, begun: float, ended: float, middle: float
) -> _Length:
    """A word whose middle piece begins and ends on these headings; `last` is ε of its last turn."""
    first_turn = turn_to(circles.first * (begun - circles.h))
    last_turn = turn_to(last * (circles.course - ended))
    excess = first_turn + middle + last_turn - circles.elapsed
    return _Length(excess, first_turn, last_turn, 0.0)
