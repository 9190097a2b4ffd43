"""Through one contact with d = d_min: the ways to it, and the best one on from it.

Up to a contact and from it on, the path is an extremal without the limit: so it is fixed by the
contact, and that by one bearing and a side (see `contact`). Both halves come from the same
enumeration of words.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is a table as in
`clearance`.
"""

from math import ceil, cos, hypot, inf, isnan, pi, sin, sqrt

import numpy as np
from numba import njit

from relguide.kernels.angles import wrap, wrap_signed
from relguide.kernels.clearance import leader_at, piece_clears
from relguide.kernels.contact import contact_exists, contact_heading
from relguide.kernels.extremals import MAX_ROWS, SIGNS, fly_piece, solve, solve_toward
from relguide.kernels.hold import word_to_point
from relguide.kernels.roots import FloatArray

GRAZE = 3e-7
"""The contact is flown this far outside d_min [R], so that rounding cannot break it."""


_TURNING_STEP = 0.15  # the leader turns by some 10° in it [R/V_P]
_LONGEST_DETOUR = 24.0  # 6π + 4, rounded up
_EARLY = 1e-9  # this much before it opens the slot counts as open [R/V_P], as in `solve`
_JUMP = 1.0  # a word's length does not change by more within one step, unless it jumps [R]


@njit(cache=True, nogil=True)
def word_clears(
    x: float, y: float, h: float, t: float, row: FloatArray, leader: FloatArray, alpha: float,
    limit: float,
) -> bool:  # fmt: skip
    """Whether a row of `solve`, flown from time t, stays `limit` away from the leader."""
    word = int(row[1])
    for k in range(3):
        sign, amount = SIGNS[word, k], row[k + 2]
        if amount > 0.0 and not piece_clears(x, y, h, sign, t, amount, leader, alpha, limit):
            return False
        x, y, h = fly_piece(x, y, h, sign, amount)
        t += amount
    return True


@njit(cache=True, nogil=True)
def best_word(
    x: float, y: float, h: float, t: float, leader: FloatArray, alpha: float, limit: float,
    t_open: float, beat: float, rows: FloatArray,
) -> tuple[float, int]:  # fmt: skip
    """The fastest extremal to the slot, from time t on, that clears; arrival time and its row.

    Infinite and −1 if none arrives before `beat`.
    """
    n = solve(x - alpha * t, y, wrap(h), alpha, max(t_open - t, 0.0), rows)
    for i in range(n):
        if t + rows[i, 0] >= beat:
            break
        if word_clears(x, y, h, t, rows[i], leader, alpha, limit):
            return t + rows[i, 0], i
    return inf, -1


@njit(cache=True, nogil=True)
def intercept(dx: float, dy: float, ax: float, ay: float) -> float:
    """Least time to a point at (dx, dy) that moves at a, by the straight way; 0 where unknown."""
    closing = dx * ax + dy * ay
    one_less = 1.0 - ax * ax - ay * ay
    if one_less <= 1e-9:
        return 0.0
    return float((closing + sqrt(closing * closing + one_less * (dx * dx + dy * dy))) / one_less)


@njit(cache=True, nogil=True)
def not_before(
    x: float, y: float, h: float, t: float, leader: FloatArray, i: int, alpha: float, delta: float,
    bearing: float, side: float,
) -> float:  # fmt: skip
    """Before this time no way from a pose at time t reaches a contact on the leader's piece i."""
    start = max(leader[i, 0], t)
    if leader[i, 4] != 0.0:
        return float(start)
    lx, ly, lh = leader_at(leader, i, alpha, t)
    course = lh + contact_heading(bearing, side, alpha)
    cx, cy = lx + delta * cos(lh + bearing), ly + delta * sin(lh + bearing)
    straight = intercept(cx - x, cy - y, alpha * cos(lh), alpha * sin(lh))
    return float(max(t + max(straight, abs(wrap_signed(course - h))), start))


@njit(cache=True, nogil=True)
def not_before_slot(x: float, y: float, h: float, t: float, alpha: float, t_open: float) -> float:
    """Before this time no way from a pose at time t reaches the slot."""
    onward = max(intercept(alpha * t - x, -y, alpha, 0.0), abs(wrap_signed(h)))
    return float(max(t + onward, t_open))


