"""How soon a path can arrive that touches d = d_min somewhere in a cell of contacts: proved.

A path whose first contact lies in a cell (see `cells`) takes at least as long as the soonest word
to any of its poses, and then as the soonest word from any of its poses on (see `word_bound`). Words
that certainly break the limit on the way lead to no first contact, nor to the slot from a last one.
Between the first contact and the last, whatever happens, a path takes at least as long as the
soonest word from pose to pose, and as something that need not turn takes round the disc: a boundary
arc comes as close to that as it can.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise. Contacts lie at d_min itself.
"""

from math import cos, hypot, inf, pi, sin
from typing import NamedTuple

from numba import njit

from relguide.kernels.base.angles import TWO_PI
from relguide.kernels.base.records import Pose, Scene, Velocity, Window, with_limit
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.breach import INSIDE, Sieve, no_sieve
from relguide.kernels.bounds.cells import EDGE, Cell, Poses, poses_of
from relguide.kernels.bounds.found_word import ByTurn, Junction
from relguide.kernels.bounds.goal import Goal, track_of
from relguide.kernels.bounds.junction import away_for, beyond_outward, junction_of
from relguide.kernels.bounds.rest import Rest, no_rest
from relguide.kernels.bounds.round_time import round_bound
from relguide.kernels.bounds.round_turning import round_arrival
from relguide.kernels.bounds.word_bound import (
    soonest,
    soonest_beyond,
    soonest_by_turn,
    soonest_kept,
)
from relguide.kernels.bounds.word_intervals import Blur
from relguide.kernels.contact.contact import to_frame_of
from relguide.kernels.words.extremals import fly_piece


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
    start: Pose, scene: Scene, goal: Goal, cell: Cell, beat: float, closely: bool, to: Rest,
    on: Rest,
) -> tuple[Passed, float]:  # fmt: skip
    """How soon a path can be at a contact of the cell, its first, and how soon at the goal from it.

    Args:
        start: where the path begins, at t = 0.
        scene: the leader and d_min; arrivals before its t_release do not count.
        goal: where the path is to arrive.
        cell: of contacts.
        beat: arrivals from here on do not matter, and all times come back as infinite [R/V_P].
        closely: whether it matters how the contact is passed.
        to: what is left of the words that lead to the contact, see `rest`.
        on: and of those that lead on.
    """
    poses = poses_of(scene, cell)
    if poses.differs == inf:
        return NEVER, inf
    onward = _onward_bound(scene, goal, cell, poses, beat - cell.start, on)
    if onward == inf:
        return NEVER, inf
    earliest, end = cell.start - EDGE, min(beat - onward, cell.end + EDGE)
    at, target = _seen_from_start(start, poses)
    # read backward, left is right
    blur = Blur(poses.right, poses.left, poses.differs, 0.0)
    inside = with_limit(scene, scene.d_min - INSIDE)
    sieve, window = Sieve(True, start, 0.0, inside, 1.0, 0.0, 0.0), Window(earliest, end)
    if closely:
        junction = junction_of(scene, cell, 1.0)
        found = soonest_by_turn(at, blur, target, window, sieve, junction, to)
        if not found.any:
            return NEVER, onward
        looped = looped_bound(start, scene, cell, end)
        return _passed(found, junction, looped, cell.start), onward
    soon, any_word = soonest_kept(at, blur, target, window, sieve, to)
    if not any_word:
        return NEVER, onward
    soon = max(min(soon, looped_bound(start, scene, cell, min(end, soon))), cell.start)
    return Passed(soon, soon, soon, soon, soon), onward


@njit(cache=True, nogil=True)
def spare_bound(
    start: Pose, scene: Scene, goal: Goal, cell: Cell, beat: float, on: Rest
) -> tuple[Passed, float]:
    """As `cell_bound`, of paths that have time to spare before the contact: see `junction`.

    They come there by any way that is long enough, so no sooner than the shortest word.

    Args:
        start: as in `cell_bound`.
        scene: likewise.
        goal: likewise.
        cell: likewise; its window of time has an end.
        beat: as in `cell_bound`.
        on: likewise.
    """
    poses = poses_of(scene, cell)
    if poses.differs == inf:
        return NEVER, inf
    onward = _onward_bound(scene, goal, cell, poses, beat - cell.start, on)
    if onward == inf:
        return NEVER, inf
    strays = poses.span * hypot(poses.vx, poses.vy)
    there = Poses(
        poses.t, 0.0, poses.middle, 0.0, 0.0, poses.differs, poses.left + strays,
        poses.right + strays,
    )  # fmt: skip
    end = min(beat - onward, cell.end + EDGE)
    soon = max(_word_to(start, scene, there, Window(0.0, end)), cell.start)
    if soon == inf or not _can_be_as_long(start, scene, poses, end):
        return NEVER, onward
    away = Passed(inf, inf, inf, soon, soon + beyond_outward(scene, cell, 1.0))
    return until_again(scene, cell, 1.0, away), onward


