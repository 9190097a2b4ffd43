"""The soonest a path without the limit can meet a target, from any pose of a small set: proved.

The counterpart of `extremals`: there exact times from one pose, here a lower bound that holds for
every pose of a set at once. A set is a pose (x, y, h), how far the centre of its left circle and of
its right one may lie from where they are drawn, and how much its heading may differ. Frame, target
and words as in `csc` and `ccc`; r below is how far the unknown pose may displace what is compared.

LSL. |a l + e| = l has a solution for some e within r of its middle iff |a l + e| ≤ l + r: the least
such l is a root of a quadratic.

LSR, by the course β of the straight. With u = (cos β, sin β), q = u − a and v = a A − c₁ − (0, 1)
− 2 (sin β, −cos β) it asks l q = v, and dv/dβ = −2 q. So over β₀ ± w

    (l + 2 (β − β₀)) q₀ = v₀ + E,    |E| ≤ r + w² + l |u − u₀|,

which rules the interval out if v₀ is too far beside q₀, and else bounds τ = A + l, whose first
derivative in β drops out.

LRL, by its middle arc m. | |d| − 4 sin(m/2) | ≤ r + 2 (1 + α) w over m₀ ± w, or it is ruled out.

Intervals that are not ruled out are halved until w counts for no more than r. What cannot be
decided is let through: that may lower the bound, and never raises it.
"""

from math import asin, atan2, cos, hypot, inf, pi, sin, sqrt
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap, wrap_signed
from relguide.kernels.base.records import Pose, Velocity, Window
from relguide.kernels.bounds.breach import ROUNDING, Flown, NearWord, Sieve, breaks_limit

ANY, TANGENT, OUTWARD = 0, 1, 2
"""What may be asked of the turn at the set: nothing, that the costate of the heading vanishes
where it begins, or that it is away from the leader."""
_DEPTH = 192
_FINEST = 1e-12  # an interval this short is not halved again [rad]
_FAST = 0.95  # a target at this speed may be met twice, or late [V_P]
_STEPS = 100  # toward where it may be met: fewer say less
_STRIDE = 0.02  # least step of the look for a breach [R/V_P]


class Blur(NamedTuple):
    """How far the poses of a set may lie from its middle."""

    left: float
    """The centre of the left circle [R]."""
    right: float
    """The centre of the right circle [R]."""
    heading: float
    """[rad]."""
    end: float
    """How much of that is because the heading on which the target is met may differ [rad]."""


class Junction(NamedTuple):
    """What is asked of the turn with which a word leaves the poses of a set: see `junction`."""

    kind: int
    """`ANY`, `TANGENT` or `OUTWARD`."""
    inward: int
    """Which turn is toward the leader: 0 left, 1 right."""
    beyond: float
    """Of `junction.beyond_outward` [rad]."""


class _Side(NamedTuple):
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
    inward: bool
    """Whether the turn at the set is toward the leader."""
    junction: Junction
    """What is asked of it."""


class _Interval(NamedTuple):
    """What an interval of the unknown angle leaves possible."""

    time: float
    """No path of it arrives sooner [R/V_P]; infinite if none can arrive in time."""
    latest: float
    """Nor later."""
    fine: bool
    """Whether halving it would say no more."""
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


