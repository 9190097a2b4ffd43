"""How soon a word can lead to the contacts of a cell, or on from them, whatever the limit.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf

from numba import njit

from relguide.kernels.base.norm import norm
from relguide.kernels.base.records import Pose, Scene, Velocity, Window
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.bounds.breach import no_sieve
from relguide.kernels.bounds.cells import EDGE, Cell, Poses, poses_of
from relguide.kernels.bounds.goal import Goal, track_of
from relguide.kernels.bounds.rest import Rest, no_rest
from relguide.kernels.bounds.ways import drifting, fixed, ways_after_turn, ways_from
from relguide.kernels.bounds.word_bound import soonest, soonest_beyond, soonest_kept
from relguide.kernels.bounds.word_intervals import Blur
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
    return Blur(poses.right, poses.left, poses.differs, 0.0, ways_from(poses.ways, -s, -c), fixed())


@njit(cache=True, nogil=True)
def onward_bound(
    scene: Scene, goal: Goal, cell: Cell, poses: Poses, beat: float, rest: Rest
) -> float:
    """How soon a path can be at the goal from a contact of a cell, with or without the limit."""
    opens = scene.t_release - cell.end
    onward, _ = soonest_kept(
        seen_from(goal, poses), blur_toward(scene, goal, cell, poses),
        Velocity(goal.speed, 0.0), Window(max(opens, 0.0) - EDGE, beat), no_sieve(scene), rest,
    )  # fmt: skip
    left = scene.t_release - cell.start
    if not goal.holds or left <= 0.0 or left >= beat or onward <= opens:
        return onward
    # who is there as the slot opens has met this point by then; when does not matter before that
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
    drifts, ways = 0.0, poses.ways
    if cell.piece + 1 < len(scene.leader) or goal.speed != scene.alpha:
        # the goal does not move with the contacts
        x, y = poses.span * (poses.vx - goal.speed), poses.span * poses.vy
        drifts, ways = norm(x, y), drifting(ways, x, y)
    return Blur(poses.left + drifts, poses.right + drifts, poses.differs, 0.0, ways, fixed())


@njit(cache=True, nogil=True)
def turned_away(poses: Poses, side: float, turn: float) -> Poses:
    """The poses after a turn away from the leader, before it if that is negative."""
    # the centre of that turn stays where it is
    kept = poses.right if side > 0.0 else poses.left
    other = kept + 2.0 * poses.differs
    left, right = (other, kept) if side > 0.0 else (kept, other)
    middle = fly_piece(poses.middle, -side, turn)
    ways = ways_after_turn(
        poses.ways, sine_and_cosine(poses.middle.h), sine_and_cosine(middle.h), -side,
        poses.differs,
    )  # fmt: skip
    return Poses(
        poses.t + turn, poses.span, middle, poses.vx, poses.vy, poses.differs, left, right, ways
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
    return took + onward_bound(scene, goal, later, there, beat - took, no_rest())
