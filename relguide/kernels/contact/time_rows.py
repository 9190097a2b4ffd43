"""Many situations with a straight leader, one after another: time, bound and proof of each.

The same steps as `plan`: the fastest extremal, alone; where that breaks the limit all others in
order of time, and the paths that touch d_min or slide along it; where nothing is found, any path.
Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import hypot, inf

import numpy as np
from numba import njit

from relguide.kernels.base.angles import wrap
from relguide.kernels.base.records import Pose, Scene, with_limit
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.any_path import any_path
from relguide.kernels.contact.chain import MAX_LEGS
from relguide.kernels.contact.clear_words import word_clears
from relguide.kernels.contact.constrained_search import (
    best_constrained_path,
    ease_to_start,
)
from relguide.kernels.contact.path_pieces import pieces_of
from relguide.kernels.contact.tangent import tangents
from relguide.kernels.separation.clearance import SLACK
from relguide.kernels.words.extremals import MAX_ROWS, solve
from relguide.kernels.words.fastest import fastest
from relguide.kernels.words.sooner import make_scratch

PROVED, BOUNDED, UNREACHABLE, ALREADY_LOST, NO_PATH = 0.0, 1.0, 2.0, 3.0, 4.0
"""What a row of the answer says: the optimum, proved; a plan with its bound; no plan, and why."""
CONSTRAINED = -1.0
"""In place of a word's number: the path touches d_min, or slides along it."""
_AS_FAST = 1e-8  # times nearer than this are equal [R/V_P]


@njit(cache=True, nogil=True)
def plan_rows(
    situations: FloatArray, latest: FloatArray, bearings: int, harder: int, limited: bool,
    first: int, last: int, answers: FloatArray,
) -> None:  # fmt: skip
    """Plan situations first … last − 1.

    Args:
        situations: x, y, h of the pursuer; α; x, y of the leader; d_min. shape (n, 7)
        latest: later arrivals do not count [R/V_P]. shape (n,)
        bearings: how finely the disc is scanned for constrained paths.
        harder: so many times as finely where nothing is found.
        limited: whether the separation limit counts at all.
        first: from this row on.
        last: up to this row.
        answers: takes arrival, lower bound, verdict, and the word's number or CONSTRAINED. (n, 4)
    """
    scratch = make_scratch()
    rows, legs = np.empty((MAX_ROWS, 5)), np.empty((MAX_LEGS, 6))
    leader = np.zeros((1, 5))
    for n in range(first, last):
        x, y, h, alpha, leader[0, 1], leader[0, 2], d_min = situations[n]
        pose, answer = Pose(x, y, wrap(h)), answers[n]
        answer[0], answer[1], answer[3] = inf, inf, CONSTRAINED
        if limited and hypot(x - leader[0, 1], y - leader[0, 2]) < d_min - SLACK:
            answer[2] = ALREADY_LOST
        elif not fastest(pose, alpha, 0.0, 0, scratch, rows[0]):
            answer[2] = UNREACHABLE
        else:
            scene = Scene(leader, alpha, d_min, 0.0, inf)
            if not limited or word_clears(pose, 0.0, rows[0], with_limit(scene, d_min - SLACK)):
                answer[0] = answer[1] = rows[0, 0]
                answer[2], answer[3] = PROVED, rows[0, 1]
            else:
                _plan_row(pose, scene, latest[n], bearings, harder, rows, legs, answer)


@njit(cache=True, nogil=True)
def _plan_row(
    pose: Pose, scene: Scene, latest: float, bearings: int, harder: int, rows: FloatArray,
    legs: FloatArray, answer: FloatArray,
) -> None:  # fmt: skip
    """Plan a situation whose fastest extremal is in the first row, and breaks the limit."""
    eased = with_limit(scene, scene.d_min - SLACK)
    bound, refused = rows[0, 0], rows[0, 1]
    answer[1], answer[2] = bound, NO_PATH
    if bound > latest:
        return
    beat = latest
    for k in range(solve(pose, scene.alpha, 0.0, rows)):
        if rows[k, 0] > latest:
            break
        as_fast = rows[k, 0] <= bound + _AS_FAST
        if as_fast and rows[k, 1] == refused:
            continue  # of several that are equally fast any may come first
        if word_clears(pose, 0.0, rows[k], eased):
            beat = rows[k, 0]
            answer[0], answer[3] = beat, rows[k, 1]
            answer[2] = PROVED if as_fast else BOUNDED
            break
    if scene.d_min <= 0.0:
        return
    met = ease_to_start(pose, scene)
    near = tangents(pose, met)
    found, count = best_constrained_path(pose, met, bearings, near, beat, legs)
    if count == 0 and beat == latest:
        found, count = best_constrained_path(pose, met, harder * bearings, near, beat, legs)
    arrival = inf
    if count > 0:
        # in pieces, as it is flown, it takes a little less or more; with R = 1 angles are lengths
        pieces = pieces_of(pose, met, 1.0, 1.0, found, legs[:count])
        if pieces.shape[1] > 0:
            arrival = pieces[2].sum()
    if arrival == inf and beat == latest:
        found, _, _, _ = any_path(pose, met, beat, rows[0])
        if found < beat:
            arrival = found
    if arrival < inf:
        answer[0], answer[2], answer[3] = arrival, BOUNDED, CONSTRAINED
