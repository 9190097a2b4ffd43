"""A way's legs as the pieces that are flown: turns at full bank, straights, the arcs of boundary
arcs.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; the leader is a table as in
`clearance`. What comes out is in metres.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.angles import wrap
from relguide.kernels.base.records import Pose
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.boundary_arc import MAX_NODES, boundary_arc_pieces
from relguide.kernels.contact.chain import BOUNDARY_ARC, WAIT
from relguide.kernels.contact.delay_after_contact import delay_until_release
from relguide.kernels.contact.passage import GRAZE, best_word, word_clears
from relguide.kernels.words.delay import DELAY_PIECES
from relguide.kernels.words.extremals import MAX_ROWS, SIGNS, fly_piece
from relguide.kernels.words.fastest import fastest
from relguide.kernels.words.sooner import make_scratch

NO_TURN = 1e-9
"""A turn below this is rounding [rad]; likewise a straight, in R."""
SAME = 2e-4
"""Flown in pieces a way takes as long as it did when it was found, to this [R/V_P]: some ms."""


@njit(cache=True, nogil=True)
def pieces_of(
    x: float, y: float, h: float, leader: FloatArray, alpha: float, limit: float, t_release: float,
    radius: float, sense: float, time: float, legs: FloatArray,
) -> FloatArray:  # fmt: skip
    """The pieces of a way; the last word anew, from where the boundary arcs really end.

    What is only rounding is left out. Two pieces that meet in a contact may be one turn, or one
    straight.

    Args:
        x: start, slot frame [R].
        y: start [R].
        h: start heading [rad].
        leader: table of its pieces. shape (k, 5)
        alpha: V_L/V_P.
        limit: d_min [R].
        t_release: when the slot opens [R/V_P].
        radius: R [m].
        sense: +1, or −1 for the mirror image of what is flown here.
        time: when the way arrives as it was found [R/V_P].
        legs: as `chain.fly_links` gives them. shape (n, 6)

    Returns:
        a column a piece: 0, or of a boundary arc's arc the boundary arc's number, negative if it
        goes clockwise round the leader; ε (+1 left, 0 straight), or of a boundary arc's arc its
        curvature, positive to the right [1/m]; turn angle [rad] or length [m]. No columns if no
        word leads on from where the last boundary arc ends, or none as soon. shape (3, pieces)
    """
    boundary_arcs = 0
    for k in range(len(legs)):
        boundary_arcs += legs[k, 0] == BOUNDARY_ARC
    pieces = np.empty((3, 3 * len(legs) + DELAY_PIECES + 2 * MAX_NODES * boundary_arcs))
    arcs = np.empty((2 * MAX_NODES if boundary_arcs > 0 else 0, 2))
    row = np.empty(5)
    n, t, last = (
        0,
        0.0,
        2.0,
    )  # of two words in a row the turns that meet may be one; of boundary arcs none
    for k in range(len(legs)):
        if legs[k, 0] == BOUNDARY_ARC:
            side = legs[k, 1]
            count, x, y, h, t = boundary_arc_pieces(
                x, y, h, t, leader, alpha, limit + GRAZE, side, legs[k, 2], legs[k, 3], arcs
            )
            for i in range(count):
                pieces[0, n] = sense * side * (k + 1.0)
                # counter-clockwise rates become curvatures positive to the right
                pieces[1, n], pieces[2, n] = -sense * arcs[i, 1] / radius, arcs[i, 0] * radius
                n += 1
            last = 2.0
            continue
        if legs[k, 0] == WAIT:
            waiting = np.empty((DELAY_PIECES, 2))
            if not delay_until_release(
                x, y, h, t, leader, alpha, limit - GRAZE, t_release, waiting
            ):  # fmt: skip
                return pieces[:, :0]
            signs, amounts = waiting[:, 0], waiting[:, 1]
        else:
            row[:] = legs[k, 1:6]
            # a boundary arc's last node lies within rounding of the limit: it must not cost the
            # best word
            if (
                boundary_arcs > 0
                and k + 1 == len(legs)
                and not _word_on(x, y, h, t, leader, alpha, limit - GRAZE, t_release, row)
            ):
                return pieces[:, :0]
            signs, amounts = SIGNS[int(row[1])], row[2:5]
        for i in range(len(signs)):
            sign, amount = signs[i], amounts[i]
            x, y, h = fly_piece(Pose(x, y, h), sign, amount)
            t += amount
            if amount <= NO_TURN:
                continue
            amount *= radius if sign == 0.0 else 1.0
            if sign == last:
                pieces[2, n - 1] += amount
                continue
            pieces[0, n], pieces[1, n], pieces[2, n] = 0.0, sense * sign, amount
            n += 1
            last = sign
    return pieces[:, :n] if t <= time + SAME else pieces[:, :0]


@njit(cache=True, nogil=True)
def _word_on(
    x: float, y: float, h: float, t: float, leader: FloatArray, alpha: float, limit: float,
    t_release: float, row: FloatArray,
) -> bool:  # fmt: skip
    """The fastest extremal to the slot, from time t on, that clears.

    Args:
        x: from here on [R].
        y: the same [R].
        h: the same [rad].
        t: when [R/V_P].
        leader: table of its pieces. shape (k, 5)
        alpha: V_L/V_P.
        limit: to be kept [R].
        t_release: when the slot opens [R/V_P].
        row: one that leads on from nearby, with the word that is likely; takes it. shape (5,)

    Returns:
        whether there is one.
    """
    scratch, hint = make_scratch(), int(row[1])
    # the fastest alone is found in a third of the time, and mostly clears
    if fastest(
        Pose(x - alpha * t, y, wrap(h)), alpha, max(t_release - t, 0.0), hint, scratch, row
    ) and word_clears(x, y, h, t, row, leader, alpha, limit):
        return True
    rows = np.empty((MAX_ROWS, 5))
    _, i = best_word(x, y, h, t, leader, alpha, limit, t_release, inf, rows)
    if i < 0:
        return False
    row[:] = rows[i]
    return True
