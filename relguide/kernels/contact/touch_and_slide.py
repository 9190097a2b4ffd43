"""Straights that touch the disc, and a boundary arc from there, put into a chain.

The straight leaves the start, a contact, or a boundary arc; the chain goes on at any later contact.
Units and frame as in `neighbourhoods`.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap_signed
from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.records import Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import (
    BOUNDARY_ARC,
    LEFT_TO_TOUCH,
    MAX_CONTACTS,
    RIGHT_TO_TOUCH,
    chain_of,
)
from relguide.kernels.contact.chain_refinement import fly_links, refine_chain
from relguide.kernels.contact.contact import (
    boundary_arc_rates,
    boundary_arc_sense,
    contact_at,
    disc_on,
    slide_within,
)
from relguide.kernels.contact.neighbourhoods import LATE, MOMENT, WORTH, Task
from relguide.kernels.contact.paths_to_contact import not_before_slot
from relguide.kernels.contact.tangent import MAX_TANGENTS, straight_touches
from relguide.kernels.separation.clearance import piece_at, piece_end

_ROUNDS = 3  # so many changes at most
_STEP = 0.2  # from one end of a new boundary arc to the next, in time [R/V_P]
_APART = 0.4  # from one place where a boundary arc is left to the next, in time [R/V_P]
_MOST = 40  # places along a boundary arc


@njit(cache=True, nogil=True)
def slide_from_touches(
    task: Task, contacts: FloatArray, count: int, here: float
) -> tuple[float, int]:
    """Put straights that touch, and boundary arcs, into a chain as long as it is sooner by it.

    Arguments and result as of `more_arcs.add_boundary_arcs`; there may be no contacts yet.
    """
    scene = task.scene
    for _ in range(_ROUNDS):
        before, k = here, -1
        while k < count and not time_is_up(scene.until):
            left = contacts[: k + 1].copy()
            pose, t = fly_links(task.start, 0.0, scene, chain_of(left, task.legs), 0, k, inf)
            if t >= here or not_before_slot(pose, t, scene) >= here - WORTH:
                break
            here, count = _touch_after(task, contacts, count, left, k + 1, here)
            if 0 <= k < count - 1 and contacts[k + 1, 3] == BOUNDARY_ARC:
                here, count = _touch_from_arc(task, contacts, count, k, t, here)
            k += 1
        if here > before - WORTH:
            break
    return here, count


@njit(cache=True, nogil=True)
def _touch_from_arc(
    task: Task, contacts: FloatArray, count: int, k: int, t: float, here: float
) -> tuple[float, int]:
    """As `slide_from_touches`, by one straight from the boundary arc begun at contact k, at t."""
    places, begun, end = np.empty((_MOST, 3)), contacts[k, 2], contacts[k + 1].copy()
    for place in places[: _places_along(task.scene, t, begun, end[1], _APART, places)]:
        beyond = (end[2] - place[1]) * (end[2] - begun) <= 0.0
        if beyond and place[0] >= end[0]:
            break
        left = contacts[: k + 2].copy()
        left[k + 1, 0], left[k + 1, 2] = place[0], place[1]
        time, n = _touch_after(task, contacts, count, left, k + 2, here)
        if time < here:
            return time, n
    return here, count


@njit(cache=True, nogil=True)
def _touch_after(
    task: Task, contacts: FloatArray, count: int, left: FloatArray, after: int, here: float
) -> tuple[float, int]:
    """As `slide_from_touches`, by one straight from the end of another chain, `left`.

    The chain goes on at contact `after`, a later one, or the slot.
    """
    start, scene, stride, legs = task
    n, leader = len(left), scene.leader
    pose, t = fly_links(start, 0.0, scene, chain_of(left.copy(), legs), 0, n - 1, inf)
    if t == inf:
        return here, count
    touches, whole = np.empty((MAX_TANGENTS, 3)), np.empty((MAX_CONTACTS, 4))
    best, won, length = here, np.empty((MAX_CONTACTS, 4)), 0
    whole[:n] = left
    for piece in range(piece_at(leader, t), len(leader)):
        for link in (LEFT_TO_TOUCH, RIGHT_TO_TOUCH):
            turn = 1.0 if link == LEFT_TO_TOUCH else -1.0
            for touch in touches[: straight_touches(pose, t, scene, piece, turn, touches)]:
                if touch[2] < MOMENT or n + 2 > MAX_CONTACTS or time_is_up(scene.until):
                    continue
                bearing, side = touch[0], touch[1]
                if n > 0 and side == left[n - 1, 1]:
                    bearing = left[n - 1, 2] + wrap_signed(bearing - left[n - 1, 2])
                there = contact_at(scene, t + touch[2], bearing, side)
                if not_before_slot(there, t + touch[2], scene) >= best - WORTH:
                    continue
                whole[n, 0], whole[n, 1], whole[n, 2], whole[n, 3] = piece, side, bearing, link
                chain = chain_of(whole[: n + 1], legs)
                _, met = fly_links(pose, t, scene, chain, n, n, best)
                if met == inf:
                    continue
                size = _slide_on(scene, met, contacts[after:count], whole, n, best, legs)
                if size == 0:
                    continue
                chain = chain_of(whole[:size], legs)
                _, time = fly_links(start, 0.0, scene, chain, 0, size, inf)
                if time < inf:
                    time = refine_chain(start, scene, chain, time, stride, best)
                if time < best - WORTH:
                    best, length = time, size
                    won[:size] = whole[:size]
    if length == 0:
        return here, count
    contacts[:length] = won[:length]
    return best, length


@njit(cache=True, nogil=True)
def _slide_on(
    scene: Scene, t: float, onward: FloatArray, whole: FloatArray, n: int, beat: float,
    legs: FloatArray,
) -> int:  # fmt: skip
    """Slide on from a contact, and go on from where that is best.

    Args:
        scene: what the path has to reckon with.
        t: when it is at the contact [R/V_P].
        onward: contacts at one of which it may go on, if not at the slot. shape (·, 4)
        whole: a chain; takes the end of the boundary arc and the contacts after that.
        n: number of the contact in it.
        beat: an arrival already known [R/V_P].
        legs: room. shape (MAX_LEGS, 6)

    Returns:
        how many contacts the chain has; 0 if it arrives far later.
    """
    places, count, side = np.empty((_MOST, 3)), len(onward), whole[n, 1]
    along = places[: _places_along(scene, t, whole[n, 2], side, _STEP, places)]
    best, size = beat + LATE, 0
    for j in range(count + 1):
        if (j < count and onward[j, 3] == BOUNDARY_ARC) or n + 2 + count - j > MAX_CONTACTS:
            continue
        rest = chain_of(onward[j:].copy(), legs)
        for place in along:
            if place[2] >= best:
                break
            pose = contact_at(scene, place[2], place[1], side)
            if not_before_slot(pose, place[2], scene) >= best:
                continue
            _, time = fly_links(pose, place[2], scene, rest, 0, count - j, best)
            if time < best:
                best, size = time, n + 2 + count - j
                whole[n + 1, 0], whole[n + 1, 1] = place[0], side
                whole[n + 1, 2], whole[n + 1, 3] = place[1], BOUNDARY_ARC
                whole[n + 2 : size] = onward[j:]
    return size


@njit(cache=True, nogil=True)
def _places_along(
    scene: Scene, t: float, bearing: float, side: float, step: float, places: FloatArray
) -> int:
    """Places along a boundary arc: the leader's piece, the bearing and the time; how many.

    The bearing is not wrapped. Just before the leader begins another piece there is one more.
    """
    leader = scene.leader
    i, n = piece_at(leader, t), 0
    while n < len(places):
        disc = disc_on(scene, i, side)
        sense = boundary_arc_sense(bearing, disc)
        if sense == 0.0:
            break
        left = min(step, piece_end(leader, i) - t)
        if left > 0.0:
            to, took = slide_within(bearing, bearing + sense * TWO_PI, disc, left)
            if took == inf or took < left:
                break
            bearing, t = to, t + left
            places[n, 0], places[n, 1], places[n, 2] = i, bearing, t
            if left < step:
                # there, but for rounding
                back = min(MOMENT, left)
                places[n, 1] -= back * boundary_arc_rates(bearing, disc)[0]
                places[n, 2] -= back
            n += 1
        if left < step:
            i += 1
            t = leader[i, 0]
    return n
