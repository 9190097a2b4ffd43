"""Where paths are to arrive, and whether one may be there just as the slot opens.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.records import Pose, Scene, Velocity, Window
from relguide.kernels.bounds.breach import no_sieve
from relguide.kernels.bounds.cells import EDGE
from relguide.kernels.bounds.ways import fixed
from relguide.kernels.bounds.word_bound import soonest
from relguide.kernels.bounds.word_intervals import Blur

ORIGIN = Pose(0.0, 0.0, 0.0)
"""Where words are looked at from that nothing is left out of."""


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

    Who is there at that moment, on heading 0, has met this point: then, if not sooner. Who meets it
    sooner can follow it, and is there, if that keeps the limit. So there is a path of just that
    length only if there is one that meets the point by then, and the soonest of those is an
    extremal; without the limit, if and only if.
    """
    return Goal(goal.x + (goal.speed - 1.0) * t_release, 1.0, False)


@njit(cache=True, nogil=True)
def is_track(goal: Goal, alpha: float) -> bool:
    """Whether a goal is a point of `track_of`, and not the slot."""
    return bool(goal.speed != alpha)


@njit(cache=True, nogil=True)
def arrives_at_release(x: float, y: float, h: float, alpha: float, t_release: float) -> bool:
    """Whether a path without the limit may be at the slot just as it opens.

    Args:
        x: the pursuer ahead of the slot [R].
        y: and left of it [R].
        h: its heading [rad], in [0, 2π).
        alpha: V_L/V_P.
        t_release: when the slot opens [R/V_P].
    """
    track = track_of(Goal(0.0, alpha, True), t_release)
    nobody = Scene(np.zeros((1, 5)), 0.0, 0.0, 0.0, inf)
    meets = soonest(
        Pose(x - track.x, y, h), Blur(0.0, 0.0, 0.0, 0.0, fixed(), fixed()), Velocity(1.0, 0.0),
        Window(0.0, t_release + EDGE), no_sieve(nobody),
    )  # fmt: skip
    return bool(meets < inf)
