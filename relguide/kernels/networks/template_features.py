"""What the template network is given of a situation in which the limit binds.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is at (D/R, 0) at
t = 0 and keeps heading 0.
"""

from math import atan2, cos, hypot, inf, isnan, log, log1p, pi, sin, sqrt

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap
from relguide.kernels.base.records import Disc, Pose, Scene, straight_scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.contact import boundary_arc_rates
from relguide.kernels.contact.touch_points import (
    LONGEST_BOUNDARY_ARC,
    boundary_arc_end,
    mirror_disc,
    straight_tangents,
)
from relguide.kernels.networks.near_guess import from_leader, slot_of
from relguide.kernels.words.branches import FEATURES as FREE_FEATURES
from relguide.kernels.words.branches import branch_of, features
from relguide.kernels.words.extremals import MAX_ROWS, SIGNS, fly_piece, solve

FEATURES = FREE_FEATURES + 78
"""How many numbers `template_features` gives."""
_PARTS = 8  # of a boundary arc, whose time is added up by Simpson's rule


@njit(cache=True, nogil=True)
def template_features(pose: Pose, scene: Scene, free: FloatArray, out: FloatArray) -> None:
    """Where slot and leader are, where simple turns lead, and the best path without the limit.

    And where straights touch the disc, from which a boundary arc would lead on.

    Args:
        pose: the pursuer's, slot frame, not `needs_mirror`; its heading in [0, 2π).
        scene: a leader that keeps straight, α below 1.
        free: the fastest extremal, a row of `solve`. shape (5,)
        out: takes them. shape (FEATURES,)
    """
    features(pose.x, pose.y, pose.h, scene.alpha, out)
    at = FREE_FEATURES
    _write_places(pose, scene, out[at : at + 10])
    _write_passage(pose, 0.0, scene, out[at + 10 : at + 14])
    _write_circles(pose, scene, out[at + 14 : at + 30])
    _write_free(pose, scene, free, out[at + 30 : at + 50])
    _write_boundary_arcs(pose, scene, free[0], out[at + 50 : at + 78])


@njit(cache=True, nogil=True)
def _write_places(pose: Pose, scene: Scene, out: FloatArray) -> None:
    """Where the pursuer is, seen from the leader, and how large everything is. Ten numbers."""
    seen, d_min = from_leader(pose, scene), scene.d_min
    slot = slot_of(scene)
    r = hypot(seen.x, seen.y)
    bearing = atan2(seen.y, seen.x)
    out[0] = log(max(r / d_min, 1e-3))
    out[1] = log1p(max(r - d_min, 0.0))
    out[2] = cos(bearing)
    out[3] = sin(bearing)
    out[4] = cos(pose.h - bearing)
    out[5] = sin(pose.h - bearing)
    out[6] = d_min
    out[7] = log(d_min)
    out[8] = log(slot / d_min)
    out[9] = log(slot)


@njit(cache=True, nogil=True)
def _write_passage(pose: Pose, t: float, scene: Scene, out: FloatArray) -> None:
    """How a straight on from a pose at time t would pass the leader. Four numbers.

    Distance of its closest approach, signed by the side and over d_min, and squashed; whether that
    lies ahead; distance now, over d_min.
    """
    rx, ry = pose.x - slot_of(scene) - scene.alpha * t, pose.y
    vx, vy = cos(pose.h) - scene.alpha, sin(pose.h)
    speed = sqrt(vx * vx + vy * vy) + 1e-9
    miss = (rx * vy - ry * vx) / (speed * scene.d_min)
    ahead = -(rx * vx + ry * vy) / (speed * scene.d_min)
    out[0] = miss / (1.0 + abs(miss))
    out[1] = ahead / (1.0 + abs(ahead))
    out[2] = log(max(hypot(rx, ry) / scene.d_min, 1e-3))
    out[3] = 1.0 / (1.0 + miss * miss)


