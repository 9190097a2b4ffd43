"""From a pose to the slot just as it opens, clear of the leader: a path of one exact length.

Or to a contact just when it is there, whose place does not move at that moment.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import wrap
from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.clear_words import pieces_clear
from relguide.kernels.contact.contact import to_frame_of
from relguide.kernels.words.delay import (
    DELAY_PIECES,
    MAX_DELAYS,
    straight_delays,
    turning_delays,
)


class _Target(NamedTuple):
    seen: Pose  # where the path starts, seen from its end as that is now
    speed: float  # of its end, along its heading [V_P]
    left: float  # how long the path is to be [R]


@njit(cache=True, nogil=True)
def delay_until_release(pose: Pose, t: float, scene: Scene, pieces: FloatArray) -> bool:
    """Find a path that keeps d_min and arrives at t_release, with as few turns as there are.

    Args:
        pose: where it starts.
        t: start time, before t_release [R/V_P].
        scene: the leader, d_min and t_release.
        pieces: takes ε, 0 for straights, and turn angle [rad] or length [R]. shape
            (DELAY_PIECES, 2)

    Returns:
        whether there is one.
    """
    return _put_fewest(pose, t, scene, _to_slot(pose, t, scene), pieces) <= DELAY_PIECES


@njit(cache=True, nogil=True)
def delay_until_contact(
    pose: Pose, t: float, scene: Scene, there: Pose, at: float, pieces: FloatArray
) -> bool:
    """The same to a contact.

    Args:
        pose: where it starts.
        t: start time [R/V_P].
        scene: the leader and d_min.
        there: the pose at the contact.
        at: and when [R/V_P].
        pieces: as in `delay_until_release`.
    """
    seen = to_frame_of(pose, there)
    target = _Target(Pose(seen.x, seen.y, wrap(seen.h)), 0.0, at - t)
    return _put_fewest(pose, t, scene, target, pieces) <= DELAY_PIECES


@njit(cache=True, nogil=True)
def delays_by_straights(pose: Pose, t: float, scene: Scene) -> bool:
    """Whether a path of two turns at most and straights would do: a quarter of the work."""
    paths, pieces = np.empty((2, MAX_DELAYS, DELAY_PIECES)), np.empty((DELAY_PIECES, 2))
    _, fewest = _put_straight(pose, t, scene, _to_slot(pose, t, scene), paths, pieces)
    return fewest <= DELAY_PIECES


@njit(cache=True, nogil=True)
def _to_slot(pose: Pose, t: float, scene: Scene) -> _Target:
    seen = Pose(pose.x - scene.alpha * t, pose.y, pose.h)
    return _Target(seen, scene.alpha, scene.t_release - t)


@njit(cache=True, nogil=True)
def _put_fewest(pose: Pose, t: float, scene: Scene, target: _Target, pieces: FloatArray) -> int:
    """Put down a clear path with the fewest turns there are; how many, or more than all."""
    paths = np.empty((2, MAX_DELAYS, DELAY_PIECES))
    n, fewest = _put_straight(pose, t, scene, target, paths, pieces)
    if fewest > 2:  # three turns or more, of which none is better than two
        n = turning_delays(target.seen, target.speed, target.left, paths, n)
        fewest = _put_clear(pose, t, scene, paths[:, :n], pieces)
    return fewest


@njit(cache=True, nogil=True)
def _put_straight(
    pose: Pose, t: float, scene: Scene, target: _Target, paths: FloatArray, pieces: FloatArray
) -> tuple[int, int]:
    """Put down the first clear path that straights delay; how many paths were tried, and turns."""
    n = straight_delays(target.seen, target.speed, target.left, paths)
    return n, _put_clear(pose, t, scene, paths[:, :n], pieces)


@njit(cache=True, nogil=True)
def _put_clear(pose: Pose, t: float, scene: Scene, paths: FloatArray, pieces: FloatArray) -> int:
    """Put down the first clear path of those with the fewest turns; how many, or more than all."""
    fewest = DELAY_PIECES + 1
    for j in range(paths.shape[1]):
        signs, amounts = paths[0, j], paths[1, j]
        turns = 0
        for k in range(DELAY_PIECES):
            if signs[k] != 0.0 and amounts[k] > 0.0:
                turns += 1
        if turns < fewest and pieces_clear(pose, t, signs, amounts, scene):
            fewest = turns
            pieces[:, 0] = signs
            pieces[:, 1] = amounts
    return fewest
