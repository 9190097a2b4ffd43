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
from relguide.kernels.bounds.breach import MOST_LOOKS, Flown, NearWord, Sieve, breaks_limit
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
    """Along it [V_P]: α for the slot, 1 for a point of its track (see `track_of`)."""
    holds: bool
    """Whether a path may arrive just as the slot opens, and then need not be an extremal."""


class Poses(NamedTuple):
    """The poses of a cell's contacts."""

    t: float
    """Middle of the window of time; its start if it has no end [R/V_P]."""
    span: float
    """Half of its width; 0 if it has no end [R/V_P]."""
    middle: Pose
    """Of the middle bearing, at the middle."""
    vx: float
    """How that moves [V_P]."""
    vy: float
    """[V_P]."""
    differs: float
    """How much the heading may differ from it [rad]; infinite if there is no contact."""
    left: float
    """How far the centre of their left circles may lie from the middle's, where that would be had
    it kept its velocity [R]."""
    right: float
    """And that of their right circles [R]."""


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
def poses_of(scene: Scene, cell: Cell) -> Poses:
    """The poses of a cell; `differs` is infinite if there is no contact."""
    low, high = cell.start, cell.end
    t = low if high == inf else 0.5 * (low + high)
    span = 0.0 if high == inf else 0.5 * (high - low)
    spread = contacts_within(cell, scene.alpha, scene.d_min)
    there = leader_at(scene, cell.piece, t)
    at = there.h + cell.bearing
    across, ahead = scene.d_min * sin(at), scene.d_min * cos(at)
    # the contact of the middle bearing moves like this, and turns with the leader
    rate = scene.leader[cell.piece, 4]
    swing, strays = turning_blur(scene, rate, span)
    return Poses(
        t, span, Pose(there.x + ahead, there.y + across, there.h + spread.heading),
        scene.alpha * cos(there.h) - rate * across, scene.alpha * sin(there.h) + rate * ahead,
        spread.differs + swing, spread.left + strays, spread.right + strays,
    )  # fmt: skip


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
    poses = poses_of(scene, cell)
    if poses.differs == inf:
        return inf, inf
    low, high = cell.start, cell.end
    onward = _onward_bound(scene, goal, cell, poses, beat - low)
    if onward == inf:
        return inf, inf
    # to the contact: read backward, the start is what is to be met, and left is right
    blur = Blur(poses.right, poses.left, poses.differs, 0.0)
    c, s = cos(start.h), sin(start.h)
    at, vx, vy = poses.middle, poses.vx, poses.vy
    target = Velocity(vx * c + vy * s, vy * c - vx * s)
    inside = with_limit(scene, scene.d_min - _INSIDE)
    soon = inf
    for loops in range(3):
        # 0: every word; 1: those that may keep the limit; 2: a word and a full loop, or more of
        # them, since without one they are paths that arrive no sooner than the soonest word
        looped = TWO_PI if loops == 2 else 0.0
        dx = at.x - (poses.t - looped) * vx - start.x
        dy = at.y - (poses.t - looped) * vy - start.y
        # a second loop takes 4π in all
        earliest = 0.0 if loops == 2 and high >= 2.0 * TWO_PI else low - looped - _EDGE
        latest = min(beat - onward, high + _EDGE, soon) - looped
        found = looped + soonest(
            Pose(-dx * c - dy * s, dx * s - dy * c, at.h - start.h), blur, target,
            Window(earliest, latest), _sieve_from(start, inside, loops == 1),
        )  # fmt: skip
        if loops == 0:
            if found == inf:
                return inf, inf
        else:
            soon = min(soon, found)
    return max(soon, low), onward


@njit(cache=True, nogil=True)
def _onward_bound(scene: Scene, goal: Goal, cell: Cell, poses: Poses, beat: float) -> float:
    """How soon a path can be at the goal from a contact of a cell, with or without the limit."""
    opens, unlimited = scene.t_release - cell.end, _sieve_from(_ORIGIN, scene, False)
    onward = soonest(
        _seen_from(goal, poses), _blur_toward(scene, goal, cell, poses),
        Velocity(goal.speed, 0.0), Window(max(opens, 0.0) - _EDGE, beat), unlimited,
    )  # fmt: skip
    left = scene.t_release - cell.start
    if not goal.holds or left <= 0.0 or left >= beat or onward <= opens:
        return onward
    # who is there as the slot opens has met this point by then
    track = track_of(goal, scene.t_release)
    early = soonest(
        _seen_from(track, poses), _blur_toward(scene, track, cell, poses),
        Velocity(track.speed, 0.0), Window(0.0, left + _EDGE), unlimited,
    )  # fmt: skip
    return min(onward, max(opens, early)) if early < inf else onward


@njit(cache=True, nogil=True)
def track_of(goal: Goal, t_release: float) -> Goal:
    """A point that moves along the slot's track at V_P, and is where the slot opens as it opens.

    Who is there at that moment, on heading 0, has met this point: then, if not sooner. Who meets it
    sooner can follow it, and is there, if that keeps the limit. So there is a path of just that
    length only if there is one that meets the point by then, and the soonest of those is an
    extremal; without the limit, if and only if.
    """
    return Goal(goal.x + (goal.speed - 1.0) * t_release, 1.0, False)


