"""The best chain of contacts: the best ones of a graph, refined.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise; a chain is as in `chain`.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.records import Pose, Scene, with_time
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.added_arcs import add_boundary_arcs
from relguide.kernels.contact.chain import MAX_LEGS, chain_of, with_contacts
from relguide.kernels.contact.chain_refinement import (
    GAIN,
    fly_links,
    follow_edges,
    refine_chain,
    simplify_chain,
)

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
) -> tuple[float, int]:
    """Refine the best chains of a graph.

    Args:
        start: where the path begins, at t = 0.
        scene: what it has to reckon with.
        chains: of `contact_graph.best_chains`; their bearings are moved. shape (·, ·, 4)
        stride: how far is looked at first [rad].
        arcs: whether boundary arcs are put into the best one.
        best: an arrival already known [R/V_P].
        legs: takes those of the best chain. shape (MAX_LEGS, 6)

    Returns:
        the least arrival [R/V_P] and the number of its legs; `best` and 0 if none is earlier.
    """
    tried, given = np.zeros((MAX_LEGS, 6)), best
    won = -1
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
        if here < best - GAIN:
            best, won = here, k
    if won < 0:
        return best, 0
    contacts = int(chains[won, 0, 1])
    chain = chain_of(chains[won, 1 : contacts + 1], tried)
    if contacts > 2:
        best, contacts = simplify_chain(start, scene, chain, best, stride)
    if arcs:
        room, before = chains[won, 1:], best
        best, contacts = add_boundary_arcs(start, scene, room, contacts, best, stride, tried)
        chain = chain_of(room[:contacts], tried)
        if best < before and contacts > 2:
            best, contacts = simplify_chain(start, scene, chain, best, stride)
    shortest = with_contacts(chain, chain.contacts[:contacts])
    # what was found is put down, whatever the time
    _, time = fly_links(start, 0.0, with_time(scene, inf), shortest, 0, contacts, inf)
    if time >= given:
        return given, 0
    legs[: contacts + 1] = tried[: contacts + 1]
    return time, contacts + 1
