"""How soon a path can be at a contact of a cell with time to spare, and on from there: proved.

It comes there by any way that takes just so long: see `junction`. Where it goes from there is in
`after_spare`.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise. Contacts lie at d_min itself.
"""

from math import inf

from numba import njit

from relguide.kernels.base.norm import norm
from relguide.kernels.base.records import Pose, Scene, Window
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.bounds.breach import no_sieve
from relguide.kernels.bounds.cell_words import onward_bound, seen_from_start, word_to
from relguide.kernels.bounds.cells import EDGE, Cell, Poses, poses_of
from relguide.kernels.bounds.goal import Goal
from relguide.kernels.bounds.rest import Rest
from relguide.kernels.bounds.word_bound import soonest_beyond
from relguide.kernels.bounds.word_intervals import Blur

_MOMENT = 0.02  # a window of time no wider than twice this is not narrowed further [R/V_P]


@njit(cache=True, nogil=True)
def spare_bound(
    start: Pose, scene: Scene, goal: Goal, cell: Cell, beat: float, on: Rest
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
    if onward == inf or not _can_be_as_long(start, scene, poses, end):
        return inf, onward
    if poses.span < _MOMENT:
        return cell.start, onward
    strays = poses.span * norm(poses.vx, poses.vy)
    there = Poses(
        poses.t, 0.0, poses.middle, 0.0, 0.0, poses.differs, poses.left + strays,
        poses.right + strays,
    )  # fmt: skip
    return max(word_to(start, scene, there, Window(0.0, end)), cell.start), onward


@njit(cache=True, nogil=True)
def _can_be_as_long(start: Pose, scene: Scene, poses: Poses, end: float) -> bool:
    """Whether a path from the start, at t = 0, may be at one of the poses at its time.

    Who is has met a point that moves at V_P along the pose's heading and is there at that time:
    then, if not sooner. The soonest of those that do so is an extremal: see `goal.track_of`.
    """
    at = poses.middle
    vy, vx = sine_and_cosine(at.h)
    strays = poses.span * (norm(poses.vx - vx, poses.vy - vy) + poses.differs)
    strays += (poses.t + poses.span) * poses.differs
    track = Poses(
        poses.t, 0.0, at, vx, vy, poses.differs, poses.left + strays, poses.right + strays
    )  # fmt: skip
    seen, target = seen_from_start(start, track)
    blur = Blur(track.right, track.left, track.differs, 0.0)
    # how soon does not matter
    met = soonest_beyond(seen, blur, target, Window(0.0, end), no_sieve(scene), end - EDGE)
    return bool(met < inf)
