"""How soon a path can arrive that touches d = d_min in a cell of contacts, or nowhere: proved.

A path whose first contact lies in a cell (see `cells`) takes at least as long as the soonest word
to any of its poses, and then as the soonest word from any of its poses on (see `word_bound`). A
word that certainly breaks the limit leads to no first contact, nor from a last contact to the slot.
A path with time to spare comes to its first contact by any way that takes just so long: see
`junction`; `after_spare` says where it goes from there. A path that touches nowhere is an extremal,
with loops or without.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise. Contacts lie at d_min itself.
"""

from math import inf, pi
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap
from relguide.kernels.base.norm import norm
from relguide.kernels.base.records import Pose, Scene, Velocity, Window, with_limit
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.words.breach import (
    INSIDE,
    MOST_LOOKS,
    Flown,
    NearWord,
    Sieve,
    breaks_limit,
    no_sieve,
)
from relguide.kernels.bounds.words.cell_words import (
    blur_backward,
    blur_toward,
    can_be_there,
    onward_bound,
    seen_from,
    seen_from_start,
    word_to,
)
from relguide.kernels.bounds.words.cells import Cell, Poses, poses_of
from relguide.kernels.bounds.words.found_word import ByTurn, Junction, OpenIntervals
from relguide.kernels.bounds.words.junction import away_for, junction_of
from relguide.kernels.bounds.words.sets import EDGE, Goal, drifting
from relguide.kernels.bounds.words.word_bound import soonest, soonest_by_turn, soonest_kept
from relguide.kernels.separation.clearance import leader_at, piece_at
from relguide.kernels.words.extremals import MAX_ROWS, SIGNS, fly_piece, solve

_MOMENT = 0.02  # a window of time no wider than twice this is not narrowed further [R/V_P]
_LOOP_STRIDE = 0.01  # from one look to the next where there may be a loop [R/V_P]
_SHORT = 1e-6  # a straight no longer than this may have any direction [R]
_STRIDE = 1e-4  # least step of the look for a breach on a path that is known [R/V_P]


class Passed(NamedTuple):
    """How soon a word leads to a contact, or from one to the goal, by how it is passed there.

    Infinite if none does, or may.
    """

    looped: float
    """With a full loop in it, or more of them [R/V_P]."""
    tangent: float
    """Where λ_ψ vanishes [R/V_P]."""
    inward: float
    """In a turn toward the leader [R/V_P]."""
    outward: float
    """In a turn away from it [R/V_P]."""
    turned: float
    """With what there is more of such a turn on the other side of the contact, if the path goes on
    to another one [R/V_P]."""


NEVER = Passed(inf, inf, inf, inf, inf)
"""No word does."""


@njit(cache=True, nogil=True)
def anyhow(passed: Passed) -> float:
    """How soon, however the contact is passed."""
    return min(passed.looped, passed.inward, passed.outward)


@njit(cache=True, nogil=True)
def otherwise(passed: Passed) -> float:
    """How soon, if not in a turn away from the leader."""
    return min(passed.looped, passed.tangent, passed.inward)


@njit(cache=True, nogil=True)
def cell_bound(
    start: Pose, scene: Scene, goal: Goal, cell: Cell, beat: float, closely: bool, switch: bool,
    to: OpenIntervals, on: OpenIntervals,
) -> tuple[Passed, float, float]:  # fmt: skip
    """How soon a path can be at a contact of the cell, its first, and how soon at the goal from it.

    Args:
        start: where the path begins, at t = 0.
        scene: the leader and d_min; arrivals before its t_release do not count.
        goal: where the path is to arrive.
        cell: of contacts.
        beat: arrivals from here on do not matter, and all times come back as infinite [R/V_P].
        closely: whether it matters how the contact is passed.
        switch: whether λ_ψ may vanish at a contact of the cell, see `tangent_contacts`.
        to: open intervals of the words that lead to the contact.
        on: and of those that lead on.
    """
    poses = poses_of(scene, cell)
    if poses.differs == inf:
        return NEVER, inf, inf
    onward = onward_bound(scene, goal, cell, poses, beat - cell.start, on)
    if onward == inf:
        return NEVER, inf, inf
    earliest, end = cell.start - EDGE, min(beat - onward, cell.end + EDGE)
    at, target = seen_from_start(start, poses)
    blur = blur_backward(start, poses)
    inside = with_limit(scene, scene.d_min - INSIDE)
    sieve, window = Sieve(True, start, 0.0, inside, 1.0, 0.0, 0.0), Window(earliest, end)
    if closely:
        junction = junction_of(scene, cell, 1.0, switch)
        found = soonest_by_turn(at, blur, target, window, sieve, junction, to, True)
        if not found.any:
            return NEVER, onward, inf
        looped = looped_bound(start, scene, cell, end)
        latest = found.latest if looped == inf else inf
        return _passed(found, junction, looped, cell.start), onward, latest
    soon, any_word = soonest_kept(at, blur, target, window, sieve, to)
    if not any_word:
        return NEVER, onward, inf
    soon = max(min(soon, looped_bound(start, scene, cell, min(end, soon))), cell.start)
    return Passed(soon, soon, soon, soon, soon), onward, inf


