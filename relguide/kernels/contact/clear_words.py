"""Words that keep d_min: whether one does, the first that does, and the best one to the slot.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.angles import wrap
from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.separation.clearance import piece_clears
from relguide.kernels.words.extremals import MAX_ROWS, SIGNS, fly_piece, solve
from relguide.kernels.words.fastest import fastest
from relguide.kernels.words.sooner import make_scratch

EARLY = 1e-9
"""This much before it opens the slot counts as open [R/V_P], as in `solve`."""


@njit(cache=True, nogil=True)
def pieces_clear(
    pose: Pose, t: float, signs: FloatArray, amounts: FloatArray, scene: Scene
) -> bool:
    """Whether pieces at full bank or straight, flown from time t, keep d_min."""
    for k in range(len(signs)):
        sign, amount = signs[k], amounts[k]
        if amount > 0.0 and not piece_clears(pose, sign, t, amount, scene):
            return False
        pose = fly_piece(pose, sign, amount)
        t += amount
    return True


@njit(cache=True, nogil=True)
def word_clears(pose: Pose, t: float, row: FloatArray, scene: Scene) -> bool:
    """Whether a row of `solve`, flown from time t, keeps d_min."""
    return pieces_clear(pose, t, SIGNS[int(row[1])], row[2:5], scene)


@njit(cache=True, nogil=True)
def to_slot_frame(pose: Pose, t: float, alpha: float) -> Pose:
    """A pose at time t in the slot's own frame of that time, its heading in [0, 2π)."""
    return Pose(pose.x - alpha * t, pose.y, wrap(pose.h))


@njit(cache=True, nogil=True)
def first_clear(
    pose: Pose, t: float, rows: FloatArray, scene: Scene, beat: float
) -> tuple[float, int]:
    """The first of the rows of `solve`, flown from time t, that is not early and keeps d_min.

    Returns:
        arrival time and its number; infinite and −1 if none arrives before `beat`.
    """
    for k in range(len(rows)):
        arrival = t + rows[k, 0]
        if arrival >= beat:
            break
        if arrival >= scene.t_release - EARLY and word_clears(pose, t, rows[k], scene):
            return arrival, k
    return inf, -1


@njit(cache=True, nogil=True)
def best_word(
    pose: Pose, t: float, scene: Scene, beat: float, rows: FloatArray
) -> tuple[float, int]:
    """The fastest extremal to the slot, from time t on, that keeps d_min: arrival and row number.

    Infinite and −1 if none arrives before `beat`.
    """
    seen, left = to_slot_frame(pose, t, scene.alpha), max(scene.t_release - t, 0.0)
    n = solve(seen, scene.alpha, left, rows)
    return first_clear(pose, t, rows[:n], scene, beat)


@njit(cache=True, nogil=True)
def best_word_near(pose: Pose, t: float, scene: Scene, row: FloatArray) -> bool:
    """As `best_word`, where the word that is likely is known.

    Args:
        pose: from here on.
        t: when [R/V_P].
        scene: what the path has to reckon with.
        row: the best from nearby; takes the best from here. shape (5,)

    Returns:
        whether there is one.
    """
    seen, left = to_slot_frame(pose, t, scene.alpha), max(scene.t_release - t, 0.0)
    # the fastest alone is found in a third of the time, and mostly keeps d_min
    if fastest(seen, scene.alpha, left, int(row[1]), make_scratch(), row) and word_clears(
        pose, t, row, scene
    ):
        return True
    rows = np.empty((MAX_ROWS, 5))
    _, i = best_word(pose, t, scene, inf, rows)
    if i < 0:
        return False
    row[:] = rows[i]
    return True
