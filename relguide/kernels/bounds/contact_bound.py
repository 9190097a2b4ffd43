"""How soon a path can arrive that touches d = d_min somewhere in a cell of contacts: proved.

A contact is fixed by its time t, its bearing b and a side (see `contact`). A cell holds those with
a bearing in b ± w, in a window of time on one piece of the leader's intent. A path whose first
contact lies in it takes at least as long as the soonest word to any of its poses, and then as the
soonest word from any of its poses on (see `word_bound`). Words that certainly break the limit on
the way lead to no first contact, nor to the slot from a last one. Between the first contact and the
last, whatever happens, a path takes at least as long as the soonest word from pose to pose, and as
the way round the disc takes something that need not turn: a boundary arc comes as close to that as
it can.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is a table as in
`clearance`.
"""

from math import acos, cos, hypot, inf, pi, sin, sqrt

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap
from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.word_bound import breaks_limit, soonest
from relguide.kernels.contact.contact import contact_heading
from relguide.kernels.separation.clearance import leader_at, piece_at
from relguide.kernels.words.extremals import MAX_ROWS, SIGNS, fly_piece, solve

_EDGE = 1e-9
"""What rounding may do to a time or a heading; and a leader within this of V_P counts as faster."""
_INSIDE = 2e-6
"""A path must come this much closer than d_min to count as breaking it [R]: 2 cm at R = 12 km."""
_FAST = 0.999  # for a leader faster than this the way round the disc is not bounded
_ROUND = 16_384
"""Points of `times_round`: every 0.02°."""
_ROUND_SLACK = 1e-6
"""What is between two points of it may differ by, as part of a whole round: ten times the square of
the step, which is more than the curvature makes of it."""
_LOOP_STRIDE = 0.01  # from one look to the next where there may be a loop [R/V_P]
_STRIDE = 1e-4  # least step of the look for a breach on a path that is known [R/V_P]


@njit(cache=True, nogil=True)
def contacts_within(
    bearing: float, half: float, side: float, alpha: float, delta: float
) -> tuple[float, float, float, float]:
    """The contacts of a cell whose bearings lie in no more than one quadrant.

    Returns:
        heading of the middle relative to the leader's, how much others may differ [rad], and how
        far the centres of their left and right circles may lie from those of (b, that heading) [R];
        the second is infinite if there is no contact.
    """
    low, high = alpha * cos(bearing - half), alpha * cos(bearing + half)
    if alpha > 1.0 - _EDGE:
        # not every bearing can be touched, and the heading may change without bound
        if min(low, high) > 1.0 or max(low, high) < -1.0:
            return 0.0, inf, inf, inf
        first, second = acos(min(max(low, -1.0), 1.0)), acos(min(max(high, -1.0), 1.0))
        differs = half + 0.5 * abs(first - second)
        blur = delta * half + differs
        return bearing + side * 0.5 * (first + second), differs, blur, blur
    heading = contact_heading(bearing, side, alpha)
    # the heading grows with the bearing, at a rate between 0 and 2 that is monotone in a quadrant
    differs = max(
        contact_heading(bearing + half, side, alpha) - heading,
        heading - contact_heading(bearing - half, side, alpha),
    )
    left, right = 0.0, 0.0
    for end in range(2):
        along, at = (low, bearing - half) if end == 0 else (high, bearing + half)
        rate = 1.0 + side * alpha * sin(at) / sqrt(1.0 - along * along)
        for other in range(2):
            across = low if other == 0 else high
            mixed = 2.0 * delta * rate * side * sqrt(1.0 - across * across)
            left = max(left, delta * delta - mixed + rate * rate)
            right = max(right, delta * delta + mixed + rate * rate)
    return heading, differs, half * sqrt(max(left, 0.0)), half * sqrt(max(right, 0.0))


