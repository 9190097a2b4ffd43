"""Does an extremal keep its distance? As `word_clears`, for maps: cheap tests first.

Over a piece of the pursuer and one of the leader, what lies between them is looked at by its ends:

- seen from a leader that keeps straight a straight remains one: its least distance is in closed
  form;
- a turn stays within 1 (= R) of its centre, which stands still;
- a leader that turns at ω strays from its chord, flown evenly, by at most α|ω| T²/8 in a time T;
- the last turn ends in the slot, so once the leader is on its final leg all last turns the same way
  are parts of one curve, and those up to a certain angle clear.

What these tests do not decide is left to `piece_clears`, so the answers are the same.
"""

from math import cos, inf, sin, sqrt

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.separation.clearance import leader_at, piece_at, piece_clears
from relguide.kernels.words.extremals import SIGNS, fly_piece

_HALVINGS = 40
_ASTRAY = 1e-6  # a path ends where it should to less than this [R]


@njit(cache=True, nogil=True)
def last_turns(leader: FloatArray, alpha: float, limit: float) -> FloatArray:
    """How long a last turn may be: right, then left [rad].

    Args:
        leader: table of its pieces. shape (k, 5)
        alpha: V_L/V_P.
        limit: least allowed separation [R].
    """
    found = np.empty(2)
    i = len(leader) - 1
    straight = leader[i:].copy()
    straight[0, 0] = 0.0
    straight[0, 1] -= alpha * leader[i, 0]
    for side in range(2):
        sign = 2.0 * side - 1.0
        low, high = 0.0, TWO_PI
        for _ in range(_HALVINGS):
            turn = 0.5 * (low + high)
            # where a turn begins that ends in the slot at time `turn`
            x, y = alpha * turn - sin(turn), sign * (1.0 - cos(turn))
            if piece_clears(x, y, -sign * turn, sign, 0.0, turn, straight, alpha, limit):
                low = turn
            else:
                high = turn
        found[side] = low
    return found


@njit(cache=True, nogil=True)
def keeps_clear(
    x: float, y: float, h: float, sin_h: float, cos_h: float, t: float, row: FloatArray,
    end_x: float, leader: FloatArray, alpha: float, limit: float, longest: FloatArray,
) -> bool:  # fmt: skip
    """Whether a row of `solve`, flown from time t, stays `limit` away from the leader.

    Args:
        x: start, slot frame [R].
        y: start [R].
        h: start heading [rad].
        sin_h: its sine, the same for a whole map.
        cos_h: and cosine.
        t: when it is there [R/V_P].
        row: of `solve`.
        end_x: it ends at (end_x, 0) on heading 0 [R].
        leader: table of its pieces. shape (k, 5)
        alpha: V_L/V_P.
        limit: least allowed separation [R].
        longest: of `last_turns`; zeros if the end is not the slot.
    """
    word = int(row[1])
    first_sign, sign, last_sign = SIGNS[word, 0], SIGNS[word, 1], SIGNS[word, 2]
    first, middle, last = row[2], row[3], row[4]
    final = leader[len(leader) - 1, 0]
    i = piece_at(leader, t)
    cx, cy = x - first_sign * sin_h, y + first_sign * cos_h
    if first > 0.0:
        room = point_room(cx, cy, 0.0, 0.0, t, first, leader, i, alpha) - 1.0
        if room < limit and not piece_clears(x, y, h, first_sign, t, first, leader, alpha, limit):
            return False
        t += first
    course = h + first_sign * first
    sin_c, cos_c = sin(course), cos(course)
    x, y = cx + first_sign * sin_c, cy - first_sign * cos_c
    if middle > 0.0:
        while i + 1 < len(leader) and leader[i + 1, 0] <= t:
            i += 1
        if sign == 0.0:
            room = point_room(x, y, cos_c, sin_c, t, middle, leader, i, alpha)
            if room < limit and t >= final:
                return False
        else:
            cx, cy = x - sign * sin_c, y + sign * cos_c
            room = point_room(cx, cy, 0.0, 0.0, t, middle, leader, i, alpha) - 1.0
        if room < limit and not piece_clears(x, y, course, sign, t, middle, leader, alpha, limit):
            return False
        t += middle
    if last <= 0.0 or (t >= final and last <= longest[1 if last_sign > 0.0 else 0]):
        return True
    while i + 1 < len(leader) and leader[i + 1, 0] <= t:
        i += 1
    room = point_room(end_x, last_sign, 0.0, 0.0, t, last, leader, i, alpha) - 1.0
    if room >= limit + _ASTRAY:
        return True
    x, y, course = fly_piece(x, y, course, sign, middle)
    return piece_clears(x, y, course, last_sign, t, last, leader, alpha, limit)


@njit(cache=True, nogil=True)
def point_room(
    x: float, y: float, vx: float, vy: float, t: float, amount: float, leader: FloatArray, i: int,
    alpha: float,
) -> float:  # fmt: skip
    """A point that keeps its velocity from time t on stays at least so far from the leader.

    Exactly so far while the leader keeps straight. The leader is on its piece i at t.
    """
    last = len(leader) - 1
    room, done, end = inf, t, t + amount
    lx, ly = _place(leader, i, alpha, t)
    while done < end:
        bend = 0.0
        if i < last:
            until = min(leader[i + 1, 0], end)
            next_x, next_y = leader[i + 1, 1], leader[i + 1, 2]
            if until < leader[i + 1, 0]:
                next_x, next_y = _place(leader, i, alpha, until)
            bend = 0.125 * alpha * abs(leader[i, 4])
        else:
            until = end
            next_x, next_y = lx + alpha * (end - done), ly
        spent = until - done
        next_at_x, next_at_y = x + vx * spent, y + vy * spent
        nearest = _nearest(x - lx, y - ly, next_at_x - next_x, next_at_y - next_y)
        room = min(room, nearest - bend * spent * spent)
        x, y, lx, ly, done = next_at_x, next_at_y, next_x, next_y, until
        i += 1
    return room


@njit(cache=True, nogil=True)
def _place(leader: FloatArray, i: int, alpha: float, t: float) -> tuple[float, float]:
    """Where the leader is at time t on its piece i; only where it turns that takes sines."""
    flown = t - leader[i, 0]
    if i == len(leader) - 1:
        return leader[i, 1] + alpha * flown, leader[i, 2]
    if leader[i, 4] == 0.0:
        share = flown / (leader[i + 1, 0] - leader[i, 0])
        return (
            leader[i, 1] + share * (leader[i + 1, 1] - leader[i, 1]),
            leader[i, 2] + share * (leader[i + 1, 2] - leader[i, 2]),
        )
    lx, ly, _ = leader_at(leader, i, alpha, t)
    return lx, ly


@njit(cache=True, nogil=True)
def _nearest(ax: float, ay: float, bx: float, by: float) -> float:
    """Distance from the origin to a straight line from a to b."""
    dx, dy = bx - ax, by - ay
    squared = dx * dx + dy * dy
    share = 0.0
    if squared > 0.0:
        share = min(max(-(ax * dx + ay * dy) / squared, 0.0), 1.0)
    nx, ny = ax + share * dx, ay + share * dy
    return sqrt(nx * nx + ny * ny)
