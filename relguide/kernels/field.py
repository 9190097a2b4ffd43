"""The time-to-converge at many places at once: one leader, one heading of the pursuer.

The cheap part of the chain of `plan`: every extremal in order of time, and the first that clears.
Ways that touch d_min or ride along it are not looked for, so where the fastest extremal does not
clear the answer is a time that can be flown, and a bound below it. Who knows which word is the
fastest may say so: then it alone is solved, and the bound is that of a straight line.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is a table as in
`clearance`.
"""

from math import cos, hypot, inf, sin

import numpy as np
from numba import njit

from relguide.kernels.clearance import SLACK, piece_clears
from relguide.kernels.extremals import MAX_ROWS, WORDS, closes, fly_piece, solve
from relguide.kernels.fastest import fastest, word_before
from relguide.kernels.final_leg import keeps_clear
from relguide.kernels.hold import word_to_point
from relguide.kernels.passage import word_clears
from relguide.kernels.roots import FloatArray
from relguide.kernels.sooner import MOST_ROOTS, work_room
from relguide.kernels.strategies import direct_time

ByteArray = np.ndarray[tuple[int, ...], np.dtype[np.int8]]
ON_TIME = 1e-9
"""A way this much too long still arrives when the slot opens [R]: rounding."""
HOLD = len(WORDS)
"""Word number of a path that arrives exactly when the slot opens."""
NO_WORD = -1
"""Word number where nothing that clears was found."""
_STEPS = 24  # of false position; ten are enough where nothing jumps


@njit(cache=True, nogil=True)
def field_rows(
    places: FloatArray, words: ByteArray, h: float, alpha: float, t_open: float,
    leader: FloatArray, limit: float, longest: FloatArray, first: int, last: int,
    answers: FloatArray,
) -> None:  # fmt: skip
    """Answers for places first … last − 1.

    Args:
        places: x, y of the pursuer. shape (n, 2)
        words: the only word that need be solved at each, −1 for all of them. shape (n,)
        h: its heading [rad], in [0, 2π).
        alpha: V_L/V_P.
        t_open: when the slot opens; 0 for a leader that keeps straight.
        leader: table of its pieces. shape (k, 5)
        limit: d_min; 0 for none.
        longest: of `final_leg.last_turns`, for d_min less `SLACK`.
        first: from this place on.
        last: up to this place.
        answers: takes the arrival by the fastest path found that clears; before what nothing
            arrives (infinite if the slot is out of reach, or the limit broken from the start); the
            path's word number; 1 if the fastest way without the limit comes too close. shape (n, 4)
    """
    room, found = work_room(), np.empty((MOST_ROOTS, 4))
    rows = np.empty((MAX_ROWS, 5))
    piece = np.empty(3)
    hint = 0
    for n in range(first, last):
        x, y = places[n, 0], places[n, 1]
        answer = answers[n]
        answer[0], answer[1], answer[2], answer[3] = inf, inf, NO_WORD, 0.0
        if hypot(x - leader[0, 1], y - leader[0, 2]) < limit - SLACK:
            continue
        if t_open > 0.0 and _reaches(x, y, h, alpha * t_open, t_open, piece):
            answer[1] = t_open
            if limit <= 0.0 or _hold_clears(x, y, h, alpha, t_open, leader, limit - SLACK, piece):
                answer[0], answer[2] = t_open, HOLD
                continue
            answer[3] = 1.0
        elif words[n] >= 0 and _alone(x, y, h, alpha, words[n], room, found, rows[0]):
            time = rows[0, 0]
            if time >= t_open and (
                limit <= 0.0 or keeps_clear(x, y, h, rows[0], leader, alpha, limit - SLACK, longest)
            ):
                answer[0], answer[2] = time, words[n]
                answer[1] = min(max(direct_time(x, y, alpha), t_open), time)
                continue
        if not fastest(x, y, h, alpha, t_open, hint, room, found, rows[0]):
            continue
        hint = int(rows[0, 1])
        if answer[1] == inf:
            answer[1] = rows[0, 0]
        if limit <= 0.0 or keeps_clear(x, y, h, rows[0], leader, alpha, limit - SLACK, longest):
            answer[0], answer[2] = rows[0, 0], rows[0, 1]
            continue
        answer[3] = 1.0
        count = solve(x, y, h, alpha, t_open, rows)
        for k in range(1, count):
            if keeps_clear(x, y, h, rows[k], leader, alpha, limit - SLACK, longest):
                answer[0], answer[2] = rows[k, 0], rows[k, 1]
                break


