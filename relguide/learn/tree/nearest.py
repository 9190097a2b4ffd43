"""nearest(lookup, situation): the path of the nearest state that the tree knows.

This is the paper's method without its network, and the baseline for whatever is learned. What it
gives leads to the slot from that state, not from the situation itself, and is certified by nobody.

States are compared by x and y in R and by the chord between their headings on the unit circle: near
by, the turn of an angle is as long as that angle in R, so both count alike.
"""

from dataclasses import dataclass

import numpy as np

from relguide.kernels.tree.point_grid import IntArray, PointGrid, nearest_points, point_grid
from relguide.learn.tree.tree import Floats, Ints, RegularTree, pairs_of, regular_from_pairs
from relguide.planning.regular import RegularTrajectory
from relguide.planning.situation import Situation
from relguide.units import Metre, Radian


@dataclass(frozen=True, slots=True, kw_only=True)
class Lookup:
    """A tree made ready to be asked."""

    tree: RegularTree
    minima: Ints
    """The nodes that are the least of their cell."""
    grid: PointGrid
    """Their states, sorted by place."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Neighbours:
    """The nearest node of each state asked for."""

    nodes: Ints
    mirrored: np.ndarray
    """Whether it is the node's mirror image that is near."""
    distance: Floats
    """How far it is in the measure of the module's docstring [R]."""


def lookup_in(tree: RegularTree) -> Lookup:
    """Make a tree ready to be asked: a second for a million cells."""
    minima = tree.minima
    if len(minima) == 0:
        raise ValueError("This tree has no state but the slot: nothing can be looked up in it.")
    points = _points(tree, tree.x[minima], tree.y[minima], tree.heading[minima])
    return Lookup(tree=tree, minima=minima, grid=point_grid(points))


def neighbours(lookup: Lookup, x: Floats, y: Floats, heading: Floats) -> Neighbours:
    """The nearest nodes of many states relative to the slot.

    Args:
        lookup: the tree.
        x: ahead of the slot [m]. shape (n,)
        y: to the left of the leader's route [m]; both sides are served.
        heading: counter-clockwise from the leader's [rad].
    """
    # the tree is on one side, but next to the route the nearest state may be on the other
    here, at_here = _nearest(lookup, x, y, heading)
    there, at_there = _nearest(lookup, x, -y, -heading)
    # where both are as near, the side the state is on decides, so that mirrors get mirrors
    mirrored = (there < here) | ((there == here) & (y < 0.0))
    return Neighbours(
        nodes=lookup.minima[np.where(mirrored, at_there, at_here)],
        mirrored=mirrored,
        distance=np.minimum(here, there),
    )


def nearest(lookup: Lookup, situation: Situation) -> RegularTrajectory:
    """The parameters of the nearest known path; `trajectory_from_regular` flies them.

    Raises:
        ValueError: if the situation belongs to another encounter than the tree.
    """
    x, y, heading = lookup.tree.parameters.encounter.place_of(situation)
    scale = situation.pursuer.turn_radius / lookup.tree.parameters.encounter.turn_radius
    near = neighbours(lookup, *(np.array([value]) for value in (x, y, heading)))
    pairs = pairs_of(lookup.tree, near.nodes)[0]
    pairs[:, 2] *= scale
    return regular_from_pairs(pairs, mirrored=bool(near.mirrored[0]))


def _nearest(lookup: Lookup, x: Floats, y: Floats, heading: Floats) -> tuple[Floats, IntArray]:
    """How far the nearest state is, and its place in `minima`."""
    distances, numbers = np.empty(len(x)), np.empty(len(x), np.int64)
    nearest_points(lookup.grid, _points(lookup.tree, x, y, heading), distances, numbers)
    return distances, numbers


def _points(
    tree: RegularTree, x: Metre | Floats, y: Metre | Floats, heading: Radian | Floats
) -> Floats:
    radius = tree.parameters.encounter.turn_radius
    return np.column_stack((x / radius, y / radius, np.cos(heading), np.sin(heading)))
