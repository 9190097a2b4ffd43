"""A chain begun again a few degrees away, as long as it is sooner by it.

With one bearing or two moved, with a contact on the leader's piece before or after, with another
word, or with a straight that touches behind a contact. Units and frame as in `neighbourhoods`.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.records import Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import (
    BOUNDARY_ARC,
    LEFT_TO_TOUCH,
    MAX_CONTACTS,
    NAMED,
    RIGHT_TO_TOUCH,
    Chain,
    chain_of,
)
from relguide.kernels.contact.chain_refinement import Move, fly_links, move_bearing, refine_chain
from relguide.kernels.contact.contact import boundary_arc_sense, disc_on
from relguide.kernels.contact.neighbourhoods import (
    LATE,
    LATER,
    MOMENT,
    SHORT,
    STILL_LATER,
    WORTH,
    Task,
)
from relguide.kernels.contact.nodes import IntArray
from relguide.kernels.contact.tangent import MAX_TANGENTS, straight_touches
from relguide.kernels.words.extremals import WORDS

_ROUNDS = 2  # so many over all contacts and changes at most
_SWEEPS = 4  # over all bearings, roughly
_LITTLE = 1e-3  # ends them [R/V_P]
_NO_LATER = 1e-6  # so much may be lost if there is one bearing less to be moved [R/V_P]: 50 µs
_TOWARD_START, _TOWARD_END = 0, 8  # changes of the piece
_SLIDING = 7  # and a boundary arc over a contact
_MOVED = (0, 1, 1, 2, 2, 1, 1, 0, 0, 1, 1, 2, 2)  # how many bearings the others move,
_BY = (0.0, -0.1, 0.1, -0.1, 0.1, -0.35, 0.35, 0.0, 0.0, -0.2, 0.2, -0.2, 0.2)  # how far [rad]
_BESIDE = (0.0, -0.1, 0.1, -0.2, 0.2)  # where a straight is begun that touches the disc [rad]
_BY_WORD = len(_MOVED)  # and, one for each word, that this one leads to it
_CHANGES = _BY_WORD + len(WORDS)


@njit(cache=True, nogil=True)
def search_nearby(
    task: Task, contacts: FloatArray, count: int, here: float, effort: int
) -> tuple[float, int]:
    """Begin a chain again from nearby, as long as it is sooner by it.

    Arguments and result as of `more_arcs.add_boundary_arcs`; `effort` says how many chains are
    refined: the sum of the squares of their contacts.
    """
    tried, left = np.empty((MAX_CONTACTS, 4)), np.array([effort])
    for _ in range(_ROUNDS):
        before = here
        for k in range(count):
            here = _touch_straight(task, contacts[:count], k, here)
        for change in range(_CHANGES):
            k = 0
            while k < count:
                if left[0] < 0 or time_is_up(task.scene.until):
                    return here, count
                n = _change(task.scene, contacts[:count], k, change, tried)
                if n > 0:
                    chain, known = chain_of(tried[:n], task.legs), contacts[:count]
                    time = _refined(task, chain, k, known, here, left)
                    if time < here - WORTH:
                        here, count = time, n
                        contacts[:n] = tried[:n]
                if change == _TOWARD_START:
                    here, count = _pass_touching(task, contacts, count, k, here, left)
                k += 1
        if here > before - WORTH:
            break
    return here, count


@njit(cache=True, nogil=True)
def _refined(
    task: Task, chain: Chain, k: int, known: FloatArray, beat: float, left: IntArray
) -> float:
    """The arrival of a chain, changed at contact k, once its bearings have been moved.

    Infinite if it is far later, or comes to a chain that is known.
    """
    start, scene, stride, _ = task
    contacts = chain.contacts
    last = len(contacts)
    _, here = fly_links(start, 0.0, scene, chain, 0, last, beat + LATER)
    if here == inf:
        return inf
    left[0] -= last * last
    for sweep in range(1 + _SWEEPS):
        before = here
        # at first what is beside the change alone: mostly that shows that it is in vain
        for j in range(last):
            if contacts[j, 3] >= LEFT_TO_TOUCH or (sweep == 0 and abs(j - k) > 1):
                continue
            at, t = fly_links(start, 0.0, scene, chain, 0, j - 1, inf)
            here, _ = move_bearing(at, t, scene, chain, Move(j, last, stride, 0.3 * stride), here)
        if sweep == 0:
            if here > beat + LATE:
                return inf
            continue
        if before - here < _LITTLE:
            break
        if here - 2.0 * (before - here) > beat:
            return inf
    if here > beat + STILL_LATER:
        return inf
    if last == len(known):
        same = True
        for j in range(last):
            apart = abs(contacts[j, 2] - known[j, 2])
            same = same and apart < stride and contacts[j, 0] == known[j, 0]
            same = same and contacts[j, 3] == known[j, 3]
        if same:
            return inf
    return refine_chain(start, scene, chain, here, 0.3 * stride, beat)


@njit(cache=True, nogil=True)
def _change(scene: Scene, contacts: FloatArray, k: int, change: int, tried: FloatArray) -> int:
    """Change a chain at contact k; `tried` takes it. How many contacts; 0 if it cannot be."""
    count = len(contacts)
    tried[:count] = contacts
    if change == _SLIDING:
        if k + 2 >= count or contacts[k, 1] != contacts[k + 2, 1]:
            return 0
        tried[k + 1 : count - 1] = contacts[k + 2 :]
        tried[k + 1, 3] = BOUNDARY_ARC
        return count - 1
    if change in (_TOWARD_START, _TOWARD_END):
        tried[k, 0] += 1.0 if change == _TOWARD_END else -1.0
        return count if 0.0 <= tried[k, 0] < len(scene.leader) else 0
    if change >= _BY_WORD:
        link = NAMED + (change - _BY_WORD)
        tried[k, 3] = link
        by_word = contacts[k, 3] != BOUNDARY_ARC and contacts[k, 3] < LEFT_TO_TOUCH
        return count if by_word and link != contacts[k, 3] else 0
    moved = _MOVED[change]
    if k + moved > count:
        return 0
    tried[k : k + moved, 2] += _BY[change]
    return count


@njit(cache=True, nogil=True)
def _pass_touching(
    task: Task, contacts: FloatArray, count: int, k: int, here: float, left: IntArray
) -> tuple[float, int]:
    """Put a straight that touches the disc, and slides on, behind contact k or one beside it."""
    scene, legs = task.scene, task.legs
    slides_on = k + 1 < count and contacts[k + 1, 3] == BOUNDARY_ARC
    more = 1 if slides_on else 2
    if count + more > MAX_CONTACTS:
        return here, count
    touches, last = np.empty((MAX_TANGENTS, 3)), len(scene.leader) - 1
    for shift in _BESIDE:
        tried = np.empty((count + more, 4))
        tried[: k + 1], tried[k + 1 + more :] = contacts[: k + 1], contacts[k + 1 : count]
        tried[k, 2] += shift
        before = chain_of(tried[: k + 1], legs)
        at, t = fly_links(task.start, 0.0, scene, before, 0, k, here)
        if t == inf:
            continue
        first = int(contacts[k, 0])
        pieces = int(contacts[k + 1, 0]) if slides_on else first
        for piece in range(first, min(pieces, last) + 1):
            for turn in (LEFT_TO_TOUCH, RIGHT_TO_TOUCH):
                sense = 1.0 if turn == LEFT_TO_TOUCH else -1.0
                for touch in touches[: straight_touches(at, t, scene, piece, sense, touches)]:
                    ahead = wrap_signed(touch[0] - tried[k, 2])
                    if touch[1] != contacts[k, 1] or touch[2] < MOMENT or time_is_up(scene.until):
                        continue
                    chain = chain_of(tried.copy(), legs)
                    new = chain.contacts[k + 1]
                    new[0], new[1], new[2], new[3] = piece, touch[1], tried[k, 2] + ahead, turn
                    if slides_on:
                        chain.contacts[k + 2] = contacts[k + 1]
                    else:
                        disc = disc_on(scene, piece, touch[1])
                        chain.contacts[k + 2] = new
                        chain.contacts[k + 2, 2] += SHORT * boundary_arc_sense(new[2], disc)
                        chain.contacts[k + 2, 3] = BOUNDARY_ARC
                    time = _refined(task, chain, k, contacts[:count], here, left)
                    if time < here - WORTH:
                        contacts[: count + more] = chain.contacts
                        return time, count + more
    return here, count


@njit(cache=True, nogil=True)
def _touch_straight(task: Task, contacts: FloatArray, k: int, here: float) -> float:
    """Come to a boundary arc, begun at contact k, by a straight instead, if that is no later.

    Returns the arrival then [R/V_P].
    """
    start, scene, stride, legs = task
    count = len(contacts)
    if k + 1 == count or contacts[k + 1, 3] != BOUNDARY_ARC:
        return here
    if contacts[k, 3] == BOUNDARY_ARC or contacts[k, 3] >= LEFT_TO_TOUCH:
        return here
    for turn in (LEFT_TO_TOUCH, RIGHT_TO_TOUCH):
        tried = contacts.copy()
        tried[k, 3] = turn
        chain = chain_of(tried, legs)
        _, time = fly_links(start, 0.0, scene, chain, 0, count, here + LATER)
        if time < inf:
            time = refine_chain(start, scene, chain, time, stride, here)
        if time < here + _NO_LATER:
            contacts[:], here = tried, time
    return here
