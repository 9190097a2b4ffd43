"""How soon a path can come from one contact to its next one: proved. Behind a straight leader only.

Behind a leader that keeps straight, as a leader that has turned does on its final leg, nothing
depends on the time, so a contact is a bearing and a side. From one contact to the next a path is a
word, which begins and ends as contacts can be passed (see `junction`): where k < 1 it does not
begin with a turn toward the leader, and where k < 0 it does not begin straight. How it ends is
bounded likewise: flown back, with the leader backward too, and mirrored across the leader's beam,
the word is one that begins there (`turned_round`).

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise. Contacts lie at d_min itself.
"""

from math import inf, pi

from numba import njit

from relguide.kernels.base.angles import TWO_PI
from relguide.kernels.base.norm import norm
from relguide.kernels.base.records import Pose, Scene, Velocity, Window, with_limit
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.bounds.words.breach import INSIDE, Sieve, no_sieve
from relguide.kernels.bounds.words.cell_words import blur_between
from relguide.kernels.bounds.words.cells import Cell, Poses, poses_of
from relguide.kernels.bounds.words.found_word import ByTurn, Junction, all_open
from relguide.kernels.bounds.words.junction import junction_of
from relguide.kernels.bounds.words.word_bound import soonest, soonest_by_turn
from relguide.kernels.contact.contact import to_frame_of

LONG = 2.0
"""Words that take no longer do not come so close that it is looked for [R/V_P]."""


@njit(cache=True, nogil=True)
def standing(piece: int, side: float, bearing: float, half: float) -> Cell:
    """A cell behind a leader that keeps straight, where times do not matter."""
    return Cell(piece, side, bearing, half, 0.0, inf)


@njit(cache=True, nogil=True)
def final_leg(scene: Scene) -> Scene:
    """The same leader as if it had never turned. Of its pieces there is only the first one."""
    last = scene.leader[len(scene.leader) - 1 :]
    return Scene(last, scene.alpha, scene.d_min, scene.t_release, scene.until)


@njit(cache=True, nogil=True)
def on_final_leg(cell: Cell) -> Cell:
    """The contacts of a cell on the final leg, whenever they are, as `final_leg` has them."""
    return standing(0, cell.side, cell.bearing, cell.half)


@njit(cache=True, nogil=True)
def turned_round(cell: Cell) -> Cell:
    """The contacts of a cell, flown back and mirrored across the leader's beam."""
    bearing = (pi if cell.bearing > 0.0 else -pi) - cell.bearing
    return Cell(cell.piece, cell.side, bearing, cell.half, cell.start, cell.end)


@njit(cache=True, nogil=True)
def hop_bound(scene: Scene, cell: Cell, other: Cell, window: Window) -> float:
    """No word without full loops leads sooner from a contact of a cell to the next, in the other.

    Only how it begins is looked at, and that it does not come through the disc.

    Args:
        scene: a leader that keeps straight, and d_min.
        cell: of contacts, made by `standing`.
        other: likewise.
        window: words that take less time than `earliest` do not count; infinite from `beat` on.
    """
    return hop_toward(scene, cell, poses_of(scene, other), window, 0.0)


@njit(cache=True, nogil=True)
def hop_toward(scene: Scene, cell: Cell, end: Poses, window: Window, astray: float) -> float:
    """The same to any poses that move with the leader.

    Args:
        scene: as in `hop_bound`.
        cell: likewise.
        end: the poses.
        window: as in `hop_bound`.
        astray: how far from the word the path may lie that keeps the limit [R].
    """
    begin = poses_of(scene, cell)
    if begin.differs == inf or end.differs == inf:
        return inf
    junction = junction_of(scene, cell, -1.0, True)
    s, c = sine_and_cosine(end.middle.h)
    back = Pose(end.middle.x, end.middle.y, end.middle.h + pi)
    inside = limit_for(scene, end, window.beat, astray)
    sieve = Sieve(window.beat > LONG, back, scene.alpha, inside, -1.0, 0.0, inf)
    found = soonest_by_turn(
        to_frame_of(begin.middle, end.middle), blur_between(begin, end),
        Velocity(scene.alpha * c, -scene.alpha * s), window, sieve, junction, all_open(), False,
    )  # fmt: skip
    return as_may_be(found, junction)


@njit(cache=True, nogil=True)
def as_may_be(found: ByTurn, junction: Junction) -> float:
    """How soon a word leads from a contact, or to it, as one may that has others beside it.

    Args:
        found: by what the words do there.
        junction: what was asked of that.
    """
    outward, inward = found.left, found.right
    if junction.outward == 1:
        outward, inward = inward, outward
    soon = min(found.tangent, outward)
    return min(soon, inward) if junction.inward else soon


@njit(cache=True, nogil=True)
def limit_for(scene: Scene, poses: Poses, longest: float, astray: float) -> Scene:
    """The limit that a path from the middle of some poses breaks if one from any of them may not.

    That one is the same path, moved and turned as its pose is.

    Args:
        scene: the leader and d_min.
        poses: of contacts.
        longest: no path takes longer [R/V_P].
        astray: how far besides from it that one may lie [R].
    """
    moved = astray + max(poses.left, poses.right) + poses.differs * (2.0 + longest)
    moved += poses.span * (norm(poses.vx, poses.vy) + scene.alpha)
    return with_limit(scene, max(scene.d_min - INSIDE - moved, 0.0))


@njit(cache=True, nogil=True)
def hops_within(scene: Scene, cell: Cell, other: Cell, window: Window) -> bool:
    """Whether any word, with or without loops, may lead to the next contact within a window.

    Arguments as `hop_bound`; both how it begins and how it ends are looked at.
    """
    back, onto = turned_round(other), turned_round(cell)
    if (
        hop_bound(scene, cell, other, window) < window.beat
        and hop_bound(scene, back, onto, window) < window.beat
    ):
        return True
    if window.beat <= TWO_PI:
        return False
    # without one of its loops the path meets the contact earlier, where that is a loop later
    begin, end = poses_of(scene, cell), poses_of(scene, other)
    s, c = sine_and_cosine(end.middle.h)
    met = Pose(end.middle.x + TWO_PI * scene.alpha, end.middle.y, end.middle.h)
    left = window.beat - TWO_PI
    looped = soonest(
        to_frame_of(begin.middle, met), blur_between(begin, end),
        Velocity(scene.alpha * c, -scene.alpha * s), Window(0.0, left), no_sieve(scene),
    )  # fmt: skip
    return bool(looped < left)
