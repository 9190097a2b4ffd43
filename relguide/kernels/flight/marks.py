"""The leader's flown path over the ground, as marks a second apart, and a place behind it there."""

from math import cos, hypot, inf, sin

from numba import njit

from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.roots import FloatArray

S, X, Y, HEADING, TRACK, SPEED, T = 0, 1, 2, 3, 4, 5, 6
"""Columns of a mark: length of the ground path up to here [m], where it is [m], heading and track
[rad, continuous], ground speed [m/s], flight time [s]."""
STRAIGHT = 0.0349066
"""Within 2° of its present heading the leader has flown straight; as for joining [rad]."""
WINDOW = 6_000.0
"""How far from the expected place the nearest point is searched [m]."""


@njit(cache=True, nogil=True)
def index_at(marks: FloatArray, column: int, value: float) -> int:
    """The mark before a value of a rising column; it and the next hold the value between them."""
    low, high = 0, len(marks) - 1
    while high - low > 1:
        middle = (low + high) // 2
        if marks[middle, column] <= value:
            low = middle
        else:
            high = middle
    return low


@njit(cache=True, nogil=True)
def mark_at(
    marks: FloatArray, column: int, value: float
) -> tuple[float, float, float, float, float]:
    """Length, place, heading and track where a rising column has a value; linear between marks."""
    i = index_at(marks, column, value)
    one, other = marks[i], marks[i + 1]
    share = (value - one[column]) / (other[column] - one[column])
    inside = min(max(share, 0.0), 1.0)  # beyond the ends it goes straight on
    return (
        one[S] + share * (other[S] - one[S]),
        one[X] + share * (other[X] - one[X]),
        one[Y] + share * (other[Y] - one[Y]),
        one[HEADING] + inside * (other[HEADING] - one[HEADING]),
        one[TRACK] + inside * (other[TRACK] - one[TRACK]),
    )


@njit(cache=True, nogil=True)
def speed_when(marks: FloatArray, t: float) -> float:
    """Ground speed at a flight time [m/s]; the first or the last beyond the ends."""
    i = index_at(marks, T, t)
    one, other = marks[i], marks[i + 1]
    share = min(max((t - one[T]) / (other[T] - one[T]), 0.0), 1.0)
    return float(one[SPEED] + share * (other[SPEED] - one[SPEED]))


@njit(cache=True, nogil=True)
def beside_marks(marks: FloatArray, x: float, y: float, expected: float) -> tuple[float, float]:
    """The point of the flown path next to a place.

    Args:
        marks: rows.
        x: east [m].
        y: north [m].
        expected: about where it should be, as length [m].

    Returns:
        its length [m], and how far to the right of the path the place is [m].
    """
    low = index_at(marks, S, expected - WINDOW)
    high = min(index_at(marks, S, expected + WINDOW) + 2, len(marks))
    s, nearest = expected, inf
    for i in range(low, high):
        apart = hypot(x - marks[i, X], y - marks[i, Y])
        if apart < nearest:
            nearest, s = apart, marks[i, S]
    if nearest > WINDOW:  # between marks far apart, behind the first position seen
        s = expected
    right = 0.0
    for _ in range(2):
        _, px, py, _, track = mark_at(marks, S, s)
        s += (x - px) * sin(track) + (y - py) * cos(track)
        _, px, py, _, track = mark_at(marks, S, s)
        right = (x - px) * cos(track) - (y - py) * sin(track)
    return s, right


@njit(cache=True, nogil=True)
def straight_for(marks: FloatArray, distance: float) -> bool:
    """Whether the leader has flown so far [m] on its present heading."""
    last = len(marks) - 1
    heading = marks[last, HEADING]
    for i in range(last - 1, -1, -1):
        if abs(wrap_signed(marks[i, HEADING] - heading)) >= STRAIGHT:
            # between this mark and the next it came within: count from the next
            return bool(marks[last, S] - marks[i + 1, S] >= distance)
        if marks[last, S] - marks[i, S] >= distance:
            return True
    return True


@njit(cache=True, nogil=True)
def sharpest_bend(marks: FloatArray, s: float, until: float, apart: float) -> float:
    """The largest curvature of the flown path between two lengths [rad/m].

    Args:
        marks: rows.
        s: length from which to look [m].
        until: and to which [m]; what has not been flown yet does not count.
        apart: between the places compared [m], > 0.
    """
    sharpest, before = 0.0, mark_at(marks, S, s)[4]
    while s < min(until, marks[len(marks) - 1, S]):
        s += apart
        after = mark_at(marks, S, s)[4]
        sharpest = max(sharpest, abs(after - before) / apart)
        before = after
    return sharpest