@njit(cache=True, nogil=True)
def _alone(
    x: float, y: float, h: float, alpha: float, word: int, room: FloatArray, found: FloatArray,
    row: FloatArray,
) -> bool:  # fmt: skip
    """The first path of one word, as a row of `solve`; whether there is one."""
    n = word_before(x, y, h, sin(h), cos(h), alpha, 0.0, word, inf, False, room, found)
    row[0] = inf
    best = 0
    for i in range(n):
        if found[i, 0] < row[0]:
            row[0], best = found[i, 0], i
    row[1] = word
    row[2], row[3], row[4] = found[best, 1], found[best, 2], found[best, 3]
    return bool(n > 0 and closes(x, y, h, alpha, 0.0, word, found[best]))


@njit(cache=True, nogil=True)
def _reaches(x: float, y: float, h: float, end_x: float, length: float, piece: FloatArray) -> bool:
    """Whether Dubins' shortest way to (end_x, 0) on heading 0 is no longer than this."""
    if hypot(end_x - x, y) > length:
        return False
    for branch in range(6):
        way = word_to_point(x, y, h, end_x, branch, piece)
        if 0.0 <= way <= length + ON_TIME:
            return True
    return False


@njit(cache=True, nogil=True)
def _hold_clears(
    x: float, y: float, h: float, alpha: float, t_open: float, leader: FloatArray, limit: float,
    piece: FloatArray,
) -> bool:  # fmt: skip
    """Whether a straight put before or behind a turn–straight–turn word uses up t_open, and clears.

    Two of the many families of `hold.holds`, enough almost everywhere: that neither clears does
    not mean that no path of that length does.
    """
    row = np.empty(5)
    end_x = alpha * t_open
    for behind in range(2):
        for branch in range(4):
            way = word_to_point(x, y, h, end_x, branch, piece)
            if not 0.0 <= way <= t_open:
                continue
            amount = _straight_to_open(x, y, h, end_x, t_open, branch, behind == 1, way, piece)
            if amount < 0.0:
                continue
            row[0], row[1] = t_open - amount, branch
            row[2:] = piece
            if behind == 0:
                if not piece_clears(x, y, h, 0.0, 0.0, amount, leader, alpha, limit):
                    continue
                at_x, at_y, _ = fly_piece(x, y, h, 0.0, amount)
                if word_clears(at_x, at_y, h, amount, row, leader, alpha, limit):
                    return True
            elif word_clears(x, y, h, 0.0, row, leader, alpha, limit) and piece_clears(
                end_x - amount, 0.0, 0.0, 0.0, t_open - amount, amount, leader, alpha, limit
            ):
                return True
    return False


@njit(cache=True, nogil=True)
def _straight_to_open(
    x: float, y: float, h: float, end_x: float, t_open: float, branch: int, behind: bool,
    shortest: float, piece: FloatArray,
) -> float:  # fmt: skip
    """Length of the straight with which a word takes exactly t_open; negative if not found.

    By false position (Illinois): the length is nearly linear in it, but where a turn jumps by 2π.
    """
    low, high, gap_low, gap_high = 0.0, t_open, shortest - t_open, t_open
    side = 0
    for _ in range(_STEPS):
        amount = (low * gap_high - high * gap_low) / (gap_high - gap_low)
        way = _with_straight(x, y, h, end_x, branch, behind, amount, piece)
        if way < 0.0:
            return -1.0
        gap = way - t_open
        if abs(gap) <= ON_TIME:
            return amount
        if gap < 0.0:
            low, gap_low = amount, gap
            gap_high *= 0.5 if side < 0 else 1.0
            side = -1
        else:
            high, gap_high = amount, gap
            gap_low *= 0.5 if side > 0 else 1.0
            side = 1
    return -1.0


@njit(cache=True, nogil=True)
def _with_straight(
    x: float, y: float, h: float, end_x: float, branch: int, behind: bool, amount: float,
    piece: FloatArray,
) -> float:  # fmt: skip
    """Length of a word to (end_x, 0) with a straight before or behind it; negative if none."""
    if behind:
        way = word_to_point(x, y, h, end_x - amount, branch, piece)
    else:
        at_x, at_y, _ = fly_piece(x, y, h, 0.0, amount)
        way = word_to_point(at_x, at_y, h, end_x, branch, piece)
    return way + amount if way >= 0.0 else way
