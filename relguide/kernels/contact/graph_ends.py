"""From nodes of the graph of contacts to the slot: at once, or just as it opens.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf

import numpy as np
from numba import njit

from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.records import Scene
from relguide.kernels.contact.clear_delay import delay_until_release, delays_by_straights
from relguide.kernels.contact.clear_words import first_clear, to_slot_frame
from relguide.kernels.contact.contact import contact_at
from relguide.kernels.contact.graph_labels import Graph
from relguide.kernels.contact.nodes import Nodes
from relguide.kernels.words.delay import DELAY_PIECES
from relguide.kernels.words.extremals import solve

NEARLY = 0.07
"""Chains on the grid that arrive this much later are kept, to be refined [R/V_P]."""
_MEANWHILE = 0.3  # labels of a contact that differ by less lead to the same delays [R/V_P]


@njit(cache=True, nogil=True)
def go_to_slot(scene: Scene, nodes: Nodes, graph: Graph, best: float) -> float:
    """Find the way on to the slot from every node whose label has fallen; the least arrival."""
    for n in range(len(nodes.time)):
        if graph.fresh[n] == 0.0:
            continue
        if time_is_up(scene.until):
            break
        graph.fresh[n] = 0.0
        t = nodes.time[n]
        pose = contact_at(scene, t, nodes.bearings[n], nodes.sides[n])
        count = solve(to_slot_frame(pose, t, scene.alpha), scene.alpha, 0.0, graph.rows)
        nodes.lower[n] = inf
        if count > 0:
            nodes.lower[n] = max(t + graph.rows[0, 0], scene.t_release)
            arrival, _ = first_clear(pose, t, graph.rows[:count], scene, best + NEARLY)
            # who is sooner at a contact may be later at the slot
            if arrival < graph.arrival[n]:
                graph.arrival[n], graph.by[n] = arrival, graph.now[n]
                best = min(best, arrival)
    return best


@njit(cache=True, nogil=True)
def delay_by_straights(scene: Scene, nodes: Nodes) -> int:
    """As `delay_to_release`, from nodes as the start leads to them, at its soonest and its latest.

    With two turns at most.
    """
    for n in np.argsort(nodes.time):
        soonest, latest = nodes.time[n], nodes.latest[n]
        if latest == 0.0 or time_is_up(scene.until):
            continue
        for t in (soonest, latest):
            if (t == latest or nodes.lower[n] == scene.t_release) and delays_by_straights(
                contact_at(scene, t, nodes.bearings[n], nodes.sides[n]), t, scene
            ):
                return int(n)
    return -1


@njit(cache=True, nogil=True)
def delay_to_release(scene: Scene, nodes: Nodes, graph: Graph, tries: int) -> tuple[int, int]:
    """A node from which a path that keeps d_min arrives just as the slot opens; tries left.

    −1 if none is found.
    """
    time, delayed = nodes.time, graph.delayed
    pieces = np.empty((DELAY_PIECES, 2))
    while tries > 0:
        n = -1
        for m in range(len(time)):
            if (
                nodes.lower[m] <= scene.t_release
                and time[m] < delayed[m]
                and (n < 0 or time[m] < time[n])
            ):
                n = m
        if n < 0 or time_is_up(scene.until):
            break
        # who is at the same contact at about that time finds no other
        for m in range(n % graph.nodes, len(time), graph.nodes):
            if abs(time[m] - time[n]) < _MEANWHILE:
                delayed[m] = time[m]
        tries -= 1
        pose = contact_at(scene, time[n], nodes.bearings[n], nodes.sides[n])
        if delay_until_release(pose, time[n], scene, pieces):
            return n, tries
    return -1, tries
