"""How soon a path can arrive that first touches d = d_min in one cell of contacts: proved.

A contact is fixed by its time t, its bearing b and a side (see `contact`). A cell holds those with a
bearing in b ± w, in a window of time on one piece of the leader's intent. A path whose first contact
lies in it takes at least as long as the soonest word to any of its poses, and then as the soonest
word from any of its poses on (see `bounds`). Words that certainly break the limit before lead to no
first contact.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is a table as in
`clearance`.
"""

from math import acos, cos, hypot, inf, sin, sqrt

import numpy as np
from numba import njit

from relguide.kernels.angles import TWO_PI, wrap
from relguide.kernels.bounds import breaks_limit, soonest
from relguide.kernels.clearance import leader_at
from relguide.kernels.contact import contact_heading
from relguide.kernels.extremals import MAX_ROWS, SIGNS, solve
from relguide.kernels.roots import FloatArray

_EDGE = 1e-9
"""What rounding may do to a time or a heading; and a leader within this of V_P counts as faster."""
_INSIDE = 2e-6
"""A path must come this much closer than d_min to count as breaking it [R]: 2 cm at R = 12 km."""
_STRIDE = 1e-4  # least step of the look for a breach on a path that is known [R/V_P]


@njit(cache=True, nogil=True)
def contacts_within(
    bearing: float, half: float, side: float, alpha: float, delta: float
) -> tuple[float, float, float, float]:
    """The contacts of a cell whose bearings lie in no more than one quadrant.

    Returns:
        heading of the middle relative to the leader's, how much others may differ [rad], and how far
        the centres of their left and right circles may lie from those of (b, that heading) [R];
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
    goal_x: float, goal_speed: float, t_open: float, side: float, bearing: float, half: float,
    low: float, high: float, beat: float,
) -> float:  # fmt: skip
    """No path whose first contact lies in the cell arrives sooner than this.

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
        t_open: arrivals before do not count [R/V_P].
        side: +1 counter-clockwise round the leader, −1 clockwise.
        bearing: middle of the cell, from the leader relative to its heading [rad].
        half: half of its width [rad]; the cell lies within a quadrant.
        low: start of its window of time, within the piece [R/V_P].
        high: end of it; infinite only on the final leg.
        beat: bounds from here on do not matter, and come back as infinite [R/V_P].
    """
    turned, differs, blur_left, blur_right = contacts_within(bearing, half, side, alpha, delta)
    if differs == inf:
        return inf
    t = low if high == inf else 0.5 * (low + high)
    span = 0.0 if high == inf else 0.5 * (high - low)
    rate = leader[i, 4]
    lx, ly, lh = leader_at(leader, i, alpha, t)
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
        differs + swing, goal_speed, 0.0, max(t_open - high, 0.0) - _EDGE, -1.0,
        beat - low, False, (0.0, 0.0, 0.0), leader, alpha, 0.0,
    )  # fmt: skip
    if onward == inf:
        return inf
    # to the contact: read backward, the start is what is to be met, and left is right
    soon = inf
    for loops in range(3):
        # 0: every word; 1: those that may keep the limit; 2: a word and a full loop
        looped = TWO_PI if loops == 2 else 0.0
        dx, dy = cx - (t - looped) * vx - x, cy - (t - looped) * vy - y
        c, s = cos(h), sin(h)
        latest = min(beat - onward, high + _EDGE) - looped
        found = soonest(
            -dx * c - dy * s, dx * s - dy * c, course - h, blur_right + strays,
            blur_left + strays, differs + swing, vx * c + vy * s, vy * c - vx * s,
            low - _EDGE - looped, -1.0, latest, loops == 1, (x, y, h), leader, alpha,
            delta - _INSIDE,
        ) + looped  # fmt: skip
        if loops == 0:
            if found == inf:
                return inf
        else:
            soon = min(soon, found)
    return max(max(soon, low) + onward, t_open)


@njit(cache=True, nogil=True)
def untouched_bound(
    x: float, y: float, h: float, leader: FloatArray, alpha: float, delta: float, goal_x: float,
    goal_speed: float, t_open: float,
) -> float:  # fmt: skip
    """No path that nowhere touches the limit arrives sooner than this. Arguments as `cell_bound`.

    It is an extremal that keeps the limit, or has a full loop in it.
    """
    rows = np.empty((MAX_ROWS, 5))
    n = solve(x - goal_x - goal_speed * TWO_PI, y, wrap(h), goal_speed, t_open - TWO_PI, rows)
    best = TWO_PI + rows[0, 0] if n > 0 else inf
    n = solve(x - goal_x, y, wrap(h), goal_speed, t_open, rows)
    for k in range(n):
        if rows[k, 0] >= best:
            break
        signs = SIGNS[int(rows[k, 1])]
        if not breaks_limit(
            x, y, h, (signs[0], signs[1], signs[2]), rows[k, 2], 0.0, rows[k, 3], 0.0, rows[k, 0],
            leader, alpha, delta - _INSIDE, _STRIDE,
        ):  # fmt: skip
            return float(rows[k, 0])
    return best