@njit(cache=True, nogil=True)
def cell_bound(
    x: float, y: float, h: float, leader: FloatArray, i: int, alpha: float, delta: float,
    goal_x: float, goal_speed: float, t_release: float, side: float, bearing: float, half: float,
    low: float, high: float, beat: float,
) -> tuple[float, float]:  # fmt: skip
    """How soon a path can be at a contact of the cell, its first, and how soon at the goal from it.

    Args:
        x: start, slot frame [R].
        y: start [R].
        h: start heading [rad].
        leader: table of its pieces. shape (k, 5)
        i: the piece it is on at the contact.
        alpha: V_L/V_P.
        delta: distance at the contact [R].
        goal_x: where the goal is at t = 0 on the x axis [R].
        goal_speed: of the goal along it [V_P]: α for the slot, 0 for a place.
        t_release: arrivals before do not count [R/V_P].
        side: +1 counter-clockwise round the leader, −1 clockwise.
        bearing: middle of the cell, from the leader relative to its heading [rad].
        half: half of its width [rad]; the cell lies within a quadrant.
        low: start of its window of time, within the piece [R/V_P].
        high: end of it; infinite only on the final leg.
        beat: arrivals from here on do not matter, and both times come back as infinite [R/V_P].
    """
    turned, differs, blur_left, blur_right = contacts_within(bearing, half, side, alpha, delta)
    if differs == inf:
        return inf, inf
    t = low if high == inf else 0.5 * (low + high)
    span = 0.0 if high == inf else 0.5 * (high - low)
    rate = leader[i, 4]
    lx, ly, lh = leader_at(Scene(leader, alpha, 0.0, 0.0), i, t)
    cx, cy = lx + delta * cos(lh + bearing), ly + delta * sin(lh + bearing)
    course = lh + turned
    # the contact of the middle bearing moves like this, and turns with the leader
    vx = alpha * cos(lh) - rate * delta * sin(lh + bearing)
    vy = alpha * sin(lh) + rate * delta * cos(lh + bearing)
    swing = abs(rate) * span
    strays = swing + 0.5 * (alpha + abs(rate) * (delta + 1.0)) * swing * span
    # the slot does not turn with it: what the contact moves relative to the goal is blur
    if i + 1 == len(leader) and goal_speed == alpha:
        drifts = 0.0
    else:
        drifts = strays + span * hypot(vx - goal_speed, vy)
    onward = soonest(
        cx - goal_x - goal_speed * t, cy, course, blur_left + drifts, blur_right + drifts,
        differs + swing, 0.0, goal_speed, 0.0, max(t_release - high, 0.0) - _EDGE, beat - low,
        False, (0.0, 0.0, 0.0), leader, alpha, 0.0,
    )  # fmt: skip
    if onward == inf:
        return inf, inf
    # to the contact: read backward, the start is what is to be met, and left is right
    soon = inf
    for loops in range(3):
        # 0: every word; 1: those that may keep the limit; 2: a word and a full loop, or more of
        # them, since without one they are paths that arrive no sooner than the soonest word
        looped = TWO_PI if loops == 2 else 0.0
        dx, dy = cx - (t - looped) * vx - x, cy - (t - looped) * vy - y
        c, s = cos(h), sin(h)
        latest = min(beat - onward, high + _EDGE) - looped
        found = soonest(
            -dx * c - dy * s, dx * s - dy * c, course - h, blur_right + strays,
            blur_left + strays, differs + swing, 0.0, vx * c + vy * s, vy * c - vx * s,
            0.0 if loops == 2 else low - _EDGE, latest, loops == 1, (x, y, h), leader, alpha,
            delta - _INSIDE,
        ) + looped  # fmt: skip
        if loops == 0:
            if found == inf:
                return inf, inf
        else:
            soon = min(soon, found)
    return max(soon, low), onward


