"""Another word than the soonest to a contact of a chain, or to one beside it.

A path that comes to a contact later may be ahead there, so contacts before it are left out. Units
and frame as in `neighbourhoods`.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.records import Contact
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import BOUNDARY_ARC, chain_of, link_by
from relguide.kernels.contact.chain_refinement import fly_links, refine_chain
from relguide.kernels.contact.clear_words import word_clears
from relguide.kernels.contact.contact import contact_at, contact_exists
from relguide.kernels.contact.neighbourhoods import WORTH, Task
from relguide.kernels.contact.paths_to_contact import not_before_slot, paths_to_contact
from relguide.kernels.words.extremals import MAX_ROWS

_BESIDE = (-0.5, -0.2, 0.0, 0.2, 0.5)  # how far beside a contact words lead [rad]


@njit(cache=True, nogil=True)
def take_other_words(
    task: Task, contacts: FloatArray, count: int, here: float
) -> tuple[float, int]:
    """Come to each contact of a chain by another word, if the chain is sooner by it.

    Arguments and result as of `more_arcs.add_boundary_arcs`.
    """
    start, scene, stride, legs = task
    k = 0
    while k < count:
        first = k
        while contacts[k, 3] != BOUNDARY_ARC and first >= 0 and not time_is_up(scene.until):
            tried = np.empty((count - k + first, 4))
            tried[:first], tried[first:] = contacts[:first], contacts[k:count]
            if _take_word(task, tried, first, here):
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
def _take_word(task: Task, contacts: FloatArray, k: int, beat: float) -> bool:
    """Find the bearing of contact k and the word to it with which a chain is soonest.

    Whether it arrives before `beat` then; `contacts` takes them.
    """
    start, scene, _, legs = task
    chain, rows = chain_of(contacts.copy(), legs), np.empty((MAX_ROWS, 5))
    tried, count, found = chain.contacts, len(contacts), False
    pose, t = fly_links(start, 0.0, scene, chain, 0, k - 1, beat)
    if t == inf:
        return False
    piece, side, bearing = int(contacts[k, 0]), contacts[k, 1], contacts[k, 2]
    best = beat - WORTH
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
