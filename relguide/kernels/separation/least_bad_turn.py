"""The least bad thing to do where d_min cannot be kept: a turn and a straight, of all sizes.

World frame; lengths in m, times in s, headings clockwise from north.
"""

from math import inf, pi

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI
from relguide.kernels.base.motion import Motion, advance, with_pieces
from relguide.kernels.base.norm import norm
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.separation.approach import least_separation

_TURNS = 120  # sizes of the turn tried each way: every 3°
_ESCAPES = 18  # … and of an escape: every 10°, finer than a crew would be asked for
_MOST = 17  # so 170° at most: a heading is turned to the shorter way, with the roll-in before it
_SAME = 1.0  # separations nearer than this are one, and found to this [m]
_STEP = 0.5  # s; separations change by V_P + V_L in a second, so times are right to half of one


@njit(cache=True, nogil=True)
def soonest_clear_turn(
    pursuer: Motion, rate: float, leader: Motion, d_min: float, horizon: float
) -> tuple[float, float]:
    """The turn after which, going straight, the separation reaches d_min soonest.

    Args:
        pursuer: where it is; its pieces do not count.
        rate: |r| of a full turn [rad/s].
        leader: how the leader moves.
        d_min: what is to be kept [m].
        horizon: how far ahead to look [s].

    Returns:
        signed turn angle [rad], positive to the right, and when [s]; infinite if it never is.
    """
    best, best_angle, leader_pieces = inf, 0.0, leader.pieces
    for k in range(2 * _TURNS + 1):
        angle = TWO_PI * (k - _TURNS) / _TURNS
        turning = abs(angle) / rate
        px, py, psi = pursuer.x, pursuer.y, pursuer.heading
        lx, ly, lpsi = leader.x, leader.y, leader.heading
        t, piece, left = 0.0, 0, leader_pieces[0, 0] if len(leader_pieces) > 0 else inf
        while t < min(best, horizon):
            r = 0.0
            if t < turning:
                r = rate if angle > 0.0 else -rate
            lr = leader_pieces[piece, 1] if piece < len(leader_pieces) else 0.0
            step = min(_STEP, left)
            if t < turning:
                step = min(step, turning - t)
            px, py, psi = advance(px, py, psi, pursuer.tas, r, step)
            lx, ly, lpsi = advance(lx, ly, lpsi, leader.tas, lr, step)
            t += step
            left -= step
            if left <= 0.0:
                piece += 1
                left = leader_pieces[piece, 0] if piece < len(leader_pieces) else inf
            if norm(px - lx, py - ly) >= d_min:
                if t < best:
                    best, best_angle = t, angle
                break
    return best_angle, best


@njit(cache=True, nogil=True)
def widest_miss(
    pursuer: Motion, rate: float, leader: Motion, horizon: float
) -> tuple[float, float, float]:
    """The turn after which, going straight, the least separation is largest.

    Often it is least at once, whatever is turned later. Arguments as in `soonest_clear_turn`; of
    turns that are worth the same the smallest is given.

    Returns:
        signed turn angle [rad], positive to the right; that least separation [m]; when [s].
    """
    best, best_angle, best_at = -inf, 0.0, 0.0
    pieces = np.empty((1, 2))
    for k in range(2 * _TURNS + 1):
        # no turn, then to the right and to the left by more and more
        angle = TWO_PI * ((k + 1) // 2) / _TURNS * (1.0 if k % 2 == 1 else -1.0)
        pieces[0, 0] = abs(angle) / rate
        pieces[0, 1] = rate if angle > 0.0 else -rate
        least, at, _ = least_separation(with_pieces(pursuer, pieces), leader, 0.0, horizon, _SAME)
        if least > best + _SAME:
            best, best_angle, best_at = least, angle, at
    return best_angle, best, best_at


@njit(cache=True, nogil=True)
def escape_path(
    pursuer: Motion, rate: float, before: FloatArray, leader: Motion, leaders_pieces: FloatArray,
    d_min: float, horizon: float,
) -> tuple[int, float, float]:  # fmt: skip
    """The smallest turn after which, going straight, d_min is kept whatever the leader does.

    Args:
        pursuer: where it is; its pieces do not count.
        rate: |r| of a full turn [rad/s].
        before: how it goes on until it turns left, flies straight or turns right, a row each:
            duration [s] and turn rate [rad/s]. shape (3, 2)
        leader: where the leader is; its pieces do not count.
        leaders_pieces: duration and turn rate of each of its pieces, for all that it may do; where
            there are fewer pieces the last have a duration of 0. shape (k, n, 2)
        d_min: what is to be kept [m].
        horizon: how far ahead to look [s].

    Returns:
        the side, −1 left, 0 straight, +1 right; the turn angle [rad], ≥ 0; the least separation
        [m]. If no turn keeps d_min, those of the one whose least separation is largest.
    """
    best, best_side, best_angle = -1.0, 0, 0.0
    pieces = np.empty((2, 2))
    for k in range(_MOST + 1):
        angle = pi * k / _ESCAPES
        for side in (-1, 1) if k > 0 else (0, 0):
            pieces[0] = before[side + 1]
            pieces[1, 0], pieces[1, 1] = angle / rate, side * rate
            ours, kept = with_pieces(pursuer, pieces), inf
            for i in range(len(leaders_pieces)):
                theirs = with_pieces(leader, leaders_pieces[i])
                least, _, _ = least_separation(ours, theirs, 0.0, horizon, _SAME)
                kept = min(kept, least)
                if kept <= best:
                    break
            if kept > best:
                best, best_side, best_angle = kept, side, angle
            if best >= d_min:
                return best_side, best_angle, best
    return best_side, best_angle, best
