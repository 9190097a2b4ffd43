"""The best word with a full loop in it: a path that touches nothing, and lets the leader pass.

Where the limit is not in the way no path has a full loop: there is a faster one. But a loop costs
2π, and a way round the disc may cost more. With a loop a path meets the slot as it does without one
where that is 2π later. The loop may be flown anywhere, as it ends where and as it began; but only
in its own turn, or from its straight to either side, does the costate fit: see `costate`.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap
from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import WORD
from relguide.kernels.contact.clear_words import EARLY, word_clears
from relguide.kernels.words.extremals import MAX_ROWS, SIGNS, fly_piece, solve

_PLACES = 16  # along a straight where the loop may begin
_WORD_OF = ((0, 2), (3, 1))  # by whether its first and its last turn is to the right


@njit(cache=True, nogil=True)
def looped_word(start: Pose, scene: Scene, beat: float, legs: FloatArray) -> tuple[float, int]:
    """The fastest word to the slot with a full loop in it that keeps d_min.

    Args:
        start: where it begins, at t = 0.
        scene: what it has to reckon with.
        beat: an arrival already known [R/V_P]; only earlier ones are looked for.
        legs: takes its legs: up to the end of the loop, and from there on. shape (≥ 2, 6)

    Returns:
        arrival time [R/V_P] and the number of legs; `beat` and 0 if none is faster.
    """
    if beat <= TWO_PI:
        return beat, 0
    rows, found = np.empty((MAX_ROWS, 5)), np.empty((2, 5))
    seen = Pose(start.x - scene.alpha * TWO_PI, start.y, wrap(start.h))
    n = solve(seen, scene.alpha, max(scene.t_release - TWO_PI, 0.0), rows)
    for k in range(n):
        time = rows[k, 0] + TWO_PI
        if time >= beat:
            break
        if time >= scene.t_release - EARLY and _put_loop(start, scene, rows[k], found):
            legs[:2, 0] = WORD
            legs[:2, 1:] = found
            return time, 2
    return beat, 0


@njit(cache=True, nogil=True)
def _put_loop(start: Pose, scene: Scene, row: FloatArray, found: FloatArray) -> bool:
    """Whether a word keeps d_min with a loop somewhere; `found`, shape (2, 5), takes both parts."""
    word = int(row[1])
    first, middle, last = SIGNS[word]
    if middle != 0.0:
        # LRL and RLR turn all the way
        return (
            _loops_at(start, scene, row, 0.0, first, found)
            or _loops_at(start, scene, row, 0.5, middle, found)
            or _loops_at(start, scene, row, 1.0, last, found)
        )
    for k in range(_PLACES + 1):
        for hand in (first, -first) if k < _PLACES else (last, -last):
            if _loops_at(start, scene, row, k / _PLACES, hand, found):
                return True
    return False


@njit(cache=True, nogil=True)
def _loops_at(
    start: Pose, scene: Scene, row: FloatArray, share: float, hand: float, found: FloatArray
) -> bool:
    """Whether a word keeps d_min with a loop so far along its middle piece.

    A straight is parted there; a turn has its loop in itself, whatever the share.
    """
    word = int(row[1])
    found[:] = 0.0
    before, after = found[0], found[1]
    if SIGNS[word, 1] != 0.0:
        before[1], before[2], before[3], before[4] = row[1], row[2], row[3], row[4]
        before[2 if share == 0.0 else 4 if share == 1.0 else 3] += TWO_PI
        after[1] = row[1]
    else:
        before[1] = _WORD_OF[int(SIGNS[word, 0] < 0.0)][int(hand < 0.0)]
        before[2], before[3], before[4] = row[2], share * row[3], TWO_PI
        after[1] = _WORD_OF[int(hand < 0.0)][int(SIGNS[word, 2] < 0.0)]
        after[3], after[4] = (1.0 - share) * row[3], row[4]
    before[0] = before[2] + before[3] + before[4]
    after[0] = after[2] + after[3] + after[4]
    if not word_clears(start, 0.0, before, scene):
        return False
    at = start
    for k in range(3):
        at = fly_piece(at, SIGNS[int(before[1]), k], before[k + 2])
    return word_clears(at, before[0], after, scene)
