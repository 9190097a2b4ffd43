"""Ways round the limit of one kind, solved next to a guess.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is at (D/R, 0) at
t = 0 and keeps heading 0.
"""

from math import atan2, inf, isnan, pi

import numpy as np
from numba import njit

from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.records import Disc, Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import WORD
from relguide.kernels.contact.contact import GRAZE, contact_distance
from relguide.kernels.contact.passage import word_clears
from relguide.kernels.contact.touch_points import (
    boundary_arc_end,
    opposite,
    slide_between,
    straight_tangents,
    turn_tangent,
)
from relguide.kernels.networks.near_guess import (
    AGAIN_ARCS,
    ARCS_AGAIN,
    ARCS_ON,
    LR,
    ON_LR,
    RS,
    descend,
    enter,
    leave,
    through,
)
from relguide.kernels.networks.template_edges import at_edge
from relguide.kernels.networks.template_legs import (
    as_legs,
    clears,
    straight_turn,
    turn_straight,
    two_turns,
)
from relguide.kernels.networks.templates import FREE, NONE, PARTS, SEVERAL, template_of
from relguide.kernels.words.extremals import MAX_ROWS, SIGNS, solve

_NARROW = 0.15  # where a way exists between two such bearings, its guess may miss it [rad]


@njit(cache=True, nogil=True)
def solve_template(
    x: float, y: float, h: float, slot: float, alpha: float, limit: float, kind: int,
    guess: FloatArray, beat: float, legs: FloatArray,
) -> tuple[float, int]:  # fmt: skip
    """The fastest way of a kind next to a guess, if it keeps the limit.

    Args:
        x: start, slot frame [R].
        y: start [R].
        h: start heading [rad], in [0, 2π).
        slot: D [R].
        alpha: V_L/V_P, below 1.
        limit: d_min [R].
        kind: number of `TEMPLATES`; neither `SEVERAL` nor `NONE`.
        guess: of its two numbers. shape (2,)
        beat: arrivals from here on do not matter [R/V_P].
        legs: takes the legs, as `chain.fly_links`. shape (≥ 3, 6)

    Returns:
        arrival time [R/V_P] and the number of legs; infinite and 0 if there is none.
    """
    leader = np.zeros((1, 5))
    leader[0, 1] = slot
    rows = np.empty((MAX_ROWS, 5))
    if kind == FREE:
        eased = Scene(leader, alpha, limit - GRAZE, 0.0)
        for k in range(solve(Pose(x, y, h), alpha, 0.0, rows)):
            if rows[k, 0] >= beat:
                break
            if word_clears(Pose(x, y, h), 0.0, rows[k], eased):
                legs[0, 0] = WORD
                legs[0, 1:6] = rows[k]
                return rows[k, 0], 1
        return inf, 0
    entry, side, on = int(PARTS[kind, 0]), float(PARTS[kind, 1]), int(PARTS[kind, 2])
    delta = contact_distance(limit)
    disc = Disc(alpha, delta, side, 0.0)
    found = np.empty((MAX_ROWS, 4))
    way = np.zeros((2, 5))
    link, fixed = np.zeros(5), np.zeros(2)
    bearing = 0.0
    if on == ARCS_ON or on == ARCS_AGAIN:
        time, bearing = _by_boundary_arc(
            x, y, h, slot, alpha, delta, entry, side, on, guess, beat, leader, found, rows, way,
            link,
        )  # fmt: skip
    elif on == AGAIN_ARCS:
        end, straight, turn = boundary_arc_end(slot, disc)
        if isnan(end):
            return inf, 0
        fixed[0], fixed[1] = end, straight + turn
        time, bearing = descend(
            x, y, h, slot, alpha, delta, atan2(guess[1], guess[0]), side, entry, on, fixed,
            found, rows, way, link,
        )  # fmt: skip
        straight_turn(side, straight, turn, way[1])
    elif entry >= LR:
        sign = 1.0 if entry == LR else -1.0
        bearing, first, second = turn_tangent(
            Pose(x - slot, y, h), disc, sign, pi * (guess[0] + 1.0), pi * (guess[1] + 1.0)
        )
        if isnan(first):
            return inf, 0
        two_turns(sign, first, second, 0.0, way[0])
        i = leave(slot, alpha, delta, bearing, side, on, found, rows)
        if i < 0:
            return inf, 0
        way[1] = rows[i]
        time = way[0, 0] + way[1, 0]
    elif on >= ON_LR:
        # backward in time, with the world turned by π: two turns from the slot
        sign = 1.0 if on == ON_LR else -1.0
        bearing, last, middle = turn_tangent(
            Pose(slot, 0.0, 0.0), opposite(disc), sign, pi * (guess[1] + 1.0),
            pi * (guess[0] + 1.0),
        )  # fmt: skip
        if isnan(last):
            return inf, 0
        bearing += pi
        two_turns(-sign, 0.0, middle, last, way[1])
        i = enter(x, y, h, slot, alpha, delta, bearing, side, entry, found, rows)
        if i < 0:
            return inf, 0
        way[0] = rows[i]
        time = way[0, 0] + way[1, 0]
    else:
        start = _start(
            atan2(guess[1], guess[0]), x, y, h, slot, alpha, delta, side, entry, on, found, rows,
            way, link,
        )  # fmt: skip
        time, bearing = descend(
            x, y, h, slot, alpha, delta, start, side, entry, on, fixed, found, rows, way, link
        )
    if time < inf:
        if time >= beat:
            return inf, 0
        count = as_legs(side, on, bearing, way, link, legs)
        if clears(x, y, h, leader, alpha, delta, side, legs[:count]):
            return time, count
    if entry >= LR or on >= ARCS_ON:
        return inf, 0
    time = at_edge(
        atan2(guess[1], guess[0]), x, y, h, slot, alpha, delta, side, entry, on, leader, found,
        rows, way, link, legs,
    )  # fmt: skip
    return (time, 2) if time < beat else (inf, 0)


