"""Boundary arcs from node to node of the graph of contacts.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf

from numba import njit

from relguide.kernels.base.angles import wrap
from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.records import Scene
from relguide.kernels.contact.chain import BOUNDARY_ARC
from relguide.kernels.contact.contact import (
    boundary_arc_sense,
    contact_at,
    disc_on,
    slide_within,
    slides_back,
)
from relguide.kernels.contact.graph_labels import BETTER, Graph, label_to_beat, take_label
from relguide.kernels.contact.nodes import Nodes, contact_of
from relguide.kernels.contact.paths_to_contact import not_before_slot
from relguide.kernels.separation.clearance import piece_at, piece_end


@njit(cache=True, nogil=True)
def slide_on(scene: Scene, nodes: Nodes, graph: Graph, beat: float) -> None:
    """Fly boundary arcs from node to node, wherever a label falls by it."""
    time, pending = nodes.time, graph.pending
    while True:
        # in order of time: a label that was taken does not fall again
        n = -1
        for m in range(len(time)):
            if pending[m] == 1.0 and (n < 0 or time[m] < time[n]):
                n = m
        if n < 0 or time_is_up(scene.until):
            break
        pending[n] = 0.0
        m, t, goal = _slide_to_next(scene, nodes, n)
        late = 0 < graph.late <= n
        m += graph.late_arcs if late else graph.arcs
        if late and t < inf and slides_back(scene, contact_of(nodes, m)):
            # who is later is ahead
            if time[m] < inf and t <= time[m] + BETTER:
                continue
        elif t >= label_to_beat(scene, nodes, graph, m, t):
            continue
        there = contact_at(scene, t, nodes.bearings[m], nodes.sides[m])
        if not_before_slot(there, t, scene) >= beat:
            continue
        if take_label(nodes, graph, m, t, n, BOUNDARY_ARC, goal - nodes.bearings[n]):
            pending[m] = 1.0


@njit(cache=True, nogil=True)
def _slide_to_next(scene: Scene, nodes: Nodes, n: int) -> tuple[int, float, float]:
    """The node that a boundary arc from node n comes to first, when, and its bearing unwrapped.

    The time is infinite if it cannot be flown. The leader may have gone on to another piece
    meanwhile.
    """
    leader, t = scene.leader, nodes.time[n]
    side, bearing = nodes.sides[n], nodes.bearings[n]
    i = piece_at(leader, t)
    for _ in range(len(leader)):
        ring = 2 * i + (0 if side > 0.0 else 1)
        disc = disc_on(scene, i, side)
        sense = boundary_arc_sense(bearing, disc)
        if sense == 0.0:
            break
        m, gap = -1, inf
        for j in range(nodes.first[ring], nodes.first[ring + 1]):
            ahead = wrap(sense * (nodes.bearings[j] - bearing))
            if 1e-9 < ahead < gap:
                m, gap = j, ahead
        left = piece_end(leader, i) - t
        goal = bearing + sense * gap
        bearing, took = slide_within(bearing, goal, disc, left)
        if took == inf:
            break
        t += took
        if bearing == goal:
            return m, t, goal
        i += 1
    return 0, inf, 0.0
