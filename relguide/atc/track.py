"""Tracks: where an aircraft is expected to be, over the ground, as straight lines between knots."""

from dataclasses import dataclass
from math import hypot

import numpy as np

from relguide.kernels.base.roots import FloatArray
from relguide.units import Metre, MetrePerSecond, Second


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Track:
    """Where an aircraft is expected to be. Between two knots it flies straight, at one speed.

    Times are of its sky: UTC [s] in the one on the earth, flight time in that of a flight. Places
    are over the ground in the plane of that sky. Past the last knot it goes on straight.
    """

    t: FloatArray
    """Times of the knots, ascending [s]. shape (n,), n >= 2"""
    x: FloatArray
    """East [m]. shape (n,)"""
    y: FloatArray
    """North [m]. shape (n,)"""
    low: FloatArray
    """It is at least this high, pressure altitude [m]; -inf where no height is known. shape (n,)"""
    high: FloatArray
    """… and at most this; inf where no height is known. shape (n,)"""
    error: Metre
    """What it flies strays from these lines by no more than this, at its time [m]: arcs, braking.
    """

    @property
    def begin(self) -> Second:
        """Time of the first knot [s]."""
        return float(self.t[0])

    @property
    def end(self) -> Second:
        """Time of the last knot [s]."""
        return float(self.t[-1])

    @property
    def fastest(self) -> MetrePerSecond:
        """Its largest ground speed [m/s]."""
        apart = np.hypot(np.diff(self.x), np.diff(self.y))
        return float(np.max(apart / np.diff(self.t)))

    def place(self, t: Second) -> tuple[Metre, Metre]:
        """Where it is at a time, before the first knot and past the last one straight on [m]."""
        k = min(max(int(np.searchsorted(self.t, t)) - 1, 0), len(self.t) - 2)
        share = (t - self.t[k]) / (self.t[k + 1] - self.t[k])
        x = self.x[k] + share * (self.x[k + 1] - self.x[k])
        y = self.y[k] + share * (self.y[k + 1] - self.y[k])
        return float(x), float(y)

    def velocity(self, t: Second) -> tuple[MetrePerSecond, MetrePerSecond]:
        """Its ground velocity at a time, east and north [m/s]."""
        k = min(max(int(np.searchsorted(self.t, t, side="right")) - 1, 0), len(self.t) - 2)
        time = self.t[k + 1] - self.t[k]
        return float((self.x[k + 1] - self.x[k]) / time), float((self.y[k + 1] - self.y[k]) / time)

    def distance(self, other: "Track", t: Second) -> Metre:
        """How far two tracks are apart at a time [m]."""
        (x, y), (other_x, other_y) = self.place(t), other.place(t)
        return hypot(x - other_x, y - other_y)