@njit(cache=True, nogil=True)
def _start(
    guess: float, x: float, y: float, h: float, slot: float, alpha: float, delta: float,
    side: float, entry: int, on: int, found: FloatArray, rows: FloatArray, way: FloatArray,
    link: FloatArray,
) -> float:  # fmt: skip
    """The bearing to begin at: the guess, or what lies between where both straights touch the disc.

    A straight way that is bent a little round the disc exists between these two bearings alone, and
    they may be closer to each other than a guess is good. Beside them the same words take full
    circles.
    """
    if entry >= 4 or on >= 4 or SIGNS[entry, 2] != side or SIGNS[on, 0] != side:
        return guess
    to, on_from = np.empty((4, 3)), np.empty((4, 3))
    disc = Disc(alpha, delta, side, 0.0)
    n = straight_tangents(Pose(x - slot, y, h), disc, SIGNS[entry, 0], to)
    if n == 0:
        return guess
    m = straight_tangents(Pose(slot, 0.0, 0.0), opposite(disc), -SIGNS[on, 2], on_from)
    best, start = inf, guess
    for i in range(n):
        for j in range(m):
            between = wrap_signed(on_from[j, 0] + pi - to[i, 0])
            if abs(between) < _NARROW:
                there = to[i, 0] + 0.5 * between
                time = through(
                    there, x, y, h, slot, alpha, delta, side, entry, on, link[:2], found, rows,
                    way, link,
                )  # fmt: skip
                if time < best:
                    best, start = time, there
    if best < inf and best < through(
        guess, x, y, h, slot, alpha, delta, side, entry, on, link[:2], found, rows, way, link
    ):
        return start
    return guess


