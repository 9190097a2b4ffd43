"""Words from node to node of the graph of contacts, from the most promising nodes first.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.records import Contact, Scene
from relguide.kernels.contact.chain import WORD, earliest_contact
from relguide.kernels.contact.clear_words import to_slot_frame
from relguide.kernels.contact.contact import contact_at, contact_exists, contact_on
from relguide.kernels.contact.graph_labels import Effort, Graph, label_to_beat, take_label
from relguide.kernels.contact.nodes import Nodes, contact_of
from relguide.kernels.contact.passing import words_onward, words_toward
from relguide.kernels.contact.paths_to_contact import earliest_arrival, not_before_slot
from relguide.kernels.contact.swept_bearings import MOST_SWEPT, may_be_swept, sweep_bearings
from relguide.kernels.separation.clearance import piece_end
from relguide.kernels.words.fastest import fastest

_WORTH = 2e-4  # how much sooner the slot has to be in reach for it to be followed [R/V_P]: 10 ms
_ALIKE = 1e-3  # labels that differ by less lead to the same places [R/V_P]: 50 ms


@njit(cache=True, nogil=True)
def hop(scene: Scene, nodes: Nodes, graph: Graph, best: float, effort: Effort) -> None:
    """Find words from the most promising nodes to all others."""
    size = len(nodes.time)
    early = graph.late if graph.late > 0 else size
    _hop_from_best(scene, nodes, graph, best, effort, 0, early, effort.hops)
    _hop_from_best(scene, nodes, graph, best, effort, early, size, effort.late)


@njit(cache=True, nogil=True)
def _hop_from_best(
    scene: Scene, nodes: Nodes, graph: Graph, best: float, effort: Effort, first: int, last: int,
    hops: int,
) -> None:  # fmt: skip
    """As `hop`, from so many of some labels."""
    time, lower = nodes.time, nodes.lower
    near = np.zeros(len(time))  # nodes beside one that was followed in this round
    for _ in range(hops):
        n = -1
        for m in range(first, last):
            if (
                near[m] == 0.0
                and lower[m] < best - _WORTH
                and time[m] < graph.hopped[m]
                and (n < 0 or lower[m] < lower[n])
            ):
                n = m
        if n < 0 or time_is_up(scene.until):
            break
        ring, of_kind = nodes.rings[n], n - n % graph.nodes
        for m in range(nodes.first[ring] + of_kind, nodes.first[ring + 1] + of_kind):
            if abs(wrap_signed(nodes.bearings[m] - nodes.bearings[n])) < effort.beside:
                near[m] = 1.0
        graph.hopped[n] = time[n]
        _hop_from(scene, nodes, graph, n, best)


@njit(cache=True, nogil=True)
def _hop_from(scene: Scene, nodes: Nodes, graph: Graph, n: int, best: float) -> None:
    """Find words from a node to all others that may be in time."""
    if np.isnan(graph.onward[0]):
        _look_onward(scene, nodes, graph)
    time, left, leader = nodes.time, nodes.time[n], scene.leader
    rings, bearings, sides, ahead = nodes.rings, nodes.bearings, nodes.sides, graph.onward
    pose = contact_at(scene, left, bearings[n], sides[n])
    onward = words_onward(scene, bearings[n], sides[n], left)
    behind = graph.late_hops if 0 < graph.late <= n else graph.hops
    swept = np.empty((MOST_SWEPT, 2))
    swept = swept[: sweep_bearings(scene, left, bearings[n], best, swept)]
    for node in range(graph.nodes):
        if node == n % graph.nodes or ahead[node] == inf:
            continue
        piece, m = rings[node] // 2, node + behind
        # what is too late for it whatever the way there need not be asked for the earliest
        in_time = min(time[m], best - ahead[node])
        begin, end = leader[piece, 0], piece_end(leader, piece)
        if max(left, begin) >= in_time or left >= end:
            continue
        in_time_there = min(in_time, end)
        if not may_be_swept(scene, swept, in_time_there - left, bearings[node]):
            continue
        contact = Contact(piece, bearings[node], sides[node])
        t = earliest_arrival(pose, left, scene, contact, in_time_there)
        if t >= in_time_there:
            continue
        beat = min(label_to_beat(scene, nodes, graph, m, t), in_time)
        if t >= beat:
            continue
        there = contact_at(scene, t, contact.bearing, contact.side)
        if not_before_slot(there, t, scene) >= best:
            continue
        if time_is_up(scene.until):
            break
        words = onward & graph.toward[node]
        t, _ = earliest_contact(pose, left, scene, contact, words, t, beat, graph.rows)
        if t == inf:
            continue
        # one that hugs the disc is a boundary arc, and would hide another that does not
        if graph.arcs == 0 or abs(t - time[node + graph.arcs]) >= _ALIKE:
            take_label(nodes, graph, m, t, n, WORD, 0.0)


@njit(cache=True, nogil=True)
def _look_onward(scene: Scene, nodes: Nodes, graph: Graph) -> None:
    """Find how long the path from each node to the slot takes at least, and words that lead to it.

    That is known on the final leg, where it takes as long whenever it begins; elsewhere it is 0
    [R/V_P].
    """
    final, row = len(scene.leader) - 1, graph.rows[0]
    t = scene.leader[final, 0]
    for node in range(graph.nodes):
        contact, known = contact_of(nodes, node), 0.0
        if not contact_exists(contact.bearing, scene.alpha):
            known = inf
        elif contact.piece == final:
            seen = to_slot_frame(contact_on(scene, contact, t), t, scene.alpha)
            known = row[0] if fastest(seen, scene.alpha, 0.0, 0, graph.scratch, row) else inf
        graph.onward[node] = known
        if known < inf:
            graph.toward[node] = words_toward(scene, contact)