NO_JUNCTION = Junction(ANY, 0, 0.0)
"""Every word will do."""
_NOTHING = _Interval(inf, inf, True, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


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
    if one_less > 1e-9:
        opening = blur + closing
        square = max(opening * opening + one_less * beyond, 0.0)
        greatest = max((opening + sqrt(square)) / one_less, blur)
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
    steepest = 1.0 + hypot(ax, ay)
    for _ in range(_STEPS):
        gap = abs(hypot(ax * least + ex, ay * least + ey) - least) - blur
        if gap <= 0.0 or least > greatest:
            break
        least += gap / steepest
    for _ in range(_STEPS):
        gap = abs(hypot(ax * greatest + ex, ay * greatest + ey) - greatest) - blur
        if gap <= 0.0 or least > greatest:
            break
        greatest -= gap / steepest
    return least, greatest


@njit(cache=True, nogil=True)
def soonest(pose: Pose, blur: Blur, target: Velocity, window: Window, sieve: Sieve) -> float:
    """No word meets the target sooner than this, from any pose of the set.

    Arguments as `soonest_joined`.
    """
    return soonest_joined(pose, blur, target, window, sieve, NO_JUNCTION)


@njit(cache=True, nogil=True)
def soonest_joined(
    pose: Pose, blur: Blur, target: Velocity, window: Window, sieve: Sieve, junction: Junction
) -> float:
    """The same for words that leave the poses as a junction asks.

    With `OUTWARD` it is the time until the target is met and the turn away from the leader, which
    there was before the pose too, is over.

    Args:
        pose: middle of the set, seen from the target along the heading to meet it on.
        blur: how far the set reaches.
        target: its velocity.
        window: words that meet it earlier do not count; bounds from `beat` on do not matter, and
            come back as infinite.
        sieve: words left out.
        junction: what is asked.
    """
    if window.beat <= 0.0:
        return inf
    best = window.beat
    for hand in range(2):
        if junction.kind == OUTWARD and hand == junction.inward:
            continue
        side = _side_of(pose, blur, target, hand, junction)
        best = _bound_same_side(side, Window(window.earliest, best), sieve)
        for turns in range(2):
            best = _bound_by_halves(turns == 1, side, Window(window.earliest, best), sieve)
    return best if best < window.beat else inf


@njit(cache=True, nogil=True)
def _side_of(pose: Pose, blur: Blur, target: Velocity, hand: int, junction: Junction) -> _Side:
    """The words that begin with a left turn, or with hand = 1 a right one, in the mirror."""
    m = 1.0 - 2.0 * hand
    h = wrap(m * pose.h)
    alpha = hypot(target.ahead, target.left)
    circle = (blur.left if hand == 0 else blur.right) + ROUNDING
    heading = blur.heading + ROUNDING
    return _Side(
        h, pose.x - sin(h), m * pose.y + cos(h), circle + alpha * heading, heading, blur.end,
        Velocity(target.ahead, m * target.left), alpha, m, hand == junction.inward, junction,
    )  # fmt: skip


@njit(cache=True, nogil=True)
def _bound_same_side(side: _Side, window: Window, sieve: Sieve) -> float:
    """The bound for LSL; `beat` if it is not lower."""
    best = window.beat
    ax, ay = side.target
    for k in range(4):
        turned = TWO_PI * k - side.h
        if turned + side.heading < 0.0 or turned - side.heading > 2.0 * TWO_PI:
            continue
        ex, ey = ax * turned - side.cx, ay * turned + 1.0 - side.cy
        least, greatest = intercept_span(ex, ey, side.target, side.radius)
        soonest_turned = max(turned - side.heading, 0.0)
        least = max(least, window.earliest - turned - side.heading)
        greatest = min(greatest, best - soonest_turned)
        if side.alpha > _FAST:
            least, greatest = _narrow(ex, ey, side.target, side.radius, least, greatest)
        time = soonest_turned + least
        if greatest < least or time >= best:
            continue
        middle, middle_blur = least, inf
        astray = pi
        course = 0.0
        if greatest < inf:
            middle, middle_blur = 0.5 * (least + greatest), 0.5 * (greatest - least)
            to_x, to_y = ax * middle + ex, ay * middle + ey
            slack = side.radius + side.alpha * middle_blur
            if slack < hypot(to_x, to_y):
                astray = asin(slack / hypot(to_x, to_y))
                course = atan2(to_y, to_x)
        latest = turned + side.heading + greatest
        found = _Interval(time, latest, True, turned, -course, astray, middle, middle_blur, least)
        best = min(best, _time_of(found, (-1.0, 0.0, -1.0), 3, 0.0, side, sieve))
    return best


@njit(cache=True, nogil=True)
def _bound_by_halves(three_turns: bool, side: _Side, window: Window, sieve: Sieve) -> float:
    """The bound for LSR, or for LRL if `three_turns`; `beat` if it is not lower."""
    best = window.beat
    mids, halves = np.empty(_DEPTH), np.empty(_DEPTH)
    for k in range(-1, 4):
        around = TWO_PI * k
        # where both outer turns are between none and a full one
        past = 0.0 if three_turns else side.end
        most = (2.0 if three_turns else 1.0) * TWO_PI
        low = max(side.h - side.heading - around, -past)
        high = min(most + side.h + side.heading - around, TWO_PI + past)
        if high < low:
            continue
        mids[0], halves[0] = 0.5 * (low + high), 0.5 * (high - low) + _FINEST
        n = 1
        while n > 0:
            n -= 1
            mid, half = mids[n], halves[n]
            left = Window(window.earliest, best)
            if three_turns:
                found = _three_turns_within(mid, half, around, side, left)
            else:
                found = _opposite_turns_within(mid, half, around, side, left)
            if found.time == inf:
                continue
            if not (found.fine or half < _FINEST or n + 2 > _DEPTH):
                # the half that begins sooner is looked at first
                halves[n] = halves[n + 1] = 0.5 * half
                mids[n], mids[n + 1] = mid + 0.5 * half, mid - 0.5 * half
                n += 2
            elif three_turns:
                best = min(best, _time_of(found, (-1.0, 1.0, -1.0), 2, half, side, sieve))
            else:
                more = _more_time(found, found.first, half + side.heading, False, side)
                if found.time + more < best and not _is_ruled_out(
                    found, (1.0, 0.0, -1.0), found.first, side, sieve
                ):
                    best = found.time + more
    return best


@njit(cache=True, nogil=True, inline="always")  # 8 % of a proof
def _three_turns_within(
    mid: float, half: float, around: float, side: _Side, window: Window
) -> _Interval:
    """LRL with a middle arc in mid ± half, and `around` how much more the outer turns make."""
    ax, ay = side.target
    turned = mid + around - side.h
    time = max(turned + mid - 2.0 * half - side.heading, 0.0)
    latest = turned + mid + 2.0 * half + side.heading
    if time >= window.beat or latest < window.earliest:
        return _NOTHING
    to_x = ax * (turned + mid) - side.cx
    to_y = ay * (turned + mid) + 1.0 - side.cy
    gap = hypot(to_x, to_y)
    spread = 2.0 * (1.0 + side.alpha) * half
    if abs(gap - 4.0 * sin(0.5 * mid)) > side.radius + spread:
        return _NOTHING
    slack = side.radius + 2.0 * side.alpha * half
    astray = pi if slack >= gap else asin(slack / gap) + 0.5 * half
    first = wrap_signed(0.5 * mid - atan2(to_y, to_x))
    shortest = max(mid - half, 0.0)
    return _Interval(
        time, latest, spread <= side.radius, turned, first, astray, mid, half, shortest
    )


@njit(cache=True, nogil=True, inline="always")  # 8 % of a proof
def _opposite_turns_within(
    mid: float, half: float, around: float, side: _Side, window: Window
) -> _Interval:
    """LSR whose straight has a course in mid ± half; `around` is as in `_three_turns_within`."""
    ax, ay = side.target
    turned = 2.0 * mid + around - side.h
    c, s = cos(mid), sin(mid)
    qx, qy = c - ax, s - ay
    q = hypot(qx, qy)
    vx = ax * turned - side.cx - 2.0 * s
    vy = ay * turned - side.cy - 1.0 + 2.0 * c
    soonest_turned = max(turned - 2.0 * half - side.heading, 0.0)
    # |v| ≤ l |q| + r, wherever in the interval
    shortest = (hypot(vx, vy) - side.radius - 2.0 * half * (q + half)) / (q + half)
    longest = window.beat - soonest_turned
    near, along = inf, 0.0
    if q > 1e-9:
        along, beside = (vx * qx + vy * qy) / q, abs(vx * qy - vy * qx) / q
        wander = half * abs(ay * c - ax * s) / q + 0.5 * half * half
        near = side.radius + half * half
        if q > wander:
            longest = min(longest, (along + near + 2.0 * half * q) / (q - wander))
        if beside > near + longest * half:
            return _NOTHING
        near += longest * wander
        shortest = max(shortest, (along - near) / q - 2.0 * half)
    shortest = max(shortest, 0.0)
    if longest < shortest:
        return _NOTHING
    time = soonest_turned + shortest
    latest = turned + 2.0 * half + side.heading + longest
    if near < inf:
        time = max(time, turned - side.heading + (along - near) / q)
        latest = min(latest, turned + side.heading + (along + near) / q)
    if time >= window.beat or latest < window.earliest:
        return _NOTHING
    fine = longest < inf and half * (longest + half) <= side.radius
    middle, middle_blur = 0.5 * (shortest + longest), 0.5 * (longest - shortest)
    return _Interval(time, latest, fine, turned, mid, half, middle, middle_blur, shortest)


@njit(cache=True, nogil=True)
def _time_of(
    found: _Interval, signs: tuple[float, float, float], turns: int, half: float, side: _Side,
    sieve: Sieve,
) -> float:  # fmt: skip
    """The least time of a word that is not sifted, with outer turns between none and a full one.

    Args:
        found: what is asked about.
        signs: of the pieces, read backward, but for the mirror.
        turns: how many full turns the first turn may be off.
        half: how much both outer turns together may differ besides [rad].
        side: of which words.
        sieve: words left out.

    Returns:
        it, and with it how long the turn at the set was there before; infinite if there is none.
    """
    least = inf
    for j in range(turns):
        first = found.first + TWO_PI * j
        other, spare = found.turned - first, found.astray + half + side.heading
        if (
            -found.astray - side.end <= first <= TWO_PI + found.astray + side.end
            and -spare <= other <= TWO_PI + spare
            and not (signs[1] != 0.0 and _has_lesser_middle(found, first, other, spare))
        ):
            time = found.time + _more_time(found, first, spare, signs[1] != 0.0, side)
            if time < least and not _is_ruled_out(found, signs, first, side, sieve):
                least = time
    return least


@njit(cache=True, nogil=True)
def _has_lesser_middle(found: _Interval, first: float, other: float, spare: float) -> bool:
    """Whether the middle of three turns is certainly less than an outer one: then no costate fits.

    λ_ψ vanishes on a line, on which both switches lie: so it would again, as long after the second
    and before the first (see `costate`).
    """
    middle = found.middle + found.middle_blur
    return (first - found.astray > middle and other > spare) or (
        other - spare > middle and first > found.astray
    )


@njit(cache=True, nogil=True)
def _more_time(
    found: _Interval, first: float, spare: float, three_turns: bool, side: _Side
) -> float:
    """How long the turn was there before the set, at least; infinite if the junction is another.

    `TANGENT`: λ_ψ vanishes. That is on the straight, a full turn from it, as far from the middle of
    three turns as that is long, and wherever it may be if there are two turns only. `OUTWARD`: see
    `junction`.

    Args:
        found: what is asked about.
        first: first turn of the path read backward [rad].
        spare: how much the turn at the set may differ [rad].
        three_turns: whether the middle piece is a turn.
        side: of which words.
    """
    junction = side.junction
    if junction.kind == ANY:
        return 0.0
    turn = found.turned - first
    free = first <= found.astray if three_turns else found.shortest <= 0.0
    if junction.kind == TANGENT:
        if turn <= spare:
            return 0.0
        if side.inward:
            return inf
        back = three_turns and abs(turn - found.middle) <= spare + found.middle_blur
        return 0.0 if free or back or abs(turn - TWO_PI) <= spare else inf
    whole = found.shortest if three_turns else TWO_PI
    return 0.0 if free else max(min(whole - turn - spare, junction.beyond), 0.0)


@njit(cache=True, nogil=True)
def _is_ruled_out(
    found: _Interval, signs: tuple[float, float, float], first: float, side: _Side, sieve: Sieve
) -> bool:
    """Whether a word is left out, as every path of it certainly breaks the limit."""
    if not sieve.used:
        return False
    m = side.mirror
    word = NearWord(
        (m * signs[0], m * signs[1], m * signs[2]), first, found.astray, found.middle,
        found.middle_blur, found.time,
    )  # fmt: skip
    begin, astray = 0.0, 0.0
    if sieve.sense < 0.0:
        # flown back from the goal, of which it is known only nearly when it is met
        begin = sieve.low + found.time
        latest = sieve.high + found.latest
        if latest < inf:
            astray = 0.5 * max(latest - begin, 0.0)
            begin += astray
        elif sieve.speed != sieve.scene.alpha:
            return False
    end = Pose(sieve.end.x + sieve.speed * begin, sieve.end.y, sieve.end.h)
    flown = Flown(begin, sieve.sense, sieve.speed, astray)
    return breaks_limit(end, word, flown, sieve.scene, _STRIDE)