@njit(cache=True, nogil=True)
def _by_boundary_arc(
    x: float, y: float, h: float, slot: float, alpha: float, delta: float, entry: int, side: float,
    on: int, guess: FloatArray, beat: float, leader: FloatArray, found: FloatArray,
    rows: FloatArray, way: FloatArray, link: FloatArray,
) -> tuple[float, float]:  # fmt: skip
    """The soonest way that begins with a boundary arc: its arrival and the boundary arc's first
    bearing.

    `way` takes the rows before and after, `link` the rest, as in `near_guess.through`.
    """
    disc = Disc(alpha, delta, side, 0.0)
    end, straight, turn = 0.0, 0.0, 0.0
    if on == ARCS_ON:
        end, straight, turn = boundary_arc_end(slot, disc)
        if isnan(end):
            return inf, 0.0
        straight_turn(side, straight, turn, way[1])
    if entry >= LR:
        sign = 1.0 if entry == LR else -1.0
        begin, first, second = turn_tangent(
            Pose(x - slot, y, h), disc, sign, pi * (guess[0] + 1.0), pi * (guess[1] + 1.0)
        )
        if isnan(first):
            return inf, 0.0
        link[3], link[4] = slide_between(begin, end, disc)
        two_turns(sign, first, second, 0.0, way[0])
        return first + second + link[4] + straight + turn, begin
    sign = -1.0 if entry == RS else 1.0
    contacts, row, fixed = np.empty((4, 3)), np.zeros(5), np.zeros(2)
    trial, joint = np.zeros((2, 5)), np.zeros(5)
    best, begun = beat, 0.0
    eased = Scene(leader, alpha, delta - 2.0 * GRAZE, 0.0)
    for k in range(straight_tangents(Pose(x - slot, y, h), disc, sign, contacts)):
        begin, before = contacts[k, 0], contacts[k, 1] + contacts[k, 2]
        if on == ARCS_ON:
            joint[3], joint[4] = slide_between(begin, end, disc)
            time = before + joint[4] + straight + turn
        else:
            fixed[0], fixed[1] = begin, before
            time, _ = descend(
                x, y, h, slot, alpha, delta, atan2(guess[1], guess[0]), side, entry, on, fixed,
                found, rows, trial, joint,
            )  # fmt: skip
        if time >= best:
            continue
        turn_straight(sign, contacts[k, 1], contacts[k, 2], row)
        # where two turns of a sign touch, the straight of the sooner one may lead through the disc
        if word_clears(Pose(x, y, h), 0.0, row, eased):
            best, begun = time, begin
            way[0] = row
            link[:] = joint
            if on == ARCS_AGAIN:
                way[1] = trial[1]
    return (best, begun) if best < beat else (inf, 0.0)


@njit(cache=True, nogil=True)
def taught_templates(
    situations: FloatArray, times: FloatArray, counts: FloatArray, legs: FloatArray, within: float,
    kinds: FloatArray, guesses: FloatArray,
) -> None:  # fmt: skip
    """What is to be learnt of exact answers: the kind of each, if its guess leads back to it.

    Args:
        situations: x, y, h in [0, 2π), α, D/R, d_min/R. shape (n, 6)
        times: of the answers [R/V_P]. shape (n,)
        counts: legs of each. shape (n,)
        legs: as `chain.fly_links`. shape (n, ·, 6)
        within: a kind that is solved this much later is not that of the answer [R/V_P].
        kinds: takes their numbers. shape (n,)
        guesses: takes their guesses. shape (n, 2)
    """
    trial = np.zeros((3, 6))
    for n in range(len(situations)):
        x, y, h, alpha, slot, limit = situations[n]
        kind = template_of(x, y, h, slot, alpha, int(counts[n]), legs[n], guesses[n])
        if kind > NONE:
            time, _ = solve_template(x, y, h, slot, alpha, limit, kind, guesses[n], inf, trial)
            if not time <= times[n] + within:
                kind = SEVERAL
        kinds[n] = kind
