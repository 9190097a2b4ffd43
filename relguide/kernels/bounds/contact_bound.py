"""How soon a path can arrive that touches d = d_min somewhere in a cell of contacts: proved.

A contact is fixed by its time t, its bearing b and a side (see `contact`). A cell holds those with
a bearing in b ± w, in a window of time on one piece of the leader's intent. A path whose first
contact lies in it takes at least as long as the soonest word to any of its poses, and then as the
soonest word from any of its poses on (see `word_bound`). Words that certainly break the limit on
the way lead to no first contact, nor to the slot from a last one. Between the first contact and the
last, whatever happens, a path takes at least as long as the soonest word from pose to pose, and as
something that need not turn takes round the disc: a boundary arc comes as close to that as it can.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise. Contacts lie at d_min itself.
"""

from math import acos, cos, hypot, inf, pi, sin, sqrt
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap
from relguide.kernels.base.records import Pose, Scene, Velocity, Window, with_limit
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.breach import MOST_LOOKS, NearWord, Sieve, breaks_limit
from relguide.kernels.bounds.word_bound import Blur, soonest
from relguide.kernels.contact.contact import contact_heading, to_frame_of
from relguide.kernels.separation.clearance import leader_at, piece_at
from relguide.kernels.words.extremals import MAX_ROWS, SIGNS, fly_piece, solve

_EDGE = 1e-9
"""What rounding may do to a time or a heading; and a leader within this of V_P counts as faster."""
_INSIDE = 2e-6
"""A path must come this much closer than d_min to count as breaking it [R]: 2 cm at R = 12 km."""
_FAST = 0.999  # for a leader faster than this the time round the disc is not bounded
_ROUND = 16_384
"""Points of `times_round`: every 0.02°."""
_ROUND_SLACK = 1e-6
"""What is between two points of it may differ by, as part of a whole round: ten times the square of
the step, which is more than the curvature makes of it."""
_LOOP_STRIDE = 0.01  # from one look to the next where there may be a loop [R/V_P]
_STRIDE = 1e-4  # least step of the look for a breach on a path that is known [R/V_P]
_ORIGIN = Pose(0.0, 0.0, 0.0)


class Cell(NamedTuple):
    """Contacts: a window of bearings, and of time, on one piece of the leader's intent and a side.

    The bearings lie in no more than one quadrant.
    """

    piece: int
    """As in `Contact`."""
    side: float
    """As in `Contact`."""
    bearing: float
    """Middle of the window [rad]."""
    half: float
    """Half of its width [rad]."""
    start: float
    """Of the window of time, within the piece [R/V_P]."""
    end: float
    """Of that window; infinite only on the final leg [R/V_P]."""


class Goal(NamedTuple):
    """Where a path is to arrive, on heading 0."""

    x: float
    """At t = 0, on the x axis [R]."""
    speed: float
    """Along it [V_P]: α for the slot, 0 for a place."""


class Spread(NamedTuple):
    """The poses of a cell's contacts, relative to the leader."""

    heading: float
    """Of the middle [rad]."""
    differs: float
    """How much others may differ [rad]; infinite if there is no contact."""
    left: float
    """How far the centre of their left circles may lie from the middle's [R]."""
    right: float
    """And that of their right circles [R]."""


@njit(cache=True, nogil=True)
def contacts_within(cell: Cell, alpha: float, d_min: float) -> Spread:
    """The contacts of a cell."""
    bearing, half, side = cell.bearing, cell.half, cell.side
    low, high = alpha * cos(bearing - half), alpha * cos(bearing + half)
    if alpha > 1.0 - _EDGE:
        # not every bearing can be touched, and the heading may change without bound
        if min(low, high) > 1.0 or max(low, high) < -1.0:
            return Spread(0.0, inf, inf, inf)
        first, second = acos(min(max(low, -1.0), 1.0)), acos(min(max(high, -1.0), 1.0))
        differs = half + 0.5 * abs(first - second)
        blur = d_min * half + differs
        return Spread(bearing + side * 0.5 * (first + second), differs, blur, blur)
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
            mixed = 2.0 * d_min * rate * side * sqrt(1.0 - across * across)
            left = max(left, d_min * d_min - mixed + rate * rate)
            right = max(right, d_min * d_min + mixed + rate * rate)
    return Spread(heading, differs, half * sqrt(max(left, 0.0)), half * sqrt(max(right, 0.0)))


