"""The time-to-converge at many places at once: one leader, one heading of the pursuer.

The cheap part of the chain of `plan`: every extremal in order of time, and the first that clears.
Paths that touch d_min or slide along it are not sought, so where the fastest extremal comes too
close the answer is a time that can be flown, and a bound below it. A caller that knows which word
is the fastest may say so: then it alone is solved, and the bound is that of a straight line.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is a table as in
`Scene`.
"""

from math import cos, hypot, inf, sin

import numpy as np
from numba import njit

from relguide.kernels.base.records import Pose, Scene, Start, Window, with_limit
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.maps.final_leg import keeps_clear
from relguide.kernels.maps.next_clear import next_clear
from relguide.kernels.maps.release import reaches, release_clears
from relguide.kernels.separation.clearance import SLACK
from relguide.kernels.words.branches import direct_time
from relguide.kernels.words.extremals import WORDS
from relguide.kernels.words.fastest import ends_at_slot, fastest, word_before
from relguide.kernels.words.sooner import Scratch, make_scratch

ByteArray = np.ndarray[tuple[int, ...], np.dtype[np.int8]]
DELAY = len(WORDS)
"""Word number of a delay: a path that arrives exactly when the slot opens."""
NO_WORD = -1
"""Word number where no path that clears was found."""


@njit(cache=True, nogil=True)
def field_rows(
    places: FloatArray, words: ByteArray, h: float, scene: Scene, longest: FloatArray,
    answers: FloatArray,
) -> None:  # fmt: skip
    """Answers for all places.

    Args:
        places: x, y of the pursuer. shape (n, 2)
        words: the only word that need be solved at each, −1 for all of them. shape (n,)
        h: its heading [rad], in [0, 2π).
        scene: d_min is 0 where there is no limit; t_release is 0 for a leader that keeps straight.
        longest: of `final_leg.last_turns`, for d_min less `SLACK`.
        answers: takes the arrival by the fastest path found that clears; before what no path
            arrives (infinite if the slot is out of reach, or d_min broken from the start); the
            path's word number; 1 if the fastest path without the limit comes too close.
            shape (n, 4)
    """
    scratch = make_scratch()
    row, tried, piece = np.empty(5), np.empty(5), np.empty(3)
    sin_h, cos_h = sin(h), cos(h)
    alpha, t_release, limited = scene.alpha, scene.t_release, scene.d_min > 0.0
    near = with_limit(scene, scene.d_min - SLACK)
    hint = next_hint = 0
    for n in range(len(places)):
        x, y = places[n, 0], places[n, 1]
        start = Start(x, y, h, sin_h, cos_h)
        answer = answers[n]
        answer[0], answer[1], answer[2], answer[3] = inf, inf, NO_WORD, 0.0
        if hypot(x - scene.leader[0, 1], y - scene.leader[0, 2]) < near.d_min:
            continue
        if t_release > 0.0 and reaches(start, alpha * t_release, t_release, piece):
            answer[1] = t_release
            if not limited or release_clears(start, near, piece, row):
                answer[0], answer[2] = t_release, DELAY
                continue
            answer[3] = 1.0
        elif words[n] >= 0 and _solve_alone(start, alpha, words[n], scratch, row):
            time = row[0]
            if time >= t_release and (
                not limited or keeps_clear(start, 0.0, row, alpha * time, near, longest)
            ):
                answer[0], answer[2] = time, words[n]
                answer[1] = min(max(direct_time(x, y, alpha), t_release), time)
                continue
        if not fastest(Pose(x, y, h), alpha, t_release, hint, scratch, row):
            continue
        hint = int(row[1])
        if answer[1] == inf:
            answer[1] = row[0]
        if not limited or keeps_clear(start, 0.0, row, alpha * row[0], near, longest):
            answer[0], answer[2] = row[0], row[1]
            continue
        answer[3] = 1.0
        if next_clear(start, near, next_hint, longest, scratch, tried, row):
            answer[0], answer[2] = row[0], row[1]
            next_hint = int(row[1])


@njit(cache=True, nogil=True)
def _solve_alone(start: Start, alpha: float, word: int, scratch: Scratch, row: FloatArray) -> bool:
    """The first path of one word, as a row of `solve`; whether there is one."""
    found = scratch.found
    n = word_before(start, alpha, word, Window(0.0, inf), False, scratch)
    row[0] = inf
    best = 0
    for i in range(n):
        if found[i, 0] < row[0]:
            row[0], best = found[i, 0], i
    row[1] = word
    row[2], row[3], row[4] = found[best, 1], found[best, 2], found[best, 3]
    return bool(n > 0 and ends_at_slot(start, alpha, word, found[best]))
