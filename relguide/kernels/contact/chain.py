"""Chains of contacts: ways to the slot that touch d = d_min several times, or slide along it.

A chain is a row a contact: the leader's piece, the side, the bearing, and whether the way to it is
a word or a boundary arc from the contact before (the leader may go on to its next pieces
meanwhile). Between contacts the way is the earliest extremal that clears, so the arrival is a
function of the bearings alone.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is a table as in
`clearance`.
"""

from math import inf

from numba import njit

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.boundary_arc import boundary_arc_arrival
from relguide.kernels.contact.contact import contact_at, contact_exists
from relguide.kernels.contact.passage import GRAZE, best_word, word_clears
from relguide.kernels.contact.paths_to_contact import paths_to_contact

WORD, BOUNDARY_ARC, WAIT = 0.0, 1.0, 2.0
"""How a contact is reached, or the slot: by a path of just the right length, in the last case."""
MAX_CONTACTS = 8
"""Longest chain."""


@njit(cache=True, nogil=True)
def earliest_contact(
    x: float, y: float, h: float, t: float, leader: FloatArray, i: int, alpha: float, delta: float,
    bearing: float, side: float, beat: float, rows: FloatArray,
) -> tuple[float, int]:  # fmt: skip
    """The earliest arrival at a contact that clears, and its row; infinite and −1 if none."""
    best, at = beat, -1
    n = paths_to_contact(x, y, h, t, leader, i, alpha, delta, bearing, side, rows)
    for k in range(n):
        if rows[k, 0] < best and word_clears(x, y, h, t, rows[k], leader, alpha, delta - GRAZE):
            best, at = rows[k, 0], k
    return (best, at) if at >= 0 else (inf, -1)


@njit(cache=True, nogil=True)
def fly_links(
    x: float, y: float, h: float, t: float, leader: FloatArray, alpha: float, delta: float,
    t_release: float, chain: FloatArray, first: int, last: int, beat: float, rows: FloatArray,
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
        t_release: when the slot opens [R/V_P].
        chain: piece, side, bearing, WORD or BOUNDARY_ARC of each contact. shape (n, 4)
        first: link to begin with.
        last: link to end with, at most n.
        beat: arrivals from here on do not matter [R/V_P].
        rows: room for words. shape (MAX_ROWS, 5)
        legs: takes WORD and a row of `solve`, or BOUNDARY_ARC, side, first and last bearing,
            for each leg. shape (≥ n + 1, 6)

    Returns:
        x, y, h, t where the last link ends; t is infinite if it cannot be flown before `beat`.
    """
    for k in range(first, min(last + 1, len(chain))):
        side, bearing = chain[k, 1], chain[k, 2]
        legs[k, 0] = chain[k, 3]
        if not contact_exists(bearing, alpha):
            return x, y, h, inf
        if chain[k, 3] == BOUNDARY_ARC:
            begun = chain[k - 1, 2]
            t = boundary_arc_arrival(leader, t, begun, bearing, side, alpha, delta)
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
        t, at = best_word(x, y, h, t, leader, alpha, delta - GRAZE, t_release, beat, rows)
        if at >= 0:
            legs[last, 1:6] = rows[at]
    return x, y, h, t
