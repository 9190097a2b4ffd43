"""Whether a path keeps its distance from the leader: yes or no, proved, in the slot frame.

The same bound as in `approach`, but it stops at the first point found too close. Lengths in R,
times in R/V_P, angles counter-clockwise. The leader is a table of its pieces, as in `Scene`.
"""

from math import cos, hypot, inf, sin

import numpy as np
from numba import njit

from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.roots import FloatArray

SLACK = 1e-6
"""Touching d_min counts as keeping it, to this much of R: 1 cm for an airliner."""
# 10 µm for an airliner [R]: a slot may lie on d_min itself, and where a turn ends there its bound
# falls short by the square of the window
_ROUNDING = 1e-9
_DEPTH = 64
_NARROW = 1e-6  # a window this short that is still undecided counts as too close
_MOST_WINDOWS = 32_768  # as does a path that takes more: 1 mm outside the disc takes 10,000


@njit(cache=True, nogil=True)
def piece_at(leader: FloatArray, t: float) -> int:
    """The leader's piece at time t."""
    i = 0
    while i + 1 < len(leader) and leader[i + 1, 0] <= t:
        i += 1
    return i


@njit(cache=True, nogil=True)
def piece_end(leader: FloatArray, i: int) -> float:
    """When the leader's piece i ends, and the next begins [R/V_P]; infinite if it is the last."""
    return float(leader[i + 1, 0]) if i + 1 < len(leader) else inf


@njit(cache=True, nogil=True)
def leader_at(scene: Scene, i: int, t: float) -> Pose:
    """The leader's pose at time t on its piece i."""
    leader = scene.leader
    x, y, h, rate = leader[i, 1], leader[i, 2], leader[i, 3], leader[i, 4]
    flown = t - leader[i, 0]
    half = 0.5 * rate * flown
    chord = scene.alpha * flown
    if abs(half) > 1e-9:
        chord *= sin(half) / half
    return Pose(x + chord * cos(h + half), y + chord * sin(h + half), h + 2.0 * half)


@njit(cache=True, nogil=True)
def piece_clears(pose: Pose, rate: float, t: float, duration: float, scene: Scene) -> bool:
    """Whether one piece keeps d_min, to 1e-9 R.

    Args:
        pose: where it starts.
        rate: turn rate: ±1 at full bank, 0 straight, or between.
        t: start time [R/V_P].
        duration: of the piece [R/V_P].
        scene: the leader and d_min.
    """
    leader, alpha, limit = scene.leader, scene.alpha, scene.d_min - _ROUNDING
    mids = np.empty(_DEPTH)
    halves = np.empty(_DEPTH)
    done = 0.0
    i = piece_at(leader, t)
    looked = 0
    while done < duration:
        end = min(duration, piece_end(leader, i) - t)
        bend = abs(rate) + alpha * abs(leader[i, 4])
        mids[0], halves[0] = 0.5 * (done + end), 0.5 * (end - done)
        n = 1
        while n > 0:
            n -= 1
            looked += 1
            mid, half = mids[n], halves[n]
            px, py, ph = fly_rate(pose, rate, mid)
            lx, ly, lh = leader_at(scene, i, t + mid)
            dx, dy = px - lx, py - ly
            vx, vy = cos(ph) - alpha * cos(lh), sin(ph) - alpha * sin(lh)
            speed_squared = vx * vx + vy * vy
            at = 0.0
            if speed_squared > 0.0:
                at = -(dx * vx + dy * vy) / speed_squared
            at = min(max(at, -half), half)
            if hypot(dx + at * vx, dy + at * vy) - 0.5 * bend * half * half >= limit:
                continue
            px, py, ph = fly_rate(pose, rate, mid + at)
            lx, ly, lh = leader_at(scene, i, t + mid + at)
            close = hypot(px - lx, py - ly) < limit
            if close or half < _NARROW or n + 2 > _DEPTH or looked > _MOST_WINDOWS:
                return False
            mids[n], halves[n] = mid - 0.5 * half, 0.5 * half
            mids[n + 1], halves[n + 1] = mid + 0.5 * half, 0.5 * half
            n += 2
        done = end
        i += 1
    return True


@njit(cache=True, nogil=True)
def fly_rate(pose: Pose, rate: float, t: float) -> Pose:
    """The end of a piece at any turn rate, full bank or less."""
    x, y, h = pose
    if abs(rate) < 1e-9:
        return Pose(x + t * cos(h), y + t * sin(h), h)
    end = h + rate * t
    return Pose(x + (sin(end) - sin(h)) / rate, y - (cos(end) - cos(h)) / rate, end)