@njit(cache=True, nogil=True)
def leaving_bound(
    leader: FloatArray, alpha: float, delta: float, side: float, bearing: float, half: float,
    beat: float,
) -> float:  # fmt: skip
    """How soon a path can be at the slot from its last contact, if that is one of the cell's.

    On the final leg, where the place of a contact from the slot does not change. Arguments as
    `cell_bound`; infinite from `beat` on.
    """
    turned, differs, blur_left, blur_right = contacts_within(bearing, half, side, alpha, delta)
    if differs == inf:
        return inf
    lx, ly, lh = leader_at(Scene(leader, alpha, 0.0, 0.0), len(leader) - 1, 0.0)
    # read backward from the slot, the leader flies backward too
    astern = np.array([[0.0, lx, ly, lh + pi, 0.0]])
    cx, cy = lx + delta * cos(lh + bearing), ly + delta * sin(lh + bearing)
    found = inf
    for looped in (0.0, TWO_PI):
        word = looped + soonest(
            cx - looped * alpha, cy, lh + turned, blur_left, blur_right, differs, 0.0, alpha, 0.0,
            0.0, beat - looped, looped == 0.0, (0.0, 0.0, pi), astern, alpha, delta - _INSIDE,
        )  # fmt: skip
        found = min(found, word)
    return found


@njit(cache=True, nogil=True)
def between_bound(
    alpha: float, delta: float, side: float, bearing: float, half: float, other_side: float,
    other_bearing: float, other_half: float, beat: float,
) -> float:  # fmt: skip
    """How soon a path can be at a contact of the other cell from one of this, on the final leg.

    Arguments as `cell_bound`; infinite from `beat` on.
    """
    turned, differs, left, right = contacts_within(bearing, half, side, alpha, delta)
    to, to_differs, to_left, to_right = contacts_within(
        other_bearing, other_half, other_side, alpha, delta
    )
    if differs == inf or to_differs == inf:
        return inf
    dx = delta * (cos(bearing) - cos(other_bearing))
    dy = delta * (sin(bearing) - sin(other_bearing))
    c, s = cos(to), sin(to)
    to_blur = max(to_left, to_right)
    return soonest(
        dx * c + dy * s, dy * c - dx * s, turned - to, left + to_blur, right + to_blur,
        differs + to_differs, to_differs, alpha * c, -alpha * s, 0.0, beat, False,
        (0.0, 0.0, 0.0), np.zeros((1, 5)), alpha, 0.0,
    )  # fmt: skip


@njit(cache=True, nogil=True)
def times_round(alpha: float, delta: float) -> FloatArray:
    """How long the way round the disc takes at least, by bearing from −π on.

    For something that needs no time to turn. Outside the disc it is fastest along its edge, since
    that is convex and the leader's motion is the same everywhere: as a boundary arc (see
    `contact`), so

        dt/db = δ / (√(1 − α² cos² b) + s α sin b) = δ (√(1 − α² cos² b) − s α sin b) / (1 − α²).

    Row 0 is counter-clockwise (s = 1), row 1 clockwise, both growing with b. shape (2, ·)
    """
    table = np.zeros((2, _ROUND + 1))
    if alpha > _FAST:
        return table
    step = TWO_PI / _ROUND
    # |d²/db² √(1 − α² cos² b)| is less than this: what the trapezia may be too large by
    bend = 2.0 * alpha * alpha / sqrt(1.0 - alpha * alpha)
    scale = delta / (1.0 - alpha * alpha)
    arc, last = 0.0, sqrt(1.0 - alpha * alpha)
    for k in range(1, _ROUND + 1):
        b = k * step - pi
        here = sqrt(1.0 - (alpha * cos(b)) ** 2)
        arc += 0.5 * step * (last + here) - bend * step * step * step / 12.0
        last = here
        table[0, k] = scale * (arc + alpha * (cos(b) + 1.0))
        table[1, k] = scale * (arc - alpha * (cos(b) + 1.0))
    return table


@njit(cache=True, nogil=True)
def round_time(table: FloatArray, way: int, bearing: float) -> float:
    """A row of `times_round` at any bearing of [−π, π]; differences are right to `_ROUND_SLACK`."""
    place = min(max((bearing + pi) / TWO_PI, 0.0), 1.0) * _ROUND
    k = min(int(place), _ROUND - 1)
    return float(table[way, k] + (place - k) * (table[way, k + 1] - table[way, k]))