@njit(cache=True, nogil=True)
def _can_be_as_long(start: Pose, scene: Scene, poses: Poses, end: float) -> bool:
    """Whether a path from the start, at t = 0, may be at one of the poses at its time.

    Who is has met a point that moves at V_P along the pose's heading and is there at that time:
    then, if not sooner. The soonest of those that do so is an extremal: see `goal.track_of`.
    """
    at = poses.middle
    vx, vy = cos(at.h), sin(at.h)
    strays = poses.span * (hypot(poses.vx - vx, poses.vy - vy) + poses.differs)
    strays += (poses.t + poses.span) * poses.differs
    track = Poses(
        poses.t, 0.0, at, vx, vy, poses.differs, poses.left + strays, poses.right + strays
    )  # fmt: skip
    return _word_to(start, scene, track, Window(0.0, end)) < inf


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
        poses.right,
    )  # fmt: skip
    # a second loop takes 4π in all
    earliest = 0.0 if cell.end >= 2.0 * TWO_PI else cell.start - TWO_PI - EDGE
    return TWO_PI + _word_to(start, scene, later, Window(earliest, end - TWO_PI))


@njit(cache=True, nogil=True)
def turned_before_bound(start: Pose, scene: Scene, cell: Cell, turn: float, end: float) -> float:
    """How soon a path can be at a contact of the cell that has last turned away so far.

    Args:
        start: as in `cell_bound`.
        scene: likewise.
        cell: likewise.
        turn: how far [rad].
        end: arrivals from here on do not matter, and come back as infinite [R/V_P].
    """
    before = _turned_away(poses_of(scene, cell), cell.side, -turn)
    return turn + _word_to(start, scene, before, Window(0.0, end - turn))


@njit(cache=True, nogil=True)
def turned_after_bound(scene: Scene, goal: Goal, cell: Cell, turn: float, beat: float) -> float:
    """How soon a path can be at the goal from a contact of the cell that first turns away so far.

    Args:
        scene: as in `cell_bound`.
        goal: likewise.
        cell: likewise; there are contacts.
        turn: how far [rad].
        beat: as in `cell_bound`.
    """
    after = _turned_away(poses_of(scene, cell), cell.side, turn)
    later = Cell(cell.piece, cell.side, cell.bearing, cell.half, cell.start + turn, cell.end + turn)
    return turn + _onward_bound(scene, goal, later, after, beat - turn, no_rest())


@njit(cache=True, nogil=True)
def _turned_away(poses: Poses, side: float, turn: float) -> Poses:
    """The poses after a turn away from the leader, before it if that is negative."""
    # the centre of that turn stays where it is
    kept = poses.right if side > 0.0 else poses.left
    other = kept + 2.0 * poses.differs
    left, right = (other, kept) if side > 0.0 else (kept, other)
    middle = fly_piece(poses.middle, -side, turn)
    return Poses(poses.t + turn, poses.span, middle, poses.vx, poses.vy, poses.differs, left, right)


@njit(cache=True, nogil=True)
def _word_to(start: Pose, scene: Scene, poses: Poses, window: Window) -> float:
    """How soon a word can lead from the start, at t = 0, to one of the poses, which move on."""
    at, target = _seen_from_start(start, poses)
    blur = Blur(poses.right, poses.left, poses.differs, 0.0)
    return soonest(at, blur, target, window, no_sieve(scene))


@njit(cache=True, nogil=True)
def _seen_from_start(start: Pose, poses: Poses) -> tuple[Pose, Velocity]:
    """The middle of some poses read backward, so that the start is what is to be met."""
    c, s = cos(start.h), sin(start.h)
    at, vx, vy = poses.middle, poses.vx, poses.vy
    dx, dy = at.x - poses.t * vx - start.x, at.y - poses.t * vy - start.y
    seen = Pose(-dx * c - dy * s, dx * s - dy * c, at.h - start.h)
    return seen, Velocity(vx * c + vy * s, vy * c - vx * s)


