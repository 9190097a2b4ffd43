"""area_words(network): where on a map one word alone need be solved, by the branch network.

The network is asked at every few nodes of the map's grid. Between four of them that hold one and
the same word possible, and nothing else, that word alone is solved. Where they differ, where one of
them is not sure or outside the box the network was trained in, all words are solved: so next to the
lines at which the word changes, times are exact, and so are the lines.

A path of the word that is solved can be flown and keeps d_min, whatever the network thinks; if it
does not keep d_min, all words are solved. But a patch of another word that lies between the nodes
asked is missed: nothing proves a time found this way the least. On grids of 160 × 120 nodes round
40 leaders at random, 70 % of the nodes were left to one word, and 2 of 768,000 times were later
than the exact ones, by 1.1 s at most.
"""

import numpy as np
from numpy.typing import NDArray

from relguide.kernels.networks.only_branch import only_words
from relguide.learn.words.branch_network import BranchNetwork
from relguide.maps.isochrones import Grid, Words
from relguide.planning.situation import Situation
from relguide.planning.slot import slot_frame

EVERY = 8
"""The network is asked at every eighth column and row. An answer of its costs as much as four exact
times, so asked everywhere it would cost more than it saves."""

Bytes = NDArray[np.int8]
Floats = NDArray[np.float64]


def area_words(network: BranchNetwork, situation: Situation, grid: Grid) -> Words:
    """Ask a network for a situation's map.

    Args:
        network: of branches.
        situation: all but the pursuer's place counts.
        grid: of the map.
    """
    x, y = (_sparse_nodes(axis) for axis in grid.axes)
    blocks = _blocks(_words_at_nodes(network, situation, x, y))

    def words(east: Floats, north: Floats) -> Bytes:
        column = np.clip(np.searchsorted(x, east) - 1, 0, len(x) - 2)
        row = np.clip(np.searchsorted(y, north) - 1, 0, len(y) - 2)
        found: Bytes = blocks[row, column]
        return found

    return words


def _sparse_nodes(axis: Floats) -> Floats:
    """Every so many nodes of an axis, its two ends among them."""
    return np.linspace(axis[0], axis[-1], max(2, -(-(len(axis) - 1) // EVERY) + 1))


def _words_at_nodes(network: BranchNetwork, situation: Situation, x: Floats, y: Floats) -> Bytes:
    """The only word at each of the nodes, −1 where there are more. (rows, columns)."""
    frame = slot_frame(situation, situation.leader.trajectory)
    east, north = (axis.ravel() for axis in np.meshgrid(x, y))
    situations = np.empty((len(east), 4))
    situations[:, 0], situations[:, 1] = frame.to_slot(east, north)  # type: ignore[arg-type]
    situations[:, 2], situations[:, 3] = frame.h, frame.alpha
    found = np.full(len(east), -1, np.int8)
    box = network.box
    if box.min_ratio <= frame.alpha <= box.max_ratio:
        inside = np.hypot(situations[:, 0], situations[:, 1]) <= box.max_range
        asked = np.empty(int(inside.sum()), np.int8)
        only_words(situations[inside], network.layers, network.least_share, asked)
        found[inside] = asked
    return found.reshape(len(y), len(x))


def _blocks(nodes: Bytes) -> Bytes:
    """Between four nodes: their word if it is the same, else −1."""
    corners = np.stack((nodes[:-1, :-1], nodes[1:, :-1], nodes[:-1, 1:], nodes[1:, 1:]))
    same = (corners == corners[0]).all(axis=0)
    return np.where(same, corners[0], -1).astype(np.int8)
