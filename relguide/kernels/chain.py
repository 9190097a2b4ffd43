"""Chains of contacts: ways to the slot that touch d = d_min several times, or ride along it.

A chain is a row a contact: the leader's piece, the side, the bearing, and whether the way to it is
a word or a ride from the contact before (the leader may go on to its next pieces meanwhile).
Between contacts the way is the earliest extremal that clears, so the arrival is a function of the
bearings alone, and they are refined one after another.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is a table as in
`clearance`.
"""

from math import cos, inf, sin

import numpy as np
from numba import njit

from relguide.kernels.clearance import leader_at
from relguide.kernels.contact import contact_exists, contact_heading, ride_within
from relguide.kernels.passage import GRAZE, best_word, ways_to_contact, word_clears
from relguide.kernels.roots import FloatArray

WORD, RIDE, WAIT = 0.0, 1.0, 2.0
"""How a contact is reached, or the slot: by a path of just the right length, in the last case."""
MAX_CONTACTS = 8
"""Longest chain."""
_FINEST = 1e-7  # bearing steps end here: 1 mm at R = 12 km, 10 µs where the time has an edge
GAIN = 1e-8
"""Or where a parabola promises less than this [R/V_P]: 1 µs."""
_SWEEPS = 16  # over all bearings of a chain
_FURTHEST = 64.0  # times the way of a sweep
_NEAR = 0.3  # values farther above the least say nothing about a minimum [R/V_P]


@njit(cache=True, nogil=True)
def piece_at(leader: FloatArray, t: float) -> int:
    """The leader's piece at time t."""
    i = 0
    while i + 1 < len(leader) and leader[i + 1, 0] <= t:
        i += 1
    return i


@njit(cache=True, nogil=True)
def ride_arrival(
    leader: FloatArray, t: float, bearing: float, goal: float, side: float, alpha: float,
    delta: float,
) -> float:  # fmt: skip
    """When a ride that begins at time t reaches a bearing; infinite if it cannot be flown."""
    i = piece_at(leader, t)
    while bearing != goal:
        left = leader[i + 1, 0] - t if i + 1 < len(leader) else inf
        bearing, took = ride_within(bearing, goal, side, alpha, delta, leader[i, 4], left)
        if took == inf:
            return inf
        t += took
        i += 1
    return t


@njit(cache=True, nogil=True)
def contact_at(
    leader: FloatArray, t: float, bearing: float, side: float, alpha: float, delta: float
) -> tuple[float, float, float]:
    """The pursuer's pose at a contact at time t."""
    lx, ly, lh = leader_at(leader, piece_at(leader, t), alpha, t)
    return (
        lx + delta * cos(lh + bearing),
        ly + delta * sin(lh + bearing),
        lh + contact_heading(bearing, side, alpha),
    )


@njit(cache=True, nogil=True)
def earliest_contact(
    x: float, y: float, h: float, t: float, leader: FloatArray, i: int, alpha: float, delta: float,
    bearing: float, side: float, beat: float, rows: FloatArray,
) -> tuple[float, int]:  # fmt: skip
    """The earliest arrival at a contact that clears, and its row; infinite and −1 if none."""
    best, at = beat, -1
    n = ways_to_contact(x, y, h, t, leader, i, alpha, delta, bearing, side, rows)
    for k in range(n):
        if rows[k, 0] < best and word_clears(x, y, h, t, rows[k], leader, alpha, delta - GRAZE):
            best, at = rows[k, 0], k
    return (best, at) if at >= 0 else (inf, -1)


