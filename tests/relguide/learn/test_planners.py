"""Planners by name: one list for the command line, the service and its settings."""

import pytest

from relguide import Plan, plan
from relguide.learn.planners import PLANNERS, SERVING, make_planner
from tests.plans import straight_behind


@pytest.mark.parametrize("name", PLANNERS)
def test_plans_carry_the_name_their_planner_is_chosen_by(name: str) -> None:
    answer = make_planner(name)(straight_behind())
    assert isinstance(answer, Plan)
    assert answer.planner == ("exact" if answer.fell_back else name)
    assert PLANNERS[name].description


def test_the_exact_planner_is_plan_itself() -> None:
    assert make_planner("exact") is plan
    assert SERVING == ("exact", "network")


def test_a_name_that_is_none_is_refused_with_the_names_there_are() -> None:
    with pytest.raises(ValueError, match="must be exact or network or regular_dp, not 'oracle'"):
        make_planner("oracle")
