"""Boundary arcs put into a chain of contacts round a leader that turns.

There a graph of contacts often hops along the disc where it would better slide: a boundary arc that
begins at a node of the grid ends at a node, and which way it moves may change with the leader's
turn. So in the best chain one is begun after each contact, or put in place of each hop along one
side, and whatever is sooner then, once its bearings have been moved, is kept.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; a chain is as in `chain`.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import BOUNDARY_ARC, MAX_CONTACTS, Chain, chain_of
from relguide.kernels.contact.chain_refinement import (
    Move,
    fly_links,
    move_bearing,
    refine_chain,
)
from relguide.kernels.contact.contact import boundary_arc_sense, disc_on

_LATER = 0.3  # a chain that is so much later at first is not refined [R/V_P] …
_STILL_LATER = 0.03  # … nor one that is so much later with the end of its new arc moved [R/V_P]
_WORTH = 1e-4  # how much sooner it has to be [R/V_P]: 5 ms
_ROUNDS = 4  # so many changes at most
_SHORT, _LONG = 0.05, 0.5  # boundary arcs as they are begun [rad]


@njit(cache=True, nogil=True)
def add_boundary_arcs(
    start: Pose, scene: Scene, contacts: FloatArray, count: int, here: float, stride: float,
    legs: FloatArray,
) -> tuple[float, int]:  # fmt: skip
    """Put boundary arcs into a chain as long as it is sooner by it.

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
    for _ in range(_ROUNDS):
        found, n = _with_one_more(start, scene, contacts, count, here, stride, legs)
        if n == 0:
            break
        here, count = found, n
    return here, count


@njit(cache=True, nogil=True)
def _with_one_more(
    start: Pose, scene: Scene, contacts: FloatArray, count: int, here: float, stride: float,
    legs: FloatArray,
) -> tuple[float, int]:  # fmt: skip
    """As `add_boundary_arcs`, the best with one more; 0 contacts if none is sooner."""
    best, n, won = here, 0, np.empty((MAX_CONTACTS, 4))
    for k in range(count):
        slides_on = k + 1 < count and contacts[k + 1, 3] == BOUNDARY_ARC
        if k + 1 < count and not slides_on and contacts[k, 1] == contacts[k + 1, 1]:
            tried = contacts[:count].copy()
            tried[k + 1, 3] = BOUNDARY_ARC
            time = _refined(start, scene, chain_of(tried, legs), k + 1, best, stride)
            if time < best - _WORTH:
                best, n = time, count
                won[:count] = tried
        if slides_on or count == MAX_CONTACTS:
            continue
        piece = int(contacts[k, 0])
        for on in range(piece, min(piece + 2, len(scene.leader))):
            sense = boundary_arc_sense(contacts[k, 2], disc_on(scene, on, contacts[k, 1]))
            for angle in (_SHORT, _LONG):
                if sense == 0.0 or time_is_up(scene.until):
                    break
                tried = np.empty((count + 1, 4))
                tried[: k + 1], tried[k + 2 :] = contacts[: k + 1], contacts[k + 1 : count]
                tried[k + 1, 0], tried[k + 1, 1] = on, contacts[k, 1]
                tried[k + 1, 2], tried[k + 1, 3] = contacts[k, 2] + sense * angle, BOUNDARY_ARC
                time = _refined(start, scene, chain_of(tried, legs), k + 1, best, stride)
                if time < best - _WORTH:
                    best, n = time, count + 1
                    won[: count + 1] = tried
    if n > 0:
        contacts[:n] = won[:n]
    return best, n


@njit(cache=True, nogil=True)
def _refined(start: Pose, scene: Scene, chain: Chain, k: int, beat: float, stride: float) -> float:
    """The arrival of a chain once its bearings have been moved, that of contact k first.

    Infinite if it is far later, or still later with this one moved.
    """
    last = len(chain.contacts)
    at, t = fly_links(start, 0.0, scene, chain, 0, k - 1, inf)
    _, here = fly_links(at, t, scene, chain, k, last, beat + _LATER)
    if here == inf:
        return inf
    here, _ = move_bearing(at, t, scene, chain, Move(k, last, stride, 0.1 * stride), here)
    if here > beat + _STILL_LATER:
        return inf
    return refine_chain(start, scene, chain, here, stride, beat)
