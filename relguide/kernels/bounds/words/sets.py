"""Sets of poses, known to within a blur, and the goals that paths from them meet.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf
from typing import NamedTuple

from numba import njit

EDGE = 1e-9
"""What rounding may do to a time or a heading; and a leader within this of V_P counts as faster."""


class Change(NamedTuple):
    """How a pose changes from the middle of a set to its edge."""

    x: float
    """[R]."""
    y: float
    """[R]."""
    h: float
    """[rad]."""


class Sensitivity(NamedTuple):
    """How the poses of a set change with the bearing of a contact, and with its time."""

    bearing: Change
    time: Change
    bends: float
    """How far besides the centres of the circles beside a pose may lie; infinite if nothing is
    known [R]."""
    twists: float
    """And how much besides its heading may differ [rad]."""


@njit(cache=True, nogil=True)
def unknown_sensitivity() -> Sensitivity:
    """Nothing is known."""
    return Sensitivity(Change(0.0, 0.0, 0.0), Change(0.0, 0.0, 0.0), inf, 0.0)


@njit(cache=True, nogil=True)
def fixed() -> Sensitivity:
    """Of a pose that is known."""
    return Sensitivity(Change(0.0, 0.0, 0.0), Change(0.0, 0.0, 0.0), 0.0, 0.0)


@njit(cache=True, nogil=True)
def sensitivity_from(sensitivity: Sensitivity, s: float, c: float) -> Sensitivity:
    """The same in a frame turned by an angle with this sine and cosine."""
    return Sensitivity(
        _turned(sensitivity.bearing, s, c),
        _turned(sensitivity.time, s, c),
        sensitivity.bends,
        sensitivity.twists,
    )


@njit(cache=True, nogil=True)
def drifting(sensitivity: Sensitivity, x: float, y: float) -> Sensitivity:
    """The same where those at the last time also lie so far away."""
    t = sensitivity.time
    return Sensitivity(
        sensitivity.bearing, Change(t.x + x, t.y + y, t.h), sensitivity.bends, sensitivity.twists
    )


@njit(cache=True, nogil=True)
def sensitivity_after_turn(
    sensitivity: Sensitivity,
    turned: tuple[float, float],
    on: tuple[float, float],
    sign: float,
    differs: float,
) -> Sensitivity:
    """The same after a turn.

    Args:
        sensitivity: before it.
        turned: sine and cosine of the middle's heading before it.
        on: and after it.
        sign: +1 of a left turn.
        differs: how much the heading may differ [rad].
    """
    # the centre of the circle stays, and so does the centre of the other one beside it nearly
    x, y = sign * (on[1] - turned[1]), sign * (on[0] - turned[0])
    b, t = sensitivity.bearing, sensitivity.time
    return Sensitivity(
        Change(b.x + b.h * x, b.y + b.h * y, b.h), Change(t.x + t.h * x, t.y + t.h * y, t.h),
        sensitivity.bends + 2.0 * sensitivity.twists + differs * differs, sensitivity.twists,
    )  # fmt: skip


@njit(cache=True, nogil=True)
def _turned(way: Change, s: float, c: float) -> Change:
    return Change(way.x * c + way.y * s, way.y * c - way.x * s, way.h)


class Blur(NamedTuple):
    """How far the poses of a set may lie from its middle."""

    left: float
    """The centre of the left circle [R]."""
    right: float
    """The centre of the right circle [R]."""
    heading: float
    """[rad]."""
    end: float
    """How much of that is because the heading on which the target is met may differ [rad]."""
    sensitivity: Sensitivity
    """How the poses differ from their middle, to first order …"""
    met: Sensitivity
    """… and how the target does, as it is met."""


class Goal(NamedTuple):
    """Where a path is to arrive, on heading 0."""

    x: float
    """At t = 0, on the x axis [R]."""
    speed: float
    """Along it [V_P]: α for the slot, 1 for a point of its track (see `track_of`)."""
    holds: bool
    """Whether a path may arrive just as the slot opens, and then need not be an extremal."""


@njit(cache=True, nogil=True)
def track_of(goal: Goal, t_release: float) -> Goal:
    """A point that moves along the slot's track at V_P, and is where the slot opens as it opens.

    A path that is there at that moment, on heading 0, has met this point: then, if not sooner. A
    path that meets it sooner can follow it, and is there, if that keeps the limit. So a path of
    just that length exists only if some path meets the point by then, and the soonest of those is
    an extremal. Without the limit the converse holds too.
    """
    return Goal(goal.x + (goal.speed - 1.0) * t_release, 1.0, False)


@njit(cache=True, nogil=True)
def is_track(goal: Goal, alpha: float) -> bool:
    """Whether a goal is a point of `track_of`, and not the slot."""
    return bool(goal.speed != alpha)
