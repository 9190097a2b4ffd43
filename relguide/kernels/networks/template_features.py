"""What a network is told of a situation in which the limit binds.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is at (D/R, 0) at
t = 0 and keeps heading 0.
"""

from math import atan2, cos, hypot, inf, isnan, log, log1p, pi, sin, sqrt

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap
from relguide.kernels.base.records import Disc, Pose
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.contact import boundary_arc_rates
from relguide.kernels.contact.touch_points import (
    LONGEST_BOUNDARY_ARC,
    boundary_arc_end,
    straight_tangents,
)
from relguide.kernels.words.branches import FEATURES as FREE_FEATURES
from relguide.kernels.words.branches import branch_of, features
from relguide.kernels.words.extremals import MAX_ROWS, SIGNS, fly_piece, solve

FEATURES = FREE_FEATURES + 78
"""How many numbers `template_features` gives."""
_PARTS = 8  # of a boundary arc, whose time is added up by Simpson's rule


@njit(cache=True, nogil=True)
def _passing(
    x: float, y: float, h: float, t: float, slot: float, alpha: float, limit: float, out: FloatArray
) -> None:
    """How a straight on from a pose at time t would pass the leader. Takes four numbers.

    Distance of its closest approach, signed by the side and over d_min, and squashed; whether that
    lies ahead; distance now, over d_min.
    """
    rx, ry = x - slot - alpha * t, y
    vx, vy = cos(h) - alpha, sin(h)
    speed = sqrt(vx * vx + vy * vy) + 1e-9
    miss = (rx * vy - ry * vx) / (speed * limit)
    ahead = -(rx * vx + ry * vy) / (speed * limit)
    out[0] = miss / (1.0 + abs(miss))
    out[1] = ahead / (1.0 + abs(ahead))
    out[2] = log(max(hypot(rx, ry) / limit, 1e-3))
    out[3] = 1.0 / (1.0 + miss * miss)


@njit(cache=True, nogil=True)
def _about_riding(bearing: float, end: float, disc: Disc) -> float:
    """About how long a boundary arc takes from one bearing on to another; infinite if it cannot be
    flown.

    To a thousandth, which `touch_points.slide_between` takes ten times as long to know better.
    """
    rate, _ = boundary_arc_rates(bearing, disc)
    way = 1.0 if rate > 0.0 else -1.0
    ahead = wrap(way * (end - bearing))
    if ahead > LONGEST_BOUNDARY_ARC:
        return inf
    total = 0.0
    for k in range(_PARTS + 1):
        there = bearing + way * ahead * k / _PARTS
        rate, turning = boundary_arc_rates(there, disc)
        if abs(turning) > 1.0 or way * rate <= 0.0:
            return inf
        weight = 1.0 if k == 0 or k == _PARTS else (4.0 if k % 2 == 1 else 2.0)
        total += weight * way / rate
    return total * ahead / (3.0 * _PARTS)


