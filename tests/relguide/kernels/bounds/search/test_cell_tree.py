"""Across which side cells of contacts are cut follows what cuts have gained."""

from math import inf, pi

import numpy as np
import pytest

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.search.cell_tree import (
    Tree,
    begin_cuts,
    cuts_times,
    halve,
    learn_cut,
    learn_gain,
    length_of,
    plant,
)

D_MIN = 0.8
HALF = 0.1


def where_it_changes(cuts: FloatArray, spare: bool) -> float:
    """The window of time, half of it as a radian weighs it, from which on it is the one cut."""
    spans = np.linspace(0.0, 2.0, 2_001)
    cut = [cuts_times(cuts, spare, HALF, float(span), D_MIN) for span in spans]
    first = cut.index(True)
    assert not any(cut[:first])
    assert all(cut[first:])
    return float(length_of(float(spans[first]), D_MIN)) / HALF


def test_times_are_cut_sooner_where_a_word_leads_to_the_contact() -> None:
    """There each bearing has its time, and cells that hold two words are told apart by it."""
    cuts = begin_cuts()
    assert where_it_changes(cuts, False) == pytest.approx(0.5, abs=0.01)
    assert where_it_changes(cuts, True) == pytest.approx(1.0, abs=0.01)


def test_a_window_of_time_without_an_end_is_not_cut() -> None:
    assert not cuts_times(begin_cuts(), False, 1e-9, inf, D_MIN)


@pytest.mark.parametrize("spare", [False, True])
@pytest.mark.parametrize("times", [False, True])
def test_what_gains_more_is_done_sooner_within_limits(spare: bool, times: bool) -> None:
    cuts = begin_cuts()
    before, other = where_it_changes(cuts, spare), cuts[0 if spare else 1].copy()
    changes = [before]
    for _ in range(20):
        for _ in range(50):
            learn_cut(cuts, spare, times, 0.9)
            learn_cut(cuts, spare, not times, 0.3)
        changes.append(where_it_changes(cuts, spare))
    falls = np.diff(changes)
    assert np.all(falls <= 0.0 if times else falls >= 0.0)
    assert changes[-1] != before
    # in the end the other side is cut as well, once it is long enough
    assert 0.12 < changes[-1] < 8.1
    np.testing.assert_array_equal(cuts[0 if spare else 1], other)


def test_it_does_not_matter_where_both_gain_alike() -> None:
    cuts = begin_cuts()
    for _ in range(1_000):
        learn_cut(cuts, True, True, 0.6)
        learn_cut(cuts, True, False, 0.6)
    assert where_it_changes(cuts, True) == pytest.approx(1.0, abs=0.02)


def a_tree(spare: bool, end: float) -> Tree:
    tree = plant(np.array([[0.0, 1.0, pi / 8, pi / 8, 0.0, end]]), 64)
    tree.spare[:1] = spare
    return tree


@pytest.mark.parametrize("spare", [False, True])
def test_a_tree_learns_from_the_side_that_was_cut(spare: bool) -> None:
    for end, times in ((3.0, True), (0.01, False)):
        tree = a_tree(spare, end)
        half = halve(tree, 0, D_MIN)
        assert bool(tree.cells[half, 3] == tree.cells[0, 3]) == times
        learn_gain(tree, 0, 1.0)
        kept = tree.cuts[1 if spare else 0]
        assert (kept[2] > 0.0, kept[1] > 0.0) == (times, not times)


def test_a_tree_learns_nothing_where_there_was_no_choice() -> None:
    tree = a_tree(False, inf)
    halve(tree, 0, D_MIN)
    learn_gain(tree, 0, 1.0)
    np.testing.assert_array_equal(tree.cuts, begin_cuts())
