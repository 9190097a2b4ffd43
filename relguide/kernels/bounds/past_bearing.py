"""Whether a path from one contact to another, that goes past a bearing, comes in time: disproved.

Behind a leader that keeps straight. Who goes past a bearing m does so in some pose X: at a distance
ρ ≥ d_min from the leader and on a heading η with which the bearing does not change the other way,

    s (sin(η − m) + α sin m) ≥ 0,    s = +1 counter-clockwise.

From the one contact to X, and from X to the other, it takes no less than the soonest word, whatever
the limit. Where k > 1 (see `junction`) that says much: who passes close by, and neither comes from
inside the disc nor goes there, has to turn away before it, and again after it. The poses X are put
into cells of ρ and η, which are halved.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import cos, inf, pi, sin
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.records import Pose, Scene, Velocity, Window
from relguide.kernels.bounds.breach import no_sieve
from relguide.kernels.bounds.cells import Cell, poses_of
from relguide.kernels.bounds.hop import standing
from relguide.kernels.bounds.word_bound import soonest_beyond
from relguide.kernels.bounds.word_intervals import Blur
from relguide.kernels.contact.contact import to_frame_of
from relguide.kernels.separation.clearance import leader_at

_HEADINGS = 8  # cells a whole turn is cut into at first
_MOST = 1_000  # cells are looked at
_STACK = 128
_SMALLEST = 3e-5  # of a cell [R or rad]


class _Set(NamedTuple):
    """Poses at t = 0, which move on with the leader."""

    middle: Pose
    """Of them."""
    left: float
    """How far the centre of their left circles may lie from the middle's [R]."""
    right: float
    """And that of their right circles [R]."""
    differs: float
    """How much their headings may differ [rad]."""


@njit(cache=True, nogil=True)
def passes_late(
    scene: Scene, cell: Cell, other: Cell, way: int, bearing: float, beat: float
) -> bool:
    """Whether certainly nobody who goes past a bearing comes from one cell to another in time.

    Args:
        scene: a leader that keeps straight, and d_min.
        cell: of contacts.
        other: likewise.
        way: 0 counter-clockwise round the leader, 1 clockwise.
        bearing: between them.
        beat: the time [R/V_P].
    """
    begin, end = _set_of(scene, cell), _set_of(scene, other)
    if begin.differs == inf or end.differs == inf:
        return False
    there = leader_at(scene, cell.piece, 0.0)
    # who is further away is late for coming there, or for going on
    reach = 0.25 * (1.0 + scene.alpha) * beat
    stack = np.empty((_STACK, 4))
    count, half = 0, pi / _HEADINGS
    for k in range(_HEADINGS):
        stack[count] = scene.d_min + reach, reach, (2 * k + 1) * half, half
        count += 1
    for _ in range(_MOST):
        if count == 0:
            return True
        count -= 1
        rho, wide, heading, half = stack[count]
        if not _changes(scene, heading, half, way, bearing):
            continue
        middle = Pose(there.x + rho * cos(bearing), there.y + rho * sin(bearing), heading)
        at = _Set(middle, wide + half, wide + half, half)
        took = _word_between(scene, begin, at, beat)
        if took >= beat or took + _word_between(scene, at, end, beat - took) >= beat:
            continue
        if max(wide, half) < _SMALLEST or count + 2 > _STACK:
            return False
        for k in range(2):
            stack[count] = rho, wide, heading, half
            column = 0 if wide >= half else 2
            stack[count, column + 1] *= 0.5
            stack[count, column] += (2 * k - 1) * stack[count, column + 1]
            count += 1
    return False


@njit(cache=True, nogil=True)
def _set_of(scene: Scene, cell: Cell) -> _Set:
    poses = poses_of(scene, standing(cell.piece, cell.side, cell.bearing, cell.half))
    return _Set(poses.middle, poses.left, poses.right, poses.differs)


@njit(cache=True, nogil=True)
def _changes(scene: Scene, heading: float, half: float, way: int, bearing: float) -> bool:
    """Whether the bearing may change that way, or not at all."""
    sense = 1.0 - 2.0 * way
    pace = sense * (sin(heading - bearing) + scene.alpha * sin(bearing))
    return pace + half >= 0.0


@njit(cache=True, nogil=True)
def _word_between(scene: Scene, begin: _Set, end: _Set, beat: float) -> float:
    """No word leads sooner from a pose of the one set to one of the other; infinite from `beat`."""
    c, s, moved = cos(end.middle.h), sin(end.middle.h), max(end.left, end.right)
    return soonest_beyond(
        to_frame_of(begin.middle, end.middle),
        Blur(begin.left + moved, begin.right + moved, begin.differs + end.differs, end.differs),
        Velocity(scene.alpha * c, -scene.alpha * s), Window(0.0, beat), no_sieve(scene), 0.0,
    )  # fmt: skip
