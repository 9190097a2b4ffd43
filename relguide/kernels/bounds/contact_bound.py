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

from numba import njit

from relguide.kernels.base.angles import TWO_PI
from relguide.kernels.base.records import Pose, Scene, Velocity, Window, with_limit
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.breach import INSIDE, Sieve
from relguide.kernels.bounds.cells import EDGE, Cell, Poses, poses_of
from relguide.kernels.bounds.goal import ORIGIN, Goal, track_of
from relguide.kernels.bounds.junction import beyond_outward
from relguide.kernels.bounds.round_time import round_bound
from relguide.kernels.bounds.round_turning import round_arrival
from relguide.kernels.bounds.word_bound import (
    ANY,
    NO_JUNCTION,
    OUTWARD,
    Blur,
    Junction,
    soonest,
    soonest_joined,
)
from relguide.kernels.contact.contact import to_frame_of
from relguide.kernels.words.extremals import fly_piece


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
    onward = _onward_bound(scene, goal, cell, poses, beat - cell.start)
    if onward == inf:
        return inf, inf
    soon = soon_bound(start, scene, cell, min(beat - onward, cell.end + EDGE), ANY)
    return max(soon, cell.start), onward


@njit(cache=True, nogil=True)
def soon_bound(start: Pose, scene: Scene, cell: Cell, end: float, kind: int) -> float:
    """How soon a path can be at a contact of the cell, its first.

    Args:
        start: where the path begins, at t = 0.
        scene: the leader and d_min.
        cell: of contacts; there are some.
        end: arrivals from here on do not matter, and come back as infinite [R/V_P].
        kind: of the junction there: see `word_bound.Junction`.
    """
    poses, earliest = poses_of(scene, cell), cell.start - EDGE
    junction = Junction(kind, 1 if cell.side > 0.0 else 0, beyond_outward(scene, cell, 1.0))
    window = Window(earliest, end)
    if kind == ANY and _word_to(start, scene, poses, window, False, NO_JUNCTION) == inf:
        return inf
    soon = _word_to(start, scene, poses, window, True, junction)
    return soon if kind == OUTWARD else min(soon, looped_bound(start, scene, cell, min(end, soon)))


@njit(cache=True, nogil=True)
def looped_bound(start: Pose, scene: Scene, cell: Cell, end: float) -> float:
    """The same for a word and a full loop, or more of them.

    Without one they are paths that arrive no sooner than the soonest word.
    """
    poses = poses_of(scene, cell)
    later = Poses(
        poses.t - TWO_PI, poses.span, poses.middle, poses.vx, poses.vy, poses.differs, poses.left,
        poses.right,
    )  # fmt: skip
    # a second loop takes 4π in all
    earliest = 0.0 if cell.end >= 2.0 * TWO_PI else cell.start - TWO_PI - EDGE
    window = Window(earliest, end - TWO_PI)
    return TWO_PI + _word_to(start, scene, later, window, False, NO_JUNCTION)


@njit(cache=True, nogil=True)
def turned_before_bound(start: Pose, scene: Scene, cell: Cell, turn: float, end: float) -> float:
    """How soon a path can be at a contact of the cell that has last turned away so far.

    Args:
        start: as in `soon_bound`.
        scene: likewise.
        cell: likewise.
        turn: how far [rad].
        end: as in `soon_bound`.
    """
    before = _turned_away(poses_of(scene, cell), cell.side, -turn)
    return turn + _word_to(start, scene, before, Window(0.0, end - turn), False, NO_JUNCTION)


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
    return turn + _onward_bound(scene, goal, later, after, beat - turn)


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
def _word_to(
    start: Pose, scene: Scene, poses: Poses, window: Window, keeps: bool, junction: Junction
) -> float:
    """How soon a word can lead from the start to one of the poses.

    Args:
        start: at t = 0.
        scene: the leader and d_min.
        poses: which move on.
        window: of `soonest_joined`.
        keeps: whether words that certainly break the limit are left out.
        junction: at the end of the word.
    """
    # read backward, the start is what is to be met, and left is right
    blur = Blur(poses.right, poses.left, poses.differs, 0.0)
    c, s = cos(start.h), sin(start.h)
    at, vx, vy = poses.middle, poses.vx, poses.vy
    dx, dy = at.x - poses.t * vx - start.x, at.y - poses.t * vy - start.y
    inside = with_limit(scene, scene.d_min - INSIDE)
    return soonest_joined(
        Pose(-dx * c - dy * s, dx * s - dy * c, at.h - start.h), blur,
        Velocity(vx * c + vy * s, vy * c - vx * s), window, _sieve_from(start, inside, keeps),
        junction,
    )  # fmt: skip


