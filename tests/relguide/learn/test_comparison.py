"""Four planners on one situation: each is judged by the conditions that all plans are held to."""

from dataclasses import replace

import pytest

from relguide.flying.scenarios import fig_6
from relguide.flying.verdicts import PlannerVerdict
from relguide.learn.comparison import COMPARED, compare
from relguide.planning.outcome import NoPlan, Plan
from relguide.planning.plan import plan
from relguide.planning.situation import Situation
from relguide.units import DEG, NM
from tests.relguide.flying.guidance.beliefs import near_limit
from tests.situations import golden

TURNS = fig_6(intent_known=True).situation
STRAIGHT = replace(TURNS, leader=replace(TURNS.leader, intent=()))
LEARNT = replace(
    STRAIGHT,
    pursuer=replace(STRAIGHT.pursuer, x=-25_000.0, y=20_000.0),
    slot_distance=12_000.0,
    min_separation=9_260.0,
)
"""The encounter of the printed network, within its ten minutes."""


def verdicts(situation: Situation) -> dict[str, PlannerVerdict]:
    return {verdict.planner: verdict for verdict in compare(situation)}


def test_all_four_are_shown_in_their_order() -> None:
    assert tuple(verdict.planner for verdict in compare(STRAIGHT)) == COMPARED
    assert [v.planner for v in compare(STRAIGHT, among=["regular_dp"])] == ["regular_dp"]


def test_where_all_learners_are_at_home_they_are_as_fast_as_the_exact_plan() -> None:
    found = verdicts(STRAIGHT)
    best = plan(STRAIGHT)
    assert isinstance(best, Plan)
    for name in ("exact", "network", "regular_dp"):
        assert found[name].status == "planned"
        assert found[name].word == best.word == "RSL"
        assert found[name].time_to_converge == pytest.approx(best.time_to_converge, abs=0.1)
        assert found[name].compute > 0.0
        assert found[name].segments
    assert found["exact"].message == "Nothing is faster."
    assert found["network"].message == "Certified; as fast as the exact plan."


def test_the_printed_network_says_where_it_ends_and_what_it_did_not_learn() -> None:
    """At home it ends beside the slot; elsewhere it says as well that it learnt another one."""
    home = verdicts(LEARNT)["printed_network"]
    assert home.status == "refused"
    assert home.message.startswith("Not flown: it ends ")
    assert "it learnt" not in home.message
    assert home.segments
    assert home.time_to_converge > 0.0
    away = verdicts(STRAIGHT)["printed_network"].message
    assert "it learnt one encounter, 389 kt ahead of 467 kt with D 6.48 NM" in away
    assert "it learnt joins within 10 min" in away


def test_a_learner_that_knows_no_path_hands_over() -> None:
    found = verdicts(TURNS)
    assert found["exact"].word == "SRSR"
    for name in ("network", "regular_dp"):
        assert found[name].status == "handed_over"
        assert found[name].message.endswith("the exact planner answers.")
        assert (found[name].word, found[name].segments) == ("", ())


@pytest.mark.slow
def test_a_path_that_comes_too_close_is_shown_and_refused() -> None:
    """Its time is below that of the exact plan, which goes round."""
    limited = [s for s, _ in golden("reference") if isinstance(answer := plan(s), Plan)
               and answer.optimality.proof != "relaxation" and not s.leader.intent]  # fmt: skip
    refused = [
        verdict
        for situation in limited[:20]
        for verdict in compare(situation, among=["regular_dp"])
        if verdict.status == "refused"
    ]
    assert refused
    for verdict in refused:
        assert "of the leader" in verdict.message
        assert verdict.segments


def test_where_there_is_no_plan_the_exact_planner_says_why() -> None:
    close = near_limit().situation
    inside = replace(close, pursuer=replace(close.pursuer, x=1.0 * NM, y=0.0, heading=180.0 * DEG))
    assert isinstance(plan(inside), NoPlan)
    exact = verdicts(inside)["exact"]
    assert exact.status == "no_plan"
    assert "apart" in exact.message or "closer" in exact.message
    assert all(verdict.over_exact == 0.0 for verdict in compare(inside))
