"""The pieces that are flown of a constrained path: turns, straights, the arcs of boundary arcs.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise. What comes out is in metres.
"""

import numpy as np
from numba import njit

from relguide.kernels.base.records import Contact, Pose, Scene, with_limit, with_release
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.boundary_arc import (
    MAX_NODES,
    boundary_arc_arrival,
    boundary_arc_pieces,
)
from relguide.kernels.contact.chain import BOUNDARY_ARC, DELAY
from relguide.kernels.contact.clear_delay import delay_until_contact, delay_until_release
from relguide.kernels.contact.clear_words import best_word_near
from relguide.kernels.contact.contact import GRAZE, contact_on
from relguide.kernels.words.delay import DELAY_PIECES
from relguide.kernels.words.extremals import SIGNS, fly_piece

NO_TURN = 1e-9
"""A turn below this is rounding [rad]; likewise a straight, in R."""
SAME = 2e-4
"""Flown in pieces a path takes as long as it did when it was found, to this [R/V_P]: some ms."""
EARLY = 1e-5
"""Along a boundary arc a path may be in the slot so long before it opens [R/V_P]: 0.5 ms."""
_UNLIKE = 2.0  # no ε: what follows a boundary arc is no part of it


@njit(cache=True, nogil=True)
def pieces_of(
    pose: Pose, scene: Scene, radius: float, mirror: float, time: float, legs: FloatArray
) -> FloatArray:
    """The pieces of a path; its last word is solved anew from where the boundary arcs really end.

    What is only rounding is left out. Two pieces that meet in a contact may be one turn, or one
    straight.

    Args:
        pose: where the path begins, at t = 0.
        scene: what it has to reckon with.
        radius: R [m].
        mirror: +1, or −1 for the mirror image of what is flown here.
        time: when the path arrives as it was found [R/V_P].
        legs: as `chain_refinement.fly_links` gives them. shape (n, 6)

    Returns:
        a column for each piece: 0 for a turn or a straight; for an arc of a boundary arc the number
        of its leg, negative if it goes clockwise round the leader. Then ε (+1 left, 0 straight), or
        the arc's curvature, positive to the right [1/m]; then turn angle [rad] or length [m]. No
        columns if no word leads on from where the last boundary arc ends, or none as soon.
        shape (3, pieces)
    """
    boundary_arcs = 0
    for k in range(len(legs)):
        boundary_arcs += legs[k, 0] == BOUNDARY_ARC
    pieces = np.empty((3, 3 * len(legs) + DELAY_PIECES + 2 * MAX_NODES * boundary_arcs))
    arcs = np.empty((2 * MAX_NODES if boundary_arcs > 0 else 0, 2))
    # what has been found keeps d_min, and arrives in the open slot, but for rounding
    eased = with_limit(scene, scene.d_min - GRAZE)
    early = with_release(eased, scene.t_release - EARLY)
    row = np.empty(5)
    n, t, planned, last = 0, 0.0, 0.0, _UNLIKE
    for k in range(len(legs)):
        if legs[k, 0] == BOUNDARY_ARC:
            side = legs[k, 1]
            count, pose, t = boundary_arc_pieces(pose, t, planned, scene, legs[k], arcs)
            planned = boundary_arc_arrival(
                scene, planned, legs[k, 2], legs[k, 3], side, int(legs[k, 4])
            )
            for i in range(count):
                pieces[0, n] = mirror * side * (k + 1.0)
                # counter-clockwise rates become curvatures positive to the right
                pieces[1, n], pieces[2, n] = -mirror * arcs[i, 1] / radius, arcs[i, 0] * radius
                n += 1
            last = _UNLIKE
            continue
        if legs[k, 0] == DELAY:
            delay = np.empty((DELAY_PIECES, 2))
            if k + 1 == len(legs):
                found = delay_until_release(pose, t, eased, delay)
            else:
                contact, planned = Contact(int(legs[k, 1]), legs[k, 3], legs[k, 2]), legs[k, 4]
                there = contact_on(eased, contact, planned)
                found = delay_until_contact(pose, t, eased, there, planned, delay)
            if not found:
                return pieces[:, :0]
            signs, amounts = delay[:, 0], delay[:, 1]
        else:
            row[:] = legs[k, 1:6]
            planned += legs[k, 1]
            # a boundary arc's last node lies within rounding of the limit and of its time: it must
            # not cost the best word
            if boundary_arcs > 0 and k + 1 == len(legs) and not best_word_near(pose, t, early, row):
                return pieces[:, :0]
            signs, amounts = SIGNS[int(row[1])], row[2:5]
        for i in range(len(signs)):
            sign, amount = signs[i], amounts[i]
            pose = fly_piece(pose, sign, amount)
            t += amount
            if amount <= NO_TURN:
                continue
            amount *= radius if sign == 0.0 else 1.0
            if sign == last:
                pieces[2, n - 1] += amount
                continue
            pieces[0, n], pieces[1, n], pieces[2, n] = 0.0, mirror * sign, amount
            n += 1
            last = sign
    return pieces[:, :n] if t <= time + SAME else pieces[:, :0]
