"""The chains of contacts that labels of the graph come from.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

import numpy as np
from numba import njit

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import BOUNDARY_ARC, MAX_CONTACTS
from relguide.kernels.contact.graph_labels import Graph
from relguide.kernels.contact.nodes import BoolArray, Nodes, contact_of

LATE = 2
"""So many chains are kept that begin with a late word."""


@njit(cache=True, nogil=True)
def collect_chains(
    nodes: Nodes, fresh: BoolArray, graph: Graph, beat: float, chains: FloatArray
) -> int:
    """The chains that end in the best nodes; of those alike in sides and links only the best.

    No more than `LATE` begin with a late word, which leave room for others.
    """
    kept, room = 0, np.array([len(chains) - LATE, LATE])
    trial = np.empty((MAX_CONTACTS + 1, 4))
    for end in np.argsort(graph.arrival):
        if graph.arrival[end] >= beat or kept == len(chains):
            break
        begins_late = 1 if 0 < graph.late <= end else 0
        if room[begins_late] == 0 or not _is_fresh(fresh, graph, end):
            continue
        contacts = _trace(nodes, graph, end, trial)
        if contacts > MAX_CONTACTS:
            continue
        trial[0, 0], trial[0, 1] = graph.arrival[end], contacts
        alike = False
        for k in range(kept):
            alike = alike or _are_alike(chains[k], trial)
        if not alike:
            chains[kept] = trial
            kept += 1
            room[begins_late] -= 1
    return kept


@njit(cache=True, nogil=True)
def _is_fresh(fresh: BoolArray, graph: Graph, end: int) -> bool:
    """Whether a fresh node is on the way to a node, or it is one."""
    row = int(graph.by[end])
    while row >= 0 and not fresh[int(graph.past[row, 0]) % graph.nodes]:
        row = int(graph.past[row, 1])
    return row >= 0


@njit(cache=True, nogil=True)
def _trace(nodes: Nodes, graph: Graph, end: int, chain: FloatArray) -> int:
    """The chain that leads to a node; how many contacts, or one more than there may be.

    The nodes along one boundary arc are no contacts of their own: only its end is.
    """
    path = np.empty(graph.used[0], dtype=np.int64)
    length, row = 0, graph.by[end]
    while row >= 0:
        path[length] = row
        length += 1
        row = int(graph.past[row, 1])
    contacts = 0
    for k in range(length - 1, -1, -1):
        past = graph.past[path[k]]
        contact, link = contact_of(nodes, int(past[0])), past[2]
        bearing, slides = contact.bearing, link == BOUNDARY_ARC
        if slides:
            bearing = chain[contacts, 2] + past[3]
        if not slides or chain[contacts, 3] != BOUNDARY_ARC:
            contacts += 1
            if contacts > MAX_CONTACTS:
                break
        chain[contacts, 0], chain[contacts, 1] = contact.piece, contact.side
        chain[contacts, 2] = bearing
        chain[contacts, 3] = link
    return contacts


@njit(cache=True, nogil=True)
def _are_alike(chain: FloatArray, other: FloatArray) -> bool:
    """Whether two chains have as many contacts, on the same sides and linked the same way."""
    if chain[0, 1] != other[0, 1]:
        return False
    for k in range(1, int(chain[0, 1]) + 1):
        if chain[k, 1] != other[k, 1] or chain[k, 3] != other[k, 3]:
            return False
    return True
