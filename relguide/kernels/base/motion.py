"""Position and heading after an arc or a straight at constant speed: eqs. (1)–(3), world frame."""

from math import cos, sin
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.roots import FloatArray


class Motion(NamedTuple):
    """How an aircraft moves: arcs and straights at one speed, then straight on for ever."""

    x: float
    """At t = 0, east [m]."""
    y: float
    """The same, north [m]."""
    heading: float
    """ψ there, clockwise from north [rad]."""
    tas: float
    """V [m/s]."""
    pieces: FloatArray
    """Duration [s] and turn rate [rad/s, right positive] of each in turn. shape (n, 2)"""


@njit(cache=True, nogil=True)
def advance(
    x: float, y: float, heading: float, speed: float, rate: float, t: float
) -> tuple[float, float, float]:
    """Fly for t at constant speed and constant turn rate.

        ψ' = r,  x' = V sin ψ,  y' = V cos ψ            integrated by the chord of the arc

    Args:
        x: east [m].
        y: north [m].
        heading: ψ clockwise from north [rad].
        speed: V [m/s].
        rate: r [rad/s], positive to the right; 0 is a straight.
        t: how long [s].

    Returns:
        x, y [m] and ψ [rad, not wrapped] at the end.
    """
    half = 0.5 * rate * t
    # chord = V t sinc(half), flown on the mean heading; the series is exact to 1e-16 below 1e-3
    if abs(half) < 1e-3:
        sinc = 1.0 - half * half / 6.0 + half**4 / 120.0
    else:
        sinc = sin(half) / half
    chord = speed * t * sinc
    return x + chord * sin(heading + half), y + chord * cos(heading + half), heading + 2.0 * half


@njit(cache=True, nogil=True)
def with_pieces(motion: Motion, pieces: FloatArray) -> Motion:
    """The same start, and other pieces."""
    return Motion(motion.x, motion.y, motion.heading, motion.tas, pieces)


@njit(cache=True, nogil=True)
def motion_along(path: FloatArray) -> Motion:
    """A motion from one array: a record handed over from Python costs a microsecond.

    Args:
        path: x, y, heading and V, as in `Motion`; then length [m] and curvature [rad/m, right
            positive] of each piece in turn. shape (4 + 2·n,)
    """
    tas = path[3]
    pieces = np.empty((len(path) // 2 - 2, 2))
    for i in range(len(pieces)):
        pieces[i, 0], pieces[i, 1] = path[4 + 2 * i] / tas, path[5 + 2 * i] * tas
    return Motion(path[0], path[1], path[2], tas, pieces)
