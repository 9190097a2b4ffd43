"""The contacts to look at: for each piece of the leader's intent and each side a ring of bearings.

Slot frame: lengths in R, times in R/V_P, angles counter-clockwise.
"""

from math import inf
from typing import NamedTuple

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, wrap
from relguide.kernels.base.records import Contact, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.contact import boundary_arc_sense, disc_on

_CLOSER = 9  # steps to either side of the end of a run
_MOST_CLOSER = 160
_BESIDE = 1e-6  # how far beside a tangent contact is looked: 1 cm at R = 12 km


IntArray = np.ndarray[tuple[int, ...], np.dtype[np.int64]]
BoolArray = np.ndarray[tuple[int, ...], np.dtype[np.bool_]]


class Nodes(NamedTuple):
    """Contacts, ring by ring, and what is known of each."""

    first: IntArray
    """Where each ring begins, and how many contacts there are. shape (rings + 1,)"""
    rings: IntArray
    """The ring of each: one to each piece of the leader's and each side. shape (n,)"""
    sides: FloatArray
    """As in `Contact`. shape (n,)"""
    bearings: FloatArray
    """As in `Contact`, ascending in each ring [rad]. shape (n,)"""
    time: FloatArray
    """When it is reached first; infinite where that does not matter [R/V_P]. shape (n,)"""
    lower: FloatArray
    """No path by way of that arrives at the slot before this; t_release where it could be reached
    sooner [R/V_P]. shape (n,)"""
    latest: FloatArray
    """When it is reached last so that the slot could still be reached as it opens; 0 if never
    [R/V_P]. shape (n,)"""
    arrival: FloatArray
    """Of the fastest path found through it; infinite if that is far too late [R/V_P]. shape (n,)"""
    ahead: FloatArray
    """Of `Workspace.ahead`. shape (n, 3)"""


@njit(cache=True, nogil=True)
def contact_of(nodes: Nodes, n: int) -> Contact:
    """The contact of a node."""
    return Contact(nodes.rings[n] // 2, nodes.bearings[n], nodes.sides[n])


@njit(cache=True, nogil=True)
def contact_nodes(scene: Scene, bearings: int, tangents: FloatArray) -> Nodes:
    """The contacts to look at, of which nothing is known yet.

    A grid; both sides of each tangent contact, since the words that end there exist on one of them
    only; and the ends of what boundary arcs can reach.

    Args:
        scene: the leader and d_min.
        bearings: of the grid, all round.
        tangents: of `tangent.tangents`. shape (·, 4)
    """
    rings = 2 * len(scene.leader)
    own = np.empty((rings, 2 * bearings + 2 * len(tangents)))
    sizes = np.zeros(rings, dtype=np.int64)
    for ring in range(rings):
        sizes[ring] = _fill_ring(scene, ring, bearings, tangents, own[ring])
    # all rings are made alike in length: spare nodes fill the grid
    size = int(sizes.max())
    for ring in range(rings):
        for n in range(sizes[ring], size):
            own[ring, n] = TWO_PI * (n - sizes[ring] + 0.5) / bearings
        sizes[ring] = size
    return _in_rings(own, sizes)


@njit(cache=True, nogil=True)
def _in_rings(own: FloatArray, sizes: IntArray) -> Nodes:
    """Nodes of which nothing is known, from the first bearings of each row."""
    rings, count = len(sizes), sizes.sum()
    first, ring_of = np.zeros(rings + 1, np.int64), np.empty(count, np.int64)
    sides, placed = np.empty(count), np.empty(count)
    for ring in range(rings):
        begin, end = first[ring], first[ring] + sizes[ring]
        first[ring + 1] = end
        ring_of[begin:end] = ring
        sides[begin:end] = _side_of(ring)
        placed[begin:end] = np.sort(own[ring, : sizes[ring]])
    nothing = np.full((3, count), inf)
    return Nodes(
        first, ring_of, sides, placed, nothing[0], nothing[1], np.zeros(count), nothing[2],
        np.full((count, 3), inf),
    )  # fmt: skip


@njit(cache=True, nogil=True)
def neighbours(nodes: Nodes, n: int) -> tuple[int, int]:
    """The nodes before and after one in its ring."""
    first = nodes.first[nodes.rings[n]]
    size = nodes.first[nodes.rings[n] + 1] - first
    return first + (n - first - 1) % size, first + (n - first + 1) % size


@njit(cache=True, nogil=True)
def nodes_closer(nodes: Nodes, alive: BoolArray, step: float) -> tuple[Nodes, BoolArray]:
    """The same nodes, and others beside the ends of runs of those that are alive.

    What is reached between the last node of a run and the next one may be a window of its own.

    Args:
        nodes: with what is known of them.
        alive: which of them may still matter. shape (n,)
        step: from one of the others to the next [rad].

    Returns:
        all of them, and which are new.
    """
    rings = len(nodes.first) - 1
    sizes = np.diff(nodes.first)
    own = np.empty((rings, sizes.max() + _MOST_CLOSER))
    added = 0
    for ring in range(rings):
        begin, end = nodes.first[ring], nodes.first[ring + 1]
        n = end - begin
        own[ring, :n] = nodes.bearings[begin:end]
        for m in range(begin, end):
            if not alive[m]:
                continue
            before, after = neighbours(nodes, m)
            if alive[before] and alive[after]:
                continue
            for k in range(-_CLOSER, _CLOSER + 1):
                bearing = wrap(nodes.bearings[m] + step * k)
                apart = np.abs(own[ring, :n] - bearing).min()
                if k != 0 and apart > 0.5 * step and added < _MOST_CLOSER:
                    own[ring, n] = bearing
                    n += 1
                    added += 1
        sizes[ring] = n
    closer = _in_rings(own, sizes)
    fresh = np.ones(len(closer.bearings), np.bool_)
    for ring in range(rings):
        m = nodes.first[ring]
        for n in range(closer.first[ring], closer.first[ring + 1]):
            if m < nodes.first[ring + 1] and closer.bearings[n] == nodes.bearings[m]:
                closer.time[n], closer.lower[n] = nodes.time[m], nodes.lower[m]
                closer.latest[n], closer.arrival[n] = nodes.latest[m], nodes.arrival[m]
                closer.ahead[n] = nodes.ahead[m]
                fresh[n] = False
                m += 1
    return closer, fresh


@njit(cache=True, nogil=True)
def _side_of(ring: int) -> float:
    return 1.0 - 2.0 * (ring % 2)


@njit(cache=True, nogil=True)
def _fill_ring(
    scene: Scene, ring: int, bearings: int, tangents: FloatArray, own: FloatArray
) -> int:
    """The bearings of one piece and side, in no order; how many."""
    disc = disc_on(scene, ring // 2, _side_of(ring))
    n = 0
    for j in range(bearings):
        low, high = TWO_PI * j / bearings, TWO_PI * (j + 1) / bearings
        own[n] = low
        n += 1
        sense = boundary_arc_sense(low, disc)
        if sense != boundary_arc_sense(high, disc):
            for _ in range(50):
                middle = 0.5 * (low + high)
                if boundary_arc_sense(middle, disc) == sense:
                    low = middle
                else:
                    high = middle
            own[n] = low if sense != 0.0 else high
            n += 1
    for tangent in tangents:
        if tangent[1] == disc.side and tangent[3] == ring // 2:
            own[n] = wrap(tangent[0] - _BESIDE)
            own[n + 1] = wrap(tangent[0] + _BESIDE)
            n += 2
    return n
