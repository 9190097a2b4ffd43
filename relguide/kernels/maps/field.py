"""The time-to-converge at many places at once: one leader, one heading of the pursuer.

The cheap part of the chain of `plan`: every extremal in order of time, and the first that clears.
Ways that touch d_min or slide along it are not looked for, so where the fastest extremal does not
clear the answer is a time that can be flown, and a bound below it. Who knows which word is the
fastest may say so: then it alone is solved, and the bound is that of a straight line.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is a table as in
`clearance`.
"""

from math import cos, hypot, inf, sin

import numpy as np
from numba import njit

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.maps.final_leg import keeps_clear
from relguide.kernels.maps.next_clear import next_clear
from relguide.kernels.maps.release import reaches, release_clears
from relguide.kernels.separation.clearance import SLACK
from relguide.kernels.words.branches import direct_time
from relguide.kernels.words.extremals import WORDS
from relguide.kernels.words.fastest import ends_at_slot, fastest, word_before
from relguide.kernels.words.sooner import MOST_ROOTS, work_room

ByteArray = np.ndarray[tuple[int, ...], np.dtype[np.int8]]
DELAY = len(WORDS)
"""Word number of a delay: a path that arrives exactly when the slot opens."""
NO_WORD = -1
"""Word number where nothing that clears was found."""


@njit(cache=True, nogil=True)
def field_rows(
    places: FloatArray, words: ByteArray, h: float, alpha: float, t_release: float,
    leader: FloatArray, limit: float, longest: FloatArray, first: int, last: int,
    answers: FloatArray,
) -> None:  # fmt: skip
    """Answers for places first … last − 1.

    Args:
        places: x, y of the pursuer. shape (n, 2)
        words: the only word that need be solved at each, −1 for all of them. shape (n,)
        h: its heading [rad], in [0, 2π).
        alpha: V_L/V_P.
        t_release: when the slot opens; 0 for a leader that keeps straight.
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
    row, tried, piece = np.empty(5), np.empty(5), np.empty(3)
    sin_h, cos_h = sin(h), cos(h)
    near = limit - SLACK
    hint = next_hint = 0
    for n in range(first, last):
        x, y = places[n, 0], places[n, 1]
        answer = answers[n]
        answer[0], answer[1], answer[2], answer[3] = inf, inf, NO_WORD, 0.0
        if hypot(x - leader[0, 1], y - leader[0, 2]) < near:
            continue
        if t_release > 0.0 and reaches(x, y, h, sin_h, cos_h, alpha * t_release, t_release, piece):
            answer[1] = t_release
            if limit <= 0.0 or release_clears(
                x, y, h, sin_h, cos_h, alpha, t_release, leader, near, piece, row
            ):
                answer[0], answer[2] = t_release, DELAY
                continue
            answer[3] = 1.0
        elif words[n] >= 0 and _alone(x, y, h, sin_h, cos_h, alpha, words[n], room, found, row):
            time = row[0]
            if time >= t_release and (
                limit <= 0.0
                or keeps_clear(
                    x, y, h, sin_h, cos_h, 0.0, row, alpha * time, leader, alpha, near, longest
                )
            ):
                answer[0], answer[2] = time, words[n]
                answer[1] = min(max(direct_time(x, y, alpha), t_release), time)
                continue
        if not fastest(x, y, h, alpha, t_release, hint, room, found, row):
            continue
        hint = int(row[1])
        if answer[1] == inf:
            answer[1] = row[0]
        if limit <= 0.0 or keeps_clear(
            x, y, h, sin_h, cos_h, 0.0, row, alpha * row[0], leader, alpha, near, longest
        ):
            answer[0], answer[2] = row[0], row[1]
            continue
        answer[3] = 1.0
        if next_clear(
            x, y, h, sin_h, cos_h, alpha, next_hint, leader, near, longest, room, found, tried, row
        ):
            answer[0], answer[2] = row[0], row[1]
            next_hint = int(row[1])


@njit(cache=True, nogil=True)
def _alone(
    x: float, y: float, h: float, sin_h: float, cos_h: float, alpha: float, word: int,
    room: FloatArray, found: FloatArray, row: FloatArray,
) -> bool:  # fmt: skip
    """The first path of one word, as a row of `solve`; whether there is one."""
    n = word_before(x, y, h, sin_h, cos_h, alpha, 0.0, word, inf, False, room, found)
    row[0] = inf
    best = 0
    for i in range(n):
        if found[i, 0] < row[0]:
            row[0], best = found[i, 0], i
    row[1] = word
    row[2], row[3], row[4] = found[best, 1], found[best, 2], found[best, 3]
    return bool(n > 0 and ends_at_slot(x, y, h, sin_h, cos_h, alpha, word, found[best]))
