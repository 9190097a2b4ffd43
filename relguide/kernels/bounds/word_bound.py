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

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap, wrap_signed
from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.separation.clearance import leader_at
from relguide.kernels.words.extremals import fly_piece

_ROUNDING = 2e-7
"""Added to every blur: twice what an accepted path may miss its end by, `extremals.CLOSURE` [R]."""
_DEPTH = 192
_FINEST = 1e-12  # an interval this short is not halved again [rad]
_FAST = 0.95  # a target at this speed may be met twice, or late [V_P]
_STEPS = 100  # toward where it may be met: fewer say less
_STRIDE = 0.02  # least step of the look for a breach [R/V_P]


@njit(cache=True, nogil=True)
def intercept_span(ex: float, ey: float, ax: float, ay: float, blur: float) -> tuple[float, float]:
    """Least and greatest l ≥ 0 with |a l + e'| = l for some e' within blur of e.

    The least is infinite if there is none, the greatest if it is not bounded (α ≥ 1).
    """
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
def _narrowed(
    ex: float, ey: float, ax: float, ay: float, blur: float, least: float, greatest: float
) -> tuple[float, float]:
    """The part of [least, greatest] outside which |a l + e'| ≠ l, by steps too short to miss it.

    For targets so fast that `intercept_span` says little, or that can be met twice.
    """
    if not greatest < inf:
        return least, greatest
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
def breaks_limit(
    x: float, y: float, h: float, signs: tuple[float, float, float], first: float,
    first_blur: float, middle: float, middle_blur: float, until: float, leader: FloatArray,
    alpha: float, limit: float, stride: float,
) -> bool:  # fmt: skip
    """Whether every path of a word with amounts near these comes closer than the limit in time.

    It is looked at now and then only: a breach that is short may be missed, and none is made up.

    Args:
        x: start, slot frame [R].
        y: start [R].
        h: start heading [rad].
        signs: of the three pieces.
        first: amount of the first piece [rad].
        first_blur: how much it may differ.
        middle: amount of the second [rad or R].
        middle_blur: how much it may differ; infinite if it is not known.
        until: when the word is not yet over [R/V_P].
        leader: table of its pieces. shape (k, 5)
        alpha: V_L/V_P.
        limit: the separation to be kept [R].
        stride: least step from one look to the next [R/V_P].
    """
    if middle_blur == inf:
        return False
    # headings differ by no more than this in the second piece and in the third
    slow = first_blur if signs[1] == 0.0 else 2.0 * first_blur
    fast = 2.0 * (first_blur + middle_blur)
    first, middle = max(first, 0.0), max(middle, 0.0)
    parted = max(first - first_blur, 0.0)
    turning = parted + max(middle - middle_blur, 0.0)
    at_x, at_y, at_h = fly_piece(Pose(x, y, h), signs[0], first)
    on_x, on_y, on_h = fly_piece(Pose(at_x, at_y, at_h), signs[1], middle)
    i = 0
    t = 0.0
    while t < until:
        while i + 1 < len(leader) and leader[i + 1, 0] <= t:
            i += 1
        if t <= first:
            px, py, _ = fly_piece(Pose(x, y, h), signs[0], t)
        elif t <= first + middle:
            px, py, _ = fly_piece(Pose(at_x, at_y, at_h), signs[1], t - first)
        else:
            px, py, _ = fly_piece(Pose(on_x, on_y, on_h), signs[2], t - first - middle)
        lx, ly, _ = leader_at(Scene(leader, alpha, 0.0, 0.0), i, t)
        astray = slow * max(t - parted, 0.0) + fast * max(t - turning, 0.0)
        gap = hypot(px - lx, py - ly) + astray + _ROUNDING - limit
        if gap < 0.0:
            return True
        t += max(gap / (1.0 + alpha), stride)
    return False


