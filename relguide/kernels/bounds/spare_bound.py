"""How soon a path can be at a contact of a cell with time to spare, and on from there: proved.

It comes there by any way that takes just so long: see `junction`. Where it goes from there is in
`after_spare`.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise. Contacts lie at d_min itself.
"""

from math import inf

from numba import njit

from relguide.kernels.base.norm import norm
from relguide.kernels.base.records import Pose, Scene, Window
from relguide.kernels.bounds.as_long import can_be_there
from relguide.kernels.bounds.cell_words import onward_bound, word_to
from relguide.kernels.bounds.cells import EDGE, Cell, Poses, poses_of
from relguide.kernels.bounds.goal import Goal
from relguide.kernels.bounds.rest import Rest
from relguide.kernels.bounds.ways import drifting

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
    if onward == inf or not can_be_there(start, scene, poses, end):
        return inf, onward
    if poses.span < _MOMENT:
        return cell.start, onward
    x, y = poses.span * poses.vx, poses.span * poses.vy
    strays, ways = norm(x, y), drifting(poses.ways, x, y)
    there = Poses(
        poses.t, 0.0, poses.middle, 0.0, 0.0, poses.differs, poses.left + strays,
        poses.right + strays, ways,
    )  # fmt: skip
    return max(word_to(start, scene, there, Window(0.0, end)), cell.start), onward
