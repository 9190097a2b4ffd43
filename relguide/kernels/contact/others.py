"""All that a path keeps clear of at once: the leader, other traffic, weather cells.

An aircraft is a table of pieces as the leader is, in the slot frame of the leader: contacts with it
and clearance from it are those of the leader, with its speed and its minimum. A cell is a point, or
a convex polygon, with an edge outside that may grow; it moves straight.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf, sin
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from relguide.kernels.base.angles import wrap
from relguide.kernels.base.norm import norm
from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.contact.clear_words import EARLY
from relguide.kernels.separation.cell import signed_distance
from relguide.kernels.separation.clearance import (
    fly_rate,
    leader_at,
    piece_at,
    piece_clears,
    piece_end,
)
from relguide.kernels.words.extremals import SIGNS, fly_piece, solve

_ROUNDING = 1e-9  # as in `piece_clears` [R]
_NARROW = 1e-6  # a window this short that is undecided counts as too close [R/V_P]
_MOST_WINDOWS = 4_096
_DEPTH = 64
_STEP = 1e-3  # how closely times are found while an aircraft turns [R/V_P]
_IN_SLOT = 5e-7  # as near as this to a minimum counts as keeping it, in the slot [R]
_HALVINGS = 50


class Others(NamedTuple):
    """What is kept clear of; the leader is the first."""

    pieces: FloatArray
    """Pieces of all, as in `Scene.leader`: those of one after those of another. shape (·, 5)"""
    first: NDArray[np.int64]
    """Number of the first piece of each, and at last how many pieces there are. shape (n + 1,)"""
    limits: FloatArray
    """Of each: its speed [V_P], its minimum at t = 0 [R], how fast that grows [V_P], and how far
    its corners lie from its place at most [R]. shape (n, 4)"""
    corners: FloatArray
    """Corners of polygons at t = 0, counter-clockwise [R]. shape (·, 2)"""
    corner: NDArray[np.int64]
    """Number of the first corner of each, as `first`. shape (n + 1,)"""
    counted: FloatArray
    """Times between which the minimum counts [R/V_P]. shape (·, 2)"""
    window: NDArray[np.int64]
    """Number of the first such window of each, as `first`. shape (n + 1,)"""
    forbidden: FloatArray
    """Arrivals after which others come too close to the slot: begin and end. shape (·, 2)"""
    alpha: float
    """V_L/V_P."""
    t_release: float
    """When the slot opens [R/V_P]."""
    until: float
    """When a search must have ended, by `clock.now` [s]."""


@njit(cache=True, nogil=True)
def scene_with(others: Others, i: int) -> Scene:
    """The scene in which one of the others takes the leader's place."""
    table = others.pieces[others.first[i] : others.first[i + 1]]
    return Scene(table, others.limits[i, 0], others.limits[i, 1], 0.0, others.until)


@njit(cache=True, nogil=True)
def is_disc(others: Others, i: int) -> bool:
    """Whether it is a disc that does not grow, as aircraft are."""
    return bool(others.limits[i, 2] == 0.0 and others.corner[i] == others.corner[i + 1])


@njit(cache=True, nogil=True)
def counts_at(others: Others, i: int, t: float) -> bool:
    """Whether the minimum of one of them counts at that time."""
    for w in range(others.window[i], others.window[i + 1]):
        if others.counted[w, 0] <= t <= others.counted[w, 1]:
            return True
    return False


@njit(cache=True, nogil=True)
def place_at(others: Others, i: int, t: float) -> tuple[float, float]:
    """Where one of the others is at time t [R]."""
    p = others.first[i]
    while p + 1 < others.first[i + 1] and others.pieces[p + 1, 0] <= t:
        p += 1
    flown = t - others.pieces[p, 0]
    half, chord = 0.5 * others.pieces[p, 4] * flown, others.limits[i, 0] * flown
    if abs(half) > 1e-9:
        chord *= sin(half) / half
    s, c = sine_and_cosine(others.pieces[p, 3] + half)
    return others.pieces[p, 1] + chord * c, others.pieces[p, 2] + chord * s


@njit(cache=True, nogil=True)
def broken_by(pose: Pose, rate: float, t: float, duration: float, others: Others) -> int:
    """One of the others that a piece comes too close to; −1 if it keeps clear of all.

    Args:
        pose: where the piece begins.
        rate: +1 left, −1 right, 0 straight.
        t: when [R/V_P].
        duration: how long it is [R/V_P].
        others: what it keeps clear of.
    """
    half = 0.5 * duration
    s, c = sine_and_cosine(pose.h)
    # the piece lies in this circle
    if rate == 0.0:
        x, y, reach = pose.x + half * c, pose.y + half * s, half
    else:
        x, y, reach = pose.x - rate * s, pose.y + rate * c, 1.0
    for i in range(len(others.limits)):
        speed, limit, growth = others.limits[i, 0], others.limits[i, 1], others.limits[i, 2]
        near = limit + others.limits[i, 3] + growth * (t + duration) + reach + speed * half
        there_x, there_y = place_at(others, i, t + half)
        if norm(x - there_x, y - there_y) >= near:
            continue
        scene = scene_with(others, i)
        for w in range(others.window[i], others.window[i + 1]):
            begin = max(others.counted[w, 0], t)
            end = min(others.counted[w, 1], t + duration)
            if begin > end:
                continue
            here = pose if begin == t else fly_rate(pose, rate, begin - t)
            if not _clears(here, rate, begin, end - begin, others, i, scene):
                return i
    return -1


