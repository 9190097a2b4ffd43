"""Constrained paths of one template, solved next to a guess.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is at (D/R, 0) at
t = 0 and keeps heading 0.
"""

from math import atan2, inf, isnan, pi

import numpy as np
from numba import njit

from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.records import Pose, Scene, straight_scene, with_limit
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import WORD
from relguide.kernels.contact.clear_words import word_clears
from relguide.kernels.contact.contact import GRAZE, disc_on
from relguide.kernels.contact.touch_points import (
    boundary_arc_end,
    mirror_disc,
    slide_between,
    straight_tangents,
    turn_tangent,
)
from relguide.kernels.networks.near_guess import (
    LR,
    ON_B,
    ON_B_TOUCH,
    ON_LR,
    ON_TOUCH_B,
    RS,
    Room,
    Task,
    descend,
    empty_room,
    enter,
    from_leader,
    keep_path,
    leave,
    room_beside,
    slot_of,
    time_through,
)
from relguide.kernels.networks.template_edges import time_at_edge
from relguide.kernels.networks.template_legs import (
    clears,
    straight_turn,
    turn_straight,
    two_turns,
    write_legs,
)
from relguide.kernels.networks.template_recognition import template_of
from relguide.kernels.networks.templates import FREE, NONE, PARTS, SEVERAL
from relguide.kernels.words.extremals import MAX_ROWS, SIGNS, solve

_NARROW = 0.15  # where a path exists between two such bearings, its guess may miss it [rad]


@njit(cache=True, nogil=True)
def solve_template(
    start: Pose, scene: Scene, template: int, guess: FloatArray, beat: float, legs: FloatArray
) -> tuple[float, int]:
    """The fastest path of a template next to a guess, if it keeps the limit.

    Args:
        start: slot frame, its heading in [0, 2π).
        scene: a leader that keeps straight, α below 1.
        template: number of `TEMPLATES`; neither `SEVERAL` nor `NONE`.
        guess: of its two numbers. shape (2,)
        beat: arrivals from here on do not matter [R/V_P].
        legs: takes the legs, as `chain.Chain`. shape (≥ 3, 6)

    Returns:
        arrival time [R/V_P] and the number of legs; infinite and 0 if there is none.
    """
    eased = with_limit(scene, scene.d_min - GRAZE)
    if template == FREE:
        return _solve_free(start, eased, beat, legs)
    entry, side, on = PARTS[template]
    task = Task(start, eased, disc_on(scene, 0, float(side)), int(entry), int(on))
    room = empty_room()
    time, bearing = _solve_unchecked(task, guess, beat, room)
    if time < inf:
        if time >= beat:
            return inf, 0
        count = write_legs(task, bearing, room, legs)
        if clears(task, legs[:count]):
            return time, count
    if task.entry >= LR or task.on >= ON_B:
        return inf, 0
    time = time_at_edge(atan2(guess[1], guess[0]), task, room, legs)
    return (time, 2) if time < beat else (inf, 0)


@njit(cache=True, nogil=True)
def _solve_free(start: Pose, eased: Scene, beat: float, legs: FloatArray) -> tuple[float, int]:
    """The fastest extremal that keeps the limit."""
    rows = np.empty((MAX_ROWS, 5))
    for k in range(solve(start, eased.alpha, 0.0, rows)):
        if rows[k, 0] >= beat:
            break
        if word_clears(start, 0.0, rows[k], eased):
            legs[0, 0] = WORD
            legs[0, 1:6] = rows[k]
            return rows[k, 0], 1
    return inf, 0


@njit(cache=True, nogil=True)
def _solve_unchecked(task: Task, guess: FloatArray, beat: float, room: Room) -> tuple[float, float]:
    """Arrival and bearing of the contact; infinite if there is none. `room` takes the path.

    What lies before and behind the boundary arcs and contacts may still lead through the disc.
    """
    if task.on == ON_B or task.on == ON_B_TOUCH:
        return _solve_from_boundary_arc(task, guess, beat, room)
    if task.on == ON_TOUCH_B:
        return _solve_to_boundary_arc(task, guess, room)
    if task.entry >= LR:
        return _solve_after_two_turns(task, guess, room)
    if task.on >= ON_LR:
        return _solve_before_two_turns(task, guess, room)
    return descend(_bearing_to_begin(task, guess, room), task, np.zeros(2), room)


