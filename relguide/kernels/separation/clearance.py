"""Whether a path keeps its distance from the leader: yes or no, proved, in the slot frame.

The same bound as in `approach`, but it stops at the first point found too close. Lengths in R,
times in R/V_P, angles counter-clockwise. The leader is a table of its pieces, as in `Scene`.
"""

from math import inf
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.borrowed import uncounted
from relguide.kernels.base.norm import norm
from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.sine import sine_and_cosine

SLACK = 1e-6
"""Touching d_min counts as keeping it, to this much of R: 1 cm for an airliner."""
# 10 µm for an airliner [R]: a slot may lie on d_min itself, and where a turn ends there its bound
# falls short by the square of the window
_ROUNDING = 1e-9
_DEPTH = 64
_NARROW = 1e-6  # a window this short that is still undecided counts as too close
_BENT = 0.5  # longer windows are not asked whether d² is convex there [R/V_P]
_MOST_WINDOWS = 32_768  # as does a path that takes more: 1 mm outside the disc takes 10,000


class _Course(NamedTuple):
    """An aircraft on a straight or an arc, with what does not depend on time."""

    x: float
    """Where it begins [R]."""
    y: float
    """[R]."""
    sin_h: float
    """Sine of its heading there …"""
    cos_h: float
    """… and cosine."""
    speed: float
    """[V_P]."""
    rate: float
    """Turn rate [V_P/R]."""


class _State(NamedTuple):
    """Where it is at one time, and how fast."""

    x: float
    """[R]."""
    y: float
    """[R]."""
    vx: float
    """[V_P]."""
    vy: float
    """[V_P]."""


@uncounted
def piece_at(leader: FloatArray, t: float) -> int:
    """The leader's piece at time t."""
    i = 0
    while i + 1 < len(leader) and leader[i + 1, 0] <= t:
        i += 1
    return i


@uncounted
def piece_end(leader: FloatArray, i: int) -> float:
    """When the leader's piece i ends, and the next begins [R/V_P]; infinite if it is the last."""
    return float(leader[i + 1, 0]) if i + 1 < len(leader) else inf


@uncounted
def leader_at(scene: Scene, i: int, t: float) -> Pose:
    """The leader's pose at time t on its piece i."""
    return leader_heading(scene, i, t)[0]


@uncounted
def leader_heading(scene: Scene, i: int, t: float) -> tuple[Pose, float, float]:
    """The same, with sine and cosine of its heading."""
    leader = scene.leader
    x, y, h, rate = leader[i, 1], leader[i, 2], leader[i, 3], leader[i, 4]
    flown = t - leader[i, 0]
    half = 0.5 * rate * flown
    chord = scene.alpha * flown
    half_s, half_c = sine_and_cosine(half)
    if abs(half) > 1e-9:
        chord *= half_s / half
    s, c = sine_and_cosine(h + half)
    there = Pose(x + chord * c, y + chord * s, h + 2.0 * half)
    return there, s * half_c + c * half_s, c * half_c - s * half_s


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
    s, c = sine_and_cosine(pose.h)
    pursuer = _Course(pose.x, pose.y, s, c, 1.0, rate)
    mids = np.empty(_DEPTH)
    halves = np.empty(_DEPTH)
    done = 0.0
    i = piece_at(leader, t)
    looked = 0
    while done < duration:
        end = min(duration, piece_end(leader, i) - t)
        bend = abs(rate) + alpha * abs(leader[i, 4])
        since = t - leader[i, 0]
        s, c = sine_and_cosine(leader[i, 3])
        led = _Course(leader[i, 1], leader[i, 2], s, c, alpha, leader[i, 4])
        mids[0], halves[0] = 0.5 * (done + end), 0.5 * (end - done)
        n = 1
        while n > 0:
            n -= 1
            looked += 1
            mid, half = mids[n], halves[n]
            here, there = _state_on(pursuer, mid), _state_on(led, since + mid)
            dx, dy = here.x - there.x, here.y - there.y
            vx, vy = here.vx - there.vx, here.vy - there.vy
            speed_squared = vx * vx + vy * vy
            at = 0.0
            if speed_squared > 0.0:
                at = -(dx * vx + dy * vy) / speed_squared
            at = min(max(at, -half), half)
            if norm(dx + at * vx, dy + at * vy) - 0.5 * bend * half * half >= limit:
                continue
            here, there = _state_on(pursuer, mid + at), _state_on(led, since + mid + at)
            close = norm(here.x - there.x, here.y - there.y) < limit
            if close or half < _NARROW or n + 2 > _DEPTH or looked > _MOST_WINDOWS:
                return False
            if half < _BENT and _bulges_away(pursuer, led, mid, half, since, limit):
                continue
            mids[n], halves[n] = mid - 0.5 * half, 0.5 * half
            mids[n + 1], halves[n + 1] = mid + 0.5 * half, 0.5 * half
            n += 2
        done = end
        i += 1
    return True