@njit(cache=True, nogil=True)
def _clears(
    pose: Pose, rate: float, t: float, duration: float, others: Others, i: int, scene: Scene
) -> bool:
    """Whether a piece keeps clear of one of the others."""
    growth, a, b = others.limits[i, 2], others.corner[i], others.corner[i + 1]
    if a == b and rate == 0.0 and len(scene.leader) == 1:
        s, c = sine_and_cosine(pose.h)
        ls, lc = sine_and_cosine(scene.leader[0, 3])
        vx, vy = c - scene.alpha * lc, s - scene.alpha * ls
        dx = pose.x - scene.leader[0, 1] - scene.alpha * lc * t
        dy = pose.y - scene.leader[0, 2] - scene.alpha * ls * t
        limit = scene.d_min + growth * t - _ROUNDING
        return _straight_clears(dx, dy, vx, vy, limit, growth, duration)
    if a == b and growth == 0.0:
        return piece_clears(pose, rate, t, duration, scene)
    return _cell_clears(pose, rate, t, duration, others, i, scene)


@njit(cache=True, nogil=True)
def _straight_clears(
    dx: float, dy: float, vx: float, vy: float, limit: float, growth: float, duration: float
) -> bool:
    """Whether |Δ + v τ|² ≥ (limit + growth τ)² for all τ in [0, duration]."""
    square = vx * vx + vy * vy - growth * growth
    slope = dx * vx + dy * vy - limit * growth
    here = dx * dx + dy * dy - limit * limit
    if here < 0.0 or here + duration * (2.0 * slope + duration * square) < 0.0:
        return False
    if square <= 0.0 or not 0.0 < -slope < square * duration:
        return True
    return here - slope * slope / square >= 0.0


@njit(cache=True, nogil=True)
def _from_cell(x: float, y: float, t: float, others: Others, i: int, scene: Scene) -> FloatArray:
    """`signed_distance` of a place from a disc or a cell at time t."""
    limit = others.limits[i, 1] + others.limits[i, 2] * t
    a, b = others.corner[i], others.corner[i + 1]
    if a == b:
        there = leader_at(scene, piece_at(scene.leader, t), t)
        return signed_distance(x - there.x, y - there.y, np.zeros((1, 2)), limit)
    s, c = sine_and_cosine(scene.leader[0, 3])
    moved = scene.alpha * t
    return signed_distance(x - moved * c, y - moved * s, others.corners[a:b], limit)


@njit(cache=True, nogil=True)
def _cell_clears(
    pose: Pose, rate: float, t: float, duration: float, others: Others, i: int, scene: Scene
) -> bool:
    """As `piece_clears`, for a cell: the bound is that of `least_from_cell`."""
    growth = others.limits[i, 2]
    s, c = sine_and_cosine(scene.leader[0, 3])
    cell_vx, cell_vy = scene.alpha * c, scene.alpha * s
    mids, halves = np.empty(_DEPTH), np.empty(_DEPTH)
    mids[0], halves[0] = 0.5 * duration, 0.5 * duration
    n, looked = 1, 0
    while n > 0:
        n -= 1
        looked += 1
        mid, half = mids[n], halves[n]
        here = fly_rate(pose, rate, mid)
        far, nx, ny = _from_cell(here.x, here.y, t + mid, others, i, scene)
        if far < -_ROUNDING:
            return False
        s, c = sine_and_cosine(here.h)
        closing = nx * (c - cell_vx) + ny * (s - cell_vy) - growth
        if far - abs(closing) * half - 0.5 * abs(rate) * half * half >= -_ROUNDING:
            continue
        if half < _NARROW or n + 2 > _DEPTH or looked > _MOST_WINDOWS:
            return False
        mids[n], halves[n] = mid - 0.5 * half, 0.5 * half
        mids[n + 1], halves[n + 1] = mid + 0.5 * half, 0.5 * half
        n += 2
    return True


@njit(cache=True, nogil=True)
def word_broken_by(pose: Pose, t: float, row: FloatArray, others: Others) -> int:
    """One of the others that a row of `solve`, flown from time t, comes too close to, or −1."""
    word = int(row[1])
    for k in range(3):
        sign, amount = SIGNS[word, k], row[2 + k]
        if amount <= 0.0:
            continue
        broken = broken_by(pose, sign, t, amount, others)
        if broken >= 0:
            return broken
        pose = fly_piece(pose, sign, amount)
        t += amount
    return -1


