"""What both halves of a cell of last contacts know, the cell knows as well."""

from math import inf, pi

import numpy as np

from relguide.kernels.bounds.contact_tree import bury, halve, is_buried, learn, plant


def test_a_cell_is_buried_once_both_its_halves_are() -> None:
    tree = plant(np.array([[0.0, 1.0, pi / 8, pi / 8, 0.0, inf]]), 16)
    half = halve(tree, 0, 1.0)
    quarter = halve(tree, half, 1.0)
    tree.known[:7] = 1.0  # whatever is known is no less
    for n in (half + 1, quarter):
        bury(tree, n)
        learn(tree, half)
        learn(tree, 0)
        assert is_buried(tree, n)
        assert not is_buried(tree, half)
        assert not is_buried(tree, 0)
    bury(tree, quarter + 1)
    learn(tree, half)
    assert is_buried(tree, half)
    assert is_buried(tree, 0)


def test_nothing_is_learned_of_halves_that_have_not_been_looked_at() -> None:
    tree = plant(np.array([[0.0, 1.0, pi / 8, pi / 8, 0.0, inf]]), 16)
    half = halve(tree, 0, 1.0)
    tree.known[0] = 1.0
    bury(tree, half)
    learn(tree, 0)
    assert not is_buried(tree, 0)