@njit(cache=True, nogil=True)
def _bulges_away(
    pursuer: _Course, led: _Course, mid: float, half: float, since: float, limit: float
) -> bool:
    """Whether d² is convex from half before mid to half behind, and its tangents there stay clear.

    Where a piece touches the disc that is seen at once: the bound by straights is as far inside as
    they are long, squared.

    With the difference Δ of the two, (d²)″/2 = |Δ′|² + Δ·Δ″, and how fast that changes,
    3 Δ′·Δ″ + Δ·Δ‴, is at most 3 (1 + α) (w + αω) + |Δ| (w² + αω²).
    """
    here, there = _state_on(pursuer, mid), _state_on(led, since + mid)
    dx, dy, vx, vy = here.x - there.x, here.y - there.y, here.vx - there.vx, here.vy - there.vy
    ax = led.rate * there.vy - pursuer.rate * here.vy
    ay = pursuer.rate * here.vx - led.rate * there.vx
    bend = abs(pursuer.rate) + led.speed * abs(led.rate)
    jerk, fastest = pursuer.rate * pursuer.rate + led.speed * led.rate * led.rate, 1.0 + led.speed
    farthest = norm(dx, dy) + fastest * half
    convex = vx * vx + vy * vy + dx * ax + dy * ay
    if convex < half * (3.0 * fastest * bend + farthest * jerk):
        return False
    here, there = _state_on(pursuer, mid - half), _state_on(led, since + mid - half)
    dx, dy = here.x - there.x, here.y - there.y
    first = dx * dx + dy * dy - limit * limit
    leaving = dx * (here.vx - there.vx) + dy * (here.vy - there.vy)
    if first < 0.0 or leaving >= 0.0:
        return first >= 0.0
    here, there = _state_on(pursuer, mid + half), _state_on(led, since + mid + half)
    dx, dy = here.x - there.x, here.y - there.y
    last = dx * dx + dy * dy - limit * limit
    coming = dx * (here.vx - there.vx) + dy * (here.vy - there.vy)
    if last < 0.0 or coming <= 0.0:
        return last >= 0.0
    # where the two tangents meet
    meet = (last - first - 4.0 * coming * half) / (2.0 * (leaving - coming))
    return first + 2.0 * leaving * meet >= 0.0


@njit(cache=True, nogil=True, inline="always")
def _state_on(course: _Course, t: float) -> _State:
    """Where an aircraft is on its course after a time: by sine and cosine of half its turn."""
    x, y, sin_h, cos_h, speed, rate = course
    half = 0.5 * rate * t
    s, c, chord = half, 1.0, speed * t
    if abs(half) > 1e-9:
        s, c = sine_and_cosine(half)
        chord *= s / half
    whole_s, whole_c = 2.0 * s * c, 1.0 - 2.0 * s * s
    return _State(
        x + chord * (cos_h * c - sin_h * s),
        y + chord * (sin_h * c + cos_h * s),
        speed * (cos_h * whole_c - sin_h * whole_s),
        speed * (sin_h * whole_c + cos_h * whole_s),
    )


@njit(cache=True, nogil=True)
def fly_rate(pose: Pose, rate: float, t: float) -> Pose:
    """The end of a piece at any turn rate, full bank or less."""
    x, y, h = pose
    s, c = sine_and_cosine(h)
    if abs(rate) < 1e-9:
        return Pose(x + t * c, y + t * s, h)
    end = h + rate * t
    end_s, end_c = sine_and_cosine(end)
    return Pose(x + (end_s - s) / rate, y - (end_c - c) / rate, end)
