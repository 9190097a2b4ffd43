"""How soon a word can lead to the contacts of a cell, between two cells, or on from one.

The limit does not count here: whatever happens between two poses takes at least as long as the
soonest word.

Where time is short, no path may be long enough to be at a contact just at its time, though a
shorter path leads there. A path that is at a pose at its time has met a point that moves at V_P
along the pose's heading and is there at that time. The soonest path to meet that point is an
extremal (see `sets.track_of`), so words rule such contacts out (`can_be_at`, `can_go_on_to`).

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise. Contacts lie at d_min itself.
"""

from math import inf

from numba import njit

from relguide.kernels.base.norm import norm
from relguide.kernels.base.records import Pose, Scene, Velocity, Window
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.bounds.words.breach import no_sieve
from relguide.kernels.bounds.words.cells import Cell, Poses, poses_of
from relguide.kernels.bounds.words.found_word import OpenIntervals, all_open
from relguide.kernels.bounds.words.sets import (
    EDGE,
    Blur,
    Goal,
    drifting,
    fixed,
    sensitivity_after_turn,
    sensitivity_from,
    track_of,
    unknown_sensitivity,
)
from relguide.kernels.bounds.words.word_bound import soonest, soonest_beyond, soonest_kept
from relguide.kernels.contact.contact import to_frame_of
from relguide.kernels.words.extremals import fly_piece


@njit(cache=True, nogil=True)
def word_to(start: Pose, scene: Scene, poses: Poses, window: Window) -> float:
    """How soon a word can lead from the start, at t = 0, to one of the poses, which move on."""
    at, target = seen_from_start(start, poses)
    return soonest(at, blur_backward(start, poses), target, window, no_sieve(scene))


@njit(cache=True, nogil=True)
def seen_from_start(start: Pose, poses: Poses) -> tuple[Pose, Velocity]:
    """The middle of some poses read backward, so that the start is what is to be met."""
    s, c = sine_and_cosine(start.h)
    at, vx, vy = poses.middle, poses.vx, poses.vy
    dx, dy = at.x - poses.t * vx - start.x, at.y - poses.t * vy - start.y
    seen = Pose(-dx * c - dy * s, dx * s - dy * c, at.h - start.h)
    return seen, Velocity(vx * c + vy * s, vy * c - vx * s)


@njit(cache=True, nogil=True)
def blur_backward(start: Pose, poses: Poses) -> Blur:
    """How far some poses, read backward, may lie from their middle, as the start sees them."""
    s, c = sine_and_cosine(start.h)
    # left is right
    return Blur(
        poses.right,
        poses.left,
        poses.differs,
        0.0,
        sensitivity_from(poses.sensitivity, -s, -c),
        fixed(),
    )


@njit(cache=True, nogil=True)
def onward_bound(
    scene: Scene, goal: Goal, cell: Cell, poses: Poses, beat: float, open_intervals: OpenIntervals
) -> float:
    """How soon a path can be at the goal from a contact of a cell, with or without the limit."""
    opens = scene.t_release - cell.end
    onward, _ = soonest_kept(
        seen_from(goal, poses), blur_toward(scene, goal, cell, poses),
        Velocity(goal.speed, 0.0), Window(max(opens, 0.0) - EDGE, beat), no_sieve(scene),
        open_intervals,
    )  # fmt: skip
    left = scene.t_release - cell.start
    if not goal.holds or left <= 0.0 or left >= beat or onward <= opens:
        return onward
    # a path that is there as the slot opens has met this point by then, no matter when
    track = track_of(goal, scene.t_release)
    early = soonest_beyond(
        seen_from(track, poses), blur_toward(scene, track, cell, poses),
        Velocity(track.speed, 0.0), Window(0.0, left + EDGE), no_sieve(scene), opens,
    )  # fmt: skip
    return min(onward, max(opens, early)) if early < inf else onward


@njit(cache=True, nogil=True)
def seen_from(goal: Goal, poses: Poses) -> Pose:
    """The middle of a cell's poses, seen from the goal at that time."""
    at = poses.middle
    return Pose(at.x - goal.x - goal.speed * poses.t, at.y, at.h)


@njit(cache=True, nogil=True)
def blur_toward(scene: Scene, goal: Goal, cell: Cell, poses: Poses) -> Blur:
    """How far the poses of a cell may lie from their middle, as the goal sees them."""
    drifts, sensitivity = 0.0, poses.sensitivity
    if cell.piece + 1 < len(scene.leader) or goal.speed != scene.alpha:
        # the goal does not move with the contacts
        x, y = poses.span * (poses.vx - goal.speed), poses.span * poses.vy
        drifts, sensitivity = norm(x, y), drifting(sensitivity, x, y)
    return Blur(poses.left + drifts, poses.right + drifts, poses.differs, 0.0, sensitivity, fixed())


