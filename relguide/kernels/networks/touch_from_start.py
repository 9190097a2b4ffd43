"""Constrained paths whose first two pieces touch the disc, behind a leader who turns.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import atan2, cos, inf, isnan, pi, sin, sqrt

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.boundary_arc import boundary_arc_arrival
from relguide.kernels.contact.chain import BOUNDARY_ARC, DELAY, WORD
from relguide.kernels.contact.clear_delay import delay_until_release
from relguide.kernels.contact.clear_words import EARLY, word_clears
from relguide.kernels.contact.touch_points import boundary_arc_end
from relguide.kernels.networks.near_guess import (
    LR,
    LS,
    ON_B,
    ON_DELAY,
    RL,
    Room,
    Task,
    contact_of,
    leave,
)
from relguide.kernels.networks.template_legs import straight_turn, turn_straight, two_turns
from relguide.kernels.networks.turn_templates import QUARTER
from relguide.kernels.separation.clearance import leader_at, piece_at
from relguide.kernels.words.delay import DELAY_PIECES
from relguide.kernels.words.extremals import fly_piece

_LOOK, _LATER = 0.25, 2.0  # times: from one to the next, and so much later than guessed [R/V_P]
_TURNS = 36  # sizes of a first turn: every 10°
_STEPS = 16  # of Newton's method
_DIFFERENCE = 1e-6  # by which its slopes are measured [rad or R]
_MET = 1e-11  # where it ends [R]


@njit(cache=True, nogil=True)
def solve_from_touch(
    task: Task, guess: FloatArray, beat: float, room: Room, legs: FloatArray
) -> tuple[float, int]:
    """By two pieces that touch the disc next to a guess, and on from there.

    Args:
        task: its entry says what the pieces are, its exit how it goes on.
        guess: of its numbers. shape (GUESS,)
        beat: later arrivals do not matter [R/V_P].
        room: to work in.
        legs: takes the legs. shape (≥ 3, 6)

    Returns:
        arrival time [R/V_P] and the number of legs; infinite and 0 if there is no such path.
    """
    first = pi * (guess[0] + 1.0)
    bearing, first, second = _touch(task, _first_sign(task), first, guess[2] / QUARTER - first)
    if isnan(first):
        return inf, 0
    return _go_on(task, bearing, first, second, guess[1], beat, room, legs)


@njit(cache=True, nogil=True)
def solve_from_any_touch(
    task: Task, guess: FloatArray, beat: float, room: Room, legs: FloatArray
) -> tuple[float, int]:
    """The same, wherever two pieces touch: the fastest.

    For first turns of all sizes the second piece is flown to its closest approach; where that
    passes from one side of the disc's edge to the other, there is a touch. Arguments and result as
    of `solve_from_touch`.
    """
    sign, other = _first_sign(task), _second_sign(task)
    trial = np.zeros((3, 6))
    best, count, last_miss = beat, 0, np.nan
    longest = TWO_PI if other != 0.0 else guess[2] / QUARTER + _LATER
    for j in range(_TURNS):
        first = TWO_PI * j / _TURNS
        before, miss, second = 0.0, np.nan, 0.0
        for k in range(int(longest / _LOOK)):
            closing, missed, _ = _miss(task, sign, first, other, _LOOK * (k + 1))
            if before < 0.0 <= closing:
                miss, second = missed, _LOOK * (k + 0.5)
                break
            before = closing
        if miss * last_miss <= 0.0:
            bearing, turn, then = _touch(task, sign, first, second)
            if not isnan(turn):
                time, n = _go_on(task, bearing, turn, then, guess[1], best, room, trial)
                if n > 0:
                    best, count = time, n
                    legs[:n] = trial[:n]
        last_miss = miss
    return (best, count) if count > 0 else (inf, 0)


@njit(cache=True, nogil=True)
def _first_sign(task: Task) -> float:
    """Of an entry's first turn."""
    return 1.0 if task.entry == LS or task.entry == LR else -1.0


@njit(cache=True, nogil=True)
def _second_sign(task: Task) -> float:
    """Of its second piece; 0 for a straight."""
    return -_first_sign(task) if task.entry == LR or task.entry == RL else 0.0


