"""Other words than the soonest to a contact of a chain, or to one beside it.

Round a leader that turns who comes to a contact later may be ahead there of who came sooner; and by
another word another bearing is best. So the bearing and the word are changed together, and contacts
before it that the other word does not need are left out.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; a chain is as in `chain`.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.records import Contact, Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import BOUNDARY_ARC, chain_of, link_by
from relguide.kernels.contact.chain_refinement import fly_links, refine_chain
from relguide.kernels.contact.clear_words import word_clears
from relguide.kernels.contact.contact import contact_at, contact_exists
from relguide.kernels.contact.paths_to_contact import not_before_slot, paths_to_contact
from relguide.kernels.words.extremals import MAX_ROWS

_BESIDE = (-0.5, -0.2, 0.0, 0.2, 0.5)  # how far beside the contact [rad]
_WORTH = 1e-4  # how much sooner the chain has to be, before its bearings are moved [R/V_P]: 5 ms


@njit(cache=True, nogil=True)
def take_other_words(
    start: Pose, scene: Scene, contacts: FloatArray, count: int, here: float, stride: float,
    legs: FloatArray,
) -> tuple[float, int]:  # fmt: skip
    """Come to each contact of a chain by another word, if the chain is sooner by it.

    Args:
        start: where it begins, at t = 0.
        scene: what it has to reckon with.
        contacts: of the chain; takes those of a sooner one. shape (MAX_CONTACTS, 4)
        count: how many they are.
        here: its arrival [R/V_P].
        stride: how far bearings are moved at first [rad].
        legs: room. shape (MAX_LEGS, 6)

    Returns:
        the arrival then [R/V_P], and how many contacts there are.
    """
    k = 0
    while k < count:
        first = k
        while contacts[k, 3] != BOUNDARY_ARC and first >= 0 and not time_is_up(scene.until):
            tried = np.empty((count - k + first, 4))
            tried[:first], tried[first:] = contacts[:first], contacts[k:count]
            if _take_word(start, scene, tried, first, here, legs):
                chain = chain_of(tried, legs)
                _, time = fly_links(start, 0.0, scene, chain, 0, len(tried), inf)
                if time < here:
                    here, count = refine_chain(start, scene, chain, time, stride, here), len(tried)
                    contacts[:count] = tried
                    k = first
                    break
            first -= 1
        k += 1
    return here, count


@njit(cache=True, nogil=True)
def _take_word(
    start: Pose, scene: Scene, contacts: FloatArray, k: int, beat: float, legs: FloatArray
) -> bool:
    """Find the bearing of contact k and the word to it with which a chain is soonest.

    Whether it arrives before `beat` then; `contacts` takes them.
    """
    chain, rows = chain_of(contacts.copy(), legs), np.empty((MAX_ROWS, 5))
    tried, count, found = chain.contacts, len(contacts), False
    pose, t = fly_links(start, 0.0, scene, chain, 0, k - 1, beat)
    if t == inf:
        return False
    piece, side, bearing = int(contacts[k, 0]), contacts[k, 1], contacts[k, 2]
    best = beat - _WORTH
    for beside in _BESIDE:
        tried[k, 2] = bearing + beside
        if not contact_exists(tried[k, 2], scene.alpha):
            continue
        contact = Contact(piece, tried[k, 2], side)
        n = paths_to_contact(pose, t, scene, contact, best, rows)
        for j in range(n):
            row, tried[k, 3] = rows[j], link_by(rows[:n], j)
            at = contact_at(scene, row[0], tried[k, 2], side)
            if not_before_slot(at, row[0], scene) >= best or not word_clears(pose, t, row, scene):
                continue
            _, time = fly_links(at, row[0], scene, chain, k + 1, count, best)
            if time < best:
                best, found = time, True
                contacts[k] = tried[k]
    return found
