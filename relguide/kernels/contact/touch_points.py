"""Contacts by themselves: where simple pieces touch the disc, and where boundary arcs begin and
end.

A turn and a straight touch the disc at isolated bearings only, and so do two opposite turns. Here
they are found from one start, on one side, all of them or the one next to a guess; `tangent` looks
for every one at once, where nothing is known yet.

Positions are relative to the leader, which keeps heading 0. Lengths in R, times in R/V_P, angles
counter-clockwise.
"""

from math import atan2, cos, inf, pi, sin, sqrt

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap
from relguide.kernels.base.records import Pose
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.contact import boundary_arc_sense, slide_within
from relguide.kernels.words.extremals import fly_piece

_TO_NEXT = 0.02  # a turn from one contact to the next is longer than this [rad]
_SCAN = 48  # sizes of a turn that is followed by a straight: every 7.5°
LONGEST_BOUNDARY_ARC = 1.5 * pi
"""A boundary arc that goes on farther has begun behind its end [rad]."""


@njit(cache=True, nogil=True)
def _straight_miss(
    px: float, py: float, h: float, alpha: float, delta: float, sign: float, side: float,
    turned: float,
) -> tuple[float, float, float, float]:  # fmt: skip
    """Turn, then straight: by how much the tangent on a side is missed, how long the straight is.

    Returns:
        the signed miss times the relative speed, time from the turn to the closest approach, and
        where that is as seen from the leader.
    """
    c, s = cos(h + sign * turned), sin(h + sign * turned)
    qx = px + sign * (s - sin(h)) - alpha * turned
    qy = py - sign * (c - cos(h))
    vx = c - alpha
    speed = sqrt(vx * vx + s * s)
    after = -(qx * vx + qy * s) / max(speed * speed, 1e-12)
    return qx * s - qy * vx - side * delta * speed, after, qx + after * vx, qy + after * s


@njit(cache=True, nogil=True)
def _tangent_between(
    px: float, py: float, h: float, alpha: float, delta: float, sign: float, side: float,
    low: float, high: float, at_low: float, at_high: float, contact: FloatArray,
) -> bool:  # fmt: skip
    """The turn between two whose straight on touches the disc (Illinois), if that lies ahead."""
    turned, kept = high, 0
    for _ in range(40):
        turned = high - (high - low) * at_high / (at_high - at_low)
        value, _, _, _ = _straight_miss(px, py, h, alpha, delta, sign, side, turned)
        if abs(value) < 1e-13 or high - low < 1e-14:
            break
        # an end that is kept twice counts half
        if (value < 0.0) == (at_low < 0.0):
            low, at_low = turned, value
            at_high *= 0.5 if kept == 1 else 1.0
            kept = 1
        else:
            high, at_high = turned, value
            at_low *= 0.5 if kept == -1 else 1.0
            kept = -1
    _, after, cx, cy = _straight_miss(px, py, h, alpha, delta, sign, side, turned)
    contact[0], contact[1], contact[2] = atan2(cy, cx), turned, after
    return after > 0.0


@njit(cache=True, nogil=True)
def straight_tangents(
    px: float, py: float, h: float, alpha: float, delta: float, sign: float, side: float,
    contacts: FloatArray,
) -> int:  # fmt: skip
    """All turns of one sign, up to a full one, whose straight on touches the disc on a side.

    Args:
        px: start ahead of the leader [R].
        py: and left of it [R].
        h: start heading [rad].
        alpha: V_L/V_P.
        delta: distance of the contact [R].
        sign: of the turn.
        side: +1 counter-clockwise round the leader, −1 clockwise.
        contacts: takes bearing, turn and straight of each. shape (·, 3)

    Returns:
        how many.
    """
    n = 0
    where = px, py, h, alpha, delta, sign, side
    step = TWO_PI / _SCAN
    # round the circle of the turn by one rotation after the other, which takes no sine
    c, s = cos(h - sign * step), sin(h - sign * step)
    mx, my = px - sign * sin(h), py + sign * cos(h)
    turn_c, turn_s = cos(step), sign * sin(step)
    before = last = 0.0
    for k in range(-1, _SCAN + 1):
        vx = c - alpha
        miss = (
            (mx + sign * s - alpha * step * k) * s
            - (my - sign * c) * vx
            - side * delta * sqrt(vx * vx + s * s)
        )
        c, s = c * turn_c - s * turn_s, s * turn_c + c * turn_s
        low, high = step * (k - 1), step * k
        if k > 0 and (last < 0.0) != (miss < 0.0):
            if n < len(contacts) and _tangent_between(*where, low, high, last, miss, contacts[n]):
                n += 1
        elif k > 0 and (before < 0.0) == (last < 0.0) and abs(last) < min(abs(before), abs(miss)):
            # next to the disc two of them lie closer to each other than is looked
            bend = before - 2.0 * last + miss
            top = low + 0.5 * step * (before - miss) / bend
            value, _, _, _ = _straight_miss(*where, top)
            if (value < 0.0) != (last < 0.0):
                for begin, end, at_begin, at_end in (
                    (low - step, top, before, value),
                    (top, high, value, miss),
                ):
                    if (
                        n < len(contacts)
                        and _tangent_between(*where, begin, end, at_begin, at_end, contacts[n])
                        and contacts[n, 1] >= 0.0
                    ):
                        n += 1
        before, last = last, miss
    return n