@njit(cache=True, nogil=True)
def cell_bound(
    start: Pose, scene: Scene, goal: Goal, cell: Cell, beat: float
) -> tuple[float, float]:
    """How soon a path can be at a contact of the cell, its first, and how soon at the goal from it.

    Args:
        start: where the path begins, at t = 0.
        scene: the leader and d_min; arrivals before its t_release do not count.
        goal: where the path is to arrive.
        cell: of contacts.
        beat: arrivals from here on do not matter, and both times come back as infinite [R/V_P].
    """
    spread = contacts_within(cell, scene.alpha, scene.d_min)
    if spread.differs == inf:
        return inf, inf
    low, high = cell.start, cell.end
    t = low if high == inf else 0.5 * (low + high)
    span = 0.0 if high == inf else 0.5 * (high - low)
    there = leader_at(scene, cell.piece, t)
    at = there.h + cell.bearing
    cx, cy = there.x + scene.d_min * cos(at), there.y + scene.d_min * sin(at)
    course = there.h + spread.heading
    # the contact of the middle bearing moves like this, and turns with the leader
    rate = scene.leader[cell.piece, 4]
    vx = scene.alpha * cos(there.h) - rate * scene.d_min * sin(at)
    vy = scene.alpha * sin(there.h) + rate * scene.d_min * cos(at)
    swing, strays = turning_blur(scene, rate, span)
    differs = spread.differs + swing
    # the slot does not turn with it: what the contact moves relative to the goal is blur
    if cell.piece + 1 == len(scene.leader) and goal.speed == scene.alpha:
        drifts = 0.0
    else:
        drifts = strays + span * hypot(vx - goal.speed, vy)
    onward = soonest(
        Pose(cx - goal.x - goal.speed * t, cy, course),
        Blur(spread.left + drifts, spread.right + drifts, differs, 0.0),
        Velocity(goal.speed, 0.0),
        Window(max(scene.t_release - high, 0.0) - _EDGE, beat - low),
        Sieve(False, start, scene),
    )
    if onward == inf:
        return inf, inf
    # to the contact: read backward, the start is what is to be met, and left is right
    blur = Blur(spread.right + strays, spread.left + strays, differs, 0.0)
    c, s = cos(start.h), sin(start.h)
    target = Velocity(vx * c + vy * s, vy * c - vx * s)
    inside = with_limit(scene, scene.d_min - _INSIDE)
    soon = inf
    for loops in range(3):
        # 0: every word; 1: those that may keep the limit; 2: a word and a full loop, or more of
        # them, since without one they are paths that arrive no sooner than the soonest word
        looped = TWO_PI if loops == 2 else 0.0
        dx, dy = cx - (t - looped) * vx - start.x, cy - (t - looped) * vy - start.y
        earliest = 0.0 if loops == 2 else low - _EDGE
        latest = min(beat - onward, high + _EDGE) - looped
        found = looped + soonest(
            Pose(-dx * c - dy * s, dx * s - dy * c, course - start.h), blur, target,
            Window(earliest, latest), Sieve(loops == 1, start, inside),
        )  # fmt: skip
        if loops == 0:
            if found == inf:
                return inf, inf
        else:
            soon = min(soon, found)
    return max(soon, low), onward


@njit(cache=True, nogil=True)
def turning_blur(scene: Scene, rate: float, span: float) -> tuple[float, float]:
    """How much a contact turns with the leader within a time, and how far it strays.

    Args:
        scene: the leader and d_min.
        rate: the leader's turn rate [V_P/R].
        span: the time, either way [R/V_P].

    Returns:
        the turn [rad], and how far the centres of the circles beside it, which turn with it, may
        lie from where they would be had it kept its velocity and heading [R].
    """
    swing = abs(rate) * span
    return swing, swing + 0.5 * (scene.alpha + abs(rate) * (scene.d_min + 1.0)) * swing * span


