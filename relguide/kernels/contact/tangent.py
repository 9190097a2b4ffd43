"""Contacts that end a turn and a straight, or two opposite turns: where a boundary arc begins or
ends best.

From the start, turn by θ and go straight: the closest approach to the leader is a function of θ
alone, and where it equals δ the straight is tangent to the disc. So is a turn the other way at its
own closest approach. These contacts are often the only ones in reach of an aircraft that is close
to the leader, in a window of bearings too narrow for a scan.

The same backward in time from the slot gives the contacts from which a straight and one turn lead
there: reversing time and turning the world by π leaves both velocities as they are, mirrors every
position in the leader and exchanges the sides.

Lengths in R, times in R/V_P, angles counter-clockwise; positions are relative to the leader, which
keeps heading 0.
"""

from math import atan2, cos, hypot, inf, pi, sin

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap
from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.separation.clearance import leader_at
from relguide.kernels.words.extremals import fly_piece

MAX_TANGENTS = 32
"""Room for contacts found."""
NEAR = 8.0
"""Farther from the disc than this [R] the windows of bearings are wide."""
_TURNS = 60  # sizes of the first turn: every 6°
_STEP = 0.2  # step along the second turn: 11°
_SIN_STEP, _COS_STEP = sin(_STEP), cos(_STEP)


@njit(cache=True, nogil=True)
def _first_approach(x: float, y: float, h: float, alpha: float, sign: float) -> float:
    """When a full turn first stops closing in on the leader; −1 if it never does."""
    s0, c0 = sin(h), cos(h)
    s, c = s0, c0
    last = x * (c - alpha) + y * s
    t = 0.0
    while t < TWO_PI:
        t += _STEP
        s, c = s * _COS_STEP + sign * c * _SIN_STEP, c * _COS_STEP - sign * s * _SIN_STEP
        rate = (x + sign * (s - s0) - alpha * t) * (c - alpha) + (y - sign * (c - c0)) * s
        if last < 0.0 <= rate:
            low, high = t - _STEP, t
            middle = high - rate * _STEP / (rate - last)
            for _ in range(30):
                at = h + sign * middle
                sm, cm = sin(at), cos(at)
                rx, ry = x + sign * (sm - s0) - alpha * middle, y - sign * (cm - c0)
                value = rx * (cm - alpha) + ry * sm
                if value < 0.0:
                    low = middle
                else:
                    high = middle
                slope = 1.0 - 2.0 * alpha * cm + alpha * alpha + sign * (ry * cm - rx * sm)
                step_to = middle - value / slope if slope > 0.0 else low
                if not low < step_to < high:
                    step_to = 0.5 * (low + high)
                if abs(step_to - middle) < 1e-14:
                    break
                middle = step_to
            return middle
        last = rate
    return -1.0


@njit(cache=True, nogil=True)
def _miss(
    x: float, y: float, h: float, alpha: float, delta: float, first: float, second: float,
    turned: float, contact: FloatArray,
) -> float:  # fmt: skip
    """Closest approach of what follows a first turn, less δ; NaN if it only moves away.

    `contact` takes the relative position and the time of the closest approach.
    """
    px, py, ph = fly_piece(Pose(x, y, h), first, turned)
    px -= alpha * turned
    if second == 0.0:
        vx, vy = cos(ph) - alpha, sin(ph)
        speed_squared = vx * vx + vy * vy
        after = -(px * vx + py * vy) / speed_squared if speed_squared > 1e-12 else -1.0
    else:
        after = _first_approach(px, py, ph, alpha, second)
    if after <= 0.0:
        return np.nan
    qx, qy, _ = fly_piece(Pose(px, py, ph), second, after)
    contact[0], contact[1], contact[2] = qx - alpha * after, qy, turned + after
    return hypot(contact[0], contact[1]) - delta


@njit(cache=True, nogil=True)
def _touch(
    x: float, y: float, h: float, alpha: float, delta: float, first: float, second: float,
    low: float, high: float, at_low: float, at_high: float, contact: FloatArray,
) -> float:  # fmt: skip
    """Where the closest approach is δ: the secant, kept inside the bracket (Illinois)."""
    middle = high
    for k in range(60):
        # every third step halves: a jump is then found out soon, too
        share = 0.5 if k % 3 == 2 else at_high / (at_high - at_low)
        middle = high - share * (high - low)
        value = _miss(x, y, h, alpha, delta, first, second, middle, contact)
        if abs(value) < 1e-14 or high - low < 1e-15:
            break
        if (value < 0.0) == (at_low < 0.0):
            low, at_low = middle, value
            at_high *= 0.5
        else:
            high, at_high = middle, value
            at_low *= 0.5
    return middle


