"""Touching d = d_min: the states in which it happens, and sliding along it.

Seen from the leader the forbidden disc stands still, and a path that touches it is tangent to it:
the relative velocity has no radial part. With b the bearing of the pursuer as seen from the leader,
counter-clockwise from the leader's heading, that fixes the pursuer's heading but for a side s:

    cos(h − b) = α cos b      ⇒      h = b + s arccos(α cos b),    s = +1 counter-clockwise round.

Sliding means to stay there. With ω the leader's turn rate and q = √(1 − α² cos² b),

    b′ = (s q + α sin b)/δ − ω,      h′ = ω + b′ (1 + s α sin b/q)    (h relative to the world),

and |h′| is at most 1. Lengths are in R, times in R/V_P, angles counter-clockwise.
"""

from math import acos, cos, inf, sqrt

from numba import njit

from relguide.kernels.base.records import Contact, Disc, Pose, Scene
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.separation.clearance import leader_at, piece_at

GRAZE = 3e-7
"""The contact is flown this far outside d_min [R], so that rounding cannot break it."""
_STEP = 0.03  # bearing step of Simpson's rule: 1.7°, right to 1e-7 R/V_P in all
_SLOWLY = 0.04  # or this much of the speed round the leader, where the boundary arc is slow
_STILL = 0.01  # slower round the leader than this, a boundary arc gets nowhere [V_P]
_BANK_SLACK = 1e-9  # the ends of a boundary arc are found by bisection, and count as inside


@njit(cache=True, nogil=True)
def contact_distance(d_min: float) -> float:
    """How far from the leader contacts and boundary arcs are flown [R]."""
    return d_min + GRAZE


@njit(cache=True, nogil=True)
def disc_on(scene: Scene, i: int, side: float) -> Disc:
    """The disc round the leader on its piece i, at the distance of contacts."""
    return Disc(scene.alpha, contact_distance(scene.d_min), side, scene.leader[i, 4])


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
def contact_on(scene: Scene, contact: Contact, t: float) -> Pose:
    """The pursuer's pose at a contact at time t.

    The leader's piece may begin later: the leader is then thought to have come along it.
    """
    lx, ly, lh = leader_at(scene, contact.piece, t)
    distance = contact_distance(scene.d_min)
    s, c = sine_and_cosine(lh + contact.bearing)
    heading = contact_heading(contact.bearing, contact.side, scene.alpha)
    return Pose(lx + distance * c, ly + distance * s, lh + heading)


@njit(cache=True, nogil=True)
def contact_at(scene: Scene, t: float, bearing: float, side: float) -> Pose:
    """The pursuer's pose at a contact at time t, on whatever piece the leader then is."""
    return contact_on(scene, Contact(piece_at(scene.leader, t), bearing, side), t)


@njit(cache=True, nogil=True)
def to_frame_of(pose: Pose, origin: Pose) -> Pose:
    """A pose in the frame of another; its heading not wrapped."""
    s, c = sine_and_cosine(origin.h)
    dx, dy = pose.x - origin.x, pose.y - origin.y
    return Pose(dx * c + dy * s, dy * c - dx * s, pose.h - origin.h)


@njit(cache=True, nogil=True)
def boundary_arc_rates(bearing: float, disc: Disc) -> tuple[float, float]:
    """b′ and h′ of a boundary arc; both infinite where the disc cannot be touched.

    Args:
        bearing: as in `contact_heading` [rad].
        disc: with the distance δ of the boundary arc, and the leader's turn rate ω.
    """
    s, c = sine_and_cosine(bearing)
    along = disc.alpha * c
    if abs(along) >= 1.0:
        return inf, inf
    across = sqrt(1.0 - along * along)
    ahead = disc.alpha * s
    round_it = (disc.side * across + ahead) / disc.distance - disc.turning
    return round_it, disc.turning + round_it * (1.0 + disc.side * ahead / across)


@njit(cache=True, nogil=True)
def boundary_arc_sense(bearing: float, disc: Disc) -> float:
    """Which way a boundary arc moves the bearing: +1, −1, or 0 where it cannot be flown."""
    round_it, rate = boundary_arc_rates(bearing, disc)
    if abs(rate) > 1.0 + _BANK_SLACK or abs(round_it) * disc.distance < _STILL:
        return 0.0
    return 1.0 if round_it > 0.0 else -1.0


@njit(cache=True, nogil=True)
def slides_back(scene: Scene, contact: Contact) -> bool:
    """Whether a boundary arc gets behind at a contact, since the leader turns faster than that."""
    if scene.leader[contact.piece, 4] == 0.0:
        return False
    disc = disc_on(scene, contact.piece, contact.side)
    return contact.side * boundary_arc_sense(contact.bearing, disc) < 0.0


@njit(cache=True, nogil=True)
def _slowness(bearing: float, sense: float, disc: Disc) -> float:
    """Time per bearing; infinite where the boundary arc cannot be flown, or goes the other way."""
    if boundary_arc_sense(bearing, disc) != sense:
        return inf
    return sense / boundary_arc_rates(bearing, disc)[0]


@njit(cache=True, nogil=True)
def slide_within(bearing: float, goal: float, disc: Disc, left: float) -> tuple[float, float]:
    """Slide from one bearing to another while the leader keeps its turn rate.

    Args:
        bearing: where it begins [rad].
        goal: where it ends; not wrapped, so that it says which way round [rad].
        disc: that the boundary arc goes round.
        left: how long the leader keeps its turn rate [R/V_P].

    Returns:
        the bearing reached and the time it took: the goal, or what is reached when the time is up;
        an infinite time where the boundary arc cannot be flown.
    """
    sense = 1.0 if goal > bearing else -1.0
    used, low = 0.0, bearing
    slow_low = _slowness(low, sense, disc)
    while low != goal:
        if slow_low == inf:
            return low, inf
        step = min(_STEP, _SLOWLY * disc.distance / slow_low)
        high = low + sense * step if abs(goal - low) > 1.001 * step else goal
        slow_high = _slowness(high, sense, disc)
        slow_middle = _slowness(0.5 * (low + high), sense, disc)
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
                    + 4.0 * _slowness(0.5 * (low + end), sense, disc)
                    + _slowness(end, sense, disc)
                )
                if used + share * abs(high - low) * partly / 6.0 < left:
                    near = share
                else:
                    far = share
            return low + far * (high - low), left
        used += took
        low, slow_low = high, slow_high
    return goal, used
