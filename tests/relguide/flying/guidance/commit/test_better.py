"""Another path is flown only if it is faster by a margin."""

from dataclasses import replace
from itertools import islice

import pytest

from relguide.flying.guidance.commit.better import better, may_be_improved
from relguide.flying.guidance.commit.committed import Committed
from relguide.flying.guidance.commit.proposal import NotBetter, Proposal
from relguide.flying.guidance.commit.propose import propose
from relguide.flying.guidance.settings import DEFAULT
from relguide.planning.outcome import NoPlan, Optimality, Plan
from relguide.planning.plan import plan
from relguide.planning.situation import Situation
from relguide.planning.words import candidates
from tests.liars import ends_beside
from tests.relguide.flying.guidance.beliefs import FIG_6B, Watched, behind, observe
from tests.relguide.flying.guidance.commit.proposals import propose_with


def second_best(situation: Situation) -> Plan | NoPlan:
    """Not the fastest path: another word, as a planner might answer that knows no better."""
    answer = plan(situation)
    assert isinstance(answer, Plan)
    others = [one.trajectory for one in islice(candidates(situation).at_release, 1, None)]
    others += [one.trajectory for one in candidates(situation).later][1:]
    slower = min(others, key=lambda one: one.duration)
    unproved = Optimality(proof="none", lower_bound=0.0)
    return replace(answer, trajectory=slower, word=slower.letters, optimality=unproved)


@pytest.fixture(scope="module")
def slow() -> tuple[Watched, Committed, float]:
    """A flight on the second best path, and how much sooner the best arrives."""
    watched = Watched(behind(along=25_000.0, abeam=15_000.0))
    found = propose(watched.belief, watched.assignment, None, second_best)
    best = propose(watched.belief, watched.assignment, None, plan)
    assert isinstance(found, Proposal)
    assert isinstance(best, Proposal)
    assert not found.fell_back
    return watched, found.committed, found.committed.due - best.committed.due


def test_a_faster_path_is_taken(slow: tuple[Watched, Committed, float]) -> None:
    watched, committed, sooner = slow
    assert sooner > 5.0
    assert may_be_improved(committed, 0.0, watched.assignment)
    found = better(watched.belief, watched.assignment, committed, plan)
    assert isinstance(found, Proposal)
    assert found.committed.forecast.join_time < committed.forecast.join_time


def test_a_path_that_is_faster_by_less_than_the_margin_is_not(
    slow: tuple[Watched, Committed, float],
) -> None:
    watched, committed, sooner = slow
    lazy = replace(watched.assignment, settings=replace(DEFAULT, better=sooner + 1.0))
    assert isinstance(better(watched.belief, lazy, committed, plan), NotBetter)
    keen = replace(watched.assignment, settings=replace(DEFAULT, better=0.5 * sooner))
    assert isinstance(better(watched.belief, keen, committed, plan), Proposal)
    far = replace(watched.assignment, settings=replace(DEFAULT, better_share=0.9))
    assert isinstance(better(watched.belief, far, committed, plan), NotBetter)


def test_the_same_path_is_not_better_than_itself() -> None:
    committed = propose_with().committed
    found = better(*observe(FIG_6B), committed, plan)
    assert found == NotBetter(fell_back=False, refusal=None)
    assert not may_be_improved(committed, 0.0, observe(FIG_6B)[1])  # it is proved the fastest


def test_a_lie_that_is_not_better_is_passed_on_as_well() -> None:
    found = better(*observe(FIG_6B), propose_with().committed, ends_beside)
    assert isinstance(found, NotBetter)
    assert found.fell_back
    assert found.refusal is not None
    assert found.refusal.fault == "slot"