@njit(cache=True, nogil=True)
def may_arrive_at(time: float, others: Others) -> bool:
    """Whether the slot is open then, and nothing comes too close to it after that."""
    if time < others.t_release - EARLY:
        return False
    for k in range(len(others.forbidden)):
        if others.forbidden[k, 0] < time < others.forbidden[k, 1]:
            return False
    return True


@njit(cache=True, nogil=True)
def words_to_slot(pose: Pose, t: float, others: Others, rows: FloatArray) -> int:
    """All extremals from a pose at time t to the slot, as `solve` gives them: how many."""
    seen = Pose(pose.x - others.alpha * t, pose.y, wrap(pose.h))
    return solve(seen, others.alpha, max(others.t_release - t, 0.0), rows)


@njit(cache=True, nogil=True)
def first_clear_of_all(
    pose: Pose, t: float, rows: FloatArray, others: Others, beat: float
) -> tuple[float, int]:
    """The first of the rows of `solve`, flown from time t, that keeps clear of all.

    Returns:
        arrival time and its number; infinite and −1 if none arrives before `beat`.
    """
    for k in range(len(rows)):
        arrival = t + rows[k, 0]
        if arrival >= beat:
            break
        if may_arrive_at(arrival, others) and word_broken_by(pose, t, rows[k], others) < 0:
            return arrival, k
    return inf, -1


@njit(cache=True, nogil=True)
def forbidden_arrivals(others: Others, follow: float, horizon: float) -> FloatArray:
    """Arrivals after which one of the others comes too close to the slot: `Others.forbidden`.

    Args:
        others: what is kept clear of; the leader keeps its own distance from the slot.
        follow: how long after arriving the slot must stay clear [R/V_P].
        horizon: later arrivals do not matter [R/V_P].
    """
    found, n = np.empty((64, 2)), 0
    for i in range(1, len(others.limits)):
        scene = scene_with(others, i)
        for p in range(len(scene.leader)):
            begin = scene.leader[p, 0]
            end = min(piece_end(scene.leader, p), horizon + follow)
            low = begin
            while low < end:
                turns, high = scene.leader[p, 4] != 0.0, end
                if turns:
                    # it stays clear until then at least
                    ahead = _slot_from(low, others, i, scene) / (others.alpha + scene.alpha)
                    high = min(low + max(ahead, _STEP), end)
                    if ahead >= _STEP:
                        low = high
                        continue
                close = (low, high) if turns else _close_between(low, high, others, i, scene)
                low = high
                for w in range(others.window[i], others.window[i + 1]):
                    first = max(close[0], others.counted[w, 0])
                    last = min(close[1], others.counted[w, 1])
                    if first >= last:
                        continue
                    if n > 0 and found[n - 1, 0] <= first - follow <= found[n - 1, 1]:
                        found[n - 1, 1] = max(found[n - 1, 1], last)
                        continue
                    if n == len(found):
                        found = np.concatenate((found, np.empty_like(found)))
                    found[n, 0], found[n, 1] = first - follow, last
                    n += 1
    return found[:n].copy()


@njit(cache=True, nogil=True)
def _close_between(
    low: float, high: float, others: Others, i: int, scene: Scene
) -> tuple[float, float]:
    """From when until when the slot is too close to one that flies straight; empty if never."""
    # the distance from a convex shape that moves straight is a convex function of time
    a, b = low, high
    for _ in range(2 * _HALVINGS):
        first, second = a + (b - a) / 3.0, b - (b - a) / 3.0
        if _slot_from(first, others, i, scene) <= _slot_from(second, others, i, scene):
            b = second
        else:
            a = first
    nearest = 0.5 * (a + b)
    if _slot_from(nearest, others, i, scene) >= 0.0:
        return high, low
    begin, end = low, high
    if _slot_from(low, others, i, scene) >= 0.0:
        begin = _edge(low, nearest, others, i, scene)
    if _slot_from(high, others, i, scene) >= 0.0:
        end = _edge(high, nearest, others, i, scene)
    return begin, end


@njit(cache=True, nogil=True)
def _edge(outside: float, inside: float, others: Others, i: int, scene: Scene) -> float:
    """When the slot comes too close, between a time when it is clear and one when it is not."""
    for _ in range(_HALVINGS):
        middle = 0.5 * (outside + inside)
        if _slot_from(middle, others, i, scene) >= 0.0:
            outside = middle
        else:
            inside = middle
    return outside


@njit(cache=True, nogil=True)
def _slot_from(t: float, others: Others, i: int, scene: Scene) -> float:
    """How far the slot is from too close to one of the others at time t [R]."""
    return float(_from_cell(others.alpha * t, 0.0, t, others, i, scene)[0] + _IN_SLOT)
