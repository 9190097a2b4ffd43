"""Some path to the slot that keeps d_min, for when nothing else was found.

That there is a path at all matters more than its time then. Slot frame: lengths in R, times in
R/V_P, angles counter-clockwise.
"""

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI
from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.clear_words import best_word, pieces_clear
from relguide.kernels.words.extremals import MAX_ROWS, fly_piece

_FIRST_TURNS = 48  # sizes of the first turn: every 7.5°
_LONGEST = 64.0  # longest straight tried [R]: 200 NM for an airliner


@njit(cache=True, nogil=True)
def any_path(
    start: Pose, scene: Scene, beat: float, row: FloatArray
) -> tuple[float, float, float, float]:
    """The first turn of any size, the straight and the word that arrive soonest and keep d_min.

    Args:
        start: where it begins, at t = 0.
        scene: what it has to reckon with.
        beat: an arrival already known [R/V_P]; only earlier ones are looked for.
        row: takes the row of the word. shape (5,)

    Returns:
        arrival, sign and angle of the first turn, length of the straight; `beat` and zeros if there
        is none.
    """
    best, best_sign, best_turn, best_straight = beat, 0.0, 0.0, 0.0
    rows, signs, amounts = np.empty((MAX_ROWS, 5)), np.zeros(2), np.empty(2)
    for side in range(2):
        signs[0] = 1.0 - 2.0 * side
        for j in range(_FIRST_TURNS + 1):
            amounts[0], amounts[1] = TWO_PI * j / _FIRST_TURNS, 0.0
            while amounts[1] <= _LONGEST and pieces_clear(start, 0.0, signs, amounts, scene):
                if time_is_up(scene.until):
                    return best, best_sign, best_turn, best_straight
                pose = fly_piece(fly_piece(start, signs[0], amounts[0]), 0.0, amounts[1])
                arrival, i = best_word(pose, amounts.sum(), scene, best, rows)
                if arrival < best:
                    best, best_sign = arrival, signs[0]
                    best_turn, best_straight = amounts
                    row[:] = rows[i]
                amounts[1] = 2.0 * amounts[1] + 0.25
            if amounts[1] == 0.0:
                break  # the turn alone breaks the limit, and so does any larger one
    return best, best_sign, best_turn, best_straight
