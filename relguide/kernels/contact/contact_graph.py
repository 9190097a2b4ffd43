"""A graph of contacts with d = d_min: earliest arrivals by words between them and slides along it.

Nodes are contacts: a piece of the leader's intent, a side and a bearing of a grid. Words lead from
the start to a node, from node to node, and on to the slot; boundary arcs lead from a node to its
neighbour. Labels are earliest arrivals. Round a leader that turns who is sooner at a contact finds
another one ahead than who is later, and need not be better off; so there each node has a label of
its own for words from the start, for words from other nodes, and for boundary arcs. Where the
leader turns faster than one slides, the later one is ahead: so two more are for late words from the
start, and for boundary arcs that begin with these. A label from which even the best path without
the limit would come too late is not followed, so where one contact is enough there is little to do
here.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import wrap, wrap_signed
from relguide.kernels.base.clock import time_is_up
from relguide.kernels.base.records import Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.chain import (
    BOUNDARY_ARC,
    MAX_CONTACTS,
    NAMED,
    WORD,
    earliest_contact,
)
from relguide.kernels.contact.clear_words import first_clear, to_slot_frame
from relguide.kernels.contact.contact import (
    boundary_arc_sense,
    contact_at,
    contact_exists,
    contact_on,
    disc_on,
    slide_within,
    slides_back,
)
from relguide.kernels.contact.delay_after_contact import delay_until_release, delays_by_straights
from relguide.kernels.contact.nodes import BoolArray, Nodes, contact_of
from relguide.kernels.contact.passing import words_onward
from relguide.kernels.contact.paths_to_contact import earliest_arrival, not_before_slot
from relguide.kernels.separation.clearance import piece_at
from relguide.kernels.words.delay import DELAY_PIECES
from relguide.kernels.words.extremals import MAX_ROWS, solve
from relguide.kernels.words.fastest import fastest
from relguide.kernels.words.sooner import Scratch, make_scratch

_TRIES = 8  # times the hops of a round: so many nodes are left by a delay path, 0.3 ms each
_ROUNDS = 4  # of hops, with boundary arcs before and after: chains with up to three hops
_NEARLY = 0.07  # chains on the grid that arrive this much later are kept, to be refined [R/V_P]
_MEANWHILE = 0.3  # labels of a contact that differ by less lead to the same delays [R/V_P]
_WORTH = 2e-4  # how much sooner the slot has to be in reach for it to be followed [R/V_P]: 10 ms
_BETTER = 1e-9  # a label must fall by more than this [R/V_P], or rounding goes round in circles


class _Graph(NamedTuple):
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
    """… and of boundary arcs that begin with these."""
    before: FloatArray
    """The label that leads to it; −1 if the start does."""
    link: FloatArray
    """How, as in `chain`."""
    slid: FloatArray
    """By how much the bearing changes on that boundary arc [rad]."""
    arrival: FloatArray
    """Of the fastest path found by way of it, at the slot [R/V_P]."""
    onward: FloatArray
    """How long the path to the slot takes at least, on the final leg, where that is the same at any
    time; NaN where it is not known yet, and 0 on other legs [R/V_P]. shape (nodes,)"""
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
    """From how many nodes words to other nodes are looked for, in each round."""
    beside: float
    """Nodes this close lead to the same places: of those one is followed in a round [rad]."""


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
    copies = 1 if len(scene.leader) == 1 else 5
    labels = _labels_of(nodes, copies)
    graph = _start_graph(scene, labels, len(nodes.time), beat + _NEARLY)
    best, tries, end = beat, _TRIES * effort.hops, -1
    if delays and scene.t_release < beat:
        end = _delay_by_straights(scene, nodes)
    for turn in range(_ROUNDS):
        # where delays are looked for, before boundary arcs too: these come to a contact sooner,
        # but then there may be no delay that keeps clear
        for slides in range(0 if delays else 1, 2):
            if end >= 0:
                break
            if slides == 1:
                _slide_on(scene, labels, graph, best + _NEARLY)
            best = _go_on(scene, labels, graph, best)
            if delays and labels.lower.min() <= scene.t_release < best:
                end, tries = _delay(scene, labels, graph, tries)
        if end >= 0:
            # what arrives as the slot opens cannot be beaten
            graph.arrival[:] = inf
            graph.arrival[end] = best = scene.t_release
            break
        if turn == _ROUNDS - 1 or time_is_up(scene.until):
            break
        _hop(scene, labels, graph, best, effort)
        graph.pending[:] = graph.fresh
        if not graph.pending.any():
            break
    for n in range(graph.nodes):
        nodes.lower[n] = labels.lower[n :: graph.nodes].min()
    return _collect(labels, fresh, graph, best + _NEARLY, chains)


@njit(cache=True, nogil=True)
def _labels_of(nodes: Nodes, copies: int) -> Nodes:
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
def _start_graph(scene: Scene, nodes: Nodes, count: int, beat: float) -> _Graph:
    """The graph of labels that only the start leads to; `count` of them are of different nodes."""
    size = len(nodes.bearings)
    behind = count if size > count else 0
    graph = _Graph(
        count, behind, 2 * behind, 3 * behind, 4 * behind, np.full(size, -1.0), np.full(size, WORD),
        np.zeros(size), np.full(size, inf), np.full(count, np.nan), np.full(size, inf),
        np.full(size, inf), np.zeros(size), np.zeros(size), np.empty((MAX_ROWS, 5)),
        make_scratch(),
    )  # fmt: skip
    for n in range(size):
        if nodes.lower[n] < beat:
            graph.pending[n] = 1.0
    if behind > 0:
        for node in range(count):
            if nodes.ahead[node, 0] < inf:
                graph.link[graph.late + node] = NAMED + nodes.ahead[node, 2]
        # words to other contacts do not begin late: they would hide some that begin early
        graph.hopped[graph.late :] = -inf
    return graph


@njit(cache=True, nogil=True)
def _onward_from(scene: Scene, nodes: Nodes, graph: _Graph, node: int) -> float:
    """How long the path from a node to the slot takes at least [R/V_P]; 0 where nothing is known.

    On the final leg, where it takes as long whenever it begins, it is found once.
    """
    if np.isnan(graph.onward[node]):
        final, known = len(scene.leader) - 1, 0.0
        contact = contact_of(nodes, node)
        if contact.piece == final:
            t, row = scene.leader[final, 0], graph.rows[0]
            seen = to_slot_frame(contact_on(scene, contact, t), t, scene.alpha)
            known = row[0] if fastest(seen, scene.alpha, 0.0, 0, graph.scratch, row) else inf
        graph.onward[node] = known
    return float(graph.onward[node])


@njit(cache=True, nogil=True)
def _is_settled(scene: Scene, nodes: Nodes, n: int, t: float) -> bool:
    """Whether nothing depends on time any more at a contact."""
    return contact_of(nodes, n).piece + 1 == len(scene.leader) and t >= scene.t_release


@njit(cache=True, nogil=True)
def _label_to_beat(scene: Scene, nodes: Nodes, graph: _Graph, n: int, t: float) -> float:
    """The time that a label must fall below [R/V_P], if it is to fall to about t.

    Where nothing depends on time, that is the least of its node's.
    """
    if not _is_settled(scene, nodes, n, t):
        return float(nodes.time[n] - _BETTER)
    least = inf
    for m in range(n % graph.nodes, len(nodes.time), graph.nodes):
        least = min(least, nodes.time[m])
    return least - _BETTER


@njit(cache=True, nogil=True)
def _slide_on(scene: Scene, nodes: Nodes, graph: _Graph, beat: float) -> None:
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
            if time[m] < inf and t <= time[m] + _BETTER:
                continue
        elif t >= _label_to_beat(scene, nodes, graph, m, t):
            continue
        there = contact_at(scene, t, nodes.bearings[m], nodes.sides[m])
        if not_before_slot(there, t, scene) >= beat:
            continue
        time[m], graph.before[m], graph.link[m] = t, n, BOUNDARY_ARC
        graph.slid[m] = goal - nodes.bearings[n]
        graph.fresh[m], pending[m] = 1.0, 1.0


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
        left = leader[i + 1, 0] - t if i + 1 < len(leader) else inf
        goal = bearing + sense * gap
        bearing, took = slide_within(bearing, goal, disc, left)
        if took == inf:
            break
        t += took
        if bearing == goal:
            return m, t, goal
        i += 1
    return 0, inf, 0.0


@njit(cache=True, nogil=True)
def _go_on(scene: Scene, nodes: Nodes, graph: _Graph, best: float) -> float:
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
        nodes.lower[n], graph.arrival[n] = inf, inf
        if count > 0:
            nodes.lower[n] = max(t + graph.rows[0, 0], scene.t_release)
            graph.arrival[n], _ = first_clear(pose, t, graph.rows[:count], scene, best + _NEARLY)
        best = min(best, graph.arrival[n])
    return best


@njit(cache=True, nogil=True)
def _delay_by_straights(scene: Scene, nodes: Nodes) -> int:
    """As `_delay`, from nodes as the start leads to them, as soon as it can be and as late.

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
def _delay(scene: Scene, nodes: Nodes, graph: _Graph, tries: int) -> tuple[int, int]:
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