@njit(cache=True, nogil=True)
def leaving_bound(scene: Scene, cell: Cell, beat: float) -> float:
    """How soon a path can be at the slot from its last contact, if that is one of the cell's.

    On the final leg, where the place of a contact from the slot does not change. Arguments as
    `cell_bound`; infinite from `beat` on.
    """
    alpha, d_min = scene.alpha, scene.d_min
    spread = contacts_within(cell, alpha, d_min)
    if spread.differs == inf:
        return inf
    lx, ly, lh = leader_at(scene, len(scene.leader) - 1, 0.0)
    # read backward from the slot, the leader flies backward too
    astern = Scene(np.array([[0.0, lx, ly, lh + pi, 0.0]]), alpha, d_min - _INSIDE, 0.0, inf)
    at = lh + cell.bearing
    cx, cy = lx + d_min * cos(at), ly + d_min * sin(at)
    blur = Blur(spread.left, spread.right, spread.differs, 0.0)
    found = inf
    for looped in (0.0, TWO_PI):
        word = looped + soonest(
            Pose(cx - looped * alpha, cy, lh + spread.heading), blur, Velocity(alpha, 0.0),
            Window(0.0, beat - looped), Sieve(looped == 0.0, Pose(0.0, 0.0, pi), astern),
        )  # fmt: skip
        found = min(found, word)
    return found


@njit(cache=True, nogil=True)
def between_bound(scene: Scene, table: FloatArray, cell: Cell, other: Cell, beat: float) -> float:
    """How soon a path can be at a contact of the other cell from one of this, on the final leg.

    Arguments as `cell_bound` and `round_bound`; infinite from `beat` on.
    """
    round_disc = min(round_bound(table, 0, cell, other), round_bound(table, 1, cell, other))
    if round_disc >= beat:
        return inf
    return max(round_disc, word_between(scene, cell, other, beat))


@njit(cache=True, nogil=True)
def word_between(scene: Scene, cell: Cell, other: Cell, beat: float) -> float:
    """No word leads sooner to a contact of the other cell from one of this, on the final leg.

    Arguments as `cell_bound`; infinite from `beat` on.
    """
    alpha, d_min = scene.alpha, scene.d_min
    begin, end = contacts_within(cell, alpha, d_min), contacts_within(other, alpha, d_min)
    if begin.differs == inf or end.differs == inf:
        return inf
    # headings and places relative to the leader
    here = Pose(d_min * cos(cell.bearing), d_min * sin(cell.bearing), begin.heading)
    there = Pose(d_min * cos(other.bearing), d_min * sin(other.bearing), end.heading)
    end_blur, differs = max(end.left, end.right), begin.differs + end.differs
    blur = Blur(begin.left + end_blur, begin.right + end_blur, differs, end.differs)
    return soonest(
        to_frame_of(here, there),
        blur,
        Velocity(alpha * cos(there.h), -alpha * sin(there.h)),
        Window(0.0, beat),
        Sieve(False, _ORIGIN, scene),
    )


@njit(cache=True, nogil=True)
def times_round(alpha: float, d_min: float) -> FloatArray:
    """How long it takes at least to go round the disc, by bearing from −π on.

    For something that needs no time to turn. Outside the disc it is fastest along its edge, since
    that is convex and the leader's motion is the same everywhere: as a boundary arc (see
    `contact`), so

        dt/db = d / (√(1 − α² cos² b) + s α sin b) = d (√(1 − α² cos² b) − s α sin b) / (1 − α²)

    with d = d_min.

    Row 0 is counter-clockwise (s = 1), row 1 clockwise, both growing with b. shape (2, ·)
    """
    table = np.zeros((2, _ROUND + 1))
    if alpha > _FAST:
        return table
    step = TWO_PI / _ROUND
    # |d²/db² √(1 − α² cos² b)| is less than this: what the trapezia may be too large by
    bend = 2.0 * alpha * alpha / sqrt(1.0 - alpha * alpha)
    scale = d_min / (1.0 - alpha * alpha)
    arc, last = 0.0, sqrt(1.0 - alpha * alpha)
    for k in range(1, _ROUND + 1):
        b = k * step - pi
        here = sqrt(1.0 - (alpha * cos(b)) ** 2)
        arc += 0.5 * step * (last + here) - bend * step * step * step / 12.0
        last = here
        table[0, k] = scale * (arc + alpha * (cos(b) + 1.0))
        table[1, k] = scale * (arc - alpha * (cos(b) + 1.0))
    return table


