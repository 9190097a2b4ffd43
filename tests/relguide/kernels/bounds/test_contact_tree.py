"""What both halves of a cell of last contacts know, the cell knows as well; and what hops cost."""

from math import inf, pi, radians

import numpy as np
import pytest

from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.bounds.around import unknown_around
from relguide.kernels.bounds.contact_tree import (
    Problem,
    bury,
    excess,
    halve,
    is_buried,
    learn,
    plant,
)
from relguide.kernels.bounds.goal import Goal
from relguide.kernels.bounds.hop import standing
from relguide.kernels.bounds.round_time import times_round
from relguide.kernels.bounds.tight_contact import tight_excess
from tests.straight_contacts import straight


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


@pytest.mark.parametrize("last", [True, False])
def test_on_the_final_leg_hops_are_as_behind_a_leader_who_never_turned(last: bool) -> None:
    never = straight(0.6568746823392786, 2.043434249423992)
    turned = np.array([[0.0, -1.0, 0.3, 0.9, 0.4], [2.0, 0.1, 1.2, 0.0, 0.0]])
    scene, table = Scene(turned, *never[1:]), times_round(never.alpha, never.d_min)
    problem = Problem(
        Pose(-9.0, 0.0, 0.0), scene, Goal(-3.0, never.alpha, False), table, 20.0, 2e-5,
        unknown_around(), np.empty((0, 5)),
    )  # fmt: skip
    bearing, half = radians(64.0 if last else 116.0), 1e-3
    tree = plant(np.array([[1.0, 1.0, bearing, half, 2.0, inf]]), 16)
    expected = tight_excess(never, table, standing(0, 1.0, bearing, half), last, 1.0)
    assert excess(tree, problem, 0, last, 1.0) == pytest.approx(expected, abs=1e-4)
    assert expected > 0.02
