"""A graph of contacts with d = d_min: earliest arrivals by words between them and slides along it.

Words lead from the start to a node (see `one_contact`), from node to node (`graph_words`), and on
to the slot (`graph_ends`); boundary arcs lead from a node to its neighbour (`graph_arcs`). Labels
are earliest arrivals (`graph_labels`), and chains are read from them backward (`graph_chains`). A
label from which even the best path without the limit would come too late is not followed, so where
one contact is enough there is little to do here.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf

from numba import njit

from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.records import Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.graph_arcs import slide_on
from relguide.kernels.contact.graph_chains import collect_chains
from relguide.kernels.contact.graph_ends import (
    NEARLY,
    delay_by_straights,
    delay_to_release,
    go_to_slot,
)
from relguide.kernels.contact.graph_labels import Effort, labels_of, start_graph
from relguide.kernels.contact.graph_words import hop
from relguide.kernels.contact.nodes import BoolArray, Nodes

_ROUNDS = 4  # of hops, with boundary arcs before and after: chains with up to three hops


@njit(cache=True, nogil=True)
def best_chains(
    scene: Scene, nodes: Nodes, fresh: BoolArray, beat: float, effort: Effort, delays: bool,
    chains: FloatArray,
) -> int:  # fmt: skip
    """The best chains of two contacts or more on the grid, best first.

    Args:
        scene: what a path has to reckon with.
        nodes: the contacts, from `one_contact.scan_contacts`; their labels fall.
        fresh: chains of others alone are left out. shape (n,)
        beat: an arrival already known [R/V_P].
        effort: how closely it is searched.
        delays: whether paths that arrive at t_release itself, by a delay, are looked for.
        chains: takes the chains: a row with their arrival and number of contacts, then rows as in
            `chain.Chain`. One that arrives at t_release itself needs a delay behind its last
            contact. shape (·, MAX_CONTACTS + 1, 4)

    Returns:
        how many.
    """
    copies = 1 if len(scene.leader) == 1 else 6
    labels = labels_of(nodes, copies)
    graph = start_graph(scene, labels, len(nodes.time), beat + NEARLY)
    best, tries, end = beat, effort.delays, -1
    if delays and scene.t_release < beat:
        end = delay_by_straights(scene, nodes)
    for turn in range(_ROUNDS):
        # where delays are looked for, before boundary arcs too: these come to a contact sooner,
        # but then there may be no delay that keeps clear
        for slides in range(0 if delays else 1, 2):
            if end >= 0:
                break
            if slides == 1:
                slide_on(scene, labels, graph, best + NEARLY)
            best = go_to_slot(scene, labels, graph, best)
            if delays and labels.lower.min() <= scene.t_release < best:
                end, tries = delay_to_release(scene, labels, graph, tries)
        if end >= 0:
            # what arrives as the slot opens cannot be beaten
            graph.arrival[:] = inf
            graph.arrival[end] = best = scene.t_release
            graph.by[end] = graph.now[end]
            break
        if turn == _ROUNDS - 1 or time_is_up(scene.until):
            break
        hop(scene, labels, graph, best, effort)
        graph.pending[:] = graph.fresh
        if not graph.pending.any():
            break
    for n in range(graph.nodes):
        nodes.lower[n] = labels.lower[n :: graph.nodes].min()
    return collect_chains(labels, fresh, graph, best + NEARLY, chains)