@njit(cache=True, nogil=True)
def _solve_to_boundary_arc(task: Task, guess: FloatArray, room: Room) -> tuple[float, float]:
    """By a contact, a turn and a straight to the boundary arc that leads on to the slot."""
    end, straight, turn = boundary_arc_end(slot_of(task.scene), 0.0, task.disc)
    if isnan(end):
        return inf, 0.0
    fixed = np.array((end, straight + turn))
    time, bearing = descend(atan2(guess[1], guess[0]), task, fixed, room)
    straight_turn(task.disc.side, straight, turn, room.path[1])
    return time, bearing


@njit(cache=True, nogil=True)
def _solve_after_two_turns(task: Task, guess: FloatArray, room: Room) -> tuple[float, float]:
    """By two turns that touch the disc by themselves, and a word on from there."""
    sign = 1.0 if task.entry == LR else -1.0
    bearing, first, second = turn_tangent(
        from_leader(task.start, task.scene),
        task.disc,
        sign,
        pi * (guess[0] + 1.0),
        pi * (guess[1] + 1.0),
    )
    if isnan(first):
        return inf, 0.0
    two_turns(sign, first, second, 0.0, room.path[0])
    if not leave(task, bearing, task.on, room):
        return inf, 0.0
    return room.path[0, 0] + room.path[1, 0], bearing


@njit(cache=True, nogil=True)
def _solve_before_two_turns(task: Task, guess: FloatArray, room: Room) -> tuple[float, float]:
    """By a word to where two turns to the slot touch the disc by themselves."""
    # backward in time, with the world turned by π: two turns from the slot
    sign = 1.0 if task.on == ON_LR else -1.0
    bearing, last, middle = turn_tangent(
        Pose(slot_of(task.scene), 0.0, 0.0),
        mirror_disc(task.disc),
        sign,
        pi * (guess[1] + 1.0),
        pi * (guess[0] + 1.0),
    )
    if isnan(last):
        return inf, 0.0
    bearing += pi
    two_turns(-sign, 0.0, middle, last, room.path[1])
    if not enter(task, bearing, room):
        return inf, 0.0
    return room.path[0, 0] + room.path[1, 0], bearing


@njit(cache=True, nogil=True)
def _bearing_to_begin(task: Task, guess: FloatArray, room: Room) -> float:
    """The guess, or what lies between where both straights touch the disc.

    A straight path that is bent a little round the disc exists between these two bearings alone,
    and they may be closer to each other than a guess is good. Beside them the same words take full
    circles.
    """
    guessed, disc, entry, on = atan2(guess[1], guess[0]), task.disc, task.entry, task.on
    if entry >= 4 or on >= 4 or SIGNS[entry, 2] != disc.side or SIGNS[on, 0] != disc.side:
        return guessed
    to, on_from = np.empty((4, 3)), np.empty((4, 3))
    n = straight_tangents(from_leader(task.start, task.scene), disc, SIGNS[entry, 0], to)
    if n == 0:
        return guessed
    m = straight_tangents(
        Pose(slot_of(task.scene), 0.0, 0.0), mirror_disc(disc), -SIGNS[on, 2], on_from
    )
    best, start = inf, guessed
    for i in range(n):
        for j in range(m):
            between = wrap_signed(on_from[j, 0] + pi - to[i, 0])
            if abs(between) < _NARROW:
                there = to[i, 0] + 0.5 * between
                time = time_through(there, task, room.link[:2], room)
                if time < best:
                    best, start = time, there
    if best < inf and best < time_through(guessed, task, room.link[:2], room):
        return start
    return guessed


