"""What the network of turning leaders is given of a situation in which the limit binds.

The numbers of the situation; all that `template_features` says, as if the leader had been on its
final leg all along; where the leader is at some moments, seen from the pursuer; how the fastest
path of each branch passes it, and the simplest paths; and where two pieces touch the disc.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import atan2, cos, hypot, inf, log, log1p, pi, sin, sqrt
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import wrap
from relguide.kernels.base.records import Pose, Scene, start_at, straight_scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.networks.near_guess import slot_of
from relguide.kernels.networks.template_features import FEATURES as ON_FINAL_LEG
from relguide.kernels.networks.template_features import template_features
from relguide.kernels.networks.turning_leader import NUMBERS, bound_without_limit, turning_scene
from relguide.kernels.separation.clearance import leader_at, piece_at
from relguide.kernels.words.branches import SIZE as BRANCHES
from relguide.kernels.words.branches import TO_POINT, branch_of
from relguide.kernels.words.extremals import MAX_ROWS, SIGNS, fly_piece
from relguide.kernels.words.to_point import word_from

_MOMENTS = 7  # at which it is said where the leader is: now, along its turn, as the slot opens
_GRID = 48  # moments at which paths are compared with the leader
_TURNS = 24  # sizes of a first turn: every 15°
_PER_MOMENT, _PER_BRANCH, _PER_PASSAGE, _PER_TOUCH = 8, 8, 5, 6
_GENERAL = 16
FEATURES = (
    ON_FINAL_LEG
    + _GENERAL
    + _PER_MOMENT * _MOMENTS
    + (_PER_BRANCH + 1) * BRANCHES
    + 3 * _PER_PASSAGE
    + 8 * _PER_TOUCH
)
"""How many numbers `turn_features` gives."""


class _Track(NamedTuple):
    """Where the leader is at moments of even steps from t = 0."""

    step: float
    """[R/V_P]."""
    poses: FloatArray
    """x, y, heading, its sine and cosine. shape (_GRID, 5)"""


@njit(cache=True, nogil=True)
def turn_features(
    pose: Pose, scene: Scene, numbers: FloatArray, rows: FloatArray, found: int,
    at_release: bool, out: FloatArray,
) -> None:  # fmt: skip
    """Everything that the network is given.

    Args:
        pose: the pursuer's, its heading in [0, 2π).
        scene: of `turning_scene`.
        numbers: the situation's. shape (NUMBERS,)
        rows: the extremals that arrive once the slot is open, fastest first. shape (MAX_ROWS, 5)
        found: how many they are, 1 or more.
        at_release: whether the slot can be reached just as it opens.
        out: takes them. shape (FEATURES,)
    """
    on_final_leg = straight_scene(scene.alpha, slot_of(scene), scene.d_min)
    template_features(pose, on_final_leg, rows[0], out)
    at = ON_FINAL_LEG
    _write_general(scene, numbers, at_release, out[at : at + _GENERAL])
    at += _GENERAL
    _write_moments(pose, scene, numbers, out[at : at + _PER_MOMENT * _MOMENTS])
    at += _PER_MOMENT * _MOMENTS
    longest = rows[0, 0]
    for k in range(found):
        if rows[k, 0] < scene.t_release + 8.0:
            longest = max(longest, rows[k, 0])
    track = _track_of(scene, longest / (_GRID - 1))
    size = (_PER_BRANCH + 1) * BRANCHES
    _write_branches(pose, scene, rows[:found], track, out[at : at + size])
    at += size
    track = _track_of(scene, max(scene.t_release, 6.0) / (_GRID - 1))
    for k in range(3):
        _write_passage(pose, scene, 1.0 - k, track, out[at : at + _PER_PASSAGE])
        at += _PER_PASSAGE
    _write_touches(pose, scene, track, out[at:])


@njit(cache=True, nogil=True)
def _squash(value: float) -> float:
    return value / (1.0 + abs(value))


@njit(cache=True, nogil=True)
def _write_general(scene: Scene, numbers: FloatArray, at_release: bool, out: FloatArray) -> None:
    """How large everything is, and when. Sixteen numbers."""
    _, _, _, alpha, limit, ahead, left, lead, turn, rate, hold = numbers
    out[0], out[1] = log(limit), limit
    out[2], out[3] = ahead / limit, left / limit
    out[4], out[5] = log1p(lead), 1.0 if lead > 0.0 else 0.0
    out[6], out[7], out[8] = turn / pi - 1.0, cos(turn), sin(turn)
    out[9], out[10] = log(rate), alpha / rate
    out[11], out[12] = log1p(turn / rate), log1p(hold)
    out[13], out[14] = log1p(scene.t_release), 1.0 if at_release else 0.0
    # how fast the leader's turn sweeps past who slides along the disc
    out[15] = rate * limit


@njit(cache=True, nogil=True)
def _write_moments(pose: Pose, scene: Scene, numbers: FloatArray, out: FloatArray) -> None:
    """Where the leader is, seen from the pursuer, at some moments. Eight numbers each."""
    lead, turning = numbers[7], numbers[8] / numbers[9]
    for k in range(_MOMENTS):
        if k == 0:
            t = 0.0
        elif k < _MOMENTS - 1:
            t = lead + turning * (k - 1) / (_MOMENTS - 3)
        else:
            t = scene.t_release
        at = leader_at(scene, piece_at(scene.leader, t), t)
        dx, dy = at.x - pose.x, at.y - pose.y
        r = hypot(dx, dy)
        bearing = atan2(dy, dx)
        i = _PER_MOMENT * k
        out[i] = log(max(r / scene.d_min, 1e-3))
        out[i + 1] = _squash(r - scene.d_min - t)
        out[i + 2], out[i + 3] = cos(bearing - pose.h), sin(bearing - pose.h)
        out[i + 4], out[i + 5] = cos(at.h - bearing), sin(at.h - bearing)
        out[i + 6], out[i + 7] = _squash(dx / scene.d_min), _squash(dy / scene.d_min)


@njit(cache=True, nogil=True)
def _track_of(scene: Scene, step: float) -> _Track:
    poses = np.empty((_GRID, 5))
    for k in range(_GRID):
        at = leader_at(scene, piece_at(scene.leader, k * step), k * step)
        poses[k, 0], poses[k, 1], poses[k, 2] = at
        poses[k, 3], poses[k, 4] = sin(at.h), cos(at.h)
    return _Track(step, poses)


@njit(cache=True, nogil=True)
def _write_branches(
    pose: Pose, scene: Scene, rows: FloatArray, track: _Track, out: FloatArray
) -> None:
    """The fastest path of each branch to the open slot: how late, and how it passes the leader.

    Eight numbers each; then how much too long the word to where the slot opens is.
    """
    out[:] = 0.0
    seen = np.zeros(BRANCHES)
    for k in range(len(rows)):
        branch = branch_of(rows[k])
        if seen[branch] > 0.0:
            continue
        seen[branch] = 1.0
        i = _PER_BRANCH * branch
        out[i], out[i + 1] = 1.0, _squash(rows[k, 0] - rows[0, 0])
        _write_closest(pose, scene, rows[k], track, out[i + 2 : i + _PER_BRANCH])
    start, piece, at = start_at(pose), np.empty(3), _PER_BRANCH * BRANCHES
    for branch in TO_POINT:
        length = word_from(start, scene.alpha * scene.t_release, branch, piece)
        out[at + branch] = _squash(length - scene.t_release) if length >= 0.0 else 1.5


@njit(cache=True, nogil=True)
def _write_closest(
    pose: Pose, scene: Scene, row: FloatArray, track: _Track, out: FloatArray
) -> None:
    """How near a word comes, when, where and on which side. Six numbers."""
    word, piece, begun = int(row[1]), 0, 0.0
    least, least_t = inf, 0.0
    x, y, side = 0.0, 0.0, 0.0
    for k in range(_GRID):
        t = k * track.step
        if t > row[0]:
            break
        while piece < 2 and t > begun + row[2 + piece]:
            pose = fly_piece(pose, SIGNS[word, piece], row[2 + piece])
            begun += row[2 + piece]
            piece += 1
        here = fly_piece(pose, SIGNS[word, piece], t - begun)
        dx, dy = here.x - track.poses[k, 0], here.y - track.poses[k, 1]
        d = sqrt(dx * dx + dy * dy)
        if d < least:
            least, least_t, x, y = d, t, dx, dy
            vx = cos(here.h) - scene.alpha * track.poses[k, 4]
            vy = sin(here.h) - scene.alpha * track.poses[k, 3]
            side = dx * vy - dy * vx
    bearing = atan2(y, x) - leader_at(scene, piece_at(scene.leader, least_t), least_t).h
    out[0] = least / scene.d_min - 1.0 if least < 2.0 * scene.d_min else 1.0
    out[1] = 0.25 * least_t
    out[2], out[3] = cos(bearing), sin(bearing)
    out[4] = _squash(side)
    out[5] = least_t / row[0]


@njit(cache=True, nogil=True)
def _write_passage(pose: Pose, scene: Scene, sign: float, track: _Track, out: FloatArray) -> None:
    """How a turn, or a straight, comes near: first breach of the limit and closest approach.

    Five numbers.
    """
    breach, least, least_t, x, y = -1.0, inf, 0.0, 0.0, 0.0
    for k in range(_GRID):
        t = k * track.step
        here = fly_piece(pose, sign, t)
        dx, dy = here.x - track.poses[k, 0], here.y - track.poses[k, 1]
        d = sqrt(dx * dx + dy * dy)
        if d < least:
            least, least_t, x, y = d, t, dx, dy
        if d < scene.d_min:
            breach = t
            break
    bearing = atan2(y, x)
    out[0] = 1.0 if breach >= 0.0 else 0.0
    out[1] = _squash(least / scene.d_min - 1.0)
    out[2] = 0.25 * least_t
    out[3], out[4] = cos(bearing), sin(bearing)


@njit(cache=True, nogil=True)
def _write_touches(pose: Pose, scene: Scene, track: _Track, out: FloatArray) -> None:
    """Where a turn and a straight, or a turn the other way, touch the disc first.

    Six numbers for each first turn, second piece and side: whether they do, the first turn, the
    time, bearing of the contact from the leader's heading, and which of them comes from nearer.
    """
    out[:] = 0.0
    closest = np.empty((2, 3))
    at = 0
    for k in range(4):
        sign = 1.0 - 2.0 * (k % 2)
        other = 0.0 if k < 2 else -sign
        last = np.nan
        for j in range(_TURNS):
            first = 2.0 * pi * j / _TURNS
            new, old = closest[j % 2], closest[1 - j % 2]
            gap = _closest_after(pose, scene, sign, first, other, track, new)
            # signed by the side on which the leader is passed: a zero of either is a contact
            for side in range(2):
                i = at + _PER_TOUCH * side
                edge = scene.d_min * (1.0 - 2.0 * side)
                if out[i] > 0.0 or last != last or gap != gap:
                    continue
                before, after = last - edge, gap - edge
                if before * after < 0.0 and abs(before - after) < 2.0 * scene.d_min:
                    share = before / (before - after)
                    out[i] = 1.0
                    out[i + 1] = (first - 2.0 * pi / _TURNS * (1.0 - share)) / pi - 1.0
                    out[i + 2] = 0.25 * (old[0] + share * (new[0] - old[0]))
                    bearing = old[1] + share * (wrap(new[1] - old[1] + pi) - pi)
                    out[i + 3], out[i + 4] = cos(bearing), sin(bearing)
                    out[i + 5] = 1.0 if after > before else -1.0
            last = gap
        at += 2 * _PER_TOUCH


@njit(cache=True, nogil=True)
def _closest_after(
    pose: Pose, scene: Scene, sign: float, first: float, other: float, track: _Track,
    closest: FloatArray,
) -> float:  # fmt: skip
    """The closest approach of a second piece, signed by the side; NaN if it never comes nearer.

    `closest` takes its time and the bearing from the leader's heading there.
    """
    begin = fly_piece(pose, sign, first)
    least, when, x, y, side, bearing = inf, -1, 0.0, 0.0, 0.0, 0.0
    k0 = int(first / track.step) + 1
    # a second turn is looked at for one round, with sine and cosine by addition
    h = begin.h + other * (k0 * track.step - first)
    s, c = sin(h), cos(h)
    ds, dc = sin(other * track.step), cos(other * track.step)
    begin_s, begin_c = sin(begin.h), cos(begin.h)
    rising = 0
    for k in range(k0, _GRID):
        flown = k * track.step - first
        if other == 0.0:
            px, py = begin.x + flown * begin_c, begin.y + flown * begin_s
        else:
            if flown > 2.0 * pi:
                break
            px = begin.x + other * (s - begin_s)
            py = begin.y - other * (c - begin_c)
        dx, dy = px - track.poses[k, 0], py - track.poses[k, 1]
        d = sqrt(dx * dx + dy * dy)
        if d < least:
            least, when, x, y, rising = d, k, dx, dy, 0
            vx, vy = c - scene.alpha * track.poses[k, 4], s - scene.alpha * track.poses[k, 3]
            side = dx * vy - dy * vx
            bearing = track.poses[k, 2]
        else:
            rising += 1
            if rising > 2:
                break
        if other != 0.0:
            s, c = s * dc + c * ds, c * dc - s * ds
    if when < 0 or when == k0:
        return np.nan
    closest[0], closest[1] = when * track.step, atan2(y, x) - bearing
    return least if side > 0.0 else -least


@njit(cache=True, nogil=True)
def turn_feature_rows(situations: FloatArray, out: FloatArray) -> None:
    """`turn_features` of many situations; zeros where no extremal reaches the slot.

    Args:
        situations: as in `turning_leader`. shape (n, NUMBERS)
        out: takes them. shape (n, FEATURES)
    """
    rows = np.empty((MAX_ROWS, 5))
    numbers = np.empty(NUMBERS)
    for n in range(len(situations)):
        numbers[:] = situations[n]
        pose, scene = turning_scene(numbers)
        bound = bound_without_limit(pose, scene, rows)
        out[n] = 0.0
        if bound.found > 0:
            turn_features(pose, scene, numbers, rows, bound.found, bound.at_release, out[n])
