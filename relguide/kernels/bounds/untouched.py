"""How soon a path can arrive that nowhere touches the limit: an extremal, with loops or without.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap
from relguide.kernels.base.norm import norm
from relguide.kernels.base.records import Pose, Scene, with_limit
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.breach import INSIDE, MOST_LOOKS, Flown, NearWord, breaks_limit
from relguide.kernels.bounds.goal import Goal
from relguide.kernels.separation.clearance import leader_at, piece_at
from relguide.kernels.words.extremals import MAX_ROWS, SIGNS, fly_piece, solve

_LOOP_STRIDE = 0.01  # from one look to the next where there may be a loop [R/V_P]
_SHORT = 1e-6  # a straight no longer than this may have any direction [R]
_STRIDE = 1e-4  # least step of the look for a breach on a path that is known [R/V_P]


@njit(cache=True, nogil=True)
def untouched_bound(start: Pose, scene: Scene, goal: Goal, beat: float) -> float:
    """No path that nowhere touches the limit arrives sooner than this. Arguments as `cell_bound`.

    It is an extremal that keeps the limit, or has a full loop in it. Nothing later than `beat` is
    looked at.
    """
    rows = np.empty((MAX_ROWS, 5))
    inside = with_limit(scene, scene.d_min - INSIDE)
    seen = Pose(start.x - goal.x, start.y, wrap(start.h))
    best = beat
    after_loop = Pose(seen.x - goal.speed * TWO_PI, seen.y, seen.h)
    n = solve(after_loop, goal.speed, scene.t_release - TWO_PI, rows)
    for k in range(n):
        if TWO_PI + rows[k, 0] >= best:
            break
        if not _breaks_with_loop(start, rows[k], inside):
            best = TWO_PI + rows[k, 0]
            break
    n = solve(seen, goal.speed, scene.t_release, rows)
    flown = Flown(0.0, 1.0, 0.0, 0.0)
    for k in range(n):
        if rows[k, 0] >= best:
            break
        signs = SIGNS[int(rows[k, 1])]
        word = NearWord(
            (signs[0], signs[1], signs[2]), rows[k, 2], 0.0, rows[k, 3], 0.0, rows[k, 0]
        )
        if not breaks_limit(start, word, flown, inside, _STRIDE):
            best = rows[k, 0]
            break
    # with two loops and more: no sooner than the soonest of all paths that are so long delayed
    after_loops = Pose(seen.x - goal.speed * 2.0 * TWO_PI, seen.y, seen.h)
    n = solve(after_loops, goal.speed, 0.0, rows)
    return min(best, max(2.0 * TWO_PI + rows[0, 0], scene.t_release)) if n > 0 else best


@njit(cache=True, nogil=True)
def _breaks_with_loop(start: Pose, row: FloatArray, scene: Scene) -> bool:
    """Whether a word with a full loop in it, wherever that is, certainly breaks the limit.

    Up to the loop it is flown as it is, and then 2π later. So it does if it breaks the limit as it
    is no later along the path than it does when flown 2π later; or if all loops between do so.
    """
    looks, along = 0, 0.0
    soonest_breach, last_breach = row[0], 0.0
    while along <= row[0] and looks < MOST_LOOKS:
        looks += 1
        nearest = inf
        at = _along(start, row, along)[0]
        for late in range(2):
            gap = _gap(at, scene, along + late * TWO_PI)
            nearest = min(nearest, abs(gap))
            if gap < 0.0:
                if late == 0:
                    soonest_breach = min(soonest_breach, along)
                else:
                    last_breach = along
        # before that neither can begin to break the limit, or cease to
        along += max(nearest / (1.0 + scene.alpha), _LOOP_STRIDE)
    while last_breach < soonest_breach and looks < MOST_LOOKS:
        looks += 1
        inside = _least_breach(start, row, last_breach, scene)
        if inside < _LOOP_STRIDE:
            return False
        # who begins the loop later by so much is no further from there than by twice as much
        last_breach += 0.5 * inside
    return bool(last_breach >= soonest_breach)


@njit(cache=True, nogil=True)
def _least_breach(start: Pose, row: FloatArray, along: float, scene: Scene) -> float:
    """How far inside the limit a loop comes that begins so far along a word, at least [R].

    A loop in a turn goes on turning, as λ_ψ vanishes on the line of the straight only; from there
    one may go either way.
    """
    at, sign = _along(start, row, along)
    least = inf
    for hand in (-1.0, 1.0):
        if sign != 0.0 and hand != sign and row[3] > _SHORT:
            continue
        deepest, flown = 0.0, 0.0
        while flown < TWO_PI:
            gap = _gap(fly_piece(at, hand, flown), scene, along + flown)
            deepest = max(deepest, -gap)
            flown += max((gap + deepest) / (1.0 + scene.alpha), _LOOP_STRIDE)
        least = min(least, deepest)
    return least


@njit(cache=True, nogil=True)
def _along(start: Pose, row: FloatArray, flown: float) -> tuple[Pose, float]:
    """Where a word has come to, and how it turns there."""
    at, left, word, sign = start, flown, int(row[1]), 0.0
    for piece in range(3):
        amount = min(left, row[piece + 2])
        sign = SIGNS[word, piece]
        at = fly_piece(at, sign, amount)
        left -= amount
        if left <= 0.0:
            break
    return at, sign


@njit(cache=True, nogil=True)
def _gap(at: Pose, scene: Scene, t: float) -> float:
    """How far outside the limit somebody is [R]."""
    there = leader_at(scene, piece_at(scene.leader, t), t)
    return norm(at.x - there.x, at.y - there.y) - scene.d_min