@njit(cache=True, nogil=True)
def _solve_from_boundary_arc(
    task: Task, guess: FloatArray, beat: float, room: Room
) -> tuple[float, float]:
    """The soonest path that begins with a boundary arc: its arrival, and where the arc begins."""
    disc = task.disc
    end, straight, turn = 0.0, 0.0, 0.0
    if task.on == ON_B:
        end, straight, turn = boundary_arc_end(slot_of(task.scene), 0.0, disc)
        if isnan(end):
            return inf, 0.0
        straight_turn(disc.side, straight, turn, room.path[1])
    if task.entry < LR:
        return _solve_from_tangents(task, guess, beat, end, straight + turn, room)
    sign = 1.0 if task.entry == LR else -1.0
    begin, first, second = turn_tangent(
        from_leader(task.start, task.scene),
        disc,
        sign,
        pi * (guess[0] + 1.0),
        pi * (guess[1] + 1.0),
    )
    if isnan(first):
        return inf, 0.0
    room.link[3], room.link[4] = slide_between(begin, end, disc)
    two_turns(sign, first, second, 0.0, room.path[0])
    return first + second + room.link[4] + straight + turn, begin


@njit(cache=True, nogil=True)
def _solve_from_tangents(
    task: Task, guess: FloatArray, beat: float, end: float, after: float, room: Room
) -> tuple[float, float]:
    """The same where a turn and a straight come first: of all that touch, the soonest that clears.

    Args:
        task: its entry is `LS` or `RS`.
        guess: of the second contact, if there is one.
        beat: later arrivals do not matter.
        end: last bearing of the boundary arc; does not count with `ON_B_TOUCH`.
        after: how long the path takes from there on.
        room: takes the path.
    """
    disc, sign = task.disc, -1.0 if task.entry == RS else 1.0
    contacts, row, fixed = np.empty((4, 3)), np.zeros(5), np.zeros(2)
    trial = room_beside(room)
    trial.path[1] = room.path[1]
    best, begun = beat, 0.0
    for k in range(straight_tangents(from_leader(task.start, task.scene), disc, sign, contacts)):
        begin, before = contacts[k, 0], contacts[k, 1] + contacts[k, 2]
        if task.on == ON_B:
            trial.link[3], trial.link[4] = slide_between(begin, end, disc)
            time = before + trial.link[4] + after
        else:
            fixed[0], fixed[1] = begin, before
            time, _ = descend(atan2(guess[1], guess[0]), task, fixed, trial)
        if time >= best:
            continue
        turn_straight(sign, contacts[k, 1], contacts[k, 2], row)
        # where two turns of a sign touch, the straight of the sooner one may lead through the disc
        if word_clears(task.start, 0.0, row, task.scene):
            best, begun = time, begin
            trial.path[0] = row
            keep_path(trial, room)
    return (best, begun) if best < beat else (inf, 0.0)


@njit(cache=True, nogil=True)
def label_templates(
    situations: FloatArray, times: FloatArray, counts: FloatArray, legs: FloatArray, within: float,
    templates: FloatArray, guesses: FloatArray,
) -> None:  # fmt: skip
    """What is to be learnt of exact answers: the template of each, if its guess leads back to it.

    Args:
        situations: x, y, h in [0, 2π), α, D/R, d_min/R. shape (n, 6)
        times: of the answers [R/V_P]. shape (n,)
        counts: legs of each. shape (n,)
        legs: as `chain.Chain`. shape (n, ·, 6)
        within: a template whose path is this much later is not that of the answer [R/V_P].
        templates: takes their numbers. shape (n,)
        guesses: takes their guesses. shape (n, 2)
    """
    trial = np.zeros((3, 6))
    for n in range(len(situations)):
        x, y, h, alpha, slot, d_min = situations[n]
        start, scene = Pose(x, y, h), straight_scene(alpha, slot, d_min)
        template = template_of(start, scene, legs[n, : int(counts[n])], guesses[n])
        if template > NONE:
            time, _ = solve_template(start, scene, template, guesses[n], inf, trial)
            if not time <= times[n] + within:
                template = SEVERAL
        templates[n] = template