@njit(cache=True, nogil=True)
def next_contact(
    bearing: float, side: float, alpha: float, delta: float, course: float, contact: FloatArray
) -> bool:
    """From a contact by a turn to its own side and a straight to the next contact on that side.

    Args:
        bearing: of the first contact [rad].
        side: +1 counter-clockwise round the leader, −1 clockwise.
        alpha: V_L/V_P.
        delta: distance of both [R].
        course: heading there [rad].
        contact: takes bearing, turn and straight. shape (3,)

    Returns:
        whether there is one.
    """
    where = delta * cos(bearing), delta * sin(bearing), course, alpha, delta, side, side
    low = _TO_NEXT
    last, _, _, _ = _straight_miss(*where, low)
    for k in range(1, _SCAN // 2):
        high = TWO_PI * k / _SCAN
        miss, _, _, _ = _straight_miss(*where, high)
        if (last < 0.0) != (miss < 0.0):
            return _tangent_between(*where, low, high, last, miss, contact)
        low, last = high, miss
    return False


@njit(cache=True, nogil=True)
def turn_tangent(
    px: float, py: float, h: float, alpha: float, delta: float, sign: float, side: float,
    first: float, second: float,
) -> tuple[float, float, float]:  # fmt: skip
    """Two opposite turns of which the second touches the disc, next to a guess: Newton.

        p·v = 0,    p × v = s δ |v|,    p, v relative to the leader at the end

    Args:
        px: start ahead of the leader [R].
        py: and left of it [R].
        h: start heading [rad].
        alpha: V_L/V_P.
        delta: distance of the contact [R].
        sign: of the first turn.
        side: +1 counter-clockwise round the leader, −1 clockwise.
        first: guess of the first turn [rad].
        second: and of the second [rad].

    Returns:
        bearing, first and second turn; the turns are NaN if there is none next to the guess.
    """
    for _ in range(20):
        mx, my, mh = fly_piece(Pose(px, py, h), sign, first)
        qx, qy, qh = fly_piece(Pose(mx, my, mh), -sign, second)
        # the second arc turns with the end of the first one
        along, across = qx - mx, qy - my
        qx -= alpha * (first + second)
        c, s = cos(qh), sin(qh)
        vx, vy = c - alpha, s
        speed = sqrt(vx * vx + vy * vy)
        closing, miss = qx * vx + qy * vy, qx * vy - qy * vx - side * delta * speed
        if abs(closing) + abs(miss) < 1e-12:
            if 0.0 <= first <= TWO_PI and 0.0 <= second <= TWO_PI:
                return atan2(qy, qx), first, second
            break
        jacobian = np.empty((2, 2))
        for k in range(2):
            turning = sign if k == 0 else -sign
            if k == 0:
                dx, dy = cos(mh) - alpha - sign * across, sin(mh) + sign * along
            else:
                dx, dy = vx, vy
            ux, uy = -turning * s, turning * c
            jacobian[0, k] = dx * vx + dy * vy + qx * ux + qy * uy
            jacobian[1, k] = (
                dx * vy - dy * vx + qx * uy - qy * ux - side * delta * (vx * ux + vy * uy) / speed
            )
        determinant = jacobian[0, 0] * jacobian[1, 1] - jacobian[0, 1] * jacobian[1, 0]
        if abs(determinant) < 1e-12:
            break
        by_first = (closing * jacobian[1, 1] - miss * jacobian[0, 1]) / determinant
        by_second = (miss * jacobian[0, 0] - closing * jacobian[1, 0]) / determinant
        shorter = min(1.0, 0.5 / max(abs(by_first), abs(by_second), 1e-12))
        first -= shorter * by_first
        second -= shorter * by_second
    return 0.0, np.nan, np.nan


@njit(cache=True, nogil=True)
def boundary_arc_end(
    slot: float, alpha: float, delta: float, side: float
) -> tuple[float, float, float]:
    """Where a boundary arc ends that goes on to the slot by a straight and a turn to the boundary
    arc's own side.

    Backward in time, with the world turned by π, that is a turn and a straight from the slot (see
    `tangent`).

    Returns:
        bearing, straight and turn; the soonest of them. NaN if there is none.
    """
    contacts = np.empty((4, 3))
    n = straight_tangents(slot, 0.0, 0.0, alpha, delta, -side, -side, contacts)
    best, at = inf, -1
    for k in range(n):
        if contacts[k, 1] + contacts[k, 2] < best:
            best, at = contacts[k, 1] + contacts[k, 2], k
    if at < 0:
        return np.nan, np.nan, np.nan
    return contacts[at, 0] + pi, contacts[at, 2], contacts[at, 1]


@njit(cache=True, nogil=True)
def slide_between(
    bearing: float, end: float, side: float, alpha: float, delta: float
) -> tuple[float, float]:
    """A boundary arc from one bearing on to another: its last bearing, unwrapped, and how long it
    takes.
    """
    way = boundary_arc_sense(bearing, side, alpha, delta, 0.0)
    if way == 0.0:
        return bearing, inf
    ahead = wrap(way * (end - bearing))
    if ahead > LONGEST_BOUNDARY_ARC:
        return bearing, inf
    _, took = slide_within(bearing, bearing + way * ahead, side, alpha, delta, 0.0, inf)
    return bearing + way * ahead, took
