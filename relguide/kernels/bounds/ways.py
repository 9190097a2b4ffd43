"""How the poses of a set change as what fixes one of them does, to first order.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf
from typing import NamedTuple

from numba import njit


class Way(NamedTuple):
    """How a pose changes from the middle of a set to its edge."""

    x: float
    """[R]."""
    y: float
    """[R]."""
    h: float
    """[rad]."""


class Ways(NamedTuple):
    """How the poses of a set change with the bearing of a contact, and with its time."""

    bearing: Way
    time: Way
    bends: float
    """How far besides the centres of the circles beside a pose may lie; infinite if nothing is
    known [R]."""
    twists: float
    """And how much besides its heading may differ [rad]."""


@njit(cache=True, nogil=True)
def no_ways() -> Ways:
    """Nothing is known."""
    return Ways(Way(0.0, 0.0, 0.0), Way(0.0, 0.0, 0.0), inf, 0.0)


@njit(cache=True, nogil=True)
def fixed() -> Ways:
    """Of a pose that is known."""
    return Ways(Way(0.0, 0.0, 0.0), Way(0.0, 0.0, 0.0), 0.0, 0.0)


@njit(cache=True, nogil=True)
def ways_from(ways: Ways, s: float, c: float) -> Ways:
    """The same in a frame turned by an angle with this sine and cosine."""
    return Ways(_turned(ways.bearing, s, c), _turned(ways.time, s, c), ways.bends, ways.twists)


@njit(cache=True, nogil=True)
def drifting(ways: Ways, x: float, y: float) -> Ways:
    """The same where those at the last time also lie so far away."""
    t = ways.time
    return Ways(ways.bearing, Way(t.x + x, t.y + y, t.h), ways.bends, ways.twists)


@njit(cache=True, nogil=True)
def ways_after_turn(
    ways: Ways, turned: tuple[float, float], on: tuple[float, float], sign: float, differs: float
) -> Ways:
    """The same after a turn.

    Args:
        ways: before it.
        turned: sine and cosine of the middle's heading before it.
        on: and after it.
        sign: +1 of a left turn.
        differs: how much the heading may differ [rad].
    """
    # the centre of the circle stays, and so does the centre of the other one beside it nearly
    x, y = sign * (on[1] - turned[1]), sign * (on[0] - turned[0])
    b, t = ways.bearing, ways.time
    return Ways(
        Way(b.x + b.h * x, b.y + b.h * y, b.h), Way(t.x + t.h * x, t.y + t.h * y, t.h),
        ways.bends + 2.0 * ways.twists + differs * differs, ways.twists,
    )  # fmt: skip


@njit(cache=True, nogil=True)
def _turned(way: Way, s: float, c: float) -> Way:
    return Way(way.x * c + way.y * s, way.y * c - way.x * s, way.h)
