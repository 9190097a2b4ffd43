"""What is kept of hops with a cell is what they take, for whatever it is asked next."""

from math import inf, radians

import numpy as np
import pytest

from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.fronts.around import times_round, unknown_around
from relguide.kernels.bounds.hops.hop import standing
from relguide.kernels.bounds.hops.tight_contact import LONGEST, tight_excess
from relguide.kernels.bounds.search.cell_tree import (
    TIGHT_FROM,
    TIGHT_TO,
    Problem,
    Tree,
    halve,
    plant,
)
from relguide.kernels.bounds.search.round_trip import excess
from relguide.kernels.bounds.words.sets import Goal
from tests.straight_contacts import straight

HALF = 1e-3
"""Half of the cell's width [rad]."""


def asked(bearing: float, alpha: float, d_min: float) -> tuple[Problem, Tree, Scene, FloatArray]:
    """A cell on the final leg, and the same leader as if he had never turned."""
    never = straight(alpha, d_min)
    turned = np.array([[0.0, -1.0, 0.3, 0.9, 0.4], [2.0, 0.1, 1.2, 0.0, 0.0]])
    scene, table = Scene(turned, *never[1:]), times_round(never.alpha, never.d_min)
    problem = Problem(
        Pose(-9.0, 0.0, 0.0), scene, Goal(-3.0, never.alpha, False), table, 20.0, 2e-5,
        unknown_around(), np.empty((0, 5)),
    )  # fmt: skip
    return problem, plant(np.array([[1.0, 1.0, bearing, HALF, 2.0, inf]]), 16), never, table


@pytest.mark.parametrize("last", [True, False])
def test_on_the_final_leg_hops_are_as_behind_a_leader_who_never_turned(last: bool) -> None:
    bearing = radians(64.0 if last else 116.0)
    problem, tree, never, table = asked(bearing, 0.6568746823392786, 2.043434249423992)
    expected = tight_excess(never, table, standing(0, 1.0, bearing, HALF), last, 1.0, LONGEST)
    assert excess(tree, problem, 0, last, 1.0, inf) == pytest.approx(expected, abs=1e-4)
    assert expected > 0.02


def test_hops_that_must_be_shorter_are_longer_round() -> None:
    """Who has longer may come to the next contact from the other side, through what is narrow."""
    raised = 0
    for alpha in (0.7, 0.8, 0.9, 0.95):
        problem, tree, _, _ = asked(radians(95.0), alpha, 0.9 * (1.0 + alpha) ** 2)
        said = [excess(tree, problem, 0, False, 1.0, longest) for longest in (inf, 1.0, 0.5, inf)]
        assert said[0] <= said[1] + 1e-9
        assert said[1] <= said[2] + 1e-9
        # the longer are asked for again
        assert said[3] == pytest.approx(said[0], abs=1e-9)
        raised += said[1] > said[0] + 1e-6
    assert raised > 0


@pytest.mark.parametrize("last", [True, False])
def test_a_part_of_a_cell_far_from_enough_is_not_looked_at_itself(last: bool) -> None:
    """It has the excess of the cell; and where there is hope its own, which is no less."""
    problem, tree, never, _ = asked(
        radians(64.0 if last else 116.0), 0.6568746823392786, 2.043434249423992
    )
    whole = excess(tree, problem, 0, last, 1.0, 5.0)
    half = halve(tree, 0, never.d_min)
    quarter = halve(tree, half, never.d_min)
    column = TIGHT_TO if last else TIGHT_FROM
    for n in (half, quarter):
        assert excess(tree, problem, n, last, 1.0, 5.0) == whole
        assert np.isnan(tree.known[n, column])
    for n in (half, quarter):
        own = excess(tree, problem, n, last, 0.1, 5.0)
        assert tree.known[n, column] == own >= whole
    assert own > whole
    # what may take longer has not been asked for
    assert excess(tree, problem, half + 1, last, 1.0, 5.9) >= 0.0
    assert not np.isnan(tree.known[half + 1, column])
