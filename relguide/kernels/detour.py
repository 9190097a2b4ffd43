"""Ways to the slot that touch d = d_min: the search when the best way without the limit breaks it.

A path that the limit bends touches the forbidden disc, and the state at a contact is fixed by its
bearing, for each piece of the leader's intent and each side. Three searches follow each other: ways
through one contact, whose arrival is a function of its bearing alone (see `passage`); a graph of
contacts joined by words and rides (see `contact_graph`); and the refinement of the best of both.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is a table as in
`clearance`. The work is bounded: pieces × 2 × bearings contacts, each a few words, and a fixed
number of basins, hops and sweeps.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.angles import TWO_PI, wrap
from relguide.kernels.chain import (
    GAIN,
    MAX_CONTACTS,
    WAIT,
    WORD,
    contact_at,
    fly_links,
    refine_chain,
    simplify_chain,
    vertex,
)
from relguide.kernels.clearance import piece_clears
from relguide.kernels.contact import contact_exists, ride_way
from relguide.kernels.contact_graph import best_chains
from relguide.kernels.extremals import MAX_ROWS, fly_piece
from relguide.kernels.passage import best_word, not_before, not_before_slot, through_contact
from relguide.kernels.roots import FloatArray

MAX_LEGS = MAX_CONTACTS + 1
"""Legs of the longest way."""
_BASINS = 8  # refined: the best of them wins in every reference case; the rest is insurance
_BESIDE = 1e-6  # how far beside a tangent contact it is looked: 1 cm at R = 12 km
_CHAINS = 4  # of the graph, refined
_PER_HOP = 4  # so many bearings on the disc let one contact be followed to all others
_NEARLY = 0.07  # how much a chain may fall below what the graph sees of it [R/V_P]
_SLACK = 0.14  # how much a basin may fall below what the scan sees of it [R/V_P]
_PARTS = 4  # into which the bearings beside a basin without a neighbour are cut
_FIRST_TURNS = 48  # sizes of a first turn in `any_way`: every 7.5°
_LONGEST = 64.0  # longest straight tried there [R]: 200 NM for an airliner
_FINEST = 1e-7  # bearing steps end here: 1 mm at R = 12 km, 10 µs where the time has an edge


@njit(cache=True, nogil=True)
def _nodes(
    leader: FloatArray, alpha: float, delta: float, bearings: int, tangents: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Sides and bearings of the contacts looked at: for each piece both sides, ascending.

    A grid; both sides of each tangent contact, since the words that end there exist on one of them
    only; and the ends of what can be ridden.
    """
    groups = 2 * len(leader)
    own = np.empty((groups, 2 * bearings + 2 * len(tangents)))
    sizes = np.zeros(groups, dtype=np.int64)
    for group in range(groups):
        i, side = group // 2, 1.0 - 2.0 * (group % 2)
        n = 0
        for j in range(bearings):
            low, high = TWO_PI * j / bearings, TWO_PI * (j + 1) / bearings
            own[group, n] = low
            n += 1
            way = ride_way(low, side, alpha, delta, leader[i, 4])
            if way != ride_way(high, side, alpha, delta, leader[i, 4]):
                for _ in range(50):
                    middle = 0.5 * (low + high)
                    if ride_way(middle, side, alpha, delta, leader[i, 4]) == way:
                        low = middle
                    else:
                        high = middle
                own[group, n] = low if way != 0.0 else high
                n += 1
        for tangent in tangents:
            if tangent[1] == side and tangent[3] == i:
                own[group, n] = wrap(tangent[0] - _BESIDE)
                own[group, n + 1] = wrap(tangent[0] + _BESIDE)
                n += 2
        sizes[group] = n
    # all groups are made alike in length: spare ones fill the grid
    size = sizes.max()
    sides, placed = np.empty(groups * size), np.empty(groups * size)
    for group in range(groups):
        for n in range(sizes[group], size):
            own[group, n] = TWO_PI * (n - sizes[group] + 0.5) / bearings
        sides[group * size : (group + 1) * size] = 1.0 - 2.0 * (group % 2)
        placed[group * size : (group + 1) * size] = np.sort(own[group, :size])
    return sides, placed