@njit(cache=True, nogil=True)
def _hop(scene: Scene, nodes: Nodes, graph: _Graph, best: float, effort: Effort) -> None:
    """Find words from the most promising nodes to all others."""
    time, lower = nodes.time, nodes.lower
    near = np.zeros(len(time))  # nodes beside one that was followed in this round
    for _ in range(effort.hops):
        n = -1
        for m in range(len(time)):
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
def _hop_from(scene: Scene, nodes: Nodes, graph: _Graph, n: int, best: float) -> None:
    """Find words from a node to all others that may be in time."""
    time, left = nodes.time, nodes.time[n]
    pose = contact_at(scene, left, nodes.bearings[n], nodes.sides[n])
    onward = words_onward(scene, nodes.bearings[n], nodes.sides[n], left)
    for node in range(graph.nodes):
        contact, m = contact_of(nodes, node), node + graph.hops
        if node == n % graph.nodes or not contact_exists(contact.bearing, scene.alpha):
            continue
        t = earliest_arrival(pose, left, scene, contact)
        beat = _label_to_beat(scene, nodes, graph, m, t)
        if t >= beat or t >= best:
            continue
        beat = min(beat, best - _onward_from(scene, nodes, graph, node))
        if t >= beat:
            continue
        there = contact_at(scene, t, contact.bearing, contact.side)
        if not_before_slot(there, t, scene) >= best:
            continue
        if time_is_up(scene.until):
            break
        t, _ = earliest_contact(pose, left, scene, contact, onward, beat, graph.rows)
        if t < inf:
            time[m], graph.before[m], graph.link[m], graph.fresh[m] = t, n, WORD, 1.0


