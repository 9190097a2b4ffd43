"""A leader who turns once, as numbers: the scene they mean, and exact answers where d_min binds.

Straight on for a while, one turn to the left, then straight for ever; a turn to the right is the
mirror image. In a cross wind the slot lies aside of the leader's final leg. So a situation is
eleven numbers, in the slot frame (lengths in R, times in R/V_P, angles counter-clockwise):

    x, y, h      the pursuer at t = 0, its heading in [0, 2π)
    α, d_min     V_L/V_P, and the limit
    a, b         the leader ahead of the slot and left of it, on the final leg
    lead         how long the leader keeps straight at first
    θ, ω         its turn, and how fast
    hold         how long it then flies on until the slot opens: D over its ground speed
"""

from math import cos, inf, sin
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import wrap
from relguide.kernels.base.records import Pose, Scene, with_limit
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import DELAY, MAX_LEGS, WORD
from relguide.kernels.contact.clear_delay import delay_until_release
from relguide.kernels.contact.clear_words import pieces_clear, word_clears
from relguide.kernels.contact.constrained_search import best_constrained_path
from relguide.kernels.contact.contact import GRAZE
from relguide.kernels.contact.path_pieces import NO_TURN
from relguide.kernels.contact.tangent import tangents
from relguide.kernels.words.delay import DELAY_PIECES, MAX_DELAYS, straight_delays
from relguide.kernels.words.extremals import MAX_ROWS, SIGNS, fly_piece, solve_and_measure

NUMBERS = 11
"""How many numbers a situation is."""
CLEAR, BINDS, UNKNOWN = 0.0, 1.0, 2.0
"""What is found without a search: that the limit does not bind; that it does; or that the slot may
be reached before it opens, and yet by no path of that length that straights make."""


@njit(cache=True, nogil=True)
def turning_scene(numbers: FloatArray) -> tuple[Pose, Scene]:
    """Where the pursuer is, and what it has to reckon with. numbers: shape (NUMBERS,)."""
    x, y, h, alpha, d_min, ahead, left, lead, turn, rate, hold = numbers
    ends = lead + turn / rate
    leader = np.zeros((3 if lead > NO_TURN else 2, 5))
    last = len(leader) - 1
    leader[last, 0] = ends
    leader[last, 1] = ahead + alpha * ends
    leader[last, 2] = left
    # back along the turn, which ends on heading 0 and began on −θ
    radius = alpha / rate
    begin_x, begin_y = leader[last, 1] - radius * sin(turn), left + radius * (1.0 - cos(turn))
    leader[last - 1, 0] = lead if last > 1 else 0.0
    leader[last - 1, 1], leader[last - 1, 2] = begin_x, begin_y
    leader[last - 1, 3], leader[last - 1, 4] = -turn, rate
    if last > 1:
        leader[0, 1] = begin_x - alpha * lead * cos(turn)
        leader[0, 2] = begin_y + alpha * lead * sin(turn)
        leader[0, 3] = -turn
    return Pose(x, y, h), Scene(leader, alpha, d_min, ends + hold, inf)


class Bound(NamedTuple):
    """What is known without the limit."""

    limit: float
    """`CLEAR`, `BINDS` or `UNKNOWN`."""
    time: float
    """No path arrives sooner [R/V_P]; infinite if none is known."""
    at_release: bool
    """Whether the slot can be reached just as it opens: all such paths are equally fast."""
    rows: FloatArray
    """The extremals that arrive once the slot is open, fastest first. shape (MAX_ROWS, 5)"""
    found: int
    """How many they are."""


@njit(cache=True, nogil=True)
def bound_without_limit(pose: Pose, scene: Scene, rows: FloatArray) -> Bound:
    """Whether the limit binds, as `planning.plan` sees it before it searches.

    Args:
        pose: the pursuer's, its heading in [0, 2π).
        scene: a leader that turns.
        rows: takes the extremals that arrive once the slot is open, fastest first, as `solve`.
            shape (MAX_ROWS, 5)

    """
    eased = with_limit(scene, scene.d_min - GRAZE)
    n, shortest = solve_and_measure(pose.x, pose.y, pose.h, scene.alpha, scene.t_release, rows)
    if shortest <= scene.t_release + NO_TURN:
        paths = np.empty((2, MAX_DELAYS, DELAY_PIECES))
        count = straight_delays(pose, scene.alpha, scene.t_release, paths)
        for k in range(count):
            if pieces_clear(pose, 0.0, paths[0, k], paths[1, k], eased):
                return Bound(CLEAR, scene.t_release, True, rows, n)
        return Bound(BINDS if count > 0 else UNKNOWN, scene.t_release, True, rows, n)
    if n == 0:
        return Bound(UNKNOWN, inf, False, rows, n)
    limit = CLEAR if word_clears(pose, 0.0, rows[0], eased) else BINDS
    return Bound(limit, rows[0, 0], False, rows, n)


