"""Delays for maps: whether the slot is reached before it opens, and simple paths that arrive then.

Where the slot can be reached before it opens, every path that arrives as it opens is optimal. Of
the many families of `delay` two are tried here, enough almost everywhere: a straight put before or
behind a turn–straight–turn word.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is a table as in
`Scene`. The slot opens at (end_x, 0), end_x = α t_release, and is entered on heading 0.
"""

from math import atan2, sqrt

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI
from relguide.kernels.base.false_position import Bracket, secant, tightened
from relguide.kernels.base.records import Pose, Scene, Start
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.maps.final_leg import MovingPoint, keeps_clear, point_room
from relguide.kernels.separation.clearance import piece_at, piece_clears
from relguide.kernels.words.branches import TO_POINT
from relguide.kernels.words.to_point import word_from

ON_TIME = 1e-9
"""A path this much too long still arrives when the slot opens [R]: rounding."""
_ROUNDING = 1e-6  # of the bound of a path's length [R]: wide of what it is
_STEPS = 24  # of false position; ten are enough where no turn jumps


@njit(cache=True, nogil=True)
def reaches(start: Start, end_x: float, length: float, piece: FloatArray) -> bool:
    """Whether Dubins' shortest path to (end_x, 0) on heading 0 is no longer than this.

    Args:
        start: where it starts.
        end_x: where to [R].
        length: t_release [R].
        piece: room to work in. shape (3,)
    """
    x, y, _, sin_h, cos_h = start
    dx, most = end_x - x, length + _ROUNDING
    if dx * dx + y * y > most * most:
        return False
    # no path is shorter than one that may end on any heading, or begin on any
    if (
        _time_to_point(dx * cos_h - y * sin_h, -dx * sin_h - y * cos_h) > most
        or _time_to_point(dx, y) > most
    ):
        return False
    for k in range(6):
        shortest = word_from(start, end_x, TO_POINT[k], piece)
        if 0.0 <= shortest <= length + ON_TIME:
            return True
    return False


@njit(cache=True, nogil=True)
def _time_to_point(along: float, across: float) -> float:
    """No path to a point is shorter: a turn to its side, then straight.

    Args:
        along: the point ahead of the start [R].
        across: and to a side [R].
    """
    off = abs(across) - 1.0
    squared = along * along + off * off - 1.0
    if squared < 0.0:  # within the turn: the path is longer, but how much does not matter
        return 0.0
    straight = sqrt(squared)
    turn = atan2(off * straight + along, along * straight - off)
    return straight + (turn if turn > -_ROUNDING else turn + TWO_PI)


@njit(cache=True, nogil=True)
def release_clears(start: Start, scene: Scene, piece: FloatArray, row: FloatArray) -> bool:
    """Whether a path of one of the two families takes exactly t_release and keeps d_min.

    If not, a path of another family may.

    Args:
        start: the pursuer's pose, seen from the slot.
        scene: the leader, d_min, and when the slot opens.
        piece: room to work in. shape (3,)
        row: the same. shape (5,)
    """
    t_release = scene.t_release
    end_x = scene.alpha * t_release
    none = np.zeros(2)  # no last turn is known to clear where a word does not end in the slot
    for behind in range(2):
        for branch in range(4):
            shortest = word_from(start, end_x, branch, piece)
            if not 0.0 <= shortest <= t_release:
                continue
            amount = _straight_to_release(start, scene, branch, behind == 1, shortest, piece)
            if amount < 0.0:
                continue
            row[0], row[1] = t_release - amount, branch
            row[2], row[3], row[4] = piece[0], piece[1], piece[2]
            if behind == 0:
                if _straight_clears(start, 0.0, amount, scene) and keeps_clear(
                    _go_straight(start, amount), amount, row, end_x, scene, none
                ):
                    return True
            else:
                along = Start(end_x - amount, 0.0, 0.0, 0.0, 1.0)
                if _straight_clears(along, t_release - amount, amount, scene) and keeps_clear(
                    start, 0.0, row, end_x - amount, scene, none
                ):
                    return True
    return False


@njit(cache=True, nogil=True)
def _go_straight(start: Start, amount: float) -> Start:
    """The end of a straight."""
    x, y, h, sin_h, cos_h = start
    return Start(x + amount * cos_h, y + amount * sin_h, h, sin_h, cos_h)


@njit(cache=True, nogil=True)
def _straight_clears(start: Start, t: float, amount: float, scene: Scene) -> bool:
    """As `piece_clears`, for a straight: the cheap test first."""
    point = MovingPoint(start.x, start.y, start.cos_h, start.sin_h)
    return bool(
        point_room(point, t, amount, scene, piece_at(scene.leader, t)) >= scene.d_min
        or piece_clears(Pose(start.x, start.y, start.h), 0.0, t, amount, scene)
    )


@njit(cache=True, nogil=True)
def _straight_to_release(
    start: Start, scene: Scene, branch: int, behind: bool, shortest: float, piece: FloatArray
) -> float:
    """Length of the straight with which a word takes exactly t_release; negative if not found.

    By false position (Illinois): the word's length is nearly linear in it, but jumps where a turn
    does, by 2π.
    """
    t_release = scene.t_release
    end_x = scene.alpha * t_release
    bracket = Bracket(0.0, t_release, shortest - t_release, t_release, 0)
    for _ in range(_STEPS):
        amount = secant(bracket)
        if behind:
            length = word_from(start, end_x - amount, branch, piece)
        else:
            length = word_from(_go_straight(start, amount), end_x, branch, piece)
        if length < 0.0:
            return -1.0
        gap = length + amount - t_release
        if abs(gap) <= ON_TIME:
            return amount
        bracket = tightened(bracket, amount, gap)
    return -1.0
