"""What the graph of contacts knows: labels, which are earliest arrivals at its nodes.

Nodes are contacts: a piece of the leader's intent, a side and a bearing of a grid. Round a leader
that turns who is sooner at a contact finds another one ahead than who is later, and need not be
better off; so there each node has a label of its own for words from the start, for words from other
nodes, and for boundary arcs. Where the leader turns faster than one slides, the later one is ahead,
and there may be time to spare: so three more are for the last words from the start, and for
boundary arcs and words to other nodes that begin with these.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.records import Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import WORD
from relguide.kernels.contact.nodes import IntArray, Nodes, contact_of
from relguide.kernels.words.extremals import MAX_ROWS
from relguide.kernels.words.sooner import Scratch, make_scratch

BETTER = 1e-9
"""A label must fall by more than this [R/V_P], or rounding goes round in circles."""
_FALLS = 6  # of a label on the average, at most


class Graph(NamedTuple):
    """What is kept of each label, beside its time in `Nodes`; of shape (n,) where not said."""

    nodes: int
    """How many nodes there are."""
    hops: int
    """How far the labels of words from other nodes lie behind those of words from the start …"""
    arcs: int
    """… and those of boundary arcs; 0 where each node has one label only."""
    late: int
    """And those of late words from the start …"""
    late_arcs: int
    """… of boundary arcs that begin with these …"""
    late_hops: int
    """… and of words from other nodes, likewise: those of earlier ones would hide them."""
    past: FloatArray
    """How labels fell, one after the other: the label; the row here of the label that leads to it,
    as that was then, −1 if the start does; how, as in `chain`; by how much the bearing changes on
    that boundary arc [rad]. shape (·, 4)"""
    used: IntArray
    """How many rows of it there are. shape (1,)"""
    now: IntArray
    """The row of `past` by which it fell last."""
    arrival: FloatArray
    """Of the fastest path found by way of it, at the slot [R/V_P] …"""
    by: IntArray
    """… and its row of `past` then."""
    onward: FloatArray
    """How long the path to the slot takes at least, on the final leg, where that is the same at any
    time; 0 on other legs, infinite where no contact exists, NaN until words from nodes are looked
    for [R/V_P]. shape (nodes,)"""
    toward: IntArray
    """The words that may lead to each node, as in `passing`, once `onward` is known. shape
    (nodes,)"""
    hopped: FloatArray
    """The label with which words from it were last looked for."""
    delayed: FloatArray
    """The label with which a delay path from it was last looked for."""
    fresh: FloatArray
    """1 if its label has fallen since its way on was last looked at."""
    pending: FloatArray
    """1 if its label has fallen since a boundary arc from it was last flown."""
    rows: FloatArray
    """Room for words. shape (MAX_ROWS, 5)"""
    scratch: Scratch
    """Room for the fastest word."""


class Effort(NamedTuple):
    """How closely the graph is searched."""

    width: float
    """From one bearing that has not been looked at before to the next [rad]."""
    hops: int
    """From how many nodes words to other nodes are looked for, in each round …"""
    late: int
    """… and from how many that begin with late words."""
    delays: int
    """How many nodes are left by a delay path at most."""
    beside: float
    """Nodes this close lead to the same places: of those one is followed in a round [rad]."""


@njit(cache=True, nogil=True)
def labels_of(nodes: Nodes, copies: int) -> Nodes:
    """As many labels of each node, one behind the other; those of the first are the nodes' own."""
    count = len(nodes.time)
    size = count * copies
    rings, sides, bearings = np.empty(size, np.int64), np.empty(size), np.empty(size)
    known = np.full((4, size), inf)
    known[2] = 0.0
    for k in range(copies):
        begin, end = k * count, (k + 1) * count
        rings[begin:end], sides[begin:end] = nodes.rings, nodes.sides
        bearings[begin:end] = nodes.bearings
    known[0, :count], known[1, :count] = nodes.time, nodes.lower
    known[2, :count], known[3, :count] = nodes.latest, nodes.arrival
    if copies > 1:
        begin, end = 3 * count, 4 * count
        known[0, begin:end], known[1, begin:end] = nodes.ahead[:, 0], nodes.ahead[:, 1]
    return Nodes(
        nodes.first, rings, sides, bearings, known[0], known[1], known[2], known[3], nodes.ahead
    )


@njit(cache=True, nogil=True)
def start_graph(scene: Scene, nodes: Nodes, count: int, beat: float) -> Graph:
    """The graph of labels that only the start leads to; `count` of them are of different nodes."""
    size = len(nodes.bearings)
    behind = count if size > count else 0
    past = np.empty((_FALLS * size, 4))
    for n in range(size):
        past[n, 0], past[n, 1], past[n, 2], past[n, 3] = n, -1.0, WORD, 0.0
    graph = Graph(
        count, behind, 2 * behind, 3 * behind, 4 * behind, 5 * behind, past, np.array([size]),
        np.arange(size), np.full(size, inf), np.arange(size), np.full(count, np.nan),
        np.zeros(count, np.int64), np.full(size, inf), np.full(size, inf), np.zeros(size),
        np.zeros(size), np.empty((MAX_ROWS, 5)), make_scratch(),
    )  # fmt: skip
    for n in range(size):
        if nodes.lower[n] < beat:
            graph.pending[n] = 1.0
    if behind > 0:
        for node in range(count):
            if nodes.ahead[node, 0] < inf:
                past[graph.late + node, 2] = nodes.ahead[node, 2]
    return graph


@njit(cache=True, nogil=True)
def _is_settled(scene: Scene, nodes: Nodes, n: int, t: float) -> bool:
    """Whether nothing depends on time any more at a contact."""
    return contact_of(nodes, n).piece + 1 == len(scene.leader) and t >= scene.t_release


@njit(cache=True, nogil=True)
def label_to_beat(scene: Scene, nodes: Nodes, graph: Graph, n: int, t: float) -> float:
    """The time that a label must fall below [R/V_P], if it is to fall to about t.

    Where nothing depends on time, that is the least of its node's.
    """
    if not _is_settled(scene, nodes, n, t):
        return float(nodes.time[n] - BETTER)
    least = inf
    for m in range(n % graph.nodes, len(nodes.time), graph.nodes):
        least = min(least, nodes.time[m])
    return least - BETTER


@njit(cache=True, nogil=True)
def take_label(
    nodes: Nodes, graph: Graph, m: int, t: float, n: int, link: float, slid: float
) -> bool:
    """Let label m fall to t, led to by label n as that is now; `link` and `slid` as in `past`.

    What has been reached from m before keeps the way that it came. False if there is no room.
    """
    row = graph.used[0]
    if row == len(graph.past):
        return False
    past = graph.past[row]
    past[0], past[1], past[2], past[3] = m, graph.now[n], link, slid
    graph.used[0], graph.now[m] = row + 1, row
    nodes.time[m], graph.fresh[m] = t, 1.0
    return True
