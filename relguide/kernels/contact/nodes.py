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

_BESIDE = 1e-6  # how far beside a tangent contact is looked: 1 cm at R = 12 km


class Nodes(NamedTuple):
    """Contacts, ring by ring, and what is known of each."""

    size: int
    """How many make a ring."""
    sides: FloatArray
    """As in `Contact`. shape (n,)"""
    bearings: FloatArray
    """As in `Contact`, ascending in each ring [rad]. shape (n,)"""
    time: FloatArray
    """When it is reached first; infinite where that does not matter [R/V_P]. shape (n,)"""
    lower: FloatArray
    """No path by way of that arrives at the slot before this; t_release where it could be reached
    sooner [R/V_P]. shape (n,)"""
    arrival: FloatArray
    """Of the fastest path found through it; infinite if that is far too late [R/V_P]. shape (n,)"""


@njit(cache=True, nogil=True)
def contact_of(nodes: Nodes, n: int) -> Contact:
    """The contact of a node."""
    return Contact(n // (2 * nodes.size), nodes.bearings[n], nodes.sides[n])


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
    sides, placed = np.empty(rings * size), np.empty(rings * size)
    for ring in range(rings):
        for n in range(sizes[ring], size):
            own[ring, n] = TWO_PI * (n - sizes[ring] + 0.5) / bearings
        sides[ring * size : (ring + 1) * size] = _side_of(ring)
        placed[ring * size : (ring + 1) * size] = np.sort(own[ring, :size])
    count = rings * size
    return Nodes(size, sides, placed, np.full(count, inf), np.full(count, inf), np.full(count, inf))


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
