"""First contacts at which λ_ψ vanishes: single points, found before the search.

λ_ψ vanishes where a path changes its turn, and on its straights (see `costate`). So up to such a
contact a path has flown a turn and a straight, or two turns, or three of which the last is as long
as the middle one. (Paths with a full turn more are bounded anyhow.) Each time two numbers say where
the path has come to, and d = d_min and d′ = 0 are two equations for them. So there are only a few
such contacts, while a great many cells hold words that nearly end so. Both numbers are cut into
boxes, and boxes are left out in which d or d′ is certainly something else.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import atan2, inf
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap_signed
from relguide.kernels.base.norm import norm
from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.sine import sine_and_cosine
from relguide.kernels.bounds.words.cells import Cell, fastest_turn
from relguide.kernels.bounds.words.sets import EDGE
from relguide.kernels.separation.clearance import leader_at, piece_at
from relguide.kernels.words.extremals import fly_piece

_STRAIGHT, _TURN, _AS_LONG = 0, 1, 2
"""What a path ends with after its first turn: a straight, a turn, or two of the same length."""
_ENDS = 3
_FINE = 1e-6  # boxes are halved until no place differs by more in them [R]
_BOXES = 500_000  # if there are more of them, which takes 60 ms, nothing is known
_DEPTH = 128  # more than halvings of both numbers
_MOST = 96  # no more such contacts are told from each other
_SIDE, _BEARING, _HALF, _START, _END, _COLUMNS = 0, 1, 2, 3, 4, 5  # of a row
_FAST = 1.0 - 1e-3  # as fast a leader may be touched on either side at a bearing


class _Box(NamedTuple):
    first: float  # length of the first turn, in the middle [rad]
    first_half: float  # and how much it may differ
    then: float  # of what comes after it: see `_STRAIGHT` [R/V_P]
    then_half: float


class _Seen(NamedTuple):
    t: float  # when [R/V_P]
    x: float  # where, from the leader [R]
    y: float
    vx: float  # how fast, seen from the leader [V_P]
    vy: float
    ahead: float  # the leader's heading [rad]
    arm: float  # from the centre of the first turn [R]


@njit(cache=True, nogil=True)
def anything_tangent() -> FloatArray:
    """As `tangent_contacts`, where nothing is known."""
    rows = np.zeros((1, _COLUMNS))
    rows[0, _HALF], rows[0, _START], rows[0, _END] = inf, -inf, inf
    return rows


@njit(cache=True, nogil=True)
def tangent_contacts(start: Pose, scene: Scene, beat: float) -> FloatArray:
    """Where all those contacts lie that are no later than a time, round a leader that turns.

    Args:
        start: where paths begin, at t = 0.
        scene: the leader and d_min.
        beat: contacts from here on do not matter [R/V_P].

    Returns:
        a row for each: side (0 if either), bearing and half of the window of bearings [rad], and
        when its window of time begins and ends [R/V_P]. shape (·, 5)
    """
    rows, count, looked = np.empty((_MOST, _COLUMNS)), 0, 0
    if len(scene.leader) == 1 or not 0.0 < beat < inf or scene.alpha > _FAST:
        return anything_tangent()
    stack, rate = np.empty((_DEPTH, 4)), fastest_turn(scene, 0, len(scene.leader) - 1)
    for hand in range(2):
        sense = 1.0 - 2.0 * hand
        for end in range(_ENDS):
            first, then = min(beat, TWO_PI), beat if end == _STRAIGHT else min(beat, TWO_PI)
            stack[0, 0], stack[0, 1] = 0.5 * first, 0.5 * first + EDGE
            stack[0, 2], stack[0, 3] = 0.5 * then, 0.5 * then + EDGE
            n = 1
            while n > 0:
                n -= 1
                looked += 1
                if looked > _BOXES:
                    return anything_tangent()
                box = _Box(stack[n, 0], stack[n, 1], stack[n, 2], stack[n, 3])
                seen = _seen(start, scene, sense, end, box)
                far = norm(seen.x, seen.y)
                by_first, by_then, later = _differs(scene, end, box, seen)
                if seen.t - later >= beat or not _can_touch(
                    scene, end, box, seen, far, by_first + by_then, later, rate
                ):
                    continue
                if by_first + by_then < _FINE:
                    found = _row(seen, far, by_first + by_then, later, rate)
                    count = _with_row(rows, count, found)
                    if count < 0:
                        return anything_tangent()
                    continue
                if n + 2 > _DEPTH:
                    return anything_tangent()
                _halve(stack, n, box, by_first > by_then)
                n += 2
    return rows[:count].copy()


@njit(cache=True, nogil=True)
def may_be_tangent(rows: FloatArray, cell: Cell) -> bool:
    """Whether one of these contacts may lie in a cell."""
    for k in range(len(rows)):
        row = rows[k]
        if (
            row[_SIDE] != -cell.side
            and row[_START] <= cell.end
            and cell.start <= row[_END]
            and abs(wrap_signed(cell.bearing - row[_BEARING])) <= cell.half + row[_HALF]
        ):
            return True
    return False


@njit(cache=True, nogil=True)
def _seen(start: Pose, scene: Scene, sense: float, end: int, box: _Box) -> _Seen:
    """What the leader sees of the path in the middle of a box."""
    turned = fly_piece(start, sense, box.first)
    s, c = sine_and_cosine(start.h)
    # the centre of the first turn
    x, y = start.x - sense * s, start.y + sense * c
    t = box.first + box.then
    at = fly_piece(turned, 0.0 if end == _STRAIGHT else -sense, box.then)
    if end == _AS_LONG:
        at = fly_piece(at, sense, box.then)
        t += box.then
    there = leader_at(scene, piece_at(scene.leader, t), t)
    s, c = sine_and_cosine(at.h)
    lead_s, lead_c = sine_and_cosine(there.h)
    return _Seen(
        t, at.x - there.x, at.y - there.y, c - scene.alpha * lead_c, s - scene.alpha * lead_s,
        there.h, norm(at.x - x, at.y - y),
    )  # fmt: skip


@njit(cache=True, nogil=True)
def _differs(scene: Scene, end: int, box: _Box, seen: _Seen) -> tuple[float, float, float]:
    """How much the place may differ in a box by each number [R], and the time [R/V_P].

    All that follows on the first turn swings round its centre with it. Where the last of three
    turns is as long as the middle one, its end moves as fast as its centre round the middle one's.
    """
    fast, times = 1.0, 1.0
    if end == _AS_LONG:
        fast, times = 2.0, 2.0
    by_first = (seen.arm + fast * box.then_half + scene.alpha) * box.first_half
    by_then = (fast + times * scene.alpha) * box.then_half
    return by_first, by_then, box.first_half + times * box.then_half


@njit(cache=True, nogil=True)
def _can_touch(
    scene: Scene, end: int, box: _Box, seen: _Seen, far: float, differs: float, later: float,
    rate: float,
) -> bool:  # fmt: skip
    """Whether the disc may be touched in a box.

    Args:
        scene: the leader and d_min.
        end: as in `_STRAIGHT`.
        box: of paths.
        seen: of the path in its middle.
        far: from the leader [R].
        differs: how much the place may differ [R].
        later: and the time [R/V_P].
        rate: the leader's greatest turn rate [V_P/R].
    """
    if abs(far - scene.d_min) > differs + EDGE:
        return False
    opens = (seen.x * seen.vx + seen.y * seen.vy) / far if far > 0.0 else 0.0
    turns = box.first_half + (box.then_half if end == _TURN else 0.0)
    turns += scene.alpha * rate * later
    # directions differ so much if one of the places is on the disc
    tilts = 2.0 * (1.0 + scene.alpha) * differs / (far + scene.d_min) + turns
    return bool(abs(opens) <= tilts + EDGE)


@njit(cache=True, nogil=True)
def _halve(stack: FloatArray, n: int, box: _Box, first: bool) -> None:
    """Put both halves of a box on a stack, from row n on."""
    for k in range(2):
        way = 1.0 - 2.0 * k
        row = stack[n + k]
        row[0], row[1], row[2], row[3] = box.first, box.first_half, box.then, box.then_half
        at = 0 if first else 2
        row[at + 1] *= 0.5
        row[at] += way * row[at + 1]


@njit(cache=True, nogil=True)
def _row(
    seen: _Seen, far: float, differs: float, later: float, rate: float
) -> tuple[float, float, float, float, float]:
    """The contacts of a box."""
    side = 1.0 if seen.x * seen.vy - seen.y * seen.vx > 0.0 else -1.0
    bearing = atan2(seen.y, seen.x) - seen.ahead
    return side, bearing, 2.0 * differs / far + rate * later, seen.t - later, seen.t + later


@njit(cache=True, nogil=True)
def _with_row(rows: FloatArray, count: int, found: tuple[float, float, float, float, float]) -> int:
    """Add contacts to those beside them; how many rows there are then, −1 if too many."""
    side, bearing, half, start, end = found
    for k in range(count):
        row = rows[k]
        off = wrap_signed(bearing - row[_BEARING])
        if (
            row[_SIDE] == side
            and start <= row[_END]
            and row[_START] <= end
            and abs(off) <= half + row[_HALF]
        ):
            low, high = min(off - half, -row[_HALF]), max(off + half, row[_HALF])
            row[_BEARING] += 0.5 * (low + high)
            row[_HALF] = 0.5 * (high - low) + EDGE
            row[_START], row[_END] = min(start, row[_START]), max(end, row[_END])
            return count
    if count == len(rows):
        return -1
    row = rows[count]
    row[_SIDE], row[_BEARING], row[_HALF], row[_START], row[_END] = side, bearing, half, start, end
    return count + 1