@njit(cache=True, nogil=True)
def best_detour(
    x: float, y: float, h: float, leader: FloatArray, alpha: float, delta: float, t_open: float,
    bearings: int, tangents: FloatArray, beat: float, legs: FloatArray,
) -> tuple[float, int]:  # fmt: skip
    """The fastest way to the slot that touches the disc.

    Args:
        x: start, slot frame [R].
        y: start [R].
        h: start heading [rad].
        leader: table of its pieces. shape (k, 5)
        alpha: V_L/V_P.
        delta: distance at the contacts, d_min and a graze more [R].
        t_open: when the slot opens [R/V_P].
        bearings: how finely the disc is scanned.
        tangents: contacts to be looked at besides, from `tangent.tangents`. shape (·, 4)
        beat: an arrival already known [R/V_P]; only earlier ones are looked for.
        legs: takes the legs of the way, as `chain.fly_links`. shape (MAX_LEGS, 6)

    Returns:
        arrival time [R/V_P] and the number of legs; `beat` and 0 if no way is faster.
    """
    rows = np.empty((MAX_ROWS, 5))
    onward = np.empty((MAX_ROWS, 5))
    way, nearby, trial = np.empty((2, 5)), np.empty((2, 5)), np.empty((2, 5))
    reached = np.empty(2)
    sides, placed = _nodes(leader, alpha, delta, bearings, tangents)
    count, size = len(placed), len(placed) // (2 * len(leader))
    time, lower, values = np.full(count, inf), np.full(count, inf), np.full(count, inf)
    soonest = np.full(count, inf)
    for n in range(count):
        if contact_exists(placed[n], alpha):
            i = n // (2 * size)
            t = not_before(x, y, h, 0.0, leader, i, alpha, delta, placed[n], sides[n])
            soonest[n] = max(t, t_open)
            if i + 1 == len(leader):
                # on the final leg the contact keeps its place from the slot
                cx, cy, ch = contact_at(leader, t, placed[n], sides[n], alpha, delta)
                soonest[n] = not_before_slot(cx, cy, ch, t, alpha, t_open)
    best, found = beat, 0
    for n in np.argsort(soonest):
        if soonest[n] >= best + _SLACK:
            break
        values[n] = through_contact(
            x, y, h, leader, n // (2 * size), alpha, delta, t_open, placed[n], sides[n],
            best + _SLACK, rows, onward, trial, reached,
        )  # fmt: skip
        time[n], lower[n] = reached[0], reached[1]
        if values[n] >= best + _SLACK:
            values[n] = inf
        elif values[n] < best:
            best, found = values[n], 2
            way[:] = trial
    taken = np.zeros(count)
    for _ in range(_BASINS):
        at = -1
        for n in range(count):
            group = n // size * size
            if (
                values[n] < inf
                and taken[n] == 0.0
                and (at < 0 or values[n] < values[at])
                and values[n] <= values[group + (n - group + 1) % size]
                and values[n] <= values[group + (n - group - 1) % size]
            ):
                at = n
        if at < 0:
            break
        taken[at] = 1.0
        group = at // size * size
        after, before = group + (at - group + 1) % size, group + (at - group - 1) % size
        # how much lower it may be between here and its neighbours: what a parabola says, or the
        # rise to them where an edge may hide more
        _, promised = vertex(values[before], values[at], values[after], TWO_PI / bearings)
        rise = max(values[after], values[before]) - values[at]
        hidden = 1.5 * promised + 0.01 if promised > 0.0 else min(rise, _SLACK)
        if values[at] > best and values[at] - hidden >= best:
            continue
        here = _descend(
            x, y, h, leader, at // (2 * size), alpha, delta, t_open, placed[at], sides[at],
            values[at], 0.5 * TWO_PI / bearings, rows, onward, trial, reached, nearby,
        )  # fmt: skip
        if here < best:
            best, found = here, 2
            way[:] = nearby
        if len(leader) == 1:
            continue
        # while the leader turns windows are narrow: it may fall towards either end of this one
        for k in range(2):
            if values[before if k == 0 else after] < inf:
                continue
            away = (2.0 * k - 1.0) * TWO_PI / bearings
            edge, there = inf, placed[at]
            for part in range(1, _PARTS):
                value = through_contact(
                    x, y, h, leader, at // (2 * size), alpha, delta, t_open,
                    placed[at] + away * part / _PARTS, sides[at], best + _SLACK, rows, onward,
                    trial, reached,
                )  # fmt: skip
                if value >= best + _SLACK:
                    break
                edge, there = value, placed[at] + away * part / _PARTS
                if edge < best:
                    best, found = edge, 2
                    way[:] = trial
            if edge == inf:
                continue
            here = _descend(
                x, y, h, leader, at // (2 * size), alpha, delta, t_open, there, sides[at], edge,
                0.5 * abs(away) / _PARTS, rows, onward, trial, reached, nearby,
            )  # fmt: skip
            if here < best:
                best, found = here, 2
                way[:] = nearby
    tried = np.empty((MAX_LEGS, 6))
    stride = 0.5 * TWO_PI / bearings
    for k in range(found):
        legs[k, 0] = WORD
        legs[k, 1:6] = way[k]
    chains = np.empty((_CHAINS, MAX_CONTACTS + 1, 4))
    kept = best_chains(
        leader, alpha, delta, t_open, sides, placed, time, lower, best, _NEARLY,
        bearings // _PER_HOP, chains,
    )  # fmt: skip
    if kept > 0 and chains[0, 0, 0] == t_open:
        contacts = int(chains[0, 0, 1])
        fly_links(
            x, y, h, 0.0, leader, alpha, delta, t_open, chains[0, 1 : contacts + 1], 0,
            contacts - 1, inf, rows, legs,
        )  # fmt: skip
        legs[contacts, 0] = WAIT
        return t_open, contacts + 1
    won = -1
    for k in range(kept):
        here = refine_chain(
            x, y, h, leader, alpha, delta, t_open, chains[k, 1 : int(chains[k, 0, 1]) + 1],
            chains[k, 0, 0], stride, best, rows, tried,
        )  # fmt: skip
        if here < best - GAIN:
            best, won = here, k
    if won >= 0:
        contacts = int(chains[won, 0, 1])
        chain = chains[won, 1 : contacts + 1]
        if contacts > 2:
            best, contacts = simplify_chain(
                x, y, h, leader, alpha, delta, t_open, chain, best, stride, rows, tried
            )
        _, _, _, best = fly_links(
            x, y, h, 0.0, leader, alpha, delta, t_open, chain[:contacts], 0, contacts, inf, rows,
            legs,
        )  # fmt: skip
        found = contacts + 1
    return best, found