@njit(cache=True, nogil=True)
def _write_circles(pose: Pose, scene: Scene, out: FloatArray) -> None:
    """The circles of the first turn, left and right, now and half round. Sixteen numbers."""
    rx, d_min = pose.x - slot_of(scene), scene.d_min
    at = 0
    for side in range(2):
        sign = 1.0 - 2.0 * side
        for k in range(2):
            cx = rx - sign * sin(pose.h) - scene.alpha * pi * k
            cy = pose.y + sign * cos(pose.h)
            gap = hypot(cx, cy)
            out[at] = (gap - 1.0) / d_min / (1.0 + gap / d_min)
            out[at + 1] = (gap + 1.0) / d_min / (1.0 + gap / d_min)
            out[at + 2] = cx / (1.0 + gap)
            out[at + 3] = cy / (1.0 + gap)
            at += 4


@njit(cache=True, nogil=True)
def _write_free(pose: Pose, scene: Scene, free: FloatArray, out: FloatArray) -> None:
    """The fastest path without the limit, and how it passes the leader. Twenty numbers."""
    branch = branch_of(free)
    for k in range(8):
        out[k] = 1.0 if k == branch else 0.0
    out[8] = log1p(free[0])
    out[9] = free[2] / TWO_PI
    out[10] = log1p(free[3])
    out[11] = free[4] / TWO_PI
    word = int(free[1])
    after = fly_piece(pose, SIGNS[word, 0], free[2])
    _write_passage(after, free[2], scene, out[12:16])
    after = fly_piece(after, SIGNS[word, 1], free[3])
    _write_passage(after, free[2] + free[3], scene, out[16:20])


@njit(cache=True, nogil=True)
def _write_boundary_arcs(pose: Pose, scene: Scene, free: float, out: FloatArray) -> None:
    """Where a turn and a straight touch the disc, and how late a boundary arc from there would be.

    Seven numbers for each side, and each first turn: whether the straight touches; bearing of the
    contact, turn and straight; whether the boundary arc ends, and how much later than the fastest
    path without the limit, squashed.
    """
    contacts = np.empty((4, 3))
    out[:] = 0.0
    at = 0
    # on the other side all is the mirror image
    left = Disc(scene.alpha, scene.d_min, 1.0, 0.0)
    end, straight, turn = boundary_arc_end(slot_of(scene), 0.0, left)
    for k in range(4):
        side, sign = 1.0 - 2.0 * (k // 2), 1.0 - 2.0 * (k % 2)
        disc = left if side > 0.0 else mirror_disc(left)
        best = -1
        for i in range(straight_tangents(from_leader(pose, scene), disc, sign, contacts)):
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
                took = _rough_slide_time(bearing, side * end, disc)
                if took < inf:
                    late = turned + flown + took + straight + turn - free
                    out[at + 5] = 1.0
                    out[at + 6] = late / (1.0 + abs(late))
        at += 7


@njit(cache=True, nogil=True)
def _rough_slide_time(bearing: float, end: float, disc: Disc) -> float:
    """About how long a boundary arc takes from one bearing on to another; infinite if it cannot be.

    To a thousandth, which `touch_points.slide_between` takes ten times as long to know better.
    """
    rate, _ = boundary_arc_rates(bearing, disc)
    sense = 1.0 if rate > 0.0 else -1.0
    ahead = wrap(sense * (end - bearing))
    if ahead > LONGEST_BOUNDARY_ARC:
        return inf
    total = 0.0
    for k in range(_PARTS + 1):
        there = bearing + sense * ahead * k / _PARTS
        rate, turning = boundary_arc_rates(there, disc)
        if abs(turning) > 1.0 or sense * rate <= 0.0:
            return inf
        weight = 1.0 if k == 0 or k == _PARTS else (4.0 if k % 2 == 1 else 2.0)
        total += weight * sense / rate
    return total * ahead / (3.0 * _PARTS)


@njit(cache=True, nogil=True)
def template_feature_rows(situations: FloatArray, out: FloatArray) -> None:
    """`template_features` of many situations that do not need a mirror (`needs_mirror`).

    Args:
        situations: x, y, h, α, D/R, d_min/R. shape (n, 6)
        out: takes them. shape (n, FEATURES)
    """
    rows = np.empty((MAX_ROWS, 5))
    for n in range(len(situations)):
        x, y, h, alpha, slot, d_min = situations[n]
        pose = Pose(x, y, h)
        solve(pose, alpha, 0.0, rows)
        template_features(pose, straight_scene(alpha, slot, d_min), rows[0], out[n])