@njit(cache=True, nogil=True)
def until_again(scene: Scene, cell: Cell, pace: float, passed: Passed) -> Passed:
    """The same, with a turn away only for so long as it surely does not touch again.

    Args:
        scene: as in `cell_bound`.
        cell: likewise.
        pace: +1 for the turn after the contact, −1 for that before it.
        passed: how soon, by how the contact is passed.
    """
    lasts = passed.turned - passed.outward
    if not 0.0 < lasts < inf:
        return passed
    turned = passed.outward + away_for(scene, cell, pace, lasts)
    return Passed(passed.looped, passed.tangent, passed.inward, passed.outward, turned)


@njit(cache=True, nogil=True)
def _passed(found: ByTurn, junction: Junction, looped: float, least: float) -> Passed:
    """By turns toward the leader and away from it; none of it less than `least`."""
    inward, outward = found.left, found.right
    if junction.outward == 0:
        inward, outward = outward, inward
    if not junction.inward:
        inward = inf
    return Passed(
        max(looped, least), max(found.tangent, least), max(inward, least), max(outward, least),
        max(found.lasting, least),
    )  # fmt: skip


@njit(cache=True, nogil=True)
def looped_bound(start: Pose, scene: Scene, cell: Cell, end: float) -> float:
    """How soon a path with a full loop in it, or more of them, can be at a contact of the cell.

    They are paths no sooner than a word. Arguments as `cell_bound`; infinite from `end` on.
    """
    poses = poses_of(scene, cell)
    later = Poses(
        poses.t - TWO_PI, poses.span, poses.middle, poses.vx, poses.vy, poses.differs, poses.left,
        poses.right, poses.sensitivity,
    )  # fmt: skip
    # a second loop takes 4π in all
    earliest = 0.0 if cell.end >= 2.0 * TWO_PI else cell.start - TWO_PI - EDGE
    return TWO_PI + word_to(start, scene, later, Window(earliest, end - TWO_PI))


@njit(cache=True, nogil=True)
def leaving_bound(
    scene: Scene, goal: Goal, cell: Cell, beat: float, closely: bool, on: OpenIntervals
) -> Passed:
    """How soon a path can be at the goal from its last contact, if that is one of the cell's.

    Arguments as `cell_bound`; infinite from `beat` on.
    """
    poses = poses_of(scene, cell)
    if poses.differs == inf:
        return NEVER
    opens = max(scene.t_release - cell.end, 0.0) - EDGE
    inside, end = with_limit(scene, scene.d_min - INSIDE), Pose(goal.x, 0.0, pi)
    blur, target = blur_toward(scene, goal, cell, poses), Velocity(goal.speed, 0.0)
    seen, window = seen_from(goal, poses), Window(opens, beat)
    sieve = Sieve(True, end, goal.speed, inside, -1.0, cell.start, cell.end)
    later = seen_from(Goal(goal.x + TWO_PI * goal.speed, goal.speed, False), poses)
    if closely:
        junction = junction_of(scene, cell, -1.0, True)
        found = soonest_by_turn(seen, blur, target, window, sieve, junction, on, False)
        window = Window(0.0, beat - TWO_PI)
        looped = TWO_PI + soonest(later, blur, target, window, no_sieve(scene))
        return _passed(found, junction, looped, 0.0)
    leaving, _ = soonest_kept(seen, blur, target, window, sieve, on)
    window = Window(0.0, min(beat, leaving) - TWO_PI)
    leaving = min(leaving, TWO_PI + soonest(later, blur, target, window, no_sieve(scene)))
    return Passed(leaving, leaving, leaving, leaving, leaving)