@njit(cache=True, nogil=True)
def tangent_contacts(
    x: float, y: float, h: float, alpha: float, delta: float, found: FloatArray
) -> int:
    """Contacts reached by a turn and a straight, or by a turn and one the other way.

    Args:
        x: start ahead of the leader [R].
        y: start left of it [R].
        h: start heading [rad].
        alpha: V_L/V_P.
        delta: distance of the contact [R].
        found: takes bearing [rad, in [0, 2π)], side and time of each. shape (MAX_TANGENTS, 3)

    Returns:
        how many.
    """
    contact = np.empty(3)
    n = 0
    for k in range(4):
        first = 1.0 - 2.0 * (k % 2)
        second = 0.0 if k < 2 else -first
        last = np.nan
        for j in range(_TURNS + 1):
            turned = TWO_PI * j / _TURNS
            gap = _miss(x, y, h, alpha, delta, first, second, turned, contact)
            if last * gap < 0.0 and n < MAX_TANGENTS:
                high = _touch(
                    x, y, h, alpha, delta, first, second, turned - TWO_PI / _TURNS, turned, last,
                    gap, contact,
                )  # fmt: skip
                value = _miss(x, y, h, alpha, delta, first, second, high, contact)
                if abs(value) < 1e-9:
                    _, _, heading = fly_piece(Pose(x, y, h), first, high)
                    if second != 0.0:
                        heading += second * (contact[2] - high)
                    across = contact[0] * sin(heading) - contact[1] * (cos(heading) - alpha)
                    found[n, 0] = wrap(atan2(contact[1], contact[0]))
                    found[n, 1] = 1.0 if across > 0.0 else -1.0
                    found[n, 2] = contact[2]
                    n += 1
            last = gap
    return n


@njit(cache=True, nogil=True)
def tangents(
    x: float, y: float, h: float, leader: FloatArray, alpha: float, delta: float
) -> FloatArray:
    """Tangent contacts of the start and of the slot, in the slot frame.

    Of the start while the leader keeps straight, on any of its pieces; none where it keeps straight
    for ever and is so far away that the scan sees all there is. Of the slot on the final leg.

    Args:
        x: start, slot frame [R].
        y: start [R].
        h: start heading [rad].
        leader: table of its pieces, as in `clearance`. shape (k, 5)
        alpha: V_L/V_P.
        delta: distance of the contacts [R].

    Returns:
        rows of bearing [rad], side, time [R/V_P], number of the leader's piece.
    """
    pieces = len(leader)
    kept = np.empty(((pieces + 1) * MAX_TANGENTS, 4))
    found = np.empty((MAX_TANGENTS, 3))
    n = 0
    for i in range(pieces):
        lx, ly, lh = leader_at(Scene(leader, alpha, 0.0, 0.0), i, 0.0)
        if leader[i, 4] != 0.0 or (pieces == 1 and hypot(x - lx, y - ly) > delta + NEAR):
            continue
        end = leader[i + 1, 0] if i + 1 < pieces else inf
        c, s = cos(lh), sin(lh)
        dx, dy = x - lx, y - ly
        m = tangent_contacts(dx * c + dy * s, dy * c - dx * s, h - lh, alpha, delta, found)
        for j in range(m):
            if leader[i, 0] <= found[j, 2] <= end:
                kept[n, :3] = found[j]
                kept[n, 3] = i
                n += 1
    lx, ly, _ = leader_at(Scene(leader, alpha, 0.0, 0.0), pieces - 1, 0.0)
    m = tangent_contacts(lx, ly, 0.0, alpha, delta, found)
    for j in range(m):
        kept[n, 0], kept[n, 1] = wrap(found[j, 0] + pi), -found[j, 1]
        kept[n, 2], kept[n, 3] = found[j, 2], pieces - 1
        n += 1
    return kept[:n]
