"""What IPOPT begins with: paths to the slot, without the limit and past the leader on either side.

All can be flown and end in the slot, which is the best one can do for IPOPT: from polylines it ends
on points of local infeasibility more often than on a path. What is there before the slot opens is
slowed down until it does.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from dataclasses import dataclass
from math import cos, pi, sin
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from benchmarks.cases import Case
from relguide.kernels.base.records import Pose, Velocity
from relguide.kernels.contact.contact import contact_heading
from relguide.kernels.words.extremals import MAX_ROWS, SIGNS, fly_piece, solve, solve_toward

ABEAM = 1.2
"""How far out a start passes the leader [d_min]."""

Floats = NDArray[np.float64]
_Pieces = list[tuple[float, float]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Path:
    """What IPOPT begins with, and what it ends on. Seen from the slot, which stands still."""

    states: Floats
    """x, y, heading (unwrapped) at the nodes. shape (intervals + 1, 3)"""
    rates: Floats
    """Turn rate of each interval. shape (intervals,)"""
    time: float
    """Arrival."""


class _Leg(NamedTuple):
    """A leader that has always kept straight."""

    x: float
    """Where it is at t = 0."""
    y: float
    h: float


def guesses(case: Case, intervals: int) -> list[Path]:
    """The best way without the limit, and the best ways past points on the leader's either side.

    A leader that turns is passed on its final leg, as if always there, and on its first.
    """
    ways = [_pieces(_onward(case, 0.0, *_start(case)))]
    for leg in _legs(case):
        for side in (1.0, -1.0):
            way = _past_leader(case, leg, side)
            if way is not None:
                ways.append(way)
    return [_sample(case, way, intervals) for way in ways]


def _start(case: Case) -> tuple[float, float, float]:
    return case.frame.x, case.frame.y, case.frame.h


def _legs(case: Case) -> list[_Leg]:
    first = case.course
    ahead, left = case.from_slot
    final = _Leg(ahead, left, 0.0)
    return [final, _Leg(first.x, first.y, first.h)] if first.turns else [final]


def _onward(case: Case, t: float, x: float, y: float, h: float) -> Floats:
    """The best word to the slot from time t on, as a row of `solve`."""
    rows: Floats = np.empty((MAX_ROWS, 5))
    solve(Pose(x - case.frame.alpha * t, y, h % (2.0 * pi)), case.frame.alpha, 0.0, rows)
    best: Floats = rows[0]
    return best


def _past_leader(case: Case, leg: _Leg, side: float) -> _Pieces | None:
    """To a point abeam of the leader, falling back along the circle there, and on to the slot.

    `None` if that point is never reached, as it may be of a leader that is as fast.
    """
    alpha, (x, y, h) = case.frame.alpha, _start(case)
    course = leg.h + contact_heading(side * 0.5 * pi, side, alpha)
    c, s = cos(course), sin(course)
    away = side * ABEAM * case.limit
    dx, dy = x - leg.x + away * sin(leg.h), y - leg.y - away * cos(leg.h)
    seen = Pose(dx * c + dy * s, dy * c - dx * s, (h - course) % (2.0 * pi))
    ahead = course - leg.h
    rows = np.empty((MAX_ROWS, 5))
    if solve_toward(seen, Velocity(alpha * cos(ahead), -alpha * sin(ahead)), 0.0, rows) == 0:
        return None
    first = _pieces(rows[0])
    t = 0.0
    for sign, amount in first:
        x, y, h = fly_piece(Pose(x, y, h), sign, amount)
        t += amount
    return first + _pieces(_onward(case, t, x, y, h))


def _pieces(row: Floats) -> _Pieces:
    signs = SIGNS[int(row[1])].tolist()
    return list(zip(signs, row[2:].tolist(), strict=True))


def _sample(case: Case, pieces: _Pieces, intervals: int) -> Path:
    """States at equally spaced times, seen from the slot, headings unwrapped."""
    ends = np.cumsum([amount for _, amount in pieces])
    at = np.linspace(0.0, ends[-1], intervals + 1)
    states = np.empty((intervals + 1, 3))
    for k, t in enumerate(at):
        x, y, h = _start(case)
        left = t
        for sign, amount in pieces:
            x, y, h = fly_piece(Pose(x, y, h), sign, min(left, amount))
            left -= min(left, amount)
        states[k] = x - case.frame.alpha * t, y, h
    time = max(float(ends[-1]), case.frame.t_release)
    return Path(states=states, rates=np.diff(states[:, 2]) * (intervals / time), time=time)
