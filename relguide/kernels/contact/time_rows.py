"""Many situations with a straight leader, one after another: time, bound and proof of each.

The same chain as `plan`: the fastest extremal, alone; where that does not clear all others in order
of time, and the ways that touch d_min or slide along it. Slot frame: lengths in R, times in R/V_P,
angles counter-clockwise.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.angles import wrap
from relguide.kernels.base.records import Pose
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.constrained_search import MAX_LEGS, best_constrained_path
from relguide.kernels.contact.passage import GRAZE, word_clears
from relguide.kernels.contact.tangent import tangents
from relguide.kernels.separation.clearance import SLACK
from relguide.kernels.words.extremals import MAX_ROWS, solve
from relguide.kernels.words.fastest import fastest
from relguide.kernels.words.sooner import make_scratch

PROVED, BOUNDED, UNREACHABLE, ALREADY_LOST, NO_PATH = 0.0, 1.0, 2.0, 3.0, 4.0
"""What a row of the answer says: the optimum, proved; a plan with its bound; no plan, and why."""


@njit(cache=True, nogil=True)
def plan_rows(
    situations: FloatArray, bearings: int, limited: bool, first: int, last: int, answers: FloatArray
) -> None:
    """Plan situations first … last − 1.

    Args:
        situations: x, y, h of the pursuer; α; x, y of the leader; d_min. shape (n, 7)
        bearings: how finely detours are looked for.
        limited: whether the separation limit counts at all.
        first: from this row on.
        last: up to this row.
        answers: takes arrival, lower bound, verdict, the word's number (−1: a detour). (n, 4)
    """
    scratch = make_scratch()
    rows = np.empty((MAX_ROWS, 5))
    leader = np.zeros((1, 5))
    legs = np.empty((MAX_LEGS, 6))
    for n in range(first, last):
        x, y, h = situations[n, 0], situations[n, 1], wrap(situations[n, 2])
        alpha, limit = situations[n, 3], situations[n, 6]
        leader[0, 1], leader[0, 2] = situations[n, 4], situations[n, 5]
        answer = answers[n]
        answer[0], answer[1], answer[3] = inf, inf, -1.0
        gap = np.hypot(x - leader[0, 1], y - leader[0, 2])
        if limited and gap < limit - SLACK:
            answer[2] = ALREADY_LOST
            continue
        if not fastest(Pose(x, y, h), alpha, 0.0, 0, scratch, rows[0]):
            answer[2] = UNREACHABLE
            continue
        answer[1] = rows[0, 0]
        answer[2] = NO_PATH
        if not limited or word_clears(x, y, h, 0.0, rows[0], leader, alpha, limit - SLACK):
            answer[0], answer[2], answer[3] = rows[0, 0], PROVED, rows[0, 1]
            continue
        for k in range(1, solve(Pose(x, y, h), alpha, 0.0, rows)):
            if word_clears(x, y, h, 0.0, rows[k], leader, alpha, limit - SLACK):
                answer[0], answer[2], answer[3] = rows[k, 0], BOUNDED, rows[k, 1]
                break
        if limit <= 0.0:
            continue
        near = tangents(x, y, h, leader, alpha, limit + GRAZE)
        arrival, legs_flown = best_constrained_path(
            x, y, h, leader, alpha, limit + GRAZE, 0.0, bearings, near, answer[0], legs
        )
        if legs_flown > 0:
            answer[0], answer[2], answer[3] = arrival, BOUNDED, -1.0
