"""Boundary arcs in a chain of contacts: one after a contact, or in place of a hop along a side.

A graph of contacts often hops where it would better slide, since its arcs begin and end at nodes
of the grid. Units and frame as in `neighbourhoods`.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import BOUNDARY_ARC, MAX_CONTACTS, Chain, chain_of
from relguide.kernels.contact.chain_refinement import Move, fly_links, move_bearing, refine_chain
from relguide.kernels.contact.contact import boundary_arc_sense, disc_on
from relguide.kernels.contact.neighbourhoods import LATER, SHORT, STILL_LATER, WORTH, Task

_ROUNDS = 4  # so many arcs at most
_LONG = 0.5  # arcs are begun so long, or `SHORT` [rad]


@njit(cache=True, nogil=True)
def add_boundary_arcs(
    task: Task, contacts: FloatArray, count: int, here: float
) -> tuple[float, int]:
    """Put boundary arcs into a chain as long as it is sooner by it.

    Args:
        task: what it is flown for.
        contacts: of the chain; takes those of a sooner one. shape (MAX_CONTACTS, 4)
        count: how many they are.
        here: its arrival [R/V_P].

    Returns:
        the arrival then [R/V_P], and how many contacts there are.
    """
    for _ in range(_ROUNDS):
        found, n = _with_one_more_arc(task, contacts, count, here)
        if n == 0:
            break
        here, count = found, n
    return here, count


@njit(cache=True, nogil=True)
def _with_one_more_arc(
    task: Task, contacts: FloatArray, count: int, here: float
) -> tuple[float, int]:
    """As `add_boundary_arcs`, the best with one more; 0 contacts if none is sooner."""
    scene, legs = task.scene, task.legs
    best, n, won = here, 0, np.empty((MAX_CONTACTS, 4))
    for k in range(count):
        slides_on = k + 1 < count and contacts[k + 1, 3] == BOUNDARY_ARC
        if k + 1 < count and not slides_on and contacts[k, 1] == contacts[k + 1, 1]:
            tried = contacts[:count].copy()
            tried[k + 1, 3] = BOUNDARY_ARC
            time = _with_arc(task, chain_of(tried, legs), k + 1, best)
            if time < best - WORTH:
                best, n = time, count
                won[:count] = tried
        if slides_on or count == MAX_CONTACTS:
            continue
        piece = int(contacts[k, 0])
        for on in range(piece, min(piece + 2, len(scene.leader))):
            sense = boundary_arc_sense(contacts[k, 2], disc_on(scene, on, contacts[k, 1]))
            for angle in (SHORT, _LONG):
                if sense == 0.0 or time_is_up(scene.until):
                    break
                tried = np.empty((count + 1, 4))
                tried[: k + 1], tried[k + 2 :] = contacts[: k + 1], contacts[k + 1 : count]
                tried[k + 1, 0], tried[k + 1, 1] = on, contacts[k, 1]
                tried[k + 1, 2], tried[k + 1, 3] = contacts[k, 2] + sense * angle, BOUNDARY_ARC
                time = _with_arc(task, chain_of(tried, legs), k + 1, best)
                if time < best - WORTH:
                    best, n = time, count + 1
                    won[: count + 1] = tried
    if n > 0:
        contacts[:n] = won[:n]
    return best, n


@njit(cache=True, nogil=True)
def _with_arc(task: Task, chain: Chain, k: int, beat: float) -> float:
    """The arrival of a chain once its bearings have been moved, that of the arc's end k first.

    Infinite if it is far later, or still later with this one moved.
    """
    start, scene, stride, _ = task
    last = len(chain.contacts)
    at, t = fly_links(start, 0.0, scene, chain, 0, k - 1, inf)
    _, here = fly_links(at, t, scene, chain, k, last, beat + LATER)
    if here == inf:
        return inf
    here, _ = move_bearing(at, t, scene, chain, Move(k, last, stride, 0.1 * stride), here)
    if here > beat + STILL_LATER:
        return inf
    return refine_chain(start, scene, chain, here, stride, beat)