@njit(cache=True, nogil=True)
def _onward_bound(scene: Scene, goal: Goal, cell: Cell, poses: Poses, beat: float) -> float:
    """How soon a path can be at the goal from a contact of a cell, with or without the limit."""
    opens, unlimited = scene.t_release - cell.end, _sieve_from(ORIGIN, scene, False)
    onward = soonest(
        _seen_from(goal, poses), _blur_toward(scene, goal, cell, poses),
        Velocity(goal.speed, 0.0), Window(max(opens, 0.0) - EDGE, beat), unlimited,
    )  # fmt: skip
    left = scene.t_release - cell.start
    if not goal.holds or left <= 0.0 or left >= beat or onward <= opens:
        return onward
    # who is there as the slot opens has met this point by then
    track = track_of(goal, scene.t_release)
    early = soonest(
        _seen_from(track, poses), _blur_toward(scene, track, cell, poses),
        Velocity(track.speed, 0.0), Window(0.0, left + EDGE), unlimited,
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
def _sieve_from(start: Pose, scene: Scene, used: bool) -> Sieve:
    """What leaves out words that break the limit on their way from the start."""
    return Sieve(used, start, 0.0, scene, 1.0, 0.0, 0.0)


@njit(cache=True, nogil=True)
def leaving_bound(scene: Scene, goal: Goal, cell: Cell, beat: float, kind: int) -> float:
    """How soon a path can be at the goal from its last contact, if that is one of the cell's.

    Arguments as `cell_bound`, and `soon_bound` for the kind; infinite from `beat` on.
    """
    junction = Junction(kind, 0 if cell.side > 0.0 else 1, beyond_outward(scene, cell, -1.0))
    found = _word_from(scene, goal, cell, beat, 0.0, junction)
    if kind == OUTWARD:
        return found
    return min(found, looped_leaving_bound(scene, goal, cell, min(beat, found)))


@njit(cache=True, nogil=True)
def looped_leaving_bound(scene: Scene, goal: Goal, cell: Cell, beat: float) -> float:
    """The same for a word and a full loop, or more of them."""
    return TWO_PI + _word_from(scene, goal, cell, beat - TWO_PI, TWO_PI, NO_JUNCTION)


@njit(cache=True, nogil=True)
def _word_from(
    scene: Scene, goal: Goal, cell: Cell, beat: float, looped: float, junction: Junction
) -> float:
    """How soon a word can lead from a contact of the cell to where the goal is so much later."""
    poses = poses_of(scene, cell)
    if poses.differs == inf:
        return inf
    seen = _seen_from(Goal(goal.x + looped * goal.speed, goal.speed, False), poses)
    opens = max(scene.t_release - cell.end, 0.0) - EDGE
    inside = with_limit(scene, scene.d_min - INSIDE)
    end = Pose(goal.x, 0.0, pi)
    return soonest_joined(
        seen, _blur_toward(scene, goal, cell, poses), Velocity(goal.speed, 0.0),
        Window(0.0 if looped > 0.0 else opens, beat),
        Sieve(looped == 0.0, end, goal.speed, inside, -1.0, cell.start, cell.end), junction,
    )  # fmt: skip


@njit(cache=True, nogil=True)
def between_bound(scene: Scene, table: FloatArray, cell: Cell, other: Cell, beat: float) -> float:
    """How soon a path can be at a contact of the other cell from one of this.

    Arguments as `cell_bound` and `round_bound`; infinite from `beat` on.
    """
    if other.end < cell.start:
        return inf
    apart = other.start - cell.end
    beat = min(beat, other.end - cell.start + EDGE)
    if min(cell.piece, other.piece) + 1 == len(scene.leader):
        apart = max(
            apart, min(round_bound(table, 0, cell, other), round_bound(table, 1, cell, other))
        )
    elif apart < beat:
        apart = max(apart, round_arrival(scene, cell, other, cell.start + beat) - cell.start)
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
        _sieve_from(ORIGIN, scene, False),
    )
