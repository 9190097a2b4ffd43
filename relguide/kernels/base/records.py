"""Records that kernels pass on in place of loose floats. As NamedTuples they cost nothing.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from typing import NamedTuple

from relguide.kernels.base.roots import FloatArray


class Pose(NamedTuple):
    """Where an aircraft is, and where it points."""

    x: float
    """[R]."""
    y: float
    """[R]."""
    h: float
    """Heading [rad]."""


class Scene(NamedTuple):
    """What a path has to reckon with: the leader, the limit, and when the slot opens."""

    leader: FloatArray
    """Table of its pieces, a row each: start time, x, y, heading, turn rate. shape (k, 5)"""
    alpha: float
    """V_L/V_P."""
    d_min: float
    """Least allowed separation [R]."""
    t_release: float
    """Release time: when the slot opens [R/V_P]."""


class Contact(NamedTuple):
    """Where a path touches d = d_min: with the time it fixes the pursuer's pose."""

    piece: int
    """The leader's, by number."""
    bearing: float
    """Of the pursuer from the leader, counter-clockwise from the leader's heading [rad]."""
    side: float
    """+1 passes counter-clockwise round the leader, −1 clockwise."""
