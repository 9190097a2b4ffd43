"""Behind leaders who turn, where the limit binds: what begins again from the best chain."""

import numpy as np
import pytest

from benchmarks import draws
from relguide import Situation
from tests.relguide.planning.test_path_round_turning_leader import sound_plan


def drawn(seed: int, case: int) -> Situation:
    """A situation near a leader that turns; every third slot lies at the limit."""
    rng = np.random.default_rng([seed, case])
    return draws.active(rng, tight=case % 2 == 0, intent=True, slot_at_limit=case % 3 == 0)


@pytest.mark.parametrize(
    ("seed", "case", "best"), [(6001, 1981, 419.9), (4001, 417, 160.4), (4001, 957, 375.9)]
)
def test_the_start_is_left_straight_for_a_boundary_arc(seed: int, case: int, best: float) -> None:
    """Another word led to a contact there sooner; they came 17.3, 9.1 and 4.1 s later."""
    assert sound_plan(drawn(seed, case)).time_to_converge < best


@pytest.mark.parametrize(("case", "best"), [(678, 312.3), (1650, 478.3)])
def test_the_chain_goes_on_at_a_later_contact(case: int, best: float) -> None:
    """Its first two contacts were in the way; they came 0.5 and 0.8 s later."""
    assert sound_plan(drawn(6001, case)).time_to_converge < best


@pytest.mark.parametrize(("case", "best"), [(1434, 530.12), (1941, 511.3)])
def test_a_boundary_arc_lasts_until_the_leader_goes_on(case: int, best: float) -> None:
    """Just there the leader's turn ends, and with it the arc; they came 0.2 and 2.6 s later."""
    assert sound_plan(drawn(6001, case)).time_to_converge < best


def test_a_straight_from_far_away_touches() -> None:
    """It takes 22 R/V_P, and the touch was not solved for; the plan came 34 s later."""
    assert sound_plan(drawn(3002, 1149)).time_to_converge < 1345.4


@pytest.mark.parametrize(("seed", "case", "best"), [(6002, 133, 367.6), (6001, 1596, 687.5)])
def test_a_contact_beside_is_reached_by_another_word(seed: int, case: int, best: float) -> None:
    """Neither the bearing nor the word alone was better; they came 8.7 and 0.5 s later."""
    assert sound_plan(drawn(seed, case)).time_to_converge < best


@pytest.mark.parametrize(("seed", "case", "best"), [(7305, 601, 277.2), (7303, 204, 242.6)])
def test_another_chain_is_best_once_begun_again(seed: int, case: int, best: float) -> None:
    """Refined where it is, it is not the soonest one; they came 3.9 and 0.4 s later."""
    assert sound_plan(drawn(seed, case)).time_to_converge < best