@njit(cache=True, nogil=True)
def turning_limit_binds_rows(situations: FloatArray, binds: FloatArray) -> None:
    """What `bound_without_limit` finds of many.

    Args:
        situations: as in the module's text. shape (n, NUMBERS)
        binds: takes what is found; `CLEAR` too where the aircraft are too close from the start.
            shape (n,)
    """
    rows = np.empty((MAX_ROWS, 5))
    for k in range(len(situations)):
        pose, scene = turning_scene(situations[k])
        at = scene.leader[0]
        away = (pose.x - at[1]) ** 2 + (pose.y - at[2]) ** 2
        binds[k] = CLEAR
        if away >= scene.d_min * scene.d_min:
            binds[k] = bound_without_limit(pose, scene, rows).limit


@njit(cache=True, nogil=True)
def solve_turning_rows(
    situations: FloatArray, bearings: int, longest: float, times: FloatArray, counts: FloatArray,
    legs: FloatArray,
) -> None:  # fmt: skip
    """The fastest path that keeps the limit, as `plan` searches it.

    Args:
        situations: as in the module's text; the limit binds. shape (n, NUMBERS)
        bearings: how finely the disc is scanned.
        longest: paths that take longer do not count [R/V_P].
        times: takes the time without the limit, that of the fastest path without contact that keeps
            it, and that of the fastest path; infinite where there is none [R/V_P]. shape (n, 3)
        counts: takes how many legs the path has; 0 where there is none. shape (n,)
        legs: takes them, as `chain.Chain`, as many as there is room for. shape (n, ·, 6)
    """
    rows, pieces = np.empty((MAX_ROWS, 5)), np.empty((DELAY_PIECES, 2))
    path = np.zeros((MAX_LEGS, 6))
    for n in range(len(situations)):
        pose, scene = turning_scene(situations[n])
        eased = with_limit(scene, scene.d_min - GRAZE)
        bound = bound_without_limit(pose, scene, rows)
        times[n, 0], times[n, 1], counts[n] = bound.time, inf, 0.0
        legs[n] = 0.0
        if bound.at_release and delay_until_release(pose, 0.0, eased, pieces):
            times[n, 1], counts[n], legs[n, 0, 0] = scene.t_release, 1.0, DELAY
        else:
            for k in range(bound.found):
                if rows[k, 0] <= longest and word_clears(pose, 0.0, rows[k], eased):
                    times[n, 1], counts[n] = rows[k, 0], 1.0
                    legs[n, 0, 0] = WORD
                    legs[n, 0, 1:6] = rows[k]
                    break
        times[n, 2] = times[n, 1]
        if times[n, 1] <= scene.t_release:
            continue
        path[:] = 0.0
        time, count = best_constrained_path(
            pose, scene, bearings, tangents(pose, scene), min(times[n, 1], longest), path
        )
        if count > 0:
            times[n, 2], counts[n] = time, count
            room = min(count, legs.shape[1])
            legs[n] = 0.0
            legs[n, :room] = path[:room]


@njit(cache=True, nogil=True)
def advance_turning_rows(
    situations: FloatArray, times: FloatArray, legs: FloatArray, shares: FloatArray
) -> None:
    """Put situations forward on their paths by a share of the first turn; what remains is optimal.

    No farther than the leader turns.

    Args:
        situations: as in the module's text; replaced by those on the path. shape (n, NUMBERS)
        times: of the paths [R/V_P]; replaced by those of the rest. shape (n,)
        legs: as `chain.Chain`, the first of them a word; replaced by those of the rest.
            shape (n, ·, 6)
        shares: how much of the first turn, or of the leader's time to turn, has been flown.
            shape (n,)
    """
    for n in range(len(situations)):
        x, y, h, alpha, _, _, _, lead, turn, rate, _ = situations[n]
        first = legs[n, 0]
        flown = shares[n] * min(first[3], lead + turn / rate)
        x, y, h = fly_piece(Pose(x, y, h), SIGNS[int(first[2]), 0], flown)
        situations[n, 0], situations[n, 1] = x - alpha * flown, y
        situations[n, 2] = wrap(h)
        situations[n, 7] = max(lead - flown, 0.0)
        situations[n, 8] = turn - rate * max(flown - lead, 0.0)
        first[1] -= flown
        first[3] -= flown
        times[n] -= flown
