"""How soon a path can come from a contact in one cell to another one, in another cell: proved.

Whatever happens between them, it takes at least as long as the soonest word from pose to pose, and
as something that need not turn takes round the disc: a boundary arc comes as close to that as it
can.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise. Contacts lie at d_min itself.
"""

from math import inf

from numba import njit

from relguide.kernels.base.norm import norm
from relguide.kernels.base.records import Pose, Scene, Velocity, Window
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.bounds.breach import no_sieve
from relguide.kernels.bounds.cell_words import turned_away
from relguide.kernels.bounds.cells import EDGE, Cell, Poses, poses_of
from relguide.kernels.bounds.kept_fronts import Fronts, round_arrival
from relguide.kernels.bounds.round_time import round_bound
from relguide.kernels.bounds.ways import drifting, ways_from
from relguide.kernels.bounds.word_bound import soonest_beyond
from relguide.kernels.bounds.word_intervals import Blur
from relguide.kernels.contact.contact import to_frame_of


@njit(cache=True, nogil=True)
def round_between(
    fronts: Fronts, n: int, scene: Scene, table: FloatArray, cell: Cell, other: Cell, beat: float
) -> float:
    """How soon a path can be at a contact of the other cell from one of this, round the leader.

    Arguments as `contact_bound.cell_bound`, `round_bound` and `round_arrival`; infinite from `beat`
    on.
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
        arrival = round_arrival(fronts, n, scene, table, cell, other, cell.start + beat)
        apart = max(apart, arrival - cell.start)
    return apart if apart < beat else inf


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
        end.ways,
    )  # fmt: skip


@njit(cache=True, nogil=True)
def blur_between(begin: Poses, end: Poses) -> Blur:
    """How far some poses may lie from their middle, as others see them that may lie so far."""
    moved, (s, c) = max(end.left, end.right), sine_and_cosine(end.middle.h)
    # who begins earlier or later finds the others elsewhere
    x, y = begin.span * (begin.vx - end.vx), begin.span * (begin.vy - end.vy)
    return Blur(
        begin.left + moved, begin.right + moved, begin.differs + end.differs, end.differs,
        ways_from(drifting(begin.ways, x, y), s, c), ways_from(end.ways, s, c),
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