@njit(cache=True, nogil=True)
def ways_to_contact(
    x: float, y: float, h: float, t: float, leader: FloatArray, i: int, alpha: float, delta: float,
    bearing: float, side: float, rows: FloatArray,
) -> int:  # fmt: skip
    """All words from (x, y, h) at time t to a contact while the leader is on its piece i.

    Returns:
        how many rows, with the time of arrival in place of how long they take; those of a straight
        piece come in order of time.
    """
    start, rate = leader[i, 0], leader[i, 4]
    end = leader[i + 1, 0] if i + 1 < len(leader) else inf
    if end <= t:
        return 0
    if rate != 0.0:
        return _ways_while_turning(x, y, h, t, leader, i, alpha, delta, bearing, side, rows)
    lx, ly, lh = leader_at(leader, i, alpha, t)
    contact_x = lx + delta * cos(lh + bearing)
    contact_y = ly + delta * sin(lh + bearing)
    left = end - t
    if left < inf and (
        hypot(contact_x + alpha * left * cos(lh) - x, contact_y + alpha * left * sin(lh) - y) > left
    ):
        return 0  # not even straight there
    course = lh + contact_heading(bearing, side, alpha)
    c, s = cos(course), sin(course)
    dx, dy = x - contact_x, y - contact_y
    n = solve_toward(
        dx * c + dy * s, dy * c - dx * s, wrap(h - course), alpha * cos(lh - course),
        alpha * sin(lh - course), max(start - t, 0.0), rows,
    )  # fmt: skip
    while n > 0 and rows[n - 1, 0] > left:
        n -= 1
    rows[:n, 0] += t
    return n


@njit(cache=True, nogil=True)
def _ways_while_turning(
    x: float, y: float, h: float, t_start: float, leader: FloatArray, i: int, alpha: float,
    delta: float, bearing: float, side: float, rows: FloatArray,
) -> int:  # fmt: skip
    """As `ways_to_contact` while the leader turns: the contact moves on a circle, so roots in t."""
    start, end = max(leader[i, 0], t_start), leader[i + 1, 0]
    steps = ceil((end - start) / _TURNING_STEP) + 1
    # a word is at least as long as the way is far, and hardly longer than three full turns more
    most = (1.0 + alpha + delta * abs(leader[i, 4])) * (end - start) / steps
    earliest, latest = steps + 1, -1
    for k in range(steps + 1):
        t = start + (end - start) * k / steps
        lx, ly, lh = leader_at(leader, i, alpha, t)
        away = hypot(lx + delta * cos(lh + bearing) - x, ly + delta * sin(lh + bearing) - y)
        if -most <= t - t_start - away <= _LONGEST_DETOUR + most:
            earliest, latest = min(earliest, k), k
    piece = np.empty(3)
    turns = np.empty((3, 2))  # first and last turn at the last time, at this one, and between
    n = 0
    for branch in range(8):
        word = t_start, leader, i, alpha, delta, bearing, side, branch
        last, last_t = np.nan, start
        for k in range(earliest, latest + 1):
            t = start + (end - start) * k / steps
            gap = _excess(x, y, h, *word, t, piece)
            turns[1, 0], turns[1, 1] = piece[0], piece[2]
            if k > earliest and _unbroken(last, turns[0], gap, turns[1]):
                n = _root(x, y, h, *word, last_t, last, t, gap, piece, rows, n)
            elif k > earliest and (abs(last) < _JUMP or abs(gap) < _JUMP):
                # a turn passes 0, or the word ceases to exist: there may be a root on either side
                low, high, at_low, at_high = last_t, t, last, gap
                for _ in range(25):
                    middle = 0.5 * (low + high)
                    value = _excess(x, y, h, *word, middle, piece)
                    turns[2, 0], turns[2, 1] = piece[0], piece[2]
                    if (isnan(value) and isnan(last)) or _unbroken(last, turns[0], value, turns[2]):
                        low, at_low = middle, value
                    else:
                        high, at_high = middle, value
                n = _root(x, y, h, *word, last_t, last, low, at_low, piece, rows, n)
                n = _root(x, y, h, *word, high, at_high, t, gap, piece, rows, n)
            last, last_t = gap, t
            turns[0] = turns[1]
    return n


@njit(cache=True, nogil=True)
def _unbroken(value: float, turns: FloatArray, other: float, others: FloatArray) -> bool:
    """Whether a word's length goes on smoothly: it exists at both times, and no turn jumps."""
    return bool(
        not isnan(value)
        and not isnan(other)
        and abs(turns[0] - others[0]) < pi
        and abs(turns[1] - others[1]) < pi
    )