@njit(cache=True, nogil=True)
def turned_away(poses: Poses, side: float, turn: float) -> Poses:
    """The poses after a turn away from the leader, before it if that is negative."""
    # the centre of that turn stays where it is
    kept = poses.right if side > 0.0 else poses.left
    other = kept + 2.0 * poses.differs
    left, right = (other, kept) if side > 0.0 else (kept, other)
    middle = fly_piece(poses.middle, -side, turn)
    sensitivity = sensitivity_after_turn(
        poses.sensitivity, sine_and_cosine(poses.middle.h), sine_and_cosine(middle.h), -side,
        poses.differs,
    )  # fmt: skip
    return Poses(
        poses.t + turn,
        poses.span,
        middle,
        poses.vx,
        poses.vy,
        poses.differs,
        left,
        right,
        sensitivity,
    )


@njit(cache=True, nogil=True)
def turned_before_bound(start: Pose, scene: Scene, cell: Cell, turn: float, end: float) -> float:
    """How soon a path can be at a contact of the cell that has last turned away so far.

    Args:
        start: where the path begins, at t = 0.
        scene: the leader and d_min.
        cell: of contacts.
        turn: how far [rad].
        end: arrivals from here on do not matter, and come back as infinite [R/V_P].
    """
    before = turned_away(poses_of(scene, cell), cell.side, -turn)
    return turn + word_to(start, scene, before, Window(0.0, end - turn))


@njit(cache=True, nogil=True)
def turned_after_bound(scene: Scene, goal: Goal, cell: Cell, turn: float, beat: float) -> float:
    """How soon a path can be at the goal from a contact of the cell that first turns away so far.

    Args:
        scene: the leader and d_min; arrivals before its t_release do not count.
        goal: where the path is to arrive.
        cell: of contacts; there are such.
        turn: how far [rad].
        beat: arrivals from here on do not matter, and all times come back as infinite [R/V_P].
    """
    after = turned_away(poses_of(scene, cell), cell.side, turn)
    return later_bound(scene, goal, cell, after, turn, beat)


@njit(cache=True, nogil=True)
def later_bound(
    scene: Scene, goal: Goal, cell: Cell, there: Poses, took: float, beat: float
) -> float:
    """How soon a path can be at the goal from a contact of the cell, if it is there so much later.

    Args:
        scene: as in `turned_after_bound`.
        goal: likewise.
        cell: likewise.
        there: where paths of the cell are then.
        took: how long after the contact [R/V_P].
        beat: as in `turned_after_bound`.
    """
    later = Cell(cell.piece, cell.side, cell.bearing, cell.half, cell.start + took, cell.end + took)
    return took + onward_bound(scene, goal, later, there, beat - took, all_open())


@njit(cache=True, nogil=True)
def word_between(
    scene: Scene, cell: Cell, other: Cell, beat: float, after: float, before: float,
    enough: float,
) -> float:  # fmt: skip
    """No word leads sooner to a contact of the other cell from one of this.

    Args:
        scene: as in `contact_bound.cell_bound`.
        cell: likewise.
        other: of the contacts to which it leads.
        beat: as in `contact_bound.cell_bound`.
        after: how far it first turns away from the leader, at least [rad].
        before: and how far just before the other contact [rad].
        enough: whether a word does so sooner than this does not matter [R/V_P].
    """
    begin = poses_of(scene, cell)
    if begin.differs == inf:
        return inf
    if after > 0.0:
        begin = turned_away(begin, cell.side, after)
    on = word_from(scene, begin, cell.piece, other, beat - after, before, enough - after)
    return after + on


@njit(cache=True, nogil=True)
def word_from(
    scene: Scene, begin: Poses, piece: int, other: Cell, beat: float, before: float, enough: float
) -> float:
    """No word leads sooner to a contact of a cell from any of some poses.

    Args:
        scene: as in `contact_bound.cell_bound`.
        begin: the poses.
        piece: of the leader's intent on which their cell is.
        other: as in `word_between`.
        beat: likewise.
        before: likewise.
        enough: likewise.
    """
    end = poses_of(scene, other)
    if end.differs == inf:
        return inf
    if before > 0.0:
        end = turned_away(end, other.side, -before)
    there = moved_with(end, begin, min(piece, other.piece) + 1 < len(scene.leader))
    return before + word_toward(scene, begin, there, beat - before, enough - before)


