"""Small trees, grown in the test that uses them."""

from functools import cache

import numpy as np

from relguide.learn.tree.reverse_dp import reverse_tree
from relguide.learn.tree.tree import RegularTree, TreeParameters, pairs_of, regular_from_pairs
from relguide.maps.area import Encounter
from relguide.planning.regular import RegularTrajectory
from relguide.units import DEG

A300 = Encounter(
    pursuer_tas=240.0,
    max_bank=25.0 * DEG,
    leader_tas=200.0,
    slot_distance=12_000.0,
    min_separation=9_260.0,
)


def parameters(
    order: int = 3,
    *,
    encounter: Encounter = A300,
    delta_theta_deg: float = 30.0,
    horizon: float = 400.0,
) -> TreeParameters:
    return TreeParameters(
        encounter=encounter,
        order=order,
        delta_theta=delta_theta_deg * DEG,
        delta_l=4_000.0,
        cell=6_000.0,
        horizon=horizon,
    )


@cache
def tree(order: int = 3) -> RegularTree:
    return reverse_tree(parameters(order))


def regular_of(tree: RegularTree, node: int) -> RegularTrajectory:
    """The path from a node to the slot in the paper's form."""
    return regular_from_pairs(pairs_of(tree, np.array([node], np.int32))[0])
