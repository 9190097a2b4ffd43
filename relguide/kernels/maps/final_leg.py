"""Whether an extremal keeps its distance. As `word_clears`, for maps: cheap tests first.

For a piece of the pursuer and one of the leader, their ends give a bound:

- seen from a leader that keeps straight a straight remains one: its least distance is in closed
  form;
- a turn stays within 1 (= R) of its centre, which stands still;
- a leader that turns at ω strays from its chord, flown evenly, by at most α|ω| T²/8 in a time T;
- the last turn ends in the slot, so once the leader is on its final leg all last turns to one side
  are parts of one curve, and those up to a certain angle clear.

Where these tests do not decide, `piece_clears` does, so the answers are the same.
"""

from math import cos, inf, sin, sqrt
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI
from relguide.kernels.base.records import Pose, Scene, Start
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.separation.clearance import leader_at, piece_at, piece_clears
from relguide.kernels.words.extremals import SIGNS, fly_piece

_HALVINGS = 40
_ASTRAY = 1e-6  # a path ends where it should to less than this [R]


class MovingPoint(NamedTuple):
    """A point that keeps its velocity."""

    x: float
    """[R]."""
    y: float
    """[R]."""
    vx: float
    """[V_P]."""
    vy: float
    """[V_P]."""


@njit(cache=True, nogil=True)
def last_turns(scene: Scene) -> FloatArray:
    """How long a last turn may be and still keep d_min: right, then left [rad]."""
    found = np.empty(2)
    alpha, i = scene.alpha, len(scene.leader) - 1
    final = scene.leader[i:].copy()
    final[0, 0] = 0.0
    final[0, 1] -= alpha * scene.leader[i, 0]
    straight = Scene(final, alpha, scene.d_min, 0.0, inf)
    for side in range(2):
        sign = 2.0 * side - 1.0
        low, high = 0.0, TWO_PI
        for _ in range(_HALVINGS):
            turn = 0.5 * (low + high)
            # where a turn begins that ends in the slot at time `turn`
            begin = Pose(alpha * turn - sin(turn), sign * (1.0 - cos(turn)), -sign * turn)
            if piece_clears(begin, sign, 0.0, turn, straight):
                low = turn
            else:
                high = turn
        found[side] = low
    return found


@njit(cache=True, nogil=True)
def keeps_clear(
    start: Start, t: float, row: FloatArray, end_x: float, scene: Scene, longest: FloatArray
) -> bool:
    """Whether a row of `solve` keeps d_min.

    Args:
        start: where it starts.
        t: and when [R/V_P].
        row: of `solve`.
        end_x: it ends at (end_x, 0) on heading 0 [R].
        scene: the leader and d_min.
        longest: of `last_turns`; zeros if the end is not the slot.
    """
    (x, y, h, sin_h, cos_h), leader, limit = start, scene.leader, scene.d_min
    word = int(row[1])
    first_sign, sign, last_sign = SIGNS[word, 0], SIGNS[word, 1], SIGNS[word, 2]
    first, middle, last = row[2], row[3], row[4]
    final = leader[len(leader) - 1, 0]
    i = piece_at(leader, t)
    cx, cy = x - first_sign * sin_h, y + first_sign * cos_h
    if first > 0.0:
        room = point_room(MovingPoint(cx, cy, 0.0, 0.0), t, first, scene, i) - 1.0
        if room < limit and not piece_clears(Pose(x, y, h), first_sign, t, first, scene):
            return False
        t += first
    course = h + first_sign * first
    sin_c, cos_c = sin(course), cos(course)
    x, y = cx + first_sign * sin_c, cy - first_sign * cos_c
    if middle > 0.0:
        while i + 1 < len(leader) and leader[i + 1, 0] <= t:
            i += 1
        if sign == 0.0:
            room = point_room(MovingPoint(x, y, cos_c, sin_c), t, middle, scene, i)
            if room < limit and t >= final:
                return False
        else:
            cx, cy = x - sign * sin_c, y + sign * cos_c
            room = point_room(MovingPoint(cx, cy, 0.0, 0.0), t, middle, scene, i) - 1.0
        if room < limit and not piece_clears(Pose(x, y, course), sign, t, middle, scene):
            return False
        t += middle
    if last <= 0.0 or (t >= final and last <= longest[1 if last_sign > 0.0 else 0]):
        return True
    while i + 1 < len(leader) and leader[i + 1, 0] <= t:
        i += 1
    room = point_room(MovingPoint(end_x, last_sign, 0.0, 0.0), t, last, scene, i) - 1.0
    if room >= limit + _ASTRAY:
        return True
    begin = fly_piece(Pose(x, y, course), sign, middle)
    return piece_clears(begin, last_sign, t, last, scene)


@njit(cache=True, nogil=True)
def point_room(point: MovingPoint, t: float, duration: float, scene: Scene, i: int) -> float:
    """A point stays at least so far from the leader, exactly so far while that keeps straight.

    Args:
        point: where it is at time t.
        t: from when [R/V_P].
        duration: for how long [R/V_P].
        scene: gives the leader.
        i: the leader's piece at t.
    """
    (x, y, vx, vy), leader, alpha = point, scene.leader, scene.alpha
    last = len(leader) - 1
    room, done, end = inf, t, t + duration
    lx, ly = _place(scene, i, t)
    while done < end:
        bend = 0.0
        if i < last:
            until = min(leader[i + 1, 0], end)
            next_x, next_y = leader[i + 1, 1], leader[i + 1, 2]
            if until < leader[i + 1, 0]:
                next_x, next_y = _place(scene, i, until)
            bend = 0.125 * alpha * abs(leader[i, 4])
        else:
            until = end
            next_x, next_y = lx + alpha * (end - done), ly
        spent = until - done
        next_at_x, next_at_y = x + vx * spent, y + vy * spent
        nearest = _nearest(x - lx, y - ly, next_at_x - next_x, next_at_y - next_y)
        room = min(room, nearest - bend * spent * spent)
        x, y, lx, ly, done = next_at_x, next_at_y, next_x, next_y, until
        i += 1
    return room


@njit(cache=True, nogil=True)
def _place(scene: Scene, i: int, t: float) -> tuple[float, float]:
    """Where the leader is at time t on its piece i; only where it turns that takes sines."""
    leader, alpha = scene.leader, scene.alpha
    flown = t - leader[i, 0]
    if i == len(leader) - 1:
        return leader[i, 1] + alpha * flown, leader[i, 2]
    if leader[i, 4] == 0.0:
        share = flown / (leader[i + 1, 0] - leader[i, 0])
        return (
            leader[i, 1] + share * (leader[i + 1, 1] - leader[i, 1]),
            leader[i, 2] + share * (leader[i + 1, 2] - leader[i, 2]),
        )
    lx, ly, _ = leader_at(scene, i, t)
    return lx, ly


@njit(cache=True, nogil=True)
def _nearest(ax: float, ay: float, bx: float, by: float) -> float:
    """Distance from the origin to a straight line from a to b."""
    dx, dy = bx - ax, by - ay
    squared = dx * dx + dy * dy
    share = 0.0
    if squared > 0.0:
        share = min(max(-(ax * dx + ay * dy) / squared, 0.0), 1.0)
    nx, ny = ax + share * dx, ay + share * dy
    return sqrt(nx * nx + ny * ny)