@njit(cache=True, nogil=True)
def _riding(
    x: float, y: float, h: float, slot: float, alpha: float, limit: float, free: float,
    out: FloatArray,
) -> None:  # fmt: skip
    """Where a turn and a straight touch the disc, and how late a boundary arc from there on would
    be.

    Takes seven numbers for each side, and each first turn: whether the straight touches; bearing
    of the contact, turn and straight; whether the boundary arc ends, and how much later than the
    fastest way without the limit, squashed.
    """
    contacts = np.empty((4, 3))
    out[:] = 0.0
    at = 0
    # on the other side all is the mirror image
    end, straight, turn = boundary_arc_end(slot, Disc(alpha, limit, 1.0, 0.0))
    for k in range(4):
        side, sign = 1.0 - 2.0 * (k // 2), 1.0 - 2.0 * (k % 2)
        best = -1
        disc = Disc(alpha, limit, side, 0.0)
        for i in range(straight_tangents(Pose(x - slot, y, h), disc, sign, contacts)):
            if best < 0 or contacts[i, 1] + contacts[i, 2] < contacts[best, 1] + contacts[best, 2]:
                best = i
        if best >= 0:
            bearing, turned, flown = contacts[best]
            out[at] = 1.0
            out[at + 1] = cos(bearing)
            out[at + 2] = sin(bearing)
            out[at + 3] = turned / pi - 1.0
            out[at + 4] = log1p(flown)
            if not isnan(end):
                took = _about_riding(bearing, side * end, disc)
                if took < inf:
                    late = turned + flown + took + straight + turn - free
                    out[at + 5] = 1.0
                    out[at + 6] = late / (1.0 + abs(late))
        at += 7


@njit(cache=True, nogil=True)
def template_features(
    x: float, y: float, h: float, slot: float, alpha: float, limit: float, free: FloatArray,
    out: FloatArray,
) -> None:  # fmt: skip
    """Where slot and leader are, where simple turns lead, and the best way without the limit.

    And where straights touch the disc, from which a boundary arc would lead on.

    Args:
        x: pursuer ahead of the slot [R].
        y: and left of it [R]; not `branches.needs_mirror`.
        h: its heading [rad], in [0, 2π).
        slot: D [R].
        alpha: V_L/V_P, below 1.
        limit: d_min [R].
        free: the fastest extremal, a row of `solve`. shape (5,)
        out: takes them. shape (FEATURES,)
    """
    features(x, y, h, alpha, out)
    at = FREE_FEATURES
    rx = x - slot
    r = hypot(rx, y)
    bearing = atan2(y, rx)
    out[at] = log(max(r / limit, 1e-3))
    out[at + 1] = log1p(max(r - limit, 0.0))
    out[at + 2] = cos(bearing)
    out[at + 3] = sin(bearing)
    out[at + 4] = cos(h - bearing)
    out[at + 5] = sin(h - bearing)
    out[at + 6] = limit
    out[at + 7] = log(limit)
    out[at + 8] = log(slot / limit)
    out[at + 9] = log(slot)
    _passing(x, y, h, 0.0, slot, alpha, limit, out[at + 10 : at + 14])
    at += 14
    for side in range(2):
        sign = 1.0 - 2.0 * side
        # the circle of the first turn, now and half round
        for k in range(2):
            cx, cy = rx - sign * sin(h) - alpha * pi * k, y + sign * cos(h)
            gap = hypot(cx, cy)
            out[at] = (gap - 1.0) / limit / (1.0 + gap / limit)
            out[at + 1] = (gap + 1.0) / limit / (1.0 + gap / limit)
            out[at + 2] = cx / (1.0 + gap)
            out[at + 3] = cy / (1.0 + gap)
            at += 4
    kind = branch_of(free)
    for k in range(8):
        out[at + k] = 1.0 if k == kind else 0.0
    out[at + 8] = log1p(free[0])
    out[at + 9] = free[2] / TWO_PI
    out[at + 10] = log1p(free[3])
    out[at + 11] = free[4] / TWO_PI
    at += 12
    word = int(free[1])
    px, py, ph = fly_piece(Pose(x, y, h), SIGNS[word, 0], free[2])
    _passing(px, py, ph, free[2], slot, alpha, limit, out[at : at + 4])
    px, py, ph = fly_piece(Pose(px, py, ph), SIGNS[word, 1], free[3])
    _passing(px, py, ph, free[2] + free[3], slot, alpha, limit, out[at + 4 : at + 8])
    _riding(x, y, h, slot, alpha, limit, free[0], out[at + 8 : at + 36])


@njit(cache=True, nogil=True)
def template_feature_rows(situations: FloatArray, out: FloatArray) -> None:
    """`template_features` of many situations, none of which `needs_mirror`.

    Args:
        situations: x, y, h, α, D/R, d_min/R. shape (n, 6)
        out: takes them. shape (n, FEATURES)
    """
    rows = np.empty((MAX_ROWS, 5))
    for n in range(len(situations)):
        x, y, h, alpha, slot, limit = situations[n]
        solve(Pose(x, y, h), alpha, 0.0, rows)
        template_features(x, y, h, slot, alpha, limit, rows[0], out[n])