@njit(cache=True, nogil=True)
def soonest(
    x: float, y: float, h: float, blur_left: float, blur_right: float, blur_h: float,
    blur_end: float, ax: float, ay: float, not_before: float, beat: float,
    kept: bool, back: tuple[float, float, float], leader: FloatArray, alpha: float, limit: float,
) -> float:  # fmt: skip
    """No word meets the target sooner than this, from any pose of the set.

    Args:
        x: middle of the set, ahead of the target along the heading to meet it on [R].
        y: and left of it [R].
        h: its heading, counter-clockwise from that heading [rad].
        blur_left: how far the centre of the left circle may lie from that of the middle [R].
        blur_right: the same of the right circle [R].
        blur_h: how much the heading may differ [rad].
        blur_end: how much of that is because the heading to meet the target on may [rad].
        ax: the target's velocity along the heading to meet it on [V_P].
        ay: and to the left of it [V_P].
        not_before: words that meet it sooner do not count [R/V_P].
        beat: bounds from here on do not matter, and come back as infinite [R/V_P].
        kept: whether words that certainly break the limit are left out. They are then read
            backward: from the middle of the set back in time to where the path began.
        back: that pose, slot frame.
        leader: table of its pieces. shape (k, 5)
        alpha: V_L/V_P.
        limit: the separation to be kept [R].
    """
    if beat <= 0.0:
        return inf
    best = beat
    for hand in range(2):
        m = 1.0 - 2.0 * hand
        blur = (blur_left if hand == 0 else blur_right) + _ROUNDING
        best = _same_side(
            x, m * y, wrap(m * h), blur, blur_h + _ROUNDING, blur_end, ax, m * ay, not_before,
            best, kept, m, back, leader, alpha, limit,
        )  # fmt: skip
        for turns in range(2):
            best = _by_halves(
                turns == 1, x, m * y, wrap(m * h), blur, blur_h + _ROUNDING, blur_end, ax,
                m * ay, not_before, best, kept, m, back, leader, alpha, limit,
            )  # fmt: skip
    return best if best < beat else inf


@njit(cache=True, nogil=True)
def _same_side(
    x: float, y: float, h: float, blur: float, blur_h: float, blur_end: float, ax: float,
    ay: float, not_before: float, beat: float, kept: bool, m: float,
    back: tuple[float, float, float], leader: FloatArray, alpha: float, limit: float,
) -> float:  # fmt: skip
    """The bound for LSL; `beat` if it is not lower."""
    best = beat
    cx, cy = x - sin(h), y + cos(h)
    radius = blur + hypot(ax, ay) * blur_h
    for k in range(4):
        turned = TWO_PI * k - h
        if turned + blur_h < 0.0 or turned - blur_h > 2.0 * TWO_PI:
            continue
        ex, ey = ax * turned - cx, ay * turned + 1.0 - cy
        least, greatest = intercept_span(ex, ey, ax, ay, radius)
        soonest_turned = max(turned - blur_h, 0.0)
        least = max(least, not_before - turned - blur_h)
        greatest = min(greatest, best - soonest_turned)
        if hypot(ax, ay) > _FAST:
            least, greatest = _narrowed(ex, ey, ax, ay, radius, least, greatest)
        time = soonest_turned + least
        if greatest < least or time >= best:
            continue
        middle, half = least, inf
        astray = pi
        course = 0.0
        if greatest < inf:
            middle, half = 0.5 * (least + greatest), 0.5 * (greatest - least)
            to_x, to_y = ax * middle + ex, ay * middle + ey
            slack = radius + hypot(ax, ay) * half
            if slack < hypot(to_x, to_y):
                astray = asin(slack / hypot(to_x, to_y))
                course = atan2(to_y, to_x)
        for j in range(3):
            last = TWO_PI * j - course
            if (
                last < -astray - blur_end
                or last > TWO_PI + astray + blur_end
                or turned - last < -astray - blur_h
                or turned - last > TWO_PI + astray + blur_h
            ):
                continue
            if kept and breaks_limit(
                back[0], back[1], back[2], (-m, 0.0, -m), last, astray, middle, half, time,
                leader, alpha, limit, _STRIDE,
            ):  # fmt: skip
                continue
            best = time
            break
    return best


