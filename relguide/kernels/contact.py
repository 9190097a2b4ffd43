"""Touching d = d_min: the states in which it happens, and riding along it.

Seen from the leader the forbidden disc stands still, and a path that touches it is tangent to it:
the relative velocity has no radial part. With b the bearing of the pursuer as seen from the leader,
counter-clockwise from the leader's heading, that fixes the pursuer's heading but for a side s:

    cos(h − b) = α cos b      ⇒      h = b + s arccos(α cos b),    s = +1 counter-clockwise round.

Riding means to stay there: δ b′ = s √(1 − α² cos² b) + α sin b, which asks for a turn to side s at
the rate h′ = δ b′² / √(1 − α² cos² b) (plus what the leader itself turns), at most 1 in R/V_P.
Lengths are in R, times in R/V_P, angles counter-clockwise.
"""

from math import acos, cos, sin, sqrt

from numba import njit


@njit(cache=True, nogil=True)
def contact_exists(bearing: float, alpha: float) -> bool:
    """Whether the disc can be touched at this bearing: everywhere, unless the leader is faster."""
    return bool(abs(alpha * cos(bearing)) <= 1.0)


@njit(cache=True, nogil=True)
def contact_heading(bearing: float, side: float, alpha: float) -> float:
    """Heading of a pursuer that touches the disc, relative to the leader's [rad].

    Args:
        bearing: of the pursuer from the leader, relative to the leader's heading [rad].
        side: +1 passes counter-clockwise round the leader, −1 clockwise.
        alpha: V_L/V_P.
    """
    return bearing + side * acos(alpha * cos(bearing))


@njit(cache=True, nogil=True)
def ride_rate(bearing: float, side: float, alpha: float, delta: float) -> float:
    """b′ when riding at δ round a leader that keeps straight; has the sign of `side`. α < 1."""
    along = alpha * cos(bearing)
    return (side * sqrt(1.0 - along * along) + alpha * sin(bearing)) / delta


@njit(cache=True, nogil=True)
def ride_turn(bearing: float, side: float, alpha: float, delta: float) -> float:
    """|h′| that riding asks for; above 1 it cannot be flown."""
    along = alpha * cos(bearing)
    rate = ride_rate(bearing, side, alpha, delta)
    return delta * rate * rate / sqrt(1.0 - along * along)


@njit(cache=True, nogil=True)
def ride_time(low: float, high: float, side: float, alpha: float, delta: float) -> float:
    """Time to ride from one bearing to another, in the direction of `side` (Simpson's rule)."""
    middle = 0.5 * (low + high)
    slowness = (
        1.0 / ride_rate(low, side, alpha, delta)
        + 4.0 / ride_rate(middle, side, alpha, delta)
        + 1.0 / ride_rate(high, side, alpha, delta)
    )
    return (high - low) * slowness / 6.0