@njit(cache=True, nogil=True)
def _collect(nodes: Nodes, fresh: BoolArray, graph: _Graph, beat: float, chains: FloatArray) -> int:
    """The chains that end in the best nodes; of those alike in sides and links only the best."""
    kept = 0
    trial = np.empty((MAX_CONTACTS + 1, 4))
    for end in np.argsort(graph.arrival):
        if graph.arrival[end] >= beat or kept == len(chains):
            break
        if not _is_fresh(fresh, graph, end):
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
    return kept


@njit(cache=True, nogil=True)
def _is_fresh(fresh: BoolArray, graph: _Graph, end: int) -> bool:
    """Whether a fresh node is on the way to a node, or it is one."""
    n = end
    while n >= 0 and not fresh[n % graph.nodes]:
        n = int(graph.before[n])
    return n >= 0


@njit(cache=True, nogil=True)
def _trace(nodes: Nodes, graph: _Graph, end: int, chain: FloatArray) -> int:
    """The chain that leads to a node; how many contacts, or one more than there may be.

    The nodes along one boundary arc are no contacts of their own: only its end is.
    """
    path = np.empty(len(nodes.bearings), dtype=np.int64)
    length, n = 0, end
    while n >= 0:
        path[length] = n
        length += 1
        n = int(graph.before[n])
    contacts = 0
    for k in range(length - 1, -1, -1):
        n = path[k]
        contact = contact_of(nodes, n)
        bearing, slides = contact.bearing, graph.link[n] == BOUNDARY_ARC and graph.before[n] >= 0.0
        if slides:
            bearing = chain[contacts, 2] + graph.slid[n]
        if not slides or chain[contacts, 3] != BOUNDARY_ARC:
            contacts += 1
            if contacts > MAX_CONTACTS:
                break
        chain[contacts, 0], chain[contacts, 1] = contact.piece, contact.side
        chain[contacts, 2] = bearing
        chain[contacts, 3] = BOUNDARY_ARC if slides else graph.link[n]
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
