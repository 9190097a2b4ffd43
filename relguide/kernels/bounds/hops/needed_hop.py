"""Whether a path from one contact to another, which cannot slide all the way, comes in time.

Behind a leader that keeps straight. The time round the disc knows nothing of sides, nor of where
bank is not enough to follow it (see `junction`). But on the way from a contact F to a contact L
there are a contact P and the next one, N,

- if F and L are on different sides: P on the side of F, and N on the other;
- if they are on the same side, but the path goes round the leader the other way: as before; or the
  path has contacts on that one side only, and from P to N it goes past the bearing midway.

From F to P, and from N to L, it takes no less than round the disc, the one way or the other, and
no less than the soonest word; and from P to N as long as a word that begins and ends as it must
(see `hop`), and no less than round the disc (`hop_is_late`).

Beside the leader bank may not be enough to slide the right way either. A path that goes past a
bearing m there does so in some pose X: at a distance ρ ≥ d_min from the leader and on a heading η
with which the bearing does not change the other way,

    s (sin(η − m) + α sin m) ≥ 0,    s = +1 counter-clockwise.

From the one contact to X, and from X to the other, it takes no less than the soonest word, whatever
the limit. Where k > 1 that says much: a path that passes close by, and neither comes from inside
the disc nor goes there, has to turn away before it, and again after it. The poses X are put into
cells of ρ and η, which are halved (`passes_late`).

A bound of one of these three reasons costs as much as some twenty bounds of pairs of cells. So
`hops_late` stops asking for a reason as long as that seldom helps.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf, pi, sin

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap, wrap_signed
from relguide.kernels.base.records import Pose, Scene, Window
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.bounds.fronts.around import round_bound, round_over
from relguide.kernels.bounds.hops.hop import hops_within, standing
from relguide.kernels.bounds.words.cell_words import word_between, word_toward
from relguide.kernels.bounds.words.cells import Cell, Poses, poses_of
from relguide.kernels.bounds.words.sets import unknown_sensitivity
from relguide.kernels.contact.nodes import IntArray
from relguide.kernels.separation.clearance import leader_at

BESIDE = 0.5 * pi
"""The bearing where a path that passes counter-clockwise must bank most to slide [rad]."""
_CELLS = 8  # of each side, at first
_MOST = 3_000  # pairs of cells are looked at
_STACK = 256
_SMALLEST = 1e-3  # of a cell [rad]
_LARGEST = 0.1  # of one of which words are looked at [rad]
_ROUNDING = 1e-9  # of a time, as part of it
_ANYHOW = -1  # instead of a way round
_HEADINGS = 8  # cells a whole turn is cut into at first
_MOST_POSES = 1_000  # cells are looked at
_STACK_OF_POSES = 128
_SMALLEST_POSES = 3e-5  # of a cell [R or rad]
REASONS = 3
"""How many reasons there are."""
_CHANGE, _TURN_BACK, _PASS = 0, 1, 2  # sides; to go the other way; beside, where no path can slide
_VAIN = 2  # what a look in vain counts, where one that helps makes up for 1


@njit(cache=True, nogil=True)
def needs_hop(scene: Scene, cell: Cell, other: Cell, way: int) -> bool:
    """Whether no path can slide all the way from any contact of a cell to any of another one.

    Args:
        scene: a leader that keeps straight, and d_min.
        cell: of contacts.
        other: likewise.
        way: 0 counter-clockwise round the leader, 1 clockwise.
    """
    if cell.side != other.side:
        return True
    sense, reach = 1.0 - 2.0 * way, cell.half + other.half
    over = wrap(sense * (other.bearing - cell.bearing))
    if over <= reach or over + reach >= TWO_PI:
        return False
    if cell.side != sense:
        return True
    beside = wrap(sense * (sense * BESIDE - cell.bearing))
    between = cell.half < beside < over - other.half
    return between and (1.0 + scene.alpha) ** 2 > scene.d_min


@njit(cache=True, nogil=True)
def hop_is_late(
    scene: Scene, table: FloatArray, cell: Cell, other: Cell, way: int, slack: float
) -> bool:
    """Whether certainly no path leads from any contact of a cell to one of another within a time.

    Args:
        scene: a leader that keeps straight, and d_min.
        table: of `times_round`.
        cell: of contacts.
        other: of contacts on the other side, or reached the other way round.
        way: which way round, where both are on one side.
        slack: the time [R/V_P].
    """
    if not _is_late(scene, table, cell, other, -cell.side, _ANYHOW, 0.0, slack):
        return False
    if cell.side != other.side:
        return True
    if table[way, -1] <= slack:
        return False
    sense = 1.0 - 2.0 * way
    past = cell.bearing + 0.5 * sense * wrap(sense * (other.bearing - cell.bearing))
    return _is_late(scene, table, cell, other, cell.side, way, past, slack)


@njit(cache=True, nogil=True)
def _is_late(
    scene: Scene, table: FloatArray, cell: Cell, other: Cell, side: float, way: int, past: float,
    slack: float,
) -> bool:  # fmt: skip
    """Whether that is so of paths with P on the side of the cell, and N on this side.

    If a way is given, N is reached that way past a bearing.
    """
    first = standing(cell.piece, cell.side, cell.bearing, cell.half)
    last = standing(other.piece, other.side, other.bearing, other.half)
    stack = np.empty((_STACK, 4))
    count, half = 0, pi / _CELLS
    for i in range(_CELLS):
        for j in range(_CELLS):
            stack[count, 0], stack[count, 1] = (2 * i + 1) * half - pi, half
            stack[count, 2], stack[count, 3] = (2 * j + 1) * half - pi, half
            count += 1
    for _ in range(_MOST):
        if count == 0:
            return True
        count -= 1
        p, p_half, n, n_half = stack[count]
        here = standing(cell.piece, cell.side, p, p_half)
        there = standing(cell.piece, side, n, n_half)
        before, after = _either_way(table, first, here), _either_way(table, there, last)
        if way == _ANYHOW:
            between = _either_way(table, here, there)
        elif _may_pass(table, here, there, way, past, slack):
            between = round_bound(table, way, here, there)
        else:
            continue
        if before + between + after >= slack:
            continue
        size = max(p_half, n_half)
        if size < _LARGEST:
            left = slack - between - after
            before = max(before, word_between(scene, first, here, left, 0.0, 0.0, before))
            left = slack - before - between
            if before < inf:
                after = max(after, word_between(scene, there, last, left, 0.0, 0.0, after))
            window = Window(between * (1.0 - _ROUNDING), slack - before - after)
            if between >= window.beat or not hops_within(scene, here, there, window):
                continue
        if size < _SMALLEST or count + 2 > _STACK:
            return False
        for i in range(2):
            stack[count] = p, p_half, n, n_half
            column = 0 if p_half >= n_half else 2
            stack[count, column + 1] *= 0.5
            stack[count, column] += (2 * i - 1) * stack[count, column + 1]
            count += 1
    return False


@njit(cache=True, nogil=True)
def _either_way(table: FloatArray, cell: Cell, other: Cell) -> float:
    return min(round_bound(table, 0, cell, other), round_bound(table, 1, cell, other))


@njit(cache=True, nogil=True)
def _may_pass(
    table: FloatArray, begin: Cell, end: Cell, way: int, past: float, slack: float
) -> bool:
    """Whether a bearing may lie between contacts of both, on the way round, of no whole round."""
    sense = 1.0 - 2.0 * way
    over, ahead = wrap(sense * (end.bearing - begin.bearing)), wrap(sense * (past - begin.bearing))
    reach = begin.half + end.half
    if over + reach >= TWO_PI:
        # a little way, or nearly a whole round
        edge = begin.bearing + sense * begin.half
        if over > reach and round_over(table, way, wrap_signed(edge), over - reach) >= slack:
            over -= TWO_PI
    furthest = over + end.half
    return ahead <= furthest or -begin.half <= ahead - TWO_PI <= furthest


@njit(cache=True, nogil=True)
def passes_late(
    scene: Scene, cell: Cell, other: Cell, way: int, bearing: float, slack: float
) -> bool:
    """Whether certainly no path that goes past a bearing comes from one cell to another in time.

    Args:
        scene: a leader that keeps straight, and d_min.
        cell: of contacts.
        other: likewise.
        way: 0 counter-clockwise round the leader, 1 clockwise.
        bearing: between them.
        slack: the time [R/V_P].
    """
    begin = poses_of(scene, standing(cell.piece, cell.side, cell.bearing, cell.half))
    end = poses_of(scene, standing(other.piece, other.side, other.bearing, other.half))
    if begin.differs == inf or end.differs == inf:
        return False
    there, (s, c) = leader_at(scene, cell.piece, 0.0), sine_and_cosine(bearing)
    # a path that is further away comes there late, or goes on late
    reach = 0.25 * (1.0 + scene.alpha) * slack
    stack = np.empty((_STACK_OF_POSES, 4))
    count, half = 0, pi / _HEADINGS
    for k in range(_HEADINGS):
        stack[count] = scene.d_min + reach, reach, (2 * k + 1) * half, half
        count += 1
    for _ in range(_MOST_POSES):
        if count == 0:
            return True
        count -= 1
        rho, wide, heading, half = stack[count]
        pace = (1.0 - 2.0 * way) * (sin(heading - bearing) + scene.alpha * s)
        if pace + half < 0.0:
            continue
        middle = Pose(there.x + rho * c, there.y + rho * s, heading)
        at = Poses(
            0.0,
            0.0,
            middle,
            scene.alpha,
            0.0,
            half,
            wide + half,
            wide + half,
            unknown_sensitivity(),
        )
        took = word_toward(scene, begin, at, slack, 0.0)
        if took >= slack or took + word_toward(scene, at, end, slack - took, 0.0) >= slack:
            continue
        if max(wide, half) < _SMALLEST_POSES or count + 2 > _STACK_OF_POSES:
            return False
        for k in range(2):
            stack[count] = rho, wide, heading, half
            column = 0 if wide >= half else 2
            stack[count, column + 1] *= 0.5
            stack[count, column] += (2 * k - 1) * stack[count, column + 1]
            count += 1
    return False


@njit(cache=True, nogil=True)
def hops_late(
    scene: Scene, table: FloatArray, cell: Cell, other: Cell, slack: float, vain: IntArray,
    most: int,
) -> bool:  # fmt: skip
    """Whether certainly no path leads from any contact of a cell to one of another within a time.

    Args:
        scene: a leader that keeps straight, and d_min.
        table: of `times_round`.
        cell: of contacts.
        other: likewise.
        slack: the time [R/V_P].
        vain: how much has been looked for each reason in vain, which changes. shape (REASONS,)
        most: how far that may come.
    """
    changes = cell.side != other.side
    for way in range(2):
        if round_bound(table, way, cell, other) >= slack:
            continue
        if not needs_hop(scene, cell, other, way):
            return False
        slides_on = cell.side == 1.0 - 2.0 * way
        reason = _CHANGE if changes else (_PASS if slides_on else _TURN_BACK)
        if vain[reason] >= most:
            return False
        if reason == _PASS:
            late = passes_late(scene, cell, other, way, cell.side * BESIDE, slack)
        else:
            late = hop_is_late(scene, table, cell, other, way, slack)
        vain[reason] = max(vain[reason] + (-1 if late else _VAIN), 0)
        if not late or changes:
            return late
    return True
