"""Ways through one contact with d = d_min: the disc is scanned, and its best bearings refined.

A path that the limit bends touches the forbidden disc, and the state at a contact is fixed by its
bearing, for each piece of the leader's intent and each side: the arrival is a function of that
bearing (see `passage`), searched on a grid first and then downward.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is a table as in
`clearance`.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain_refinement import FINEST, GAIN, vertex
from relguide.kernels.contact.contact import boundary_arc_sense, contact_at, contact_exists
from relguide.kernels.contact.passage import through_contact
from relguide.kernels.contact.paths_to_contact import not_before, not_before_slot
from relguide.kernels.words.extremals import MAX_ROWS

_BASINS = 8  # refined: the best of them wins in every reference case; the rest is insurance
_BESIDE = 1e-6  # how far beside a tangent contact it is looked: 1 cm at R = 12 km
_HIDDEN = 0.14  # how much a basin may fall below what the scan sees of it [R/V_P]
_PARTS = 4  # into which the bearings beside a basin without a neighbour are cut


@njit(cache=True, nogil=True)
def contact_nodes(
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
            way = boundary_arc_sense(low, side, alpha, delta, leader[i, 4])
            if way != boundary_arc_sense(high, side, alpha, delta, leader[i, 4]):
                for _ in range(50):
                    middle = 0.5 * (low + high)
                    if boundary_arc_sense(middle, side, alpha, delta, leader[i, 4]) == way:
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
def scan_contacts(
    x: float, y: float, h: float, leader: FloatArray, alpha: float, delta: float, t_release: float,
    sides: FloatArray, placed: FloatArray, beat: float, time: FloatArray, lower: FloatArray,
    values: FloatArray, way: FloatArray,
) -> float:  # fmt: skip
    """The fastest way through one of many contacts, those that may be reached soonest first.

    Args:
        x: start, slot frame [R].
        y: start [R].
        h: start heading [rad].
        leader: table of its pieces. shape (k, 5)
        alpha: V_L/V_P.
        delta: distance at the contacts [R].
        t_release: when the slot opens [R/V_P].
        sides: of the contacts, from `contact_nodes`. shape (n,)
        placed: their bearings [rad]. shape (n,)
        beat: an arrival already known [R/V_P].
        time: takes the earliest time at each contact [R/V_P], infinite where none matters. (n,)
        lower: takes before what no way on from there arrives [R/V_P]. shape (n,)
        values: takes the arrivals [R/V_P], infinite where far too late. shape (n,)
        way: takes the two rows of the fastest way. shape (2, 5)

    Returns:
        its arrival [R/V_P]; `beat` if none is earlier.
    """
    rows, onward = np.empty((MAX_ROWS, 5)), np.empty((MAX_ROWS, 5))
    trial, reached = np.empty((2, 5)), np.empty(2)
    count, size = len(placed), len(placed) // (2 * len(leader))
    time[:], lower[:], values[:] = inf, inf, inf
    soonest = np.full(count, inf)
    for n in range(count):
        if contact_exists(placed[n], alpha):
            i = n // (2 * size)
            t = not_before(x, y, h, 0.0, leader, i, alpha, delta, placed[n], sides[n])
            soonest[n] = max(t, t_release)
            if i + 1 == len(leader):
                # on the final leg the contact keeps its place from the slot
                cx, cy, ch = contact_at(leader, t, placed[n], sides[n], alpha, delta)
                soonest[n] = not_before_slot(cx, cy, ch, t, alpha, t_release)
    best = beat
    for n in np.argsort(soonest):
        if soonest[n] >= best + _HIDDEN:
            break
        values[n] = through_contact(
            x, y, h, leader, n // (2 * size), alpha, delta, t_release, placed[n], sides[n],
            best + _HIDDEN, rows, onward, trial, reached,
        )  # fmt: skip
        time[n], lower[n] = reached[0], reached[1]
        if values[n] >= best + _HIDDEN:
            values[n] = inf
        elif values[n] < best:
            best = values[n]
            way[:] = trial
    return best


@njit(cache=True, nogil=True)
def descend_basins(
    x: float, y: float, h: float, leader: FloatArray, alpha: float, delta: float, t_release: float,
    sides: FloatArray, placed: FloatArray, values: FloatArray, bearings: int, best: float,
    way: FloatArray,
) -> float:  # fmt: skip
    """From the lowest of what a scan has seen, downward between its bearings.

    Args:
        x: start, slot frame [R].
        y: start [R].
        h: start heading [rad].
        leader: table of its pieces. shape (k, 5)
        alpha: V_L/V_P.
        delta: distance at the contacts [R].
        t_release: when the slot opens [R/V_P].
        sides: of the contacts. shape (n,)
        placed: their bearings [rad]. shape (n,)
        values: arrivals through them, from `scan_contacts`. shape (n,)
        bearings: how many of them make the round.
        best: the least arrival so far [R/V_P].
        way: takes the two rows of a faster way. shape (2, 5)

    Returns:
        the least arrival [R/V_P].
    """
    rows, onward = np.empty((MAX_ROWS, 5)), np.empty((MAX_ROWS, 5))
    nearby, trial, reached = np.empty((2, 5)), np.empty((2, 5)), np.empty(2)
    count, size = len(placed), len(placed) // (2 * len(leader))
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
        hidden = 1.5 * promised + 0.01 if promised > 0.0 else min(rise, _HIDDEN)
        if values[at] > best and values[at] - hidden >= best:
            continue
        here = _descend(
            x, y, h, leader, at // (2 * size), alpha, delta, t_release, placed[at], sides[at],
            values[at], 0.5 * TWO_PI / bearings, rows, onward, trial, reached, nearby,
        )  # fmt: skip
        if here < best:
            best = here
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
                    x, y, h, leader, at // (2 * size), alpha, delta, t_release,
                    placed[at] + away * part / _PARTS, sides[at], best + _HIDDEN, rows, onward,
                    trial, reached,
                )  # fmt: skip
                if value >= best + _HIDDEN:
                    break
                edge, there = value, placed[at] + away * part / _PARTS
                if edge < best:
                    best = edge
                    way[:] = trial
            if edge == inf:
                continue
            here = _descend(
                x, y, h, leader, at // (2 * size), alpha, delta, t_release, there, sides[at], edge,
                0.5 * abs(away) / _PARTS, rows, onward, trial, reached, nearby,
            )  # fmt: skip
            if here < best:
                best = here
                way[:] = nearby
    return best


@njit(cache=True, nogil=True)
def _descend(
    x: float, y: float, h: float, leader: FloatArray, i: int, alpha: float, delta: float,
    t_release: float, bearing: float, side: float, here: float, stride: float, rows: FloatArray,
    onward: FloatArray, trial: FloatArray, reached: FloatArray, way: FloatArray,
) -> float:  # fmt: skip
    """The least arrival near a bearing whose own is `here`; `way` takes the way if it is less."""
    while stride > FINEST:
        moved = False
        values = (inf, inf)
        for direction in range(2):
            there = bearing + stride * (2.0 * direction - 1.0)
            found = through_contact(
                x, y, h, leader, i, alpha, delta, t_release, there, side, here + 0.2, rows, onward,
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
            x, y, h, leader, i, alpha, delta, t_release, bearing + shift, side, here, rows, onward,
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