@njit(cache=True, nogil=True)
def spare_bound(
    start: Pose, scene: Scene, goal: Goal, cell: Cell, beat: float, on: OpenIntervals
) -> tuple[float, float]:
    """How soon a path can be at a contact of the cell with time to spare, and at the goal from it.

    It comes there by any way that is long enough, so no sooner than by the shortest word.

    Args:
        start: as in `contact_bound.cell_bound`.
        scene: likewise.
        goal: likewise.
        cell: likewise; its window of time has an end.
        beat: as there.
        on: likewise.
    """
    poses = poses_of(scene, cell)
    if poses.differs == inf:
        return inf, inf
    onward = onward_bound(scene, goal, cell, poses, beat - cell.start, on)
    end = min(beat - onward, cell.end + EDGE)
    if onward == inf or not can_be_there(start, scene, poses, end):
        return inf, onward
    if poses.span < _MOMENT:
        return cell.start, onward
    x, y = poses.span * poses.vx, poses.span * poses.vy
    strays, sensitivity = norm(x, y), drifting(poses.sensitivity, x, y)
    there = Poses(
        poses.t, 0.0, poses.middle, 0.0, 0.0, poses.differs, poses.left + strays,
        poses.right + strays, sensitivity,
    )  # fmt: skip
    return max(word_to(start, scene, there, Window(0.0, end)), cell.start), onward


@njit(cache=True, nogil=True)
def untouched_bound(start: Pose, scene: Scene, goal: Goal, beat: float) -> float:
    """No path that nowhere touches the limit arrives sooner than this. Arguments as `cell_bound`.

    It is an extremal that keeps the limit, or has a full loop in it. Nothing later than `beat` is
    looked at.
    """
    rows = np.empty((MAX_ROWS, 5))
    inside = with_limit(scene, scene.d_min - INSIDE)
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
    is no later along the path than it does when flown 2π later; or if all loops between do so.
    """
    looks, along = 0, 0.0
    soonest_breach, last_breach = row[0], 0.0
    while along <= row[0] and looks < MOST_LOOKS:
        looks += 1
        nearest = inf
        at = _along(start, row, along)[0]
        for late in range(2):
            gap = _gap(at, scene, along + late * TWO_PI)
            nearest = min(nearest, abs(gap))
            if gap < 0.0:
                if late == 0:
                    soonest_breach = min(soonest_breach, along)
                else:
                    last_breach = along
        # before that neither can begin to break the limit, or cease to
        along += max(nearest / (1.0 + scene.alpha), _LOOP_STRIDE)
    while last_breach < soonest_breach and looks < MOST_LOOKS:
        looks += 1
        inside = _least_breach(start, row, last_breach, scene)
        if inside < _LOOP_STRIDE:
            return False
        # a path that begins the loop so much later is no further from there than twice as much
        last_breach += 0.5 * inside
    return bool(last_breach >= soonest_breach)


@njit(cache=True, nogil=True)
def _least_breach(start: Pose, row: FloatArray, along: float, scene: Scene) -> float:
    """How far inside the limit a loop comes that begins so far along a word, at least [R].

    A loop in a turn goes on turning, as λ_ψ vanishes on the line of the straight only; from there
    one may go either way.
    """
    at, sign = _along(start, row, along)
    least = inf
    for hand in (-1.0, 1.0):
        if sign != 0.0 and hand != sign and row[3] > _SHORT:
            continue
        deepest, flown = 0.0, 0.0
        while flown < TWO_PI:
            gap = _gap(fly_piece(at, hand, flown), scene, along + flown)
            deepest = max(deepest, -gap)
            flown += max((gap + deepest) / (1.0 + scene.alpha), _LOOP_STRIDE)
        least = min(least, deepest)
    return least


@njit(cache=True, nogil=True)
def _along(start: Pose, row: FloatArray, flown: float) -> tuple[Pose, float]:
    """Where a word has come to, and how it turns there."""
    at, left, word, sign = start, flown, int(row[1]), 0.0
    for piece in range(3):
        amount = min(left, row[piece + 2])
        sign = SIGNS[word, piece]
        at = fly_piece(at, sign, amount)
        left -= amount
        if left <= 0.0:
            break
    return at, sign


@njit(cache=True, nogil=True)
def _gap(at: Pose, scene: Scene, t: float) -> float:
    """How far outside the limit a pose is [R]."""
    there = leader_at(scene, piece_at(scene.leader, t), t)
    return norm(at.x - there.x, at.y - there.y) - scene.d_min