@njit(cache=True, nogil=True)
def fly_links(
    x: float, y: float, h: float, t: float, leader: FloatArray, alpha: float, delta: float,
    t_open: float, chain: FloatArray, first: int, last: int, beat: float, rows: FloatArray,
    legs: FloatArray,
) -> tuple[float, float, float, float]:  # fmt: skip
    """Fly some links of a chain: link k leads to contact k, and one more to the slot.

    Args:
        x: where link `first` begins, slot frame [R].
        y: the same [R].
        h: the same [rad].
        t: when [R/V_P].
        leader: table of its pieces. shape (k, 5)
        alpha: V_L/V_P.
        delta: distance at the contacts [R].
        t_open: when the slot opens [R/V_P].
        chain: piece, side, bearing, WORD or RIDE of each contact. shape (n, 4)
        first: link to begin with.
        last: link to end with, at most n.
        beat: arrivals from here on do not matter [R/V_P].
        rows: room for words. shape (MAX_ROWS, 5)
        legs: takes WORD and a row of `solve`, or RIDE, side, first and last bearing, for each leg.
            shape (≥ n + 1, 6)

    Returns:
        x, y, h, t where the last link ends; t is infinite if it cannot be flown before `beat`.
    """
    for k in range(first, min(last + 1, len(chain))):
        side, bearing = chain[k, 1], chain[k, 2]
        legs[k, 0] = chain[k, 3]
        if not contact_exists(bearing, alpha):
            return x, y, h, inf
        if chain[k, 3] == RIDE:
            begun = chain[k - 1, 2]
            t = ride_arrival(leader, t, begun, bearing, side, alpha, delta)
            legs[k, 1], legs[k, 2], legs[k, 3] = side, begun, bearing
            if t >= beat:
                return x, y, h, inf
        else:
            t_start = t
            t, at = earliest_contact(
                x, y, h, t, leader, int(chain[k, 0]), alpha, delta, bearing, side, beat, rows
            )
            if at < 0:
                return x, y, h, inf
            legs[k, 1:6] = rows[at]
            legs[k, 1] = t - t_start
        x, y, h = contact_at(leader, t, bearing, side, alpha, delta)
    if last == len(chain):
        legs[last, 0] = WORD
        t, at = best_word(x, y, h, t, leader, alpha, delta - GRAZE, t_open, beat, rows)
        if at >= 0:
            legs[last, 1:6] = rows[at]
    return x, y, h, t


@njit(cache=True, nogil=True)
def refine_chain(
    x: float, y: float, h: float, leader: FloatArray, alpha: float, delta: float, t_open: float,
    chain: FloatArray, here: float, stride: float, beat: float, rows: FloatArray, legs: FloatArray,
) -> float:  # fmt: skip
    """The least arrival near a chain, whose bearings are moved.

    From the chain's arrival `here` on, looking as far as `stride` [rad] at first; given up where
    the last sweep gained less than what is missing to `beat`. Other arguments as `fly_links`.
    """
    strides = np.full(len(chain), stride)
    finest = 0.1 * stride
    further = np.empty_like(chain)
    for _ in range(_SWEEPS):
        before, begun = here, chain.copy()
        for k in range(len(chain)):
            ax, ay, ah, t = fly_links(
                x, y, h, 0.0, leader, alpha, delta, t_open, chain, 0, k - 1, inf, rows, legs
            )
            # on the final leg nothing depends on time: past the next contact all stays as it is
            last = len(chain)
            if t >= t_open and chain[k, 0] == len(leader) - 1:
                last = min(k + 1, last)
            here = _refine_one(
                ax, ay, ah, t, leader, alpha, delta, t_open, chain, k, last, here, strides, finest,
                rows, legs,
            )  # fmt: skip
        gain = before - here
        # a valley that no bearing goes down alone: on the way that this sweep went together
        reach = 1.0
        while gain > GAIN and len(chain) > 1 and reach <= _FURTHEST:
            further[:] = chain
            further[:, 2] += reach * (chain[:, 2] - begun[:, 2])
            _, _, _, there = fly_links(
                x, y, h, 0.0, leader, alpha, delta, t_open, further, 0, len(chain), here, rows, legs
            )
            if there >= here:
                break
            here = there
            begun[:] = chain
            chain[:] = further
            reach *= 2.0
        gain = before - here
        if here - 2.0 * gain > beat or (gain < GAIN and finest == _FINEST):
            break
        finest = max(0.1 * finest, _FINEST)
    return here


