"""Contacts by themselves: where simple pieces touch the disc, and boundary arcs begin and end.

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
from relguide.kernels.base.records import Bracket, Disc, Pose
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.contact.contact import boundary_arc_sense, slide_within
from relguide.kernels.words.extremals import fly_piece

_TO_NEXT = 0.02  # a turn from one contact to the next is longer than this [rad]
_SCAN = 48  # sizes of a turn that is followed by a straight: every 7.5°
LONGEST_BOUNDARY_ARC = 1.5 * pi
"""A boundary arc that goes on farther has begun behind its end [rad]."""


@njit(cache=True, nogil=True)
def mirror_disc(disc: Disc) -> Disc:
    """The disc passed on its other side."""
    return Disc(disc.alpha, disc.distance, -disc.side, disc.turning)


@njit(cache=True, nogil=True)
def _straight_miss(
    pose: Pose, disc: Disc, sign: float, turned: float
) -> tuple[float, float, float, float]:
    """Turn, then straight: by how much the tangent on a side is missed, how long the straight is.

    Returns:
        the signed miss times the relative speed, time from the turn to the closest approach, and
        where that is as seen from the leader.
    """
    sin_h, cos_h = sine_and_cosine(pose.h)
    s, c = sine_and_cosine(pose.h + sign * turned)
    qx = pose.x + sign * (s - sin_h) - disc.alpha * turned
    qy = pose.y - sign * (c - cos_h)
    vx = c - disc.alpha
    speed = sqrt(vx * vx + s * s)
    after = -(qx * vx + qy * s) / max(speed * speed, 1e-12)
    miss = qx * s - qy * vx - disc.side * disc.distance * speed
    return miss, after, qx + after * vx, qy + after * s


@njit(cache=True, nogil=True)
def _tangent_between(
    pose: Pose, disc: Disc, sign: float, turns: Bracket, contact: FloatArray
) -> bool:
    """The turn between two whose straight on touches the disc (Illinois), if that lies ahead."""
    low, high, at_low, at_high = turns
    turned, kept = high, 0
    for _ in range(40):
        turned = high - (high - low) * at_high / (at_high - at_low)
        value, _, _, _ = _straight_miss(pose, disc, sign, turned)
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
    _, after, cx, cy = _straight_miss(pose, disc, sign, turned)
    contact[0], contact[1], contact[2] = atan2(cy, cx), turned, after
    return after > 0.0


@njit(cache=True, nogil=True)
def straight_tangents(pose: Pose, disc: Disc, sign: float, contacts: FloatArray) -> int:
    """All turns of one sign, up to a full one, whose straight on touches the disc on its side.

    Args:
        pose: where the turn begins, seen from the leader.
        disc: round a leader that keeps straight.
        sign: of the turn.
        contacts: takes bearing, turn and straight of each. shape (·, 3)

    Returns:
        how many.
    """
    n = 0
    alpha, h = disc.alpha, pose.h
    step = TWO_PI / _SCAN
    # round the circle of the turn by one rotation after the other, which takes no sine
    sin_h, cos_h = sine_and_cosine(h)
    s, c = sine_and_cosine(h - sign * step)
    mx, my = pose.x - sign * sin_h, pose.y + sign * cos_h
    turn_c, turn_s = cos(step), sign * sin(step)
    before = last = 0.0
    for k in range(-1, _SCAN + 1):
        vx = c - alpha
        miss = (
            (mx + sign * s - alpha * step * k) * s
            - (my - sign * c) * vx
            - disc.side * disc.distance * sqrt(vx * vx + s * s)
        )
        c, s = c * turn_c - s * turn_s, s * turn_c + c * turn_s
        low, high = step * (k - 1), step * k
        if k > 0 and (last < 0.0) != (miss < 0.0):
            between = Bracket(low, high, last, miss)
            if n < len(contacts) and _tangent_between(pose, disc, sign, between, contacts[n]):
                n += 1
        elif k > 0 and (before < 0.0) == (last < 0.0) and abs(last) < min(abs(before), abs(miss)):
            # next to the disc two of them lie closer to each other than is looked
            bend = before - 2.0 * last + miss
            top = low + 0.5 * step * (before - miss) / bend
            value, _, _, _ = _straight_miss(pose, disc, sign, top)
            if (value < 0.0) != (last < 0.0):
                for between in (
                    Bracket(low - step, top, before, value), Bracket(top, high, value, miss)
                ):  # fmt: skip
                    if (
                        n < len(contacts)
                        and _tangent_between(pose, disc, sign, between, contacts[n])
                        and contacts[n, 1] >= 0.0
                    ):
                        n += 1
        before, last = last, miss
    return n


@njit(cache=True, nogil=True)
def next_contact(bearing: float, disc: Disc, course: float, contact: FloatArray) -> bool:
    """From a contact by a turn to its own side and a straight to the next contact on that side.

    Args:
        bearing: of the first contact [rad].
        disc: round a leader that keeps straight.
        course: heading at the first contact [rad].
        contact: takes bearing, turn and straight. shape (3,)

    Returns:
        whether there is one.
    """
    s, c = sine_and_cosine(bearing)
    pose = Pose(disc.distance * c, disc.distance * s, course)
    low = _TO_NEXT
    last, _, _, _ = _straight_miss(pose, disc, disc.side, low)
    for k in range(1, _SCAN // 2):
        high = TWO_PI * k / _SCAN
        miss, _, _, _ = _straight_miss(pose, disc, disc.side, high)
        if (last < 0.0) != (miss < 0.0):
            between = Bracket(low, high, last, miss)
            return _tangent_between(pose, disc, disc.side, between, contact)
        low, last = high, miss
    return False


@njit(cache=True, nogil=True)
def turn_tangent(
    pose: Pose, disc: Disc, sign: float, first: float, second: float
) -> tuple[float, float, float]:
    """Two opposite turns of which the second touches the disc, next to a guess: Newton.

        p·v = 0,    p × v = s δ |v|,    p, v relative to the leader at the end

    Args:
        pose: where the first turn begins, seen from the leader.
        disc: round a leader that keeps straight.
        sign: of the first turn.
        first: guess of the first turn [rad].
        second: and of the second [rad].

    Returns:
        bearing, first and second turn; the turns are NaN if there is none next to the guess.
    """
    alpha, edge = disc.alpha, disc.side * disc.distance
    for _ in range(20):
        mx, my, mh = fly_piece(pose, sign, first)
        qx, qy, qh = fly_piece(Pose(mx, my, mh), -sign, second)
        # the second arc turns with the end of the first one
        along, across = qx - mx, qy - my
        qx -= alpha * (first + second)
        s, c = sine_and_cosine(qh)
        vx, vy = c - alpha, s
        speed = sqrt(vx * vx + vy * vy)
        closing, miss = qx * vx + qy * vy, qx * vy - qy * vx - edge * speed
        if abs(closing) + abs(miss) < 1e-12:
            if 0.0 <= first <= TWO_PI and 0.0 <= second <= TWO_PI:
                return atan2(qy, qx), first, second
            break
        jacobian = np.empty((2, 2))
        for k in range(2):
            turning = sign if k == 0 else -sign
            if k == 0:
                sin_m, cos_m = sine_and_cosine(mh)
                dx, dy = cos_m - alpha - sign * across, sin_m + sign * along
            else:
                dx, dy = vx, vy
            ux, uy = -turning * s, turning * c
            jacobian[0, k] = dx * vx + dy * vy + qx * ux + qy * uy
            jacobian[1, k] = (
                dx * vy - dy * vx + qx * uy - qy * ux - edge * (vx * ux + vy * uy) / speed
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
def boundary_arc_end(ahead: float, left: float, disc: Disc) -> tuple[float, float, float]:
    """Where a boundary arc ends that goes on to the slot by a straight and a turn to its own side.

    Backward in time, with the world turned by π, that is a turn and a straight from the slot (see
    `tangent`).

    Args:
        ahead: how far the leader is ahead of the slot: D, if its route is straight [R].
        left: how far it is to the left of it [R].
        disc: round a leader that keeps straight.

    Returns:
        bearing, straight and turn; the soonest of them. NaN if there is none.
    """
    contacts = np.empty((4, 3))
    n = straight_tangents(Pose(ahead, left, 0.0), mirror_disc(disc), -disc.side, contacts)
    best, at = inf, -1
    for k in range(n):
        if contacts[k, 1] + contacts[k, 2] < best:
            best, at = contacts[k, 1] + contacts[k, 2], k
    if at < 0:
        return np.nan, np.nan, np.nan
    return contacts[at, 0] + pi, contacts[at, 2], contacts[at, 1]


@njit(cache=True, nogil=True)
def slide_between(bearing: float, end: float, disc: Disc) -> tuple[float, float]:
    """A boundary arc from one bearing on to another: its last bearing, unwrapped, and its time."""
    sense = boundary_arc_sense(bearing, disc)
    if sense == 0.0:
        return bearing, inf
    ahead = wrap(sense * (end - bearing))
    if ahead > LONGEST_BOUNDARY_ARC:
        return bearing, inf
    _, took = slide_within(bearing, bearing + sense * ahead, disc, inf)
    return bearing + sense * ahead, took