@njit(cache=True, nogil=True)
def _root(
    x: float, y: float, h: float, t_start: float, leader: FloatArray, i: int, alpha: float,
    delta: float, bearing: float, side: float, branch: int, low: float, at_low: float,
    high: float, at_high: float, piece: FloatArray, rows: FloatArray, n: int,
) -> int:  # fmt: skip
    """Append the row of a word that arrives between two times, if there is one (Illinois)."""
    if not at_low * at_high <= 0.0 or n == MAX_ROWS:
        return n
    at, value = (low, at_low) if abs(at_low) < abs(at_high) else (high, at_high)
    for k in range(60):
        if abs(value) < 1e-13 or high - low < 1e-14:
            break
        share = 0.5 if k % 4 == 3 else at_high / (at_high - at_low)
        at = high - share * (high - low)
        value = _excess(x, y, h, t_start, leader, i, alpha, delta, bearing, side, branch, at, piece)
        if (value < 0.0) == (at_low < 0.0):
            low, at_low = at, value
            at_high *= 0.5
        else:
            high, at_high = at, value
            at_low *= 0.5
    value = _excess(x, y, h, t_start, leader, i, alpha, delta, bearing, side, branch, at, piece)
    if not abs(value) < 1e-9:
        return n
    rows[n, 0] = at
    rows[n, 1] = branch if branch < 6 else branch - 2
    rows[n, 2:5] = piece
    return n + 1


@njit(cache=True, nogil=True)
def _excess(
    x: float, y: float, h: float, t_start: float, leader: FloatArray, i: int, alpha: float,
    delta: float, bearing: float, side: float, branch: int, t: float, piece: FloatArray,
) -> float:  # fmt: skip
    """Length of a word to where the contact is at t, less the time for it; NaN if out of reach."""
    lx, ly, lh = leader_at(leader, i, alpha, t)
    course = lh + contact_heading(bearing, side, alpha)
    c, s = cos(course), sin(course)
    dx, dy = x - lx - delta * cos(lh + bearing), y - ly - delta * sin(lh + bearing)
    length = word_to_point(dx * c + dy * s, dy * c - dx * s, h - course, 0.0, branch, piece)
    return length - (t - t_start) if length >= 0.0 else np.nan


@njit(cache=True, nogil=True)
def through_contact(
    x: float, y: float, h: float, leader: FloatArray, i: int, alpha: float, delta: float,
    t_open: float, bearing: float, side: float, beat: float, rows: FloatArray,
    onward: FloatArray, way: FloatArray, reached: FloatArray,
) -> float:  # fmt: skip
    """Arrival by the fastest way through one contact that clears, if it is before `beat`.

    Args:
        x: start, slot frame [R].
        y: start [R].
        h: start heading [rad].
        leader: table of its pieces. shape (k, 5)
        i: piece it is on at the contact.
        alpha: V_L/V_P.
        delta: distance at the contact [R].
        t_open: when the slot opens [R/V_P].
        bearing: of the contact from the leader, relative to its heading [rad].
        side: +1 counter-clockwise round the leader, −1 clockwise.
        beat: arrivals from here on do not matter [R/V_P].
        rows: room for words. shape (MAX_ROWS, 5)
        onward: the same.
        way: takes the two rows of the way found. shape (2, 5)
        reached: takes the earliest time the contact is reached clear of the limit, and before what
            no way on from there arrives; infinite if not in time. shape (2,)

    Returns:
        arrival time; infinite if there is none before `beat`.
    """
    reached[:] = inf
    if not contact_exists(bearing, alpha):
        return inf
    limit = delta - GRAZE
    n = ways_to_contact(x, y, h, 0.0, leader, i, alpha, delta, bearing, side, rows)
    m = -1
    for k in range(n):
        t = rows[k, 0]
        if t >= beat:
            continue
        lx, ly, lh = leader_at(leader, i, alpha, t)
        cx, cy = lx + delta * cos(lh + bearing), ly + delta * sin(lh + bearing)
        ch = lh + contact_heading(bearing, side, alpha)
        if not_before_slot(cx, cy, ch, t, alpha, t_open) >= beat:
            continue
        if m < 0 or i + 1 < len(leader):
            # on the final leg the ways on are the same at any time
            m = solve(cx - alpha * t, cy, wrap(ch), alpha, 0.0, onward)
        if m == 0:
            continue
        # the cheap test first: could it be in time at all? What is too early may wait
        lower = max(t + onward[0, 0], t_open)
        if lower >= beat or not word_clears(x, y, h, 0.0, rows[k], leader, alpha, limit):
            continue
        if t < reached[0]:
            reached[0], reached[1] = t, lower
        for j in range(m):
            arrival = t + onward[j, 0]
            if arrival >= beat:
                break
            if arrival >= t_open - _EARLY and word_clears(
                cx, cy, ch, t, onward[j], leader, alpha, limit
            ):
                beat = arrival
                way[0] = rows[k]
                way[1] = onward[j]
                break
    return beat