@njit(cache=True, nogil=True)
def simplify_chain(
    x: float, y: float, h: float, leader: FloatArray, alpha: float, delta: float, t_open: float,
    chain: FloatArray, here: float, stride: float, rows: FloatArray, legs: FloatArray,
) -> tuple[float, int]:  # fmt: skip
    """Leave out contacts that a chain does as well without, or better.

    As `refine_chain`; `chain` takes the shorter one. Returns its arrival and how many contacts.
    """
    contacts = len(chain)
    k = 0
    while k < contacts and contacts > 1:
        fewer = np.empty((contacts - 1, 4))
        fewer[:k] = chain[:k]
        fewer[k:] = chain[k + 1 : contacts]
        if k < contacts - 1 and chain[k, 3] == WORD:
            fewer[k, 3] = WORD  # the ride that began at k is left out with it
        _, _, _, there = fly_links(
            x, y, h, 0.0, leader, alpha, delta, t_open, fewer, 0, contacts - 1, here + _NEAR, rows,
            legs,
        )  # fmt: skip
        if there < inf:
            there = refine_chain(
                x, y, h, leader, alpha, delta, t_open, fewer, there, stride, here, rows, legs
            )
        if there <= here + GAIN:
            contacts -= 1
            here = there
            chain[:contacts] = fewer
            k = 0
        else:
            k += 1
    return here, contacts


@njit(cache=True, nogil=True)
def _refine_one(
    x: float, y: float, h: float, t: float, leader: FloatArray, alpha: float, delta: float,
    t_open: float, chain: FloatArray, k: int, last: int, arrival: float, strides: FloatArray,
    finest: float, rows: FloatArray, legs: FloatArray,
) -> float:  # fmt: skip
    """One bearing of a chain: parabolas where the arrival is smooth, smaller steps at edges.

    Only the links up to `last` depend on it; the arrival falls by as much as their end.
    """
    stride, moved_by = strides[k], 0.0
    link = t, leader, alpha, delta, t_open, chain, k, last
    _, _, _, begun = fly_links(x, y, h, *link, inf, rows, legs)
    here = begun
    while stride >= finest and here < inf:
        bearing = chain[k, 2]
        beat = here + _NEAR
        chain[k, 2] = bearing - stride
        _, _, _, below = fly_links(x, y, h, *link, beat, rows, legs)
        chain[k, 2] = bearing + stride
        _, _, _, above = fly_links(x, y, h, *link, beat, rows, legs)
        shift, promised = vertex(below, here, above, stride)
        to, least, smooth = bearing, here, False
        if promised > 0.0:
            chain[k, 2] = bearing + shift
            _, _, _, found = fly_links(x, y, h, *link, beat, rows, legs)
            smooth = abs(here - found - promised) <= 0.1 * promised + GAIN
            if found < least:
                to, least = bearing + shift, found
        if below < least:
            to, least = bearing - stride, below
        if above < least:
            to, least = bearing + stride, above
        chain[k, 2] = to
        moved_by = max(moved_by, abs(to - bearing))
        here = least
        if smooth and promised < GAIN:
            break
        if smooth:
            stride *= 0.1
        elif abs(to - bearing) < stride:
            stride *= 0.4
    strides[k] = max(2.0 * moved_by, finest)
    return arrival - (begun - here) if here < inf else arrival


@njit(cache=True, nogil=True)
def vertex(below: float, here: float, above: float, stride: float) -> tuple[float, float]:
    """The least point of the parabola through three values: how far it is, and what it promises.

    Both 0 where there is none within two strides.
    """
    bend = below - 2.0 * here + above
    if not 0.0 < bend < inf:
        return 0.0, 0.0
    shift = 0.5 * stride * (below - above) / bend
    if abs(shift) > 2.0 * stride:
        return 0.0, 0.0
    return shift, shift * shift * bend / (2.0 * stride * stride)
