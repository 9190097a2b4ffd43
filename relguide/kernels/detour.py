"""Ways to the slot that touch d = d_min: the search when the best way without the limit breaks it.

A path that the limit bends touches the forbidden disc, and the arrival is a function of the
contact's bearing alone, for each piece of the leader's intent and each side (see `passage`). It is
scanned round the disc, every basin that matters is refined, and so are the contacts of `tangent`.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is a table as in
`clearance`. The work is bounded: pieces × 2 × bearings contacts, each a few words.
"""

from math import cos, inf, sin, sqrt

import numpy as np
from numba import njit

from relguide.kernels.angles import TWO_PI, wrap_signed
from relguide.kernels.clearance import leader_at, piece_clears
from relguide.kernels.contact import contact_exists, contact_heading
from relguide.kernels.extremals import MAX_ROWS, fly_piece
from relguide.kernels.passage import best_word, through_contact
from relguide.kernels.roots import FloatArray

_BASINS = 8  # refined: the best of them wins in every reference case; the rest is insurance
_BESIDE = 1e-6  # how far beside a tangent contact it is looked: 1 cm at R = 12 km
_FIRST_TURNS = 48  # sizes of a first turn in `any_way`: every 7.5°
_LONGEST = 64.0  # longest straight tried there [R]: 200 NM for an airliner
_FINEST = 1e-7  # bearing steps end here: 1 mm at R = 12 km, 10 µs where the time has an edge


@njit(cache=True, nogil=True)
def _intercept(dx: float, dy: float, ax: float, ay: float) -> float:
    """Least time to a point at (dx, dy) that moves at a, by the straight way; 0 where unknown."""
    closing = dx * ax + dy * ay
    one_less = 1.0 - ax * ax - ay * ay
    if one_less <= 1e-9:
        return 0.0
    return (closing + sqrt(closing * closing + one_less * (dx * dx + dy * dy))) / one_less


@njit(cache=True, nogil=True)
def _soonest(
    x: float, y: float, h: float, leader: FloatArray, i: int, alpha: float, delta: float,
    t_open: float, bearing: float, side: float,
) -> float:  # fmt: skip
    """A cheap lower bound on the arrival through a contact: straight ways, and least turns."""
    if not contact_exists(bearing, alpha):
        return inf
    lx, ly, lh = leader_at(leader, i, alpha, leader[i, 0] if leader[i, 4] != 0.0 else 0.0)
    course = lh + contact_heading(bearing, side, alpha)
    if leader[i, 4] != 0.0:
        return float(max(leader[i, 0], t_open))
    cx, cy = lx + delta * cos(lh + bearing), ly + delta * sin(lh + bearing)
    ax, ay = alpha * cos(lh), alpha * sin(lh)
    there = max(_intercept(cx - x, cy - y, ax, ay), abs(wrap_signed(course - h)), leader[i, 0])
    if i + 1 < len(leader):
        return float(max(there, t_open))
    # on the final leg the contact keeps its place from the slot
    onward = max(_intercept(-cx, -cy, alpha, 0.0), abs(wrap_signed(course)))
    return float(max(there + onward, t_open))