@njit(cache=True, nogil=True)
def round_bound(
    table: FloatArray, way: int, bearing: float, half: float, other_bearing: float,
    other_half: float,
) -> float:  # fmt: skip
    """The least time from any bearing of one cell to any of another, outside the disc.

    Args:
        table: of `times_round`.
        way: 0 counter-clockwise round the leader, 1 clockwise.
        bearing: middle of the cell, in [−π, π] [rad].
        half: half of its width [rad].
        other_bearing: of the other cell.
        other_half: of the other cell.
    """
    sign = 1.0 - 2.0 * way
    gap = wrap(sign * (other_bearing - bearing)) - half - other_half
    if gap <= 0.0 or gap + 2.0 * (half + other_half) >= TWO_PI:
        return 0.0
    begin, end = bearing + sign * half, other_bearing - sign * other_half
    took = sign * (round_time(table, way, end) - round_time(table, way, begin))
    if sign * (end - begin) < 0.0:
        took += table[way, _ROUND]
    return float(max(took - _ROUND_SLACK * table[way, _ROUND], 0.0))


@njit(cache=True, nogil=True)
def untouched_bound(
    x: float, y: float, h: float, leader: FloatArray, alpha: float, delta: float, goal_x: float,
    goal_speed: float, t_release: float,
) -> float:  # fmt: skip
    """No path that nowhere touches the limit arrives sooner than this. Arguments as `cell_bound`.

    It is an extremal that keeps the limit, or has a full loop in it.
    """
    rows = np.empty((MAX_ROWS, 5))
    best = inf
    n = solve(
        Pose(x - goal_x - goal_speed * TWO_PI, y, wrap(h)), goal_speed, t_release - TWO_PI, rows
    )
    for k in range(n):
        if not _breaks_with_loop(x, y, h, rows[k], leader, alpha, delta - _INSIDE):
            best = TWO_PI + rows[k, 0]
            break
    n = solve(Pose(x - goal_x, y, wrap(h)), goal_speed, t_release, rows)
    for k in range(n):
        if rows[k, 0] >= best:
            break
        signs = SIGNS[int(rows[k, 1])]
        if not breaks_limit(
            x, y, h, (signs[0], signs[1], signs[2]), rows[k, 2], 0.0, rows[k, 3], 0.0, rows[k, 0],
            leader, alpha, delta - _INSIDE, _STRIDE,
        ):  # fmt: skip
            best = rows[k, 0]
            break
    # with two loops and more: no sooner than the soonest of all paths that are to wait so long
    n = solve(Pose(x - goal_x - goal_speed * 2.0 * TWO_PI, y, wrap(h)), goal_speed, 0.0, rows)
    return min(best, max(2.0 * TWO_PI + rows[0, 0], t_release)) if n > 0 else best


@njit(cache=True, nogil=True)
def _breaks_with_loop(
    x: float, y: float, h: float, row: FloatArray, leader: FloatArray, alpha: float, limit: float
) -> bool:  # fmt: skip
    """Whether a word with a full loop in it, wherever that is, certainly breaks the limit.

    Up to the loop it is flown as it is, and then 2π later. So it does if it breaks the limit as it
    is no later along the way than it does when flown 2π later.
    """
    word = int(row[1])
    steps = int(row[0] / _LOOP_STRIDE)
    soonest_breach, last_breach = inf, -inf
    for k in range(steps + 1):
        along = k * _LOOP_STRIDE
        px, py, ph, left = x, y, h, along
        for piece in range(3):
            amount = min(left, row[piece + 2])
            px, py, ph = fly_piece(Pose(px, py, ph), SIGNS[word, piece], amount)
            left -= amount
        for late in range(2):
            t = along + late * TWO_PI
            lx, ly, _ = leader_at(Scene(leader, alpha, 0.0, 0.0), piece_at(leader, t), t)
            if hypot(px - lx, py - ly) < limit:
                if late == 0:
                    soonest_breach = min(soonest_breach, along)
                else:
                    last_breach = along
    return soonest_breach <= last_breach
