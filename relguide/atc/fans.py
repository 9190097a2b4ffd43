"""Where an aircraft may be that has not said what it intends: anywhere in a fan.

Its heading is taken to stay within ±α of what it is now, and its speed v as it is; it may turn at
any time, and as often as it likes. Places that it may reach in t are means of such velocities times
t, and so exactly the convex hull of an arc, t S with

    S = conv {v (cos β, sin β) : |β| ≤ α}.

The signed distance from q to t S is sup over unit n of n·q − t h_S(n): convex in q and t together.
So while q moves straight, the margin to a bound that grows with t is convex in t, and its least is
bracketed by a golden section.
"""

from math import sqrt
from typing import NamedTuple

import numpy as np

from relguide.atc.pieces import Pieces
from relguide.kernels.base.roots import FloatArray

_GOLDEN = 0.5 * (sqrt(5.0) - 1.0)
_STEPS = 48  # 30 s at 600 m/s down to 2 µm


class Fans(NamedTuple):
    """Fans of some aircraft: x, y where they were seen, when, velocities. shape (n,) each."""

    x: FloatArray
    y: FloatArray
    since: FloatArray
    east: FloatArray
    north: FloatArray
    speed: FloatArray
    half: FloatArray
    """α."""

    def taken(self, of: np.ndarray) -> "Fans":
        """Some of them, each as often as it is named."""
        return Fans(*(column[of] for column in self))

    def distance(self, x: FloatArray, y: FloatArray, t: FloatArray) -> FloatArray:
        """From places to where the aircraft may be at times [m]; negative inside."""
        since = np.maximum(t - self.since, 0.0)
        reach = self.speed * since
        speed = np.maximum(self.speed, 1e-9)
        dx, dy = x - self.x, y - self.y
        ahead = (dx * self.east + dy * self.north) / speed
        aside = np.abs(dx * self.north - dy * self.east) / speed
        s, c = np.sin(self.half), np.cos(self.half)
        corner = np.hypot(ahead - reach * c, aside - reach * s)
        before = reach * c - ahead
        beyond = np.hypot(dx, dy) - reach
        ahead_of_chord = np.where(before > 0.0, before, np.maximum(beyond, before))
        beside_chord = np.where(aside * c <= ahead * s, beyond, corner)
        return np.where(aside <= reach * s, ahead_of_chord, beside_chord)


def least_margin(
    pieces: Pieces, fans: Fans, bound: FloatArray, growth: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Least of the distance to a fan, less a growing bound, in each piece.

    Args:
        pieces: of one's own flight, m of them.
        fans: one for each piece.
        bound: at the begin of each piece [m]. shape (m,)
        growth: how fast it grows [m/s]. shape (m,)

    Returns:
        a lower bound on the margin [m], and when it is least, from the begin of the piece [s].
    """

    def margin(since: FloatArray) -> FloatArray:
        x = pieces.own_x + pieces.own_east * since
        y = pieces.own_y + pieces.own_north * since
        return fans.distance(x, y, pieces.begin + since) - bound - growth * since

    low, high = np.zeros(len(bound)), pieces.length.copy()
    a, b = high - _GOLDEN * high, _GOLDEN * high
    at_a, at_b = margin(a), margin(b)
    for _ in range(_STEPS):
        left = at_a < at_b
        low, high = np.where(left, low, a), np.where(left, b, high)
        a_then, b_then = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
        a, b = np.where(left, a_then, b), np.where(left, a, b_then)
        fresh = margin(np.where(left, a, b))
        at_a, at_b = np.where(left, fresh, at_b), np.where(left, at_a, fresh)
    at = 0.5 * (low + high)
    fastest = np.hypot(pieces.own_east, pieces.own_north) + fans.speed + growth
    found = np.minimum(np.minimum(margin(at), margin(np.zeros(len(at)))), margin(pieces.length))
    return found - fastest * (high - low), at
