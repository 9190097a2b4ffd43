"""Touching d = d_min: the states in which it happens, and sliding along it.

Seen from the leader the forbidden disc stands still, and a path that touches it is tangent to it:
the relative velocity has no radial part. With b the bearing of the pursuer as seen from the leader,
counter-clockwise from the leader's heading, that fixes the pursuer's heading but for a side s:

    cos(h − b) = α cos b      ⇒      h = b + s arccos(α cos b),    s = +1 counter-clockwise round.

Sliding means to stay there. With ω the leader's turn rate and q = √(1 − α² cos² b),

    b′ = (s q + α sin b)/δ − ω,      h′ = ω + b′ (1 + s α sin b/q)    (h relative to the world),

and |h′| is at most 1. Lengths are in R, times in R/V_P, angles counter-clockwise.
"""

from math import acos, cos, inf, sin, sqrt

from numba import njit

from relguide.kernels.base.records import Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.separation.clearance import leader_at, piece_at

_STEP = 0.07  # bearing step of Simpson's rule: 4°, right to 1e-9
_SLOWLY = 0.1  # or this much of the speed round the leader, where the boundary arc is slow
_STILL = 0.01  # slower round the leader than this, a boundary arc gets nowhere [V_P]
_BANK_SLACK = 1e-9  # ends of what can be ridden are found by bisection, and count as inside


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
def contact_on(
    leader: FloatArray, i: int, t: float, bearing: float, side: float, alpha: float, delta: float
) -> tuple[float, float, float]:
    """The pursuer's pose at a contact at time t, the leader on its piece i.

    Args:
        leader: table of its pieces, as in `clearance`. shape (k, 5)
        i: piece; it may begin later, and is then thought to go back to t.
        t: time [R/V_P].
        bearing: as in `contact_heading` [rad].
        side: as there.
        alpha: V_L/V_P.
        delta: distance [R].
    """
    lx, ly, lh = leader_at(Scene(leader, alpha, 0.0, 0.0), i, t)
    return (
        lx + delta * cos(lh + bearing),
        ly + delta * sin(lh + bearing),
        lh + contact_heading(bearing, side, alpha),
    )


@njit(cache=True, nogil=True)
def contact_at(
    leader: FloatArray, t: float, bearing: float, side: float, alpha: float, delta: float
) -> tuple[float, float, float]:
    """The pursuer's pose at a contact at time t, on whatever piece the leader then is."""
    return contact_on(leader, piece_at(leader, t), t, bearing, side, alpha, delta)


@njit(cache=True, nogil=True)
def boundary_arc_rates(
    bearing: float, side: float, alpha: float, delta: float, turning: float
) -> tuple[float, float]:
    """b′ and h′ of a boundary arc at δ; both infinite where the disc cannot be touched.

    Args:
        bearing: as in `contact_heading` [rad].
        side: as there.
        alpha: V_L/V_P.
        delta: distance of the boundary arc [R].
        turning: the leader's turn rate ω [V_P/R].
    """
    along = alpha * cos(bearing)
    if abs(along) >= 1.0:
        return inf, inf
    across = sqrt(1.0 - along * along)
    round_it = (side * across + alpha * sin(bearing)) / delta - turning
    return round_it, turning + round_it * (1.0 + side * alpha * sin(bearing) / across)


@njit(cache=True, nogil=True)
def boundary_arc_sense(
    bearing: float, side: float, alpha: float, delta: float, turning: float
) -> float:
    """Which way a boundary arc moves the bearing: +1, −1, or 0 where it cannot be flown."""
    round_it, rate = boundary_arc_rates(bearing, side, alpha, delta, turning)
    if abs(rate) > 1.0 + _BANK_SLACK or abs(round_it) * delta < _STILL:
        return 0.0
    return 1.0 if round_it > 0.0 else -1.0


@njit(cache=True, nogil=True)
def _slowness(
    bearing: float, way: float, side: float, alpha: float, delta: float, turning: float
) -> float:
    """Time per bearing; infinite where the boundary arc cannot be flown, or goes the other way."""
    if boundary_arc_sense(bearing, side, alpha, delta, turning) != way:
        return inf
    return way / boundary_arc_rates(bearing, side, alpha, delta, turning)[0]


@njit(cache=True, nogil=True)
def slide_within(
    bearing: float, goal: float, side: float, alpha: float, delta: float, turning: float,
    left: float,
) -> tuple[float, float]:  # fmt: skip
    """Ride from one bearing to another while the leader keeps its turn rate.

    Args:
        bearing: where it begins [rad].
        goal: where it ends; not wrapped, so that it tells the way [rad].
        side: as in `contact_heading`.
        alpha: V_L/V_P.
        delta: distance of the boundary arc [R].
        turning: the leader's turn rate ω [V_P/R].
        left: how long the leader keeps it [R/V_P].

    Returns:
        the bearing reached and the time it took: the goal, or what is reached when the time is up;
        an infinite time where the boundary arc cannot be flown.
    """
    way = 1.0 if goal > bearing else -1.0
    used, low = 0.0, bearing
    slow_low = _slowness(low, way, side, alpha, delta, turning)
    while low != goal:
        if slow_low == inf:
            return low, inf
        step = min(_STEP, _SLOWLY * delta / slow_low)
        high = low + way * step if abs(goal - low) > 1.001 * step else goal
        slow_high = _slowness(high, way, side, alpha, delta, turning)
        slow_middle = _slowness(0.5 * (low + high), way, side, alpha, delta, turning)
        took = abs(high - low) * (slow_low + 4.0 * slow_middle + slow_high) / 6.0
        if took == inf:
            return low, inf
        if used + took > left:
            near, far = 0.0, 1.0
            for _ in range(50):
                share = 0.5 * (near + far)
                end = low + share * (high - low)
                partly = (
                    slow_low
                    + 4.0 * _slowness(0.5 * (low + end), way, side, alpha, delta, turning)
                    + _slowness(end, way, side, alpha, delta, turning)
                )
                if used + share * abs(high - low) * partly / 6.0 < left:
                    near = share
                else:
                    far = share
            return low + far * (high - low), left
        used += took
        low, slow_low = high, slow_high
    return goal, used