@njit(cache=True, nogil=True)
def round_time(table: FloatArray, way: int, bearing: float) -> float:
    """A row of `times_round` at any bearing of [−π, π]; differences are right to `_ROUND_SLACK`."""
    place = min(max((bearing + pi) / TWO_PI, 0.0), 1.0) * _ROUND
    k = min(int(place), _ROUND - 1)
    return float(table[way, k] + (place - k) * (table[way, k + 1] - table[way, k]))


@njit(cache=True, nogil=True)
def round_bound(table: FloatArray, way: int, cell: Cell, other: Cell) -> float:
    """The least time from any bearing of one cell to any of another, outside the disc.

    Args:
        table: of `times_round`.
        way: 0 counter-clockwise round the leader, 1 clockwise.
        cell: its bearing in [−π, π].
        other: its bearing in [−π, π].
    """
    sign = 1.0 - 2.0 * way
    gap = wrap(sign * (other.bearing - cell.bearing)) - cell.half - other.half
    if gap <= 0.0 or gap + 2.0 * (cell.half + other.half) >= TWO_PI:
        return 0.0
    begin, end = cell.bearing + sign * cell.half, other.bearing - sign * other.half
    took = sign * (round_time(table, way, end) - round_time(table, way, begin))
    if sign * (end - begin) < 0.0:
        took += table[way, _ROUND]
    return float(max(took - _ROUND_SLACK * table[way, _ROUND], 0.0))


@njit(cache=True, nogil=True)
def untouched_bound(start: Pose, scene: Scene, goal: Goal, beat: float) -> float:
    """No path that nowhere touches the limit arrives sooner than this. Arguments as `cell_bound`.

    It is an extremal that keeps the limit, or has a full loop in it. Nothing later than `beat` is
    looked at.
    """
    rows = np.empty((MAX_ROWS, 5))
    inside = with_limit(scene, scene.d_min - _INSIDE)
    seen = Pose(start.x - goal.x, start.y, wrap(start.h))
    best = beat
    after_loop = Pose(seen.x - goal.speed * TWO_PI, seen.y, seen.h)
    n = solve(after_loop, goal.speed, scene.t_release - TWO_PI, rows)
    for k in range(n):
        if TWO_PI + rows[k, 0] >= best:
            break
        if not _breaks_with_loop(start, rows[k], inside):
            best = TWO_PI + rows[k, 0]
            break
    n = solve(seen, goal.speed, scene.t_release, rows)
    for k in range(n):
        if rows[k, 0] >= best:
            break
        signs = SIGNS[int(rows[k, 1])]
        word = NearWord(
            (signs[0], signs[1], signs[2]), rows[k, 2], 0.0, rows[k, 3], 0.0, rows[k, 0]
        )
        if not breaks_limit(start, word, inside, _STRIDE):
            best = rows[k, 0]
            break
    # with two loops and more: no sooner than the soonest of all paths that are so long delayed
    after_loops = Pose(seen.x - goal.speed * 2.0 * TWO_PI, seen.y, seen.h)
    n = solve(after_loops, goal.speed, 0.0, rows)
    return min(best, max(2.0 * TWO_PI + rows[0, 0], scene.t_release)) if n > 0 else best


@njit(cache=True, nogil=True)
def _breaks_with_loop(start: Pose, row: FloatArray, scene: Scene) -> bool:
    """Whether a word with a full loop in it, wherever that is, certainly breaks the limit.

    Up to the loop it is flown as it is, and then 2π later. So it does if it breaks the limit as it
    is no later along the path than it does when flown 2π later.
    """
    word, looks, along = int(row[1]), 0, 0.0
    soonest_breach, last_breach = inf, -inf
    while along <= row[0] and looks < MOST_LOOKS:
        looks += 1
        nearest = inf
        at, left = start, along
        for piece in range(3):
            amount = min(left, row[piece + 2])
            at = fly_piece(at, SIGNS[word, piece], amount)
            left -= amount
        for late in range(2):
            t = along + late * TWO_PI
            there = leader_at(scene, piece_at(scene.leader, t), t)
            gap = hypot(at.x - there.x, at.y - there.y) - scene.d_min
            nearest = min(nearest, abs(gap))
            if gap < 0.0:
                if late == 0:
                    soonest_breach = min(soonest_breach, along)
                else:
                    last_breach = along
        # before that neither can begin to break the limit, or cease to
        along += max(nearest / (1.0 + scene.alpha), _LOOP_STRIDE)
    return soonest_breach <= last_breach
