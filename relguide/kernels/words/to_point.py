"""Words to a point at rest: the length of a branch.

Slot frame as in `extremals`: lengths in R, angles counter-clockwise; the point is met on heading 0.
With first and last turn to the same side (ε = 1: LSL, LRL) or to opposite ones (LSR), d the vector
between the centres of their circles and β the course of the straight,

    LSL   β = arg d, l = |d|;        LSR   β = arg d + ε arcsin(2/|d|), l² = |d|² − 4;
    LRL   |d| = 4 sin(m/2), m or 2π − m; the first turn ends on the heading arg d + ε m/2.
"""

from math import asin, atan2, sqrt

from numba import njit

from relguide.kernels.base.angles import TWO_PI, turn_to
from relguide.kernels.base.norm import norm
from relguide.kernels.base.records import Pose, Start, start_at
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.words.branches import WORD_OF
from relguide.kernels.words.extremals import SIGNS


@njit(cache=True, nogil=True)
def word_to_point(pose: Pose, end_x: float, branch: int, piece: FloatArray) -> float:
    """One Dubins word from a pose to (end_x, 0) on heading 0.

    Args:
        pose: where it starts.
        end_x: where to [R].
        branch: number of `branches.BRANCHES`.
        piece: takes the three amounts [rad or R]. shape (3,)

    Returns:
        the length [R]; negative if the word does not reach.
    """
    return word_from(start_at(pose), end_x, branch, piece)


@njit(cache=True, nogil=True)
def word_from(start: Start, end_x: float, branch: int, piece: FloatArray) -> float:
    """As `word_to_point`, for maps."""
    x, y, h, sin_h, cos_h = start
    word = WORD_OF[branch]
    first, last = SIGNS[word, 0], SIGNS[word, 2]
    return word_between(end_x - (x - first * sin_h), last - (y + first * cos_h), h, branch, piece)


@njit(cache=True, nogil=True)
def word_between(dx: float, dy: float, h: float, branch: int, piece: FloatArray) -> float:
    """The same by the vector from the centre of its first circle to that of its last one [R]."""
    word = WORD_OF[branch]
    first = SIGNS[word, 0]
    gap = norm(dx, dy)
    bearing = atan2(dy, dx)
    if word < 2:
        course, middle = bearing, gap
        piece[0], piece[2] = turn_to(first * (course - h)), turn_to(-first * course)
    elif word < 4:
        if gap < 2.0:
            return -1.0
        course, middle = bearing + first * asin(2.0 / gap), sqrt(gap * gap - 4.0)
        piece[0], piece[2] = turn_to(first * (course - h)), turn_to(first * course)
    else:
        if gap > 4.0:
            return -1.0
        middle = 2.0 * asin(0.25 * gap)
        if branch % 2 == 1:
            middle = TWO_PI - middle
        crossing = bearing + 0.5 * first * middle
        piece[0], piece[2] = (
            turn_to(first * (crossing - h)),
            turn_to(-first * (crossing - first * middle)),
        )
    piece[1] = middle
    return float(piece[0] + middle + piece[2])
