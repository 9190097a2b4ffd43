"""How soon a path can arrive that touches d = d_min somewhere in a cell of contacts: proved.

A path whose first contact lies in a cell (see `cells`) takes at least as long as the soonest word
to any of its poses, and then as the soonest word from any of its poses on (see `word_bound`). Words
that certainly break the limit on the way lead to no first contact, nor to the slot from a last one.
What happens between the first contact and the last is in `between`, and paths that come to the
first with time to spare are in `spare_bound`.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise. Contacts lie at d_min itself.
"""

from math import inf, pi
from typing import NamedTuple

from numba import njit

from relguide.kernels.base.angles import TWO_PI
from relguide.kernels.base.records import Pose, Scene, Velocity, Window, with_limit
from relguide.kernels.bounds.breach import INSIDE, Sieve, no_sieve
from relguide.kernels.bounds.cell_words import (
    blur_backward,
    blur_toward,
    onward_bound,
    seen_from,
    seen_from_start,
    word_to,
)
from relguide.kernels.bounds.cells import EDGE, Cell, Poses, poses_of
from relguide.kernels.bounds.found_word import ByTurn, Junction
from relguide.kernels.bounds.goal import Goal
from relguide.kernels.bounds.junction import away_for, junction_of
from relguide.kernels.bounds.rest import Rest
from relguide.kernels.bounds.word_bound import (
    soonest,
    soonest_by_turn,
    soonest_kept,
)


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
    to: Rest, on: Rest,
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
        to: what is left of the words that lead to the contact, see `rest`.
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
        poses.right, poses.ways,
    )  # fmt: skip
    # a second loop takes 4π in all
    earliest = 0.0 if cell.end >= 2.0 * TWO_PI else cell.start - TWO_PI - EDGE
    return TWO_PI + word_to(start, scene, later, Window(earliest, end - TWO_PI))


@njit(cache=True, nogil=True)
def leaving_bound(
    scene: Scene, goal: Goal, cell: Cell, beat: float, closely: bool, on: Rest
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