@njit(cache=True, nogil=True)
def moved_with(end: Poses, begin: Poses, drifts: bool) -> Poses:
    """Where some poses would be at the time of others, had they always moved as they then do.

    Args:
        end: the ones.
        begin: the others.
        drifts: whether these move otherwise.
    """
    strays = begin.span * norm(begin.vx - end.vx, begin.vy - end.vy) if drifts else 0.0
    early = begin.t - end.t
    met = Pose(end.middle.x + early * end.vx, end.middle.y + early * end.vy, end.middle.h)
    return Poses(
        end.t, end.span, met, end.vx, end.vy, end.differs, end.left + strays, end.right + strays,
        end.sensitivity,
    )  # fmt: skip


@njit(cache=True, nogil=True)
def blur_between(begin: Poses, end: Poses) -> Blur:
    """How far some poses may lie from their middle, as others see them that may lie so far."""
    moved, (s, c) = max(end.left, end.right), sine_and_cosine(end.middle.h)
    # a path that begins earlier or later finds the others elsewhere
    x, y = begin.span * (begin.vx - end.vx), begin.span * (begin.vy - end.vy)
    return Blur(
        begin.left + moved, begin.right + moved, begin.differs + end.differs, end.differs,
        sensitivity_from(drifting(begin.sensitivity, x, y), s, c),
        sensitivity_from(end.sensitivity, s, c),
    )  # fmt: skip


@njit(cache=True, nogil=True)
def word_toward(scene: Scene, begin: Poses, end: Poses, beat: float, enough: float) -> float:
    """No word leads sooner from any of some poses to any of others, which move on as they do.

    Both are where they are as the word begins. Arguments as `word_between`.
    """
    s, c = sine_and_cosine(end.middle.h)
    return soonest_beyond(
        to_frame_of(begin.middle, end.middle), blur_between(begin, end),
        Velocity(end.vx * c + end.vy * s, end.vy * c - end.vx * s),
        Window(0.0, beat), no_sieve(scene), enough,
    )  # fmt: skip


@njit(cache=True, nogil=True)
def can_be_there(start: Pose, scene: Scene, poses: Poses, end: float) -> bool:
    """Whether a path from the start, at t = 0, may be at one of the poses at its time.

    Args:
        start: where it begins.
        scene: the leader.
        poses: of a cell whose window of time has an end.
        end: how late it may be there [R/V_P].
    """
    track = _track_of(poses, poses.t + poses.span)
    seen, target = seen_from_start(start, track)
    blur = blur_backward(start, track)
    # how soon does not matter
    met = soonest_beyond(seen, blur, target, Window(0.0, end), no_sieve(scene), end - EDGE)
    return bool(met < inf)


@njit(cache=True, nogil=True)
def can_be_at(start: Pose, scene: Scene, cell: Cell) -> bool:
    """Whether a path from the start, at t = 0, may be at a contact of a cell just then."""
    poses = poses_of(scene, cell)
    if cell.end == inf or poses.differs == inf:
        return bool(poses.differs < inf)
    return can_be_there(start, scene, poses, cell.end + EDGE)


@njit(cache=True, nogil=True)
def can_go_on_to(scene: Scene, begin: Poses, other: Cell) -> bool:
    """Whether a path from one of some poses, at its time, may be at a contact of a cell at its.

    Args:
        scene: the leader and d_min.
        begin: where it begins; the window of time of their cell has an end.
        other: where it leads to.
    """
    end = poses_of(scene, other)
    if other.end == inf or end.differs == inf:
        return bool(end.differs < inf)
    longest = end.t + end.span - begin.t + begin.span + EDGE
    there = moved_with(_track_of(end, longest), begin, True)
    return word_toward(scene, begin, there, longest + EDGE, longest) < inf


@njit(cache=True, nogil=True)
def _track_of(poses: Poses, longest: float) -> Poses:
    """Points that move along the poses' headings at V_P and are there at their times.

    Args:
        poses: of a cell whose window of time has an end.
        longest: how long before that at most it matters where they are [R/V_P].
    """
    vy, vx = sine_and_cosine(poses.middle.h)
    strays = poses.span * (norm(poses.vx - vx, poses.vy - vy) + poses.differs)
    strays += longest * poses.differs
    return Poses(
        poses.t, 0.0, poses.middle, vx, vy, poses.differs, poses.left + strays,
        poses.right + strays, unknown_sensitivity(),
    )  # fmt: skip
