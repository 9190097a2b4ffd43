"""Paths that arrive exactly when the slot opens, for maps: whether there are any, and simple ones.

Where the slot can be reached before it opens every path that takes until then is optimal. Of the
many families of `delay.holds` two are tried here, enough almost everywhere: a straight put before
or behind a turn–straight–turn word.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is a table as in
`clearance`. The slot opens at (end_x, 0), end_x = α t_release, and is entered on heading 0.
"""

from math import atan2, sqrt

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.maps.final_leg import keeps_clear, point_room
from relguide.kernels.separation.clearance import piece_at, piece_clears
from relguide.kernels.words.delay import word_headed

ON_TIME = 1e-9
"""A way this much too long still arrives when the slot opens [R]: rounding."""
_ROUNDING = 1e-6  # of the bound of a way's length [R]: wide of what it is
_STEPS = 24  # of false position; ten are enough where nothing jumps


@njit(cache=True, nogil=True)
def reaches(
    x: float, y: float, h: float, sin_h: float, cos_h: float, end_x: float, length: float,
    piece: FloatArray,
) -> bool:  # fmt: skip
    """Whether Dubins' shortest way to (end_x, 0) on heading 0 is no longer than this.

    Args:
        x: start [R].
        y: start [R].
        h: start heading [rad].
        sin_h: its sine, the same for a whole map.
        cos_h: and cosine.
        end_x: where to [R].
        length: t_release [R].
        piece: room to work in. shape (3,)
    """
    dx, most = end_x - x, length + _ROUNDING
    if dx * dx + y * y > most * most:
        return False
    # no way is shorter than one that may end on any heading, or begin on any
    if _to_point(dx * cos_h - y * sin_h, -dx * sin_h - y * cos_h) > most or _to_point(dx, y) > most:
        return False
    for branch in range(6):
        way = word_headed(x, y, h, sin_h, cos_h, end_x, branch, piece)
        if 0.0 <= way <= length + ON_TIME:
            return True
    return False


@njit(cache=True, nogil=True)
def _to_point(along: float, across: float) -> float:
    """No way to a point is shorter: a turn to its side, then straight.

    Args:
        along: the point ahead of the start [R].
        across: and to a side [R].
    """
    off = abs(across) - 1.0
    squared = along * along + off * off - 1.0
    if squared < 0.0:  # within the turn: the way is longer, but how much does not matter
        return 0.0
    straight = sqrt(squared)
    turn = atan2(off * straight + along, along * straight - off)
    return straight + (turn if turn > -_ROUNDING else turn + TWO_PI)


@njit(cache=True, nogil=True)
def release_clears(
    x: float, y: float, h: float, sin_h: float, cos_h: float, alpha: float, t_release: float,
    leader: FloatArray, limit: float, piece: FloatArray, row: FloatArray,
) -> bool:  # fmt: skip
    """Whether a straight put before or behind a turn–straight–turn word uses up t_release, and
    clears.

    That none does does not mean that no path of that length does.

    Args:
        x: as in `reaches`.
        y: as there.
        h: as there.
        sin_h: as there.
        cos_h: as there.
        alpha: V_L/V_P.
        t_release: when the slot opens [R/V_P].
        leader: table of its pieces. shape (k, 5)
        limit: least allowed separation [R].
        piece: room to work in. shape (3,)
        row: the same. shape (5,)
    """
    end_x = alpha * t_release
    none = np.zeros(2)  # no last turn is known to clear where a word does not end in the slot
    for behind in range(2):
        for branch in range(4):
            way = word_headed(x, y, h, sin_h, cos_h, end_x, branch, piece)
            if not 0.0 <= way <= t_release:
                continue
            amount = _straight_to_release(
                x, y, h, sin_h, cos_h, end_x, t_release, branch, behind == 1, way, piece
            )
            if amount < 0.0:
                continue
            row[0], row[1] = t_release - amount, branch
            row[2], row[3], row[4] = piece[0], piece[1], piece[2]
            if behind == 0:
                if not _straight_clears(x, y, h, sin_h, cos_h, 0.0, amount, leader, alpha, limit):
                    continue
                at_x, at_y = x + amount * cos_h, y + amount * sin_h
                if keeps_clear(
                    at_x, at_y, h, sin_h, cos_h, amount, row, end_x, leader, alpha, limit, none
                ):
                    return True
            elif _straight_clears(
                end_x - amount, 0.0, 0.0, 0.0, 1.0, t_release - amount, amount, leader, alpha, limit
            ) and keeps_clear(
                x, y, h, sin_h, cos_h, 0.0, row, end_x - amount, leader, alpha, limit, none
            ):
                return True
    return False


@njit(cache=True, nogil=True)
def _straight_clears(
    x: float, y: float, h: float, sin_h: float, cos_h: float, t: float, amount: float,
    leader: FloatArray, alpha: float, limit: float,
) -> bool:  # fmt: skip
    """As `piece_clears`, for a straight: the cheap test first."""
    i = piece_at(leader, t)
    return bool(
        point_room(x, y, cos_h, sin_h, t, amount, leader, i, alpha) >= limit
        or piece_clears(x, y, h, 0.0, t, amount, leader, alpha, limit)
    )


@njit(cache=True, nogil=True)
def _straight_to_release(
    x: float, y: float, h: float, sin_h: float, cos_h: float, end_x: float, t_release: float,
    branch: int, behind: bool, shortest: float, piece: FloatArray,
) -> float:  # fmt: skip
    """Length of the straight with which a word takes exactly t_release; negative if not found.

    By false position (Illinois): the length is nearly linear in it, but where a turn jumps by 2π.
    """
    low, high, gap_low, gap_high = 0.0, t_release, shortest - t_release, t_release
    side = 0
    for _ in range(_STEPS):
        amount = (low * gap_high - high * gap_low) / (gap_high - gap_low)
        if behind:
            way = word_headed(x, y, h, sin_h, cos_h, end_x - amount, branch, piece)
        else:
            at_x, at_y = x + amount * cos_h, y + amount * sin_h
            way = word_headed(at_x, at_y, h, sin_h, cos_h, end_x, branch, piece)
        if way < 0.0:
            return -1.0
        gap = way + amount - t_release
        if abs(gap) <= ON_TIME:
            return amount
        if gap < 0.0:
            low, gap_low = amount, gap
            gap_high *= 0.5 if side < 0 else 1.0
            side = -1
        else:
            high, gap_high = amount, gap
            gap_low *= 0.5 if side > 0 else 1.0
            side = 1
    return -1.0
