"""Whether any path, whatever its way, can be at a contact of a cell just when it is there: proved.

Where there is little time no path may be as long as that, though a shorter one leads there: who
must turn all the time cannot turn more on the way. Who is at a pose at its time has met a point
that moves at V_P along its heading and is there at that time: then, if not sooner. The soonest of
those that meet it is an extremal: see `goal.track_of`. So none has to be as long itself.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise. Contacts lie at d_min itself.
"""

from math import inf

from numba import njit

from relguide.kernels.base.norm import norm
from relguide.kernels.base.records import Pose, Scene, Window
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.bounds.between import moved_with, word_toward
from relguide.kernels.bounds.breach import no_sieve
from relguide.kernels.bounds.cell_words import blur_backward, seen_from_start
from relguide.kernels.bounds.cells import EDGE, Cell, Poses, poses_of
from relguide.kernels.bounds.ways import no_ways
from relguide.kernels.bounds.word_bound import soonest_beyond


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
        poses.right + strays, no_ways(),
    )  # fmt: skip
