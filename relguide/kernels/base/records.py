"""Records that kernels pass on in place of loose floats. As NamedTuples they cost nothing.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.sine import sine_and_cosine


class Pose(NamedTuple):
    """Where an aircraft is, and where it points."""

    x: float
    """Ahead of the slot at t = 0, or of another target [R]."""
    y: float
    """Left of it [R]."""
    h: float
    """Heading, from the heading on which the target is met [rad]."""


class Start(NamedTuple):
    """A pose with sine and cosine of its heading, which a map needs only once."""

    x: float
    """As in `Pose` [R]."""
    y: float
    """[R]."""
    h: float
    """[rad], in [0, 2π)."""
    sin_h: float
    """sin h."""
    cos_h: float
    """cos h."""


class Velocity(NamedTuple):
    """How a target moves: the slot, or a contact."""

    ahead: float
    """Along the heading on which it is met [V_P]."""
    left: float
    """To the left of it [V_P]; 0 for the slot."""


class Window(NamedTuple):
    """When a path may arrive."""

    earliest: float
    """[R/V_P]."""
    beat: float
    """Before this time, which is to be beaten [R/V_P]."""


class Scene(NamedTuple):
    """What a path has to reckon with: the leader, the limit, and when the slot opens."""

    leader: FloatArray
    """Table of its pieces, a row each: start time, x, y, heading, turn rate; the last row is its
    endless final leg. shape (k, 5)"""
    alpha: float
    """V_L/V_P."""
    d_min: float
    """Least allowed separation [R]."""
    t_release: float
    """Release time: when the slot opens [R/V_P]."""
    until: float = inf
    """When a search must have ended, by `clock.now` [s]: it then gives the best it has found."""


class Contact(NamedTuple):
    """Where a path touches d = d_min: with the time it fixes the pursuer's pose."""

    piece: int
    """The leader's, by number."""
    bearing: float
    """Of the pursuer from the leader, counter-clockwise from the leader's heading [rad]."""
    side: float
    """+1 passes counter-clockwise round the leader, −1 clockwise."""


class Disc(NamedTuple):
    """What a path must not enter, seen from the leader, and how it is passed."""

    alpha: float
    """V_L/V_P."""
    distance: float
    """Of contacts and boundary arcs from the leader, δ [R]."""
    side: float
    """As in `Contact`."""
    turning: float
    """The leader's turn rate ω [V_P/R]."""


class Bracket(NamedTuple):
    """Two arguments with a root of a function between them, and its values there."""

    low: float
    high: float
    at_low: float
    at_high: float


@njit(cache=True, nogil=True)
def start_at(pose: Pose) -> Start:
    """A pose as a start."""
    return Start(pose.x, pose.y, pose.h, *sine_and_cosine(pose.h))


@njit(cache=True, nogil=True)
def straight_scene(alpha: float, slot: float, d_min: float) -> Scene:
    """A leader that keeps straight, and a slot that is open from the start.

    Args:
        alpha: V_L/V_P.
        slot: D, how far the leader is ahead of the slot [R].
        d_min: least allowed separation [R].
    """
    leader = np.zeros((1, 5))
    leader[0, 1] = slot
    return Scene(leader, alpha, d_min, 0.0, inf)


@njit(cache=True, nogil=True)
def with_limit(scene: Scene, d_min: float) -> Scene:
    """The same scene with another limit [R]."""
    return Scene(scene.leader, scene.alpha, d_min, scene.t_release, scene.until)


@njit(cache=True, nogil=True)
def with_time(scene: Scene, until: float) -> Scene:
    """The same scene with another time at which a search must have ended."""
    return Scene(scene.leader, scene.alpha, scene.d_min, scene.t_release, until)


@njit(cache=True, nogil=True)
def with_release(scene: Scene, t_release: float) -> Scene:
    """The same scene with a slot that opens at another time [R/V_P]."""
    return Scene(scene.leader, scene.alpha, scene.d_min, t_release, scene.until)