@njit(cache=True, nogil=True)
def _by_halves(
    three_turns: bool, x: float, y: float, h: float, blur: float, blur_h: float, blur_end: float,
    ax: float, ay: float, not_before: float, beat: float, kept: bool, m: float,
    back: tuple[float, float, float], leader: FloatArray, alpha: float, limit: float,
) -> float:  # fmt: skip
    """The bound for LSR, or for LRL if `three_turns`; `beat` if it is not lower."""
    best = beat
    cx, cy = x - sin(h), y + cos(h)
    a = hypot(ax, ay)
    radius = blur + a * blur_h
    mids, halves = np.empty(_DEPTH), np.empty(_DEPTH)
    for k in range(-1, 4):
        # where both outer turns are between none and a full one
        past = 0.0 if three_turns else blur_end
        low = max(h - blur_h - TWO_PI * k, -past)
        high = min((2.0 if three_turns else 1.0) * TWO_PI + h + blur_h - TWO_PI * k, TWO_PI + past)
        if high < low:
            continue
        mids[0], halves[0] = 0.5 * (low + high), 0.5 * (high - low) + _FINEST
        n = 1
        while n > 0:
            n -= 1
            mid, half = mids[n], halves[n]
            if three_turns:
                turned = mid + TWO_PI * k - h
                time = max(turned + mid - 2.0 * half - blur_h, 0.0)
                latest = turned + mid + 2.0 * half + blur_h
                if time >= best or latest < not_before:
                    continue
                to_x = ax * (turned + mid) - cx
                to_y = ay * (turned + mid) + 1.0 - cy
                gap = hypot(to_x, to_y)
                if abs(gap - 4.0 * sin(0.5 * mid)) > radius + 2.0 * (1.0 + a) * half:
                    continue
                fine = 2.0 * (1.0 + a) * half <= radius
                slack = radius + 2.0 * a * half
                astray = pi if slack >= gap else asin(slack / gap) + 0.5 * half
                last = 0.5 * mid - atan2(to_y, to_x)
                length, length_blur = mid, half
            else:
                turned = 2.0 * mid + TWO_PI * k - h
                c, s = cos(mid), sin(mid)
                qx, qy = c - ax, s - ay
                q = hypot(qx, qy)
                vx = ax * turned - cx - 2.0 * s
                vy = ay * turned - cy - 1.0 + 2.0 * c
                soonest_turned = max(turned - 2.0 * half - blur_h, 0.0)
                # |v| ≤ l |q| + r, wherever in the interval
                shortest = (hypot(vx, vy) - radius - 2.0 * half * (q + half)) / (q + half)
                longest = best - soonest_turned
                near = inf
                if q > 1e-9:
                    along, beside = (vx * qx + vy * qy) / q, abs(vx * qy - vy * qx) / q
                    wander = half * abs(ay * c - ax * s) / q + 0.5 * half * half
                    near = radius + half * half
                    if q > wander:
                        longest = min(longest, (along + near + 2.0 * half * q) / (q - wander))
                    if beside > near + longest * half:
                        continue
                    near += longest * wander
                    shortest = max(shortest, (along - near) / q - 2.0 * half)
                shortest = max(shortest, 0.0)
                if longest < shortest:
                    continue
                time = soonest_turned + shortest
                latest = turned + 2.0 * half + blur_h + longest
                if near < inf:
                    time = max(time, turned - blur_h + (along - near) / q)
                    latest = min(latest, turned + blur_h + (along + near) / q)
                if time >= best or latest < not_before:
                    continue
                fine = longest < inf and half * (longest + half) <= radius
                last, astray = mid, half
                length, length_blur = 0.5 * (shortest + longest), 0.5 * (longest - shortest)
            if not (fine or half < _FINEST or n + 2 > _DEPTH):
                # the half that begins sooner is looked at first
                halves[n] = halves[n + 1] = 0.5 * half
                mids[n], mids[n + 1] = mid + 0.5 * half, mid - 0.5 * half
                n += 2
                continue
            possible = not three_turns
            if three_turns:
                last = wrap_signed(last)
                for j in range(2):
                    end = last + TWO_PI * j
                    if (
                        end < -astray - blur_end
                        or end > TWO_PI + astray + blur_end
                        or turned - end < -astray - half - blur_h
                        or turned - end > TWO_PI + astray + half + blur_h
                    ):
                        continue
                    if not kept or not breaks_limit(
                        back[0], back[1], back[2], (-m, m, -m), end, astray, length, length_blur,
                        time, leader, alpha, limit, _STRIDE,
                    ):  # fmt: skip
                        possible = True
            elif kept:
                possible = not breaks_limit(
                    back[0], back[1], back[2], (m, 0.0, -m), last, astray, length, length_blur,
                    time, leader, alpha, limit, _STRIDE,
                )  # fmt: skip
            if possible:
                best = time
    return best
