"""Chains of contacts: paths to the slot that touch d = d_min several times, or slide along it.

A chain has a row for each contact: the leader's piece, the side, the bearing, and whether a word or
a boundary arc leads to it from the contact before (the leader may go on to its next pieces
meanwhile). Between contacts the path is the earliest extremal that keeps d_min, so the arrival is a
function of the bearings alone.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.records import Contact, Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.boundary_arc import boundary_arc_arrival
from relguide.kernels.contact.contact import contact_at, contact_exists
from relguide.kernels.contact.passage import best_word, word_clears
from relguide.kernels.contact.paths_to_contact import paths_to_contact
from relguide.kernels.words.extremals import MAX_ROWS

WORD, BOUNDARY_ARC, DELAY = 0.0, 1.0, 2.0
"""How a contact is reached, or the slot: in the last case by a path of just the right length."""
MAX_CONTACTS = 8
"""Longest chain."""


class Chain(NamedTuple):
    """A chain, and room to fly it."""

    contacts: FloatArray
    """Piece, side, bearing, WORD or BOUNDARY_ARC of each contact. shape (n, 4)"""
    legs: FloatArray
    """Takes WORD and a row of `solve`, or BOUNDARY_ARC, side, first and last bearing, for each
    leg. shape (≥ n + 1, 6)"""
    rows: FloatArray
    """Room for words. shape (MAX_ROWS, 5)"""


@njit(cache=True, nogil=True)
def chain_of(contacts: FloatArray, legs: FloatArray) -> Chain:
    """A chain of these contacts that puts its legs there."""
    return Chain(contacts, legs, np.empty((MAX_ROWS, 5)))


@njit(cache=True, nogil=True)
def with_contacts(chain: Chain, contacts: FloatArray) -> Chain:
    """Other contacts, in the same room."""
    return Chain(contacts, chain.legs, chain.rows)


@njit(cache=True, nogil=True)
def earliest_contact(
    pose: Pose, t: float, scene: Scene, contact: Contact, beat: float, rows: FloatArray
) -> tuple[float, int]:
    """The earliest arrival at a contact with d_min kept on the way, and its row.

    Infinite and −1 if none arrives before `beat`.
    """
    best, at = beat, -1
    n = paths_to_contact(pose, t, scene, contact, rows)
    for k in range(n):
        if rows[k, 0] < best and word_clears(pose, t, rows[k], scene):
            best, at = rows[k, 0], k
    return (best, at) if at >= 0 else (inf, -1)


@njit(cache=True, nogil=True)
def fly_links(
    pose: Pose, t: float, scene: Scene, chain: Chain, first: int, last: int, beat: float
) -> tuple[Pose, float]:
    """Fly some links of a chain: link k leads to contact k, and one more to the slot.

    Args:
        pose: where link `first` begins.
        t: when [R/V_P].
        scene: what the path has to reckon with.
        chain: its contacts; takes the legs.
        first: link to begin with.
        last: link to end with, at most n.
        beat: arrivals from here on do not matter [R/V_P].

    Returns:
        where the last link ends, and when; the time is infinite if it cannot be flown before
        `beat`.
    """
    contacts, legs, rows = chain
    for k in range(first, min(last + 1, len(contacts))):
        side, bearing = contacts[k, 1], contacts[k, 2]
        legs[k, 0] = contacts[k, 3]
        if not contact_exists(bearing, scene.alpha):
            return pose, inf
        if contacts[k, 3] == BOUNDARY_ARC:
            begun = contacts[k - 1, 2]
            t = boundary_arc_arrival(scene, t, begun, bearing, side)
            legs[k, 1], legs[k, 2], legs[k, 3] = side, begun, bearing
            if t >= beat:
                return pose, inf
        else:
            t_start = t
            contact = Contact(int(contacts[k, 0]), bearing, side)
            t, at = earliest_contact(pose, t, scene, contact, beat, rows)
            if at < 0:
                return pose, inf
            legs[k, 1:6] = rows[at]
            legs[k, 1] = t - t_start
        pose = contact_at(scene, t, bearing, side)
    if last == len(contacts):
        legs[last, 0] = WORD
        t, at = best_word(pose, t, scene, beat, rows)
        if at >= 0:
            legs[last, 1:6] = rows[at]
    return pose, t
