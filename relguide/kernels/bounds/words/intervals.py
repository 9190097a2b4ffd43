"""What the unknown of a word leaves possible, for every pose of a set at once, in an interval.

LSL. |a l + e| = l has a solution for some e within r of its middle iff |a l + e| ≤ l + r: the least
such l is a root of a quadratic.

LSR, by the course β of the straight. With u = (cos β, sin β), q = u − a and v = a A − c₁ − (0, 1)
− 2 (sin β, −cos β) it asks l q = v, and dv/dβ = −2 q. So over β₀ ± w

    (l + 2 (β − β₀)) q₀ = v₀ + E,    |E| ≤ r + w² + l |u − u₀|,

which rules the interval out if v₀ is too far beside q₀, and else bounds τ = A + l, whose first
derivative in β drops out.

LRL, by its middle arc m. | |d| − 4 sin(m/2) | ≤ r + 2 (1 + α) w over m₀ ± w, or it is ruled out.

Where in the interval a root of either can be follows as in Newton's method, with what is neglected
bounded: by the slope at m₀, and by −κ l (β − β₀) = v₀ × q₀/|q₀| + E with κ = (1 − a u₀)/|q₀| and
|E| ≤ r + w² + l w²/2. That part of it is looked at next.

Words as in `csc` and `ccc`, in the frame in which the target is met at the origin on the heading 0;
r is how far the unknown pose may displace what is compared. What cannot be decided is let through.
Lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import asin, atan2, inf, pi, sqrt
from typing import NamedTuple

from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap, wrap_signed
from relguide.kernels.base.norm import norm
from relguide.kernels.base.records import Pose, Velocity, Window
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.bounds.words.breach import ROUNDING
from relguide.kernels.bounds.words.sets import Blur

MOST_TURNS = 4
"""Of `same_turns`."""
_EQUAL = 1e-12  # a target is as fast as V_P if 1 − α² is no more than this [V_P²]
_RECEDES = 1e-6  # and it surely recedes if it does so this fast, times the distance [V_P R]
_FASTER = 1.0 + _EQUAL  # a target that may be met twice, or late [V_P]
_FINE = 0.5  # what an interval's width may still count for, as part of what the set's does
_SMALL = 0.03  # below this few terms of a series are exact [rad]
_STEPS = 100  # toward where it may be met: fewer say less
FINEST = 1e-12
"""An interval this short is not halved again [rad]."""


class Side(NamedTuple):
    """What is asked of the words that begin with a left turn, or in the mirror with a right one."""

    h: float
    """Heading of the middle of the set, in [0, 2π) [rad]."""
    cx: float
    """Centre of the circle of the first turn [R]."""
    cy: float
    """[R]."""
    radius: float
    """How far the unknown pose may displace what is compared, r [R]."""
    heading: float
    """How much the heading may differ [rad]."""
    end: float
    """As in `Blur`."""
    target: Velocity
    """Of the target."""
    alpha: float
    """Its speed [V_P]."""
    mirror: float
    """+1, or −1 in the mirror."""
    hand: int
    """Which words: 0 left, or 1 right in the mirror."""


class Interval(NamedTuple):
    """What an interval of the unknown angle leaves possible."""

    time: float
    """No path of it arrives sooner [R/V_P]; infinite if none can arrive in time."""
    latest: float
    """Nor later."""
    fine: bool
    """Whether halving it would say no more; if not, nothing else is said but where in it there may
    be a path: within `middle_blur` of `middle` beyond its middle."""
    turned: float
    """Both outer turns together, at its middle [rad]."""
    first: float
    """First turn of the path read backward [rad]."""
    astray: float
    """How much that may differ [rad]."""
    middle: float
    """Amount of the middle piece [rad or R]."""
    middle_blur: float
    """How much that may differ."""
    shortest: float
    """No less than this is it."""


NOTHING = Interval(inf, inf, True, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
"""No word is possible."""


@njit(cache=True, nogil=True)
def side_of(pose: Pose, blur: Blur, target: Velocity, hand: int) -> Side:
    """The words that begin with a left turn, or with hand = 1 a right one, in the mirror."""
    m = 1.0 - 2.0 * hand
    h = wrap(m * pose.h)
    alpha = norm(target.ahead, target.left)
    circle = (blur.left if hand == 0 else blur.right) + ROUNDING
    heading = blur.heading + ROUNDING
    s, c = sine_and_cosine(h)
    return Side(
        h, pose.x - s, m * pose.y + c, circle + alpha * heading, heading, blur.end,
        Velocity(target.ahead, m * target.left), alpha, m, hand,
    )  # fmt: skip


@njit(cache=True, nogil=True)
def intercept_span(ex: float, ey: float, target: Velocity, blur: float) -> tuple[float, float]:
    """Least and greatest l ≥ 0 with |a l + e'| = l for some e' within blur of e.

    The least is infinite if there is none, the greatest if it is not bounded (α ≥ 1).
    """
    ax, ay = target
    one_less = 1.0 - ax * ax - ay * ay
    closing = ax * ex + ay * ey
    beyond = ex * ex + ey * ey - blur * blur
    least, greatest = 0.0, inf
    if beyond > 0.0:
        opening = blur - closing
        square = opening * opening + one_less * beyond
        if square < -1e-12 * opening * opening:
            return inf, inf
        root = sqrt(max(square, 0.0))
        if opening > 0.0:
            least = beyond / (opening + root)
        elif one_less > 0.0:
            least = (root - opening) / one_less
        else:
            return inf, inf
    opening = blur + closing
    square = opening * opening + one_less * beyond
    if one_less > 1e-9:
        greatest = max((opening + sqrt(max(square, 0.0))) / one_less, blur)
    elif one_less > -_EQUAL and opening < -_RECEDES and beyond > 0.0:
        greatest = max(beyond / (sqrt(max(square, 0.0)) - opening), blur)
    return least, greatest


@njit(cache=True, nogil=True)
def _narrow(
    ex: float, ey: float, target: Velocity, blur: float, least: float, greatest: float
) -> tuple[float, float]:
    """The part of [least, greatest] outside which |a l + e'| ≠ l, by steps too short to miss it.

    For targets so fast that `intercept_span` says little, or that can be met twice.
    """
    if not greatest < inf:
        return least, greatest
    ax, ay = target
    steepest = 1.0 + norm(ax, ay)
    for _ in range(_STEPS):
        gap = abs(norm(ax * least + ex, ay * least + ey) - least) - blur
        if gap <= 0.0 or least > greatest:
            break
        least += gap / steepest
    for _ in range(_STEPS):
        gap = abs(norm(ax * greatest + ex, ay * greatest + ey) - greatest) - blur
        if gap <= 0.0 or least > greatest:
            break
        greatest -= gap / steepest
    return least, greatest


@njit(cache=True, nogil=True)
def same_turns(k: int, side: Side, window: Window) -> Interval:
    """LSL whose turns are `side.h` less than k full ones; k is less than `MOST_TURNS`."""
    ax, ay = side.target
    turned = TWO_PI * k - side.h
    if turned + side.heading < 0.0 or turned - side.heading > 2.0 * TWO_PI:
        return NOTHING
    ex, ey = ax * turned - side.cx, ay * turned + 1.0 - side.cy
    least, greatest = intercept_span(ex, ey, side.target, side.radius)
    soonest_turned = max(turned - side.heading, 0.0)
    least = max(least, window.earliest - turned - side.heading)
    greatest = min(greatest, window.beat - soonest_turned)
    if side.alpha > _FASTER:
        least, greatest = _narrow(ex, ey, side.target, side.radius, least, greatest)
    time = soonest_turned + least
    if greatest < least or time >= window.beat:
        return NOTHING
    middle, middle_blur = least, inf
    astray = pi
    course = 0.0
    if greatest < inf:
        middle, middle_blur = 0.5 * (least + greatest), 0.5 * (greatest - least)
        to_x, to_y = ax * middle + ex, ay * middle + ey
        slack = side.radius + side.alpha * middle_blur
        if slack < norm(to_x, to_y):
            astray = asin(slack / norm(to_x, to_y))
            course = atan2(to_y, to_x)
    latest = turned + side.heading + greatest
    return Interval(time, latest, True, turned, -course, astray, middle, middle_blur, least)


@njit(cache=True, nogil=True)
def span_of(three_turns: bool, around: float, side: Side, window: Window) -> tuple[float, float]:
    """Least and greatest course of LSR's straight, or middle arc of LRL, that come into question.

    There both outer turns are between none and a full one, and the path is in time. `around` is as
    in `three_turns_within`.
    """
    past = 0.0 if three_turns else side.end
    most = (2.0 if three_turns else 1.0) * TWO_PI
    low = max(side.h - side.heading - around, -past)
    high = min(most + side.h + side.heading - around, TWO_PI + past)
    # both take as long as their outer turns and their middle arc, or as the turns at least
    high = min(high, 0.5 * (window.beat + side.heading + side.h - around))
    if three_turns:
        low = max(low, 0.5 * (window.earliest - side.heading + side.h - around))
    if not three_turns or high < low:
        return low, high
    # |d| ≤ 4 + r
    ax, ay = side.target
    mid, half = 0.5 * (low + high), 0.5 * (high - low)
    turned = 2.0 * mid + around - side.h
    to_x, to_y = ax * turned - side.cx, ay * turned + 1.0 - side.cy
    reach = 4.0 + side.radius
    square = 4.0 * side.alpha * side.alpha
    along, beyond = 2.0 * (ax * to_x + ay * to_y), to_x * to_x + to_y * to_y - reach * reach
    if beyond > 2.0 * half * abs(along):
        return inf, -inf
    inner = along * along - square * beyond
    if inner < 0.0:
        return inf, -inf
    if square > 1e-6:
        root = sqrt(inner)
        low = max(low, mid + (-along - root) / square - FINEST)
        high = min(high, mid + (-along + root) / square + FINEST)
    return low, high


@njit(cache=True, nogil=True, inline="always")
def _undecided(low: float, high: float) -> Interval:
    """There may be paths in this part of an interval, counted from its middle."""
    if high < low:
        return NOTHING
    return Interval(
        0.0, inf, False, 0.0, 0.0, 0.0, 0.5 * (low + high), 0.5 * (high - low), 0.0
    )  # fmt: skip


@njit(cache=True, nogil=True, inline="always")
def three_turns_within(
    mid: float, half: float, sin_half: float, cos_half: float, around: float, side: Side,
    window: Window,
) -> Interval:  # fmt: skip
    """LRL with a middle arc in mid ± half, and `around` how much more the outer turns make.

    `sin_half` and `cos_half` are sine and cosine of mid/2.
    """
    ax, ay = side.target
    turned = mid + around - side.h
    time = max(turned + mid - 2.0 * half - side.heading, 0.0)
    latest = turned + mid + 2.0 * half + side.heading
    if time >= window.beat or latest < window.earliest:
        return NOTHING
    to_x = ax * (turned + mid) - side.cx
    to_y = ay * (turned + mid) + 1.0 - side.cy
    gap = norm(to_x, to_y)
    spread = 2.0 * (1.0 + side.alpha) * half
    if abs(gap - 4.0 * sin_half) > side.radius + spread:
        return NOTHING
    if spread > _FINE * side.radius and half >= FINEST:
        # f = |d| - 4 sin(m/2), |f| ≤ r; f″ is no more than this
        closest = gap - 2.0 * side.alpha * half
        if closest <= 0.0:
            return _undecided(-half, half)
        slope = 2.0 * (ax * to_x + ay * to_y) / gap - 2.0 * cos_half
        bend = 0.5 * half * half * (4.0 * side.alpha * side.alpha / closest + 1.0)
        blur, misses = side.radius + bend, gap - 4.0 * sin_half
        if abs(slope) * half <= blur:
            return _undecided(-half, half) if abs(misses) <= blur + abs(slope) * half else NOTHING
        low, high = (-misses - blur) / slope, (-misses + blur) / slope
        return _undecided(max(min(low, high), -half), min(max(low, high), half))
    slack = side.radius + 2.0 * side.alpha * half
    astray = pi if slack >= gap else asin(slack / gap) + 0.5 * half
    first = wrap_signed(0.5 * mid - atan2(to_y, to_x))
    shortest = max(mid - half, 0.0)
    return Interval(time, latest, True, turned, first, astray, mid, half, shortest)


@njit(cache=True, nogil=True, inline="always")
def opposite_turns_within(
    mid: float, half: float, s: float, c: float, around: float, side: Side, window: Window
) -> Interval:
    """LSR whose straight has a course in mid ± half; `around` is as in `three_turns_within`.

    `s` and `c` are sine and cosine of mid.
    """
    ax, ay = side.target
    turned = 2.0 * mid + around - side.h
    soonest_turned = max(turned - 2.0 * half - side.heading, 0.0)
    longest = window.beat - soonest_turned
    if longest <= 0.0:
        return NOTHING
    qx, qy = c - ax, s - ay
    q = norm(qx, qy)
    vx = ax * turned - side.cx - 2.0 * s
    vy = ay * turned - side.cy - 1.0 + 2.0 * c
    # |v| ≤ l |q| + r, wherever in the interval
    shortest = (norm(vx, vy) - side.radius - 2.0 * half * (q + half)) / (q + half)
    near, along, beside = inf, 0.0, 0.0
    if q > 1e-9:
        per_q = 1.0 / q
        along, beside = (vx * qx + vy * qy) * per_q, (vx * qy - vy * qx) * per_q
        wander = half * abs(ay * c - ax * s) * per_q + 0.5 * half * half
        near = side.radius + half * half
        if q > wander:
            longest = min(longest, (along + near + 2.0 * half * q) / (q - wander))
        if abs(beside) > near + longest * half:
            return NOTHING
        near += longest * wander
        shortest = max(shortest, (along - near) * per_q - 2.0 * half)
    shortest = max(shortest, 0.0)
    if longest < shortest:
        return NOTHING
    time = soonest_turned + shortest
    latest = turned + 2.0 * half + side.heading + longest
    if near < inf:
        time = max(time, turned - side.heading + (along - near) / q)
        latest = min(latest, turned + side.heading + (along + near) / q)
    if time >= window.beat or latest < window.earliest:
        return NOTHING
    if not (longest < inf and half * (longest + half) <= _FINE * side.radius) and half >= FINEST:
        # −κ l (β − β₀) = beside + E, |E| ≤ r + w² + l w²/2
        bends = (1.0 - ax * c - ay * s) / q if q > 1e-9 else 0.0
        if bends <= 0.0 or shortest <= 0.0:
            return _undecided(-half, half)
        blur = side.radius + half * half
        low, high = -beside - blur, -beside + blur
        low = low / (bends * (shortest if low < 0.0 else longest))
        high = high / (bends * (longest if high < 0.0 else shortest))
        past = 0.5 * half * half / bends
        return _undecided(max(low - past, -half), min(high + past, half))
    middle, middle_blur = 0.5 * (shortest + longest), 0.5 * (longest - shortest)
    return Interval(time, latest, True, turned, mid, half, middle, middle_blur, shortest)


@njit(cache=True, nogil=True, inline="always")
def sine_cosine(angle: float) -> tuple[float, float]:
    """Of an angle that is mostly small."""
    if abs(angle) > _SMALL:
        return sine_and_cosine(angle)
    square = angle * angle
    sine = angle * (1.0 - square * (1.0 - square / 20.0) / 6.0)
    return sine, 1.0 - 0.5 * square * (1.0 - square * (1.0 - square / 30.0) / 12.0)