@njit(cache=True, nogil=True)
def arrives_at_release(x: float, y: float, h: float, alpha: float, t_release: float) -> bool:
    """Whether a path without the limit may be at the slot just as it opens.

    Args:
        x: the pursuer ahead of the slot [R].
        y: and left of it [R].
        h: its heading [rad], in [0, 2π).
        alpha: V_L/V_P.
        t_release: when the slot opens [R/V_P].
    """
    track = track_of(Goal(0.0, alpha, True), t_release)
    nobody = Scene(np.zeros((1, 5)), 0.0, 0.0, 0.0, inf)
    meets = soonest(
        Pose(x - track.x, y, h), Blur(0.0, 0.0, 0.0, 0.0), Velocity(1.0, 0.0),
        Window(0.0, t_release + _EDGE), Sieve(False, _ORIGIN, 0.0, nobody, 1.0, 0.0, 0.0),
    )  # fmt: skip
    return bool(meets < inf)


@njit(cache=True, nogil=True)
def _seen_from(goal: Goal, poses: Poses) -> Pose:
    """The middle of a cell's poses, seen from the goal at that time."""
    at = poses.middle
    return Pose(at.x - goal.x - goal.speed * poses.t, at.y, at.h)


@njit(cache=True, nogil=True)
def _blur_toward(scene: Scene, goal: Goal, cell: Cell, poses: Poses) -> Blur:
    """How far the poses of a cell may lie from their middle, as the goal sees them."""
    drifts = 0.0
    if cell.piece + 1 < len(scene.leader) or goal.speed != scene.alpha:
        # the goal does not move with the contacts
        drifts = poses.span * hypot(poses.vx - goal.speed, poses.vy)
    return Blur(poses.left + drifts, poses.right + drifts, poses.differs, 0.0)


@njit(cache=True, nogil=True)
def _sieve_from(start: Pose, scene: Scene, used: bool) -> Sieve:
    """What leaves out words that break the limit on their way from the start."""
    return Sieve(used, start, 0.0, scene, 1.0, 0.0, 0.0)


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
def leaving_bound(scene: Scene, goal: Goal, cell: Cell, beat: float) -> float:
    """How soon a path can be at the goal from its last contact, if that is one of the cell's.

    Arguments as `cell_bound`; infinite from `beat` on.
    """
    poses = poses_of(scene, cell)
    if poses.differs == inf:
        return inf
    blur = _blur_toward(scene, goal, cell, poses)
    inside = with_limit(scene, scene.d_min - _INSIDE)
    opens = max(scene.t_release - cell.end, 0.0) - _EDGE
    found = inf
    for loops in range(2):
        looped = TWO_PI * loops
        seen = _seen_from(Goal(goal.x + looped * goal.speed, goal.speed, False), poses)
        sieve = Sieve(
            loops == 0, Pose(goal.x, 0.0, pi), goal.speed, inside, -1.0, cell.start, cell.end
        )
        word = looped + soonest(
            seen, blur, Velocity(goal.speed, 0.0),
            Window(0.0 if loops > 0 else opens, min(beat, found) - looped), sieve,
        )  # fmt: skip
        found = min(found, word)
    return found


@njit(cache=True, nogil=True)
def between_bound(scene: Scene, table: FloatArray, cell: Cell, other: Cell, beat: float) -> float:
    """How soon a path can be at a contact of the other cell from one of this.

    Arguments as `cell_bound` and `round_bound`; infinite from `beat` on.
    """
    if other.end < cell.start:
        return inf
    apart = other.start - cell.end
    if min(cell.piece, other.piece) + 1 == len(scene.leader):
        apart = max(
            apart, min(round_bound(table, 0, cell, other), round_bound(table, 1, cell, other))
        )
    beat = min(beat, other.end - cell.start + _EDGE)
    if apart >= beat:
        return inf
    return max(apart, word_between(scene, cell, other, beat))


@njit(cache=True, nogil=True)
def word_between(scene: Scene, cell: Cell, other: Cell, beat: float) -> float:
    """No word leads sooner to a contact of the other cell from one of this.

    Arguments as `cell_bound`; infinite from `beat` on.
    """
    begin, end = poses_of(scene, cell), poses_of(scene, other)
    if begin.differs == inf or end.differs == inf:
        return inf
    # where the other contact would be at that time, had it always moved as it then does
    drifts = 0.0
    met = end.middle
    if min(cell.piece, other.piece) + 1 < len(scene.leader):
        drifts = begin.span * hypot(begin.vx - end.vx, begin.vy - end.vy)
    early = begin.t - end.t
    met = Pose(met.x + early * end.vx, met.y + early * end.vy, met.h)
    c, s = cos(met.h), sin(met.h)
    moved, differs = max(end.left, end.right) + drifts, begin.differs + end.differs
    return soonest(
        to_frame_of(begin.middle, met),
        Blur(begin.left + moved, begin.right + moved, differs, end.differs),
        Velocity(end.vx * c + end.vy * s, end.vy * c - end.vx * s),
        Window(0.0, beat),
        _sieve_from(_ORIGIN, scene, False),
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
    flown = Flown(0.0, 1.0, 0.0, 0.0)
    for k in range(n):
        if rows[k, 0] >= best:
            break
        signs = SIGNS[int(rows[k, 1])]
        word = NearWord(
            (signs[0], signs[1], signs[2]), rows[k, 2], 0.0, rows[k, 3], 0.0, rows[k, 0]
        )
        if not breaks_limit(start, word, flown, inside, _STRIDE):
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