@njit(cache=True, nogil=True)
def _go_on(
    task: Task, bearing: float, first: float, second: float, round_it: float, beat: float,
    room: Room, legs: FloatArray,
) -> tuple[float, int]:  # fmt: skip
    """From where two pieces touch, by a boundary arc, a delay or a word.

    Args:
        task: its entry says what the pieces are.
        bearing: of the contact [rad].
        first: the first turn [rad].
        second: the second piece [rad or R].
        round_it: how far the boundary arc goes round, about, in π.
        beat: later arrivals do not matter.
        room: to work in.
        legs: takes the legs.
    """
    scene, row, t = task.scene, room.path[0], first + second
    if _second_sign(task) == 0.0:
        turn_straight(_first_sign(task), first, second, row)
    else:
        two_turns(_first_sign(task), first, second, 0.0, row)
    if not word_clears(task.start, 0.0, row, scene):
        return inf, 0
    legs[0, 0] = WORD
    legs[0, 1:6] = row
    if task.on == ON_B:
        time = _slide_to_slot(task, bearing, bearing + pi * round_it, t, legs)
        return (time, 3) if time < beat else (inf, 0)
    there = contact_of(task, bearing, t)
    if task.on == ON_DELAY:
        pieces = np.empty((DELAY_PIECES, 2))
        if not t < scene.t_release < beat or not delay_until_release(there, t, scene, pieces):
            return inf, 0
        legs[1, 0] = DELAY
        return scene.t_release, 2
    if not leave(task, bearing, task.on, room):
        return inf, 0
    legs[1, 0] = WORD
    legs[1, 1:6] = room.path[1]
    time = t + room.path[1, 0]
    if time < beat and word_clears(there, t, room.path[1], scene):
        return time, 2
    return inf, 0


@njit(cache=True, nogil=True)
def _slide_to_slot(task: Task, bearing: float, goal: float, t: float, legs: FloatArray) -> float:
    """From a contact by a boundary arc to where a straight and a turn lead to the slot.

    Args:
        task: where it is solved.
        bearing: of the contact [rad].
        goal: guess of the boundary arc's last bearing, unwrapped [rad].
        t: when it begins [R/V_P].
        legs: takes the second and the third leg.

    Returns:
        arrival time; infinite if there is no such path.
    """
    scene, disc, last = task.scene, task.disc, len(task.scene.leader) - 1
    final = scene.leader[last]
    end, straight, turn = boundary_arc_end(final[1] - scene.alpha * final[0], final[2], disc)
    if isnan(end):
        return inf
    # once more round, or once less: as far round as it is guessed
    goal = end + TWO_PI * round((goal - end) / TWO_PI)
    left = boundary_arc_arrival(scene, t, bearing, goal, disc.side, last)
    time = left + straight + turn
    if left == inf or time < scene.t_release - EARLY:
        return inf
    legs[1, 0], legs[1, 1], legs[1, 2], legs[1, 3], legs[1, 4] = (
        BOUNDARY_ARC, disc.side, bearing, goal, last,
    )  # fmt: skip
    legs[2, 0] = WORD
    straight_turn(disc.side, straight, turn, legs[2, 1:6])
    there = contact_of(task, goal, left)
    return float(time) if word_clears(there, left, legs[2, 1:6], scene) else inf


@njit(cache=True, nogil=True)
def _touch(task: Task, sign: float, first: float, second: float) -> tuple[float, float, float]:
    """A turn and a straight, or a turn the other way, of which the second touches the disc: Newton.

    As `touch_points.turn_tangent`, round a leader that turns; the leader may be on any leg.

    Args:
        task: its entry says what the second piece is.
        sign: of the first turn.
        first: guess of the turn [rad].
        second: and of the second piece [rad or R].

    Returns:
        bearing, first and second piece; these are NaN if there is none next to the guess.
    """
    other = _second_sign(task)
    for _ in range(_STEPS):
        closing, miss, bearing = _miss(task, sign, first, other, second)
        if abs(closing) + abs(miss) < _MET:
            if 0.0 <= first <= TWO_PI and second >= 0.0:
                return bearing, first, second
            break
        a, c, _ = _miss(task, sign, first + _DIFFERENCE, other, second)
        b, d, _ = _miss(task, sign, first, other, second + _DIFFERENCE)
        a, b = (a - closing) / _DIFFERENCE, (b - closing) / _DIFFERENCE
        c, d = (c - miss) / _DIFFERENCE, (d - miss) / _DIFFERENCE
        determinant = a * d - b * c
        if abs(determinant) < 1e-12:
            break
        by_first = (closing * d - miss * b) / determinant
        by_second = (miss * a - closing * c) / determinant
        shorter = min(1.0, 0.5 / max(abs(by_first), abs(by_second), 1e-12))
        first -= shorter * by_first
        second -= shorter * by_second
    return 0.0, np.nan, np.nan


@njit(cache=True, nogil=True)
def _miss(
    task: Task, sign: float, first: float, other: float, second: float
) -> tuple[float, float, float]:
    """How fast the end of two pieces closes in on the leader, how wide it misses, and its bearing.

    p·v,    p × v − s δ |v|,    p, v relative to the leader
    """
    scene, disc, t = task.scene, task.disc, first + second
    pose = fly_piece(fly_piece(task.start, sign, first), other, second)
    at = leader_at(scene, piece_at(scene.leader, t), t)
    x, y = pose.x - at.x, pose.y - at.y
    vx, vy = cos(pose.h) - disc.alpha * cos(at.h), sin(pose.h) - disc.alpha * sin(at.h)
    speed = sqrt(vx * vx + vy * vy)
    miss = x * vy - y * vx - disc.side * disc.distance * speed
    return x * vx + y * vy, miss, atan2(y, x) - at.h
