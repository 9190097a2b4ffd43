"""Reverse dynamic programming: the tree of regular trajectories, grown back from the slot. Fig. 3.

Order by order, every pair (±ε, kΔθ, hΔl) is laid back from every state that the order before has
made the best of its cell; what keeps d_min and reaches a cell sooner than anything before becomes
that cell's state. Straights are tested in closed form, turns as the arcs they are.

Paper: section 3 ends by saying that dynamic programming works forward only, because of the
    separation; section 4 then does it in reverse. With a leader that keeps straight the latter is
    right: in its frame the state is Markov and the disc does not move. Section 4 calls what comes
    out minimum-time trajectories; it is *a* path from each cell, the fastest found.

A child's heading is its parent's changed by kΔθ. So the work is dealt out by the child's heading:
no two threads write one cell, and the tree does not depend on how many there are, nor on where it
was interrupted.
"""

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from os import cpu_count

import numpy as np

from relguide.kernels.base.records import straight_scene
from relguide.kernels.tree.reverse import Cells, Mesh, Nodes, compass, expand, settle
from relguide.learn.tree.tree import Floats, Ints, RegularTree, TreeParameters

BLOCK = 2048
"""Parents expanded between two reports: a tenth of a second or so."""
NONE = -1
"""No parent, no node."""
CELL_COLUMNS = ("best_time", "best", "origin", "pair")
"""Fields of `Growth` that have a value for each cell."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Growth:
    """A tree still growing, at a moment when it may be saved.

    Its arrays of cells are written on when the next one is asked for.
    """

    parameters: TreeParameters
    order: int
    """The order being grown, or grown whole."""
    next: int
    """How many of `latest` have been expanded."""
    laid: int
    """As in `RegularTree`."""
    close: int
    """As in `RegularTree`."""
    states: Floats
    """x, y, time of every node [R, R/V_P]. shape (n, 3)"""
    headings: Ints
    """Heading of every node in Δθ. shape (n,)"""
    parents: Ints
    """Parent of every node. shape (n,)"""
    pairs: Ints
    """First pair of every node: h, k, ε, mirrored. shape (n, 4)"""
    latest: Ints
    """The nodes to expand: those the order before has made the best of a cell."""
    best_time: Floats
    """Least time of each cell [R/V_P]. shape (headings, cells_x, cells_y)"""
    best: Ints
    """Node of least time of each cell as the order before left it."""
    origin: Ints
    """Parent of what has improved a cell at this order, −1 where nothing has."""
    pair: Ints
    """First pair of it. shape (headings, cells_x, cells_y, 4)"""

    @property
    def finished(self) -> bool:
        """Whether the tree is whole."""
        return self.order >= self.parameters.order


def plant(parameters: TreeParameters) -> Growth:
    """The tree of order 1: the slot alone."""
    shape = parameters.shape
    best_time, best = np.full(shape, np.inf), np.full(shape, NONE, np.int32)
    at_slot = 0, int(-parameters.x_low / parameters.cell), 0
    best_time[at_slot], best[at_slot] = 0.0, 0
    return Growth(
        parameters=parameters,
        order=1,
        next=0,
        laid=0,
        close=0,
        states=np.zeros((1, 3)),
        headings=np.zeros(1, np.int32),
        parents=np.full(1, NONE, np.int32),
        pairs=np.zeros((1, 4), np.int32),
        latest=np.zeros(1, np.int32),
        best_time=best_time,
        best=best,
        origin=np.full(shape, NONE, np.int32),
        pair=np.zeros((*shape, 4), np.int32),
    )


def grow_order(growth: Growth, *, threads: int | None = None) -> Iterator[Growth]:
    """Grow a tree by one order, reporting after every block of states.

    Args:
        growth: where to begin, whether at the start of an order or within one.
        threads: how many; all cores if left out.
    """
    parameters = growth.parameters
    encounter = parameters.encounter
    radius = encounter.turn_radius
    table = compass(parameters.headings)
    turns = growth.pairs[:, 2] * (1 - 2 * growth.pairs[:, 3])
    turns[growth.pairs[:, 1] == 0] = 0
    nodes = Nodes(growth.states, growth.headings, turns)
    scene = straight_scene(
        encounter.speed_ratio,
        encounter.slot_distance / radius,
        encounter.min_separation / radius,
    )
    mesh = Mesh(
        horizon=parameters.horizon * encounter.pursuer_tas / radius,
        delta_l=parameters.delta_l / radius,
        cell=parameters.cell / radius,
        x_low=parameters.x_low / radius,
        nx=parameters.cells_x,
        ny=parameters.cells_y,
    )
    cells = Cells(growth.best_time, growth.origin, growth.pair)

    def work(parents: Ints, heading: int) -> tuple[int, int]:
        laid, close = expand(parents, nodes, table, heading, scene, mesh, cells)
        return int(laid), int(close)

    # a heading and its mirror image, N − it, go together
    headings = range(parameters.headings // 2 + 1)
    with ThreadPoolExecutor(threads or cpu_count() or 1) as pool:
        while growth.next < len(growth.latest):
            parents = growth.latest[growth.next : growth.next + BLOCK]
            counts = list(pool.map(lambda heading: work(parents, heading), headings))  # noqa: B023
            growth = replace(
                growth,
                next=growth.next + len(parents),
                laid=growth.laid + sum(laid for laid, _ in counts),
                close=growth.close + sum(close for _, close in counts),
            )
            if growth.next < len(growth.latest):
                yield growth
    yield _settle(growth, nodes)


def _settle(growth: Growth, nodes: Nodes) -> Growth:
    """What has improved a cell becomes a node, in the order of the cells."""
    parameters = growth.parameters
    improved = np.flatnonzero(growth.origin.ravel() != NONE)
    first = len(growth.states)
    parents = growth.origin.ravel()[improved]
    pairs = growth.pair.reshape(-1, 4)[improved]
    states, headings = settle(
        parents,
        pairs,
        nodes,
        compass(parameters.headings),
        parameters.encounter.speed_ratio,
        parameters.delta_l / parameters.encounter.turn_radius,
    )
    numbers = np.arange(first, first + len(improved), dtype=np.int32)
    growth.best.ravel()[improved] = numbers
    growth.origin.fill(NONE)
    return replace(
        growth,
        order=growth.order + 1,
        next=0,
        states=np.concatenate((growth.states, states)),
        headings=np.concatenate((growth.headings, headings)),
        parents=np.concatenate((growth.parents, parents)),
        pairs=np.concatenate((growth.pairs, pairs)),
        # a straight before a straight is one straight, which its parent's own children have
        latest=numbers[pairs[:, 1] > 0],
    )


def tree_from(growth: Growth, provenance: dict[str, str]) -> RegularTree:
    """The tree as others use it, in SI.

    Args:
        growth: finished.
        provenance: who made it, with what and when.
    """
    encounter = growth.parameters.encounter
    radius = encounter.turn_radius
    return RegularTree(
        parameters=growth.parameters,
        laid=growth.laid,
        close=growth.close,
        provenance=provenance,
        x=growth.states[:, 0] * radius,
        y=growth.states[:, 1] * radius,
        heading_number=growth.headings,
        time=growth.states[:, 2] * (radius / encounter.pursuer_tas),
        parent=growth.parents,
        length_number=growth.pairs[:, 0].copy(),
        angle_number=growth.pairs[:, 1].copy(),
        turn=growth.pairs[:, 2].copy(),
        mirrored=growth.pairs[:, 3].copy(),
        best=growth.best,
    )


def reverse_tree(parameters: TreeParameters, *, threads: int | None = None) -> RegularTree:
    """Grow a tree at one go, for programs; the command shows its progress and may be resumed."""
    growth = plant(parameters)
    while not growth.finished:
        *_, growth = grow_order(growth, threads=threads)
    return tree_from(growth, {})
