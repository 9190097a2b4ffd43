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

from math import cos, hypot, inf, sin

import numpy as np
from numba import njit

from relguide.kernels.angles import TWO_PI
from relguide.kernels.clearance import leader_at, piece_clears
from relguide.kernels.extremals import SIGNS, fly_piece
from relguide.kernels.roots import FloatArray

_HALVINGS = 40


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
    x: float, y: float, h: float, row: FloatArray, leader: FloatArray, alpha: float, limit: float,
    longest: FloatArray,
) -> bool:  # fmt: skip
    """Whether a row of `solve`, flown from t = 0, stays `limit` away from the leader.

    Args:
        x: start, slot frame [R].
        y: start [R].
        h: start heading [rad].
        row: of `solve`, right to the slot.
        leader: table of its pieces. shape (k, 5)
        alpha: V_L/V_P.
        limit: least allowed separation [R].
        longest: of `last_turns`.
    """
    word, t, i = int(row[1]), 0.0, 0
    final = leader[len(leader) - 1, 0]
    for k in range(3):
        sign, amount = SIGNS[word, k], row[k + 2]
        if amount > 0.0:
            if k == 2 and t >= final and amount <= longest[1 if sign > 0.0 else 0]:
                return True
            while i + 1 < len(leader) and leader[i + 1, 0] <= t:
                i += 1
            room = _room(x, y, h, sign, t, amount, leader, i, alpha)
            if room < limit:
                if sign == 0.0 and t >= final:
                    return False
                if not piece_clears(x, y, h, sign, t, amount, leader, alpha, limit):
                    return False
        if k < 2:
            x, y, h = fly_piece(x, y, h, sign, amount)
            t += amount
    return True


@njit(cache=True, nogil=True)
def _room(
    x: float, y: float, h: float, sign: float, t: float, amount: float, leader: FloatArray, i: int,
    alpha: float,
) -> float:  # fmt: skip
    """A piece that begins at time t, with the leader on its piece i, stays at least so far away.

    Exactly so far if both are straight.
    """
    last = len(leader) - 1
    ax, ay = x, y  # where the pursuer is, or the centre it turns about
    if sign != 0.0:
        ax, ay = x - sign * sin(h), y + sign * cos(h)
    vx, vy = (cos(h), sin(h)) if sign == 0.0 else (0.0, 0.0)
    room, done, end = inf, t, t + amount
    lx, ly, _ = leader_at(leader, i, alpha, t)
    while done < end:
        if i < last:
            until = min(leader[i + 1, 0], end)
            next_x, next_y = leader[i + 1, 1], leader[i + 1, 2]
            if until < leader[i + 1, 0]:
                next_x, next_y, _ = leader_at(leader, i, alpha, until)
        else:
            until = end
            next_x, next_y = lx + alpha * (end - done), ly
        spent = until - done
        bx, by = ax + vx * spent, ay + vy * spent
        nearest = _nearest(ax - lx, ay - ly, bx - next_x, by - next_y)
        room = min(room, nearest - 0.125 * alpha * abs(leader[i, 4]) * spent * spent)
        ax, ay, lx, ly, done = bx, by, next_x, next_y, until
        i += 1
    return room if sign == 0.0 else room - 1.0


@njit(cache=True, nogil=True)
def _nearest(ax: float, ay: float, bx: float, by: float) -> float:
    """Distance from the origin to a straight line from a to b."""
    dx, dy = bx - ax, by - ay
    squared = dx * dx + dy * dy
    share = 0.0
    if squared > 0.0:
        share = min(max(-(ax * dx + ay * dy) / squared, 0.0), 1.0)
    return hypot(ax + share * dx, ay + share * dy)