@njit(cache=True, nogil=True)
def _descend(
    x: float, y: float, h: float, leader: FloatArray, i: int, alpha: float, delta: float,
    t_open: float, bearing: float, side: float, here: float, stride: float, rows: FloatArray,
    onward: FloatArray, trial: FloatArray, reached: FloatArray, way: FloatArray,
) -> float:  # fmt: skip
    """The least arrival near a bearing whose own is `here`; `way` takes the way if it is less."""
    while stride > _FINEST:
        moved = False
        values = (inf, inf)
        for direction in range(2):
            there = bearing + stride * (2.0 * direction - 1.0)
            found = through_contact(
                x, y, h, leader, i, alpha, delta, t_open, there, side, here + 0.2, rows, onward,
                trial, reached,
            )  # fmt: skip
            values = (values[1], found)
            if found < here:
                here, bearing, moved = found, there, True
                way[:] = trial
                break
        if moved:
            continue
        shift, promised = vertex(values[0], here, values[1], stride)
        if promised == 0.0:
            stride *= 0.4
            continue
        found = through_contact(
            x, y, h, leader, i, alpha, delta, t_open, bearing + shift, side, here, rows, onward,
            trial, reached,
        )  # fmt: skip
        smooth = abs(here - found - promised) <= 0.1 * promised + GAIN
        if found < here:
            here, bearing = found, bearing + shift
            way[:] = trial
        if smooth and promised < GAIN:
            break
        stride *= 0.1 if smooth else 0.4
    return here


@njit(cache=True, nogil=True)
def any_way(
    x: float, y: float, h: float, leader: FloatArray, alpha: float, limit: float, t_open: float,
    beat: float, way: FloatArray,
) -> tuple[float, float, float, float]:  # fmt: skip
    """Some way to the slot that clears: a first turn of any size, a straight, and a word.

    For when nothing else was found: whether there is a way at all matters more than its time then.

    Args:
        x: start, slot frame [R].
        y: start [R].
        h: start heading [rad].
        leader: table of its pieces. shape (k, 5)
        alpha: V_L/V_P.
        limit: least allowed separation [R].
        t_open: when the slot opens [R/V_P].
        beat: an arrival already known [R/V_P]; only earlier ones are looked for.
        way: takes the row of the word. shape (5,)

    Returns:
        arrival, sign and angle of the first turn, length of the straight; `beat` and zeros if none.
    """
    best, best_sign, best_turn, best_straight = beat, 0.0, 0.0, 0.0
    rows = np.empty((MAX_ROWS, 5))
    for side in range(2):
        sign = 1.0 - 2.0 * side
        for j in range(_FIRST_TURNS + 1):
            turned = TWO_PI * j / _FIRST_TURNS
            if not piece_clears(x, y, h, sign, 0.0, turned, leader, alpha, limit):
                break  # nor does any larger turn
            px, py, ph = fly_piece(x, y, h, sign, turned)
            straight = 0.0
            while straight <= _LONGEST:
                if not piece_clears(px, py, ph, 0.0, turned, straight, leader, alpha, limit):
                    break
                qx, qy, _ = fly_piece(px, py, ph, 0.0, straight)
                arrival, i = best_word(
                    qx, qy, ph, turned + straight, leader, alpha, limit, t_open, best, rows
                )
                if arrival < best:
                    best, best_sign, best_turn, best_straight = arrival, sign, turned, straight
                    way[:] = rows[i]
                straight = 2.0 * straight + 0.25
    return best, best_sign, best_turn, best_straight
