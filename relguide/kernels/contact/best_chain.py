"""The best chain of contacts: the best ones of a graph, refined.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; a chain is as in `chain`.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.records import Pose, Scene, with_time
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.begun_nearby import search_nearby
from relguide.kernels.contact.chain import MAX_LEGS, chain_of
from relguide.kernels.contact.chain_refinement import (
    GAIN,
    fly_links,
    follow_edges,
    refine_chain,
    simplify_chain,
)
from relguide.kernels.contact.kept_chains import keep_chain
from relguide.kernels.contact.more_arcs import add_boundary_arcs
from relguide.kernels.contact.neighbourhoods import Task
from relguide.kernels.contact.other_words import take_other_words
from relguide.kernels.contact.touch_and_slide import slide_from_touches

AGAIN = 2
"""So often a chain that has become faster is begun again from nearby."""
_WORTH_AGAIN = 1e-3  # if it was by this much [R/V_P]: 50 ms
_SAME = 1e-3  # two that arrive this near to each other are taken for one [R/V_P]: 50 ms
_AT_EDGE = 0.02  # chains this near to the best are followed along edges [R/V_P]


@njit(cache=True, nogil=True)
def refine_chains(
    start: Pose,
    scene: Scene,
    chains: FloatArray,
    stride: float,
    arcs: bool,
    best: float,
    legs: FloatArray,
    spare: FloatArray,
) -> tuple[float, int]:
    """Refine the best chains of a graph.

    Args:
        start: where the path begins, at t = 0.
        scene: what it has to reckon with.
        chains: of `contact_graph.best_chains`; their bearings are moved, and the first takes the
            best one. shape (·, ·, 4)
        stride: how far is looked at first [rad].
        arcs: whether boundary arcs are put into the best one.
        best: an arrival already known [R/V_P].
        legs: takes those of the best chain. shape (MAX_LEGS, 6)
        spare: takes some of the others, of `kept_chains.no_chains`.

    Returns:
        the least arrival [R/V_P] and the number of its legs; `best` and 0 if none is earlier.
    """
    tried, given = np.zeros((MAX_LEGS, 6)), best
    won = -1
    chains[:, 0, 0] = inf
    for k in range(len(chains)):
        if k > 0 and time_is_up(scene.until):
            break
        contacts = int(chains[k, 0, 1])
        chain = chain_of(chains[k, 1 : contacts + 1], tried)
        # while the leader turns the graph may know of a later path to a contact than the earliest
        _, here = fly_links(start, 0.0, with_time(scene, inf), chain, 0, contacts, inf)
        if here == inf:
            continue
        here = refine_chain(start, scene, chain, here, stride, best)
        if here < best + _AT_EDGE:
            along = follow_edges(start, scene, chain, here, stride)
            if along < here - GAIN:
                here = refine_chain(start, scene, chain, along, 0.1 * stride, best)
        chains[k, 0, 0] = here
        if here < best - GAIN:
            best, won = here, k
    for k in range(len(chains)):
        if k != won and chains[k, 0, 0] < inf:
            keep_chain(spare, chains[k, 0, 0], chains[k, 1 : int(chains[k, 0, 1]) + 1])
    if won < 0:
        return best, 0
    contacts = int(chains[won, 0, 1])
    chains[0, 1:] = chains[won, 1:]
    best, contacts = _finished(start, scene, chains[0, 1:], contacts, best, stride, arcs)
    return _put_down(start, scene, chains[0, 1 : contacts + 1], given, legs)


@njit(cache=True, nogil=True)
def begin_again(
    start: Pose, scene: Scene, contacts: FloatArray, count: int, best: float, stride: float,
    legs: FloatArray, effort: int, begun: FloatArray,
) -> tuple[float, int]:  # fmt: skip
    """Look for a faster chain near the best one, or near another.

    By other words to its contacts, by straights that touch, and by `search_nearby`. Several chains
    often come to the same one by that: only the first of them is searched from there.

    Args:
        start: where it begins, at t = 0.
        scene: what it has to reckon with.
        contacts: of the chain; takes those of a faster one. shape (MAX_CONTACTS, 4)
        count: how many they are; none if the best path is not one of this search.
        best: its arrival [R/V_P].
        stride: how far is looked at first [rad].
        legs: takes those of a faster chain. shape (MAX_LEGS, 6)
        effort: as of `search_nearby`.
        begun: arrivals of chains that were begun again from nearby, infinite behind the last one;
            takes those of this [R/V_P].

    Returns:
        the least arrival [R/V_P] and the number of its legs; `best` and 0 if none is earlier.
    """
    task, given = Task(start, scene, stride, np.zeros((MAX_LEGS, 6))), best
    for _ in range(AGAIN):
        before = best
        best, count = take_other_words(task, contacts, count, best)
        best, count = slide_from_touches(task, contacts, count, best)
        if count == 0 or _was_begun(begun, best):
            break
        best, count = search_nearby(task, contacts, count, best, effort)
        if best > before - _WORTH_AGAIN:
            break
        best, count = _finished(start, scene, contacts, count, best, stride, True)
    return _put_down(start, scene, contacts[:count], given, legs)


@njit(cache=True, nogil=True)
def _was_begun(begun: FloatArray, arrival: float) -> bool:
    """Whether a chain that arrives then was begun again before; if not it is put down as such."""
    for k in range(len(begun)):
        if begun[k] == inf:
            begun[k] = arrival
            break
        if abs(begun[k] - arrival) < _SAME:
            return True
    return False


@njit(cache=True, nogil=True)
def _finished(
    start: Pose, scene: Scene, contacts: FloatArray, count: int, best: float, stride: float,
    arcs: bool,
) -> tuple[float, int]:  # fmt: skip
    """Leave out what a refined chain does not need, and put boundary arcs into it.

    Arguments as of `begin_again`. Returns the arrival and how many contacts there are.
    """
    room = np.zeros((MAX_LEGS, 6))
    if count > 2:
        best, count = simplify_chain(start, scene, chain_of(contacts[:count], room), best, stride)
    if arcs:
        before = best
        best, count = add_boundary_arcs(Task(start, scene, stride, room), contacts, count, best)
        if best < before and count > 2:
            chain = chain_of(contacts[:count], room)
            best, count = simplify_chain(start, scene, chain, best, stride)
    return best, count


@njit(cache=True, nogil=True)
def _put_down(
    start: Pose, scene: Scene, contacts: FloatArray, beat: float, legs: FloatArray
) -> tuple[float, int]:
    """Take down the legs of a chain, whatever the time, if it arrives before `beat`.

    Returns the arrival and how many legs it has; `beat` and 0 if it does not.
    """
    tried, count = np.zeros((MAX_LEGS, 6)), len(contacts)
    chain = chain_of(contacts, tried)
    _, time = fly_links(start, 0.0, with_time(scene, inf), chain, 0, count, inf)
    if time >= beat:
        return beat, 0
    legs[: count + 1] = tried[: count + 1]
    return time, count + 1