@njit(cache=True, nogil=True)
def _onward_bound(
    scene: Scene, goal: Goal, cell: Cell, poses: Poses, beat: float, rest: Rest
) -> float:
    """How soon a path can be at the goal from a contact of a cell, with or without the limit."""
    opens = scene.t_release - cell.end
    onward, _ = soonest_kept(
        _seen_from(goal, poses), _blur_toward(scene, goal, cell, poses),
        Velocity(goal.speed, 0.0), Window(max(opens, 0.0) - EDGE, beat), no_sieve(scene), rest,
    )  # fmt: skip
    left = scene.t_release - cell.start
    if not goal.holds or left <= 0.0 or left >= beat or onward <= opens:
        return onward
    # who is there as the slot opens has met this point by then
    track = track_of(goal, scene.t_release)
    early = soonest(
        _seen_from(track, poses), _blur_toward(scene, track, cell, poses),
        Velocity(track.speed, 0.0), Window(0.0, left + EDGE), no_sieve(scene),
    )  # fmt: skip
    return min(onward, max(opens, early)) if early < inf else onward


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
    blur, target = _blur_toward(scene, goal, cell, poses), Velocity(goal.speed, 0.0)
    seen, window = _seen_from(goal, poses), Window(opens, beat)
    sieve = Sieve(True, end, goal.speed, inside, -1.0, cell.start, cell.end)
    later = _seen_from(Goal(goal.x + TWO_PI * goal.speed, goal.speed, False), poses)
    if closely:
        junction = junction_of(scene, cell, -1.0)
        found = soonest_by_turn(seen, blur, target, window, sieve, junction, on)
        window = Window(0.0, beat - TWO_PI)
        looped = TWO_PI + soonest(later, blur, target, window, no_sieve(scene))
        return _passed(found, junction, looped, 0.0)
    leaving, _ = soonest_kept(seen, blur, target, window, sieve, on)
    window = Window(0.0, min(beat, leaving) - TWO_PI)
    leaving = min(leaving, TWO_PI + soonest(later, blur, target, window, no_sieve(scene)))
    return Passed(leaving, leaving, leaving, leaving, leaving)


@njit(cache=True, nogil=True)
def round_between(scene: Scene, table: FloatArray, cell: Cell, other: Cell, beat: float) -> float:
    """How soon a path can be at a contact of the other cell from one of this, round the leader.

    Arguments as `cell_bound` and `round_bound`; infinite from `beat` on.
    """
    if other.end < cell.start:
        return inf
    apart = other.start - cell.end
    beat = min(beat, other.end - cell.start + EDGE)
    if apart < beat and min(cell.piece, other.piece) + 1 == len(scene.leader):
        apart = max(
            apart, min(round_bound(table, 0, cell, other), round_bound(table, 1, cell, other))
        )
    elif apart < beat:
        apart = max(apart, round_arrival(scene, cell, other, cell.start + beat) - cell.start)
    return apart if apart < beat else inf


@njit(cache=True, nogil=True)
def word_between(
    scene: Scene, cell: Cell, other: Cell, beat: float, after: float, before: float,
    enough: float,
) -> float:  # fmt: skip
    """No word leads sooner to a contact of the other cell from one of this.

    Args:
        scene: as in `cell_bound`.
        cell: likewise.
        other: of the contacts to which it leads.
        beat: as in `cell_bound`.
        after: how far it first turns away from the leader, at least [rad].
        before: and how far just before the other contact [rad].
        enough: whether a word does so sooner than this does not matter [R/V_P].
    """
    begin, end = poses_of(scene, cell), poses_of(scene, other)
    if begin.differs == inf or end.differs == inf:
        return inf
    if after > 0.0:
        begin = _turned_away(begin, cell.side, after)
    if before > 0.0:
        end = _turned_away(end, other.side, -before)
    # where the other contact would be at that time, had it always moved as it then does
    drifts = 0.0
    met = end.middle
    if min(cell.piece, other.piece) + 1 < len(scene.leader):
        drifts = begin.span * hypot(begin.vx - end.vx, begin.vy - end.vy)
    early = begin.t - end.t
    met = Pose(met.x + early * end.vx, met.y + early * end.vy, met.h)
    c, s = cos(met.h), sin(met.h)
    moved, differs = max(end.left, end.right) + drifts, begin.differs + end.differs
    turned = after + before
    return turned + soonest_beyond(
        to_frame_of(begin.middle, met),
        Blur(begin.left + moved, begin.right + moved, differs, end.differs),
        Velocity(end.vx * c + end.vy * s, end.vy * c - end.vx * s),
        Window(0.0, beat - turned), no_sieve(scene), enough - turned,
    )  # fmt: skip