@njit(cache=True, nogil=True)
def best_detour(
    x: float, y: float, h: float, leader: FloatArray, alpha: float, delta: float, t_open: float,
    bearings: int, tangents: FloatArray, beat: float, way: FloatArray,
) -> float:  # fmt: skip
    """The fastest way to the slot through one contact.

    Args:
        x: start, slot frame [R].
        y: start [R].
        h: start heading [rad].
        leader: table of its pieces. shape (k, 5)
        alpha: V_L/V_P.
        delta: distance at the contact, d_min and a graze more [R].
        t_open: when the slot opens [R/V_P].
        bearings: how finely the disc is scanned.
        tangents: contacts to be looked at besides, from `tangent.tangents`. shape (·, 3)
        beat: an arrival already known [R/V_P]; only earlier ones are looked for.
        way: takes the row to the contact and the row from it. shape (2, 5)

    Returns:
        arrival time [R/V_P]; `beat` if no way is faster.
    """
    pieces = len(leader)
    rows = np.empty((MAX_ROWS, 5))
    onward = np.empty((MAX_ROWS, 5))
    trial = np.empty((2, 5))
    values = np.full((pieces, 2, bearings), inf)
    soonest = np.empty(pieces * 2 * bearings)
    for n in range(len(soonest)):
        soonest[n] = _soonest(
            x, y, h, leader, n // (2 * bearings), alpha, delta, t_open,
            TWO_PI * (n % bearings) / bearings, 1.0 - 2.0 * (n // bearings % 2),
        )  # fmt: skip
    best = beat
    # basins are compared against what is known before any is refined: some slack, or none survives
    slack = 2.0 * TWO_PI / bearings
    for n in np.argsort(soonest):
        if soonest[n] >= best + slack:
            break
        i, side, j = n // (2 * bearings), n // bearings % 2, n % bearings
        found = through_contact(
            x, y, h, leader, i, alpha, delta, t_open, TWO_PI * j / bearings, 1.0 - 2.0 * side,
            best + slack, rows, onward, trial,
        )  # fmt: skip
        if found < best + slack:
            values[i, side, j] = found
            if found < best:
                best = found
                way[:] = trial
    taken = np.zeros((pieces, 2, bearings))
    for _ in range(_BASINS):
        low, at_i, at_side, at_j = inf, -1, 0, 0
        for i in range(pieces):
            for side in range(2):
                for j in range(bearings):
                    value = values[i, side, j]
                    is_basin = (
                        value < low
                        and taken[i, side, j] == 0.0
                        and value <= values[i, side, (j + 1) % bearings]
                        and value <= values[i, side, j - 1]
                    )
                    if is_basin:
                        low, at_i, at_side, at_j = value, i, side, j
        if at_i < 0:
            break
        taken[at_i, at_side, at_j] = 1.0
        # how much lower it may be between here and its neighbours; an edge may hide more
        rise = max(values[at_i, at_side, (at_j + 1) % bearings], values[at_i, at_side, at_j - 1])
        if low > best and low - min(rise - low, slack) >= best:
            continue
        here = _descend(
            x, y, h, leader, at_i, alpha, delta, t_open, TWO_PI * at_j / bearings,
            1.0 - 2.0 * at_side, low, 0.5 * TWO_PI / bearings, rows, onward, trial,
        )  # fmt: skip
        if here < best:
            best = here
            way[:] = trial
    for tangent in tangents:
        # the words that end there exist on one side of the bearing only
        for off in (-_BESIDE, _BESIDE):
            found = through_contact(
                x, y, h, leader, pieces - 1, alpha, delta, t_open, tangent[0] + off, tangent[1],
                best, rows, onward, trial,
            )  # fmt: skip
            if found < best:
                best = _descend(
                    x, y, h, leader, pieces - 1, alpha, delta, t_open, tangent[0] + off,
                    tangent[1], found, 0.1 * TWO_PI / bearings, rows, onward, trial,
                )  # fmt: skip
                way[:] = trial
    return best


@njit(cache=True, nogil=True)
def _descend(
    x: float, y: float, h: float, leader: FloatArray, i: int, alpha: float, delta: float,
    t_open: float, bearing: float, side: float, here: float, stride: float, rows: FloatArray,
    onward: FloatArray, trial: FloatArray,
) -> float:  # fmt: skip
    """The least arrival near a bearing whose own is `here`; `trial` takes the way if it is less."""
    while stride > _FINEST:
        moved = False
        for direction in range(2):
            there = bearing + stride * (1.0 - 2.0 * direction)
            found = through_contact(
                x, y, h, leader, i, alpha, delta, t_open, there, side, here, rows, onward, trial
            )
            if found < here:
                here, bearing, moved = found, there, True
                break
        if not moved:
            stride *= 0.4
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
