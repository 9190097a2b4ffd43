"""Whoever made a plan, it is flown only if it leads from here to the open slot and keeps d_min."""

from dataclasses import replace

import pytest

from relguide import Cell, Certificate, Disc, NoPlan, Plan, Reason, Situation, certify, plan
from relguide.planning.acceptance import ask, judge_answer
from tests.liars import LIARS, LIED_ABOUT, Liar
from tests.plans import find_plan


def name(liar: object) -> str:
    return getattr(liar, "__name__", "")


@pytest.mark.parametrize("liar", LIARS, ids=name)
def test_the_exact_plan_stands_in_for_a_lie(liar: Liar) -> None:
    answer = ask(liar, LIED_ABOUT)
    assert answer.fell_back
    assert answer.plan == plan(LIED_ABOUT)
    assert answer.refusal is not None
    assert answer.refusal.fault == LIARS[liar]
    assert answer.refusal.message.endswith(".")


def test_a_plan_for_more_separation_will_do_for_less() -> None:
    """Its situation and its certificate become those of what was asked."""
    wide = replace(LIED_ABOUT, min_separation=LIED_ABOUT.min_separation + 100.0)
    answer = ask(lambda situation: replace(find_plan(wide), planner="careful"), LIED_ABOUT)
    assert answer.refusal is None
    assert isinstance(answer.plan, Plan)
    assert (answer.plan.planner, answer.plan.situation) == ("careful", LIED_ABOUT)
    assert answer.plan.certificate == certify(answer.plan.trajectory, LIED_ABOUT)


def test_what_a_plan_says_of_itself_is_not_believed() -> None:
    modest = Certificate(least_separation=0.0, at_time=0.0, lower_bound=0.0, holds=False)
    answer = judge_answer(replace(find_plan(LIED_ABOUT), certificate=modest), LIED_ABOUT)
    assert answer.plan == find_plan(LIED_ABOUT)
    assert not answer.fell_back


def test_a_planner_may_say_that_there_is_none() -> None:
    none = NoPlan(reason=Reason.SLOT_UNREACHABLE, message="I do not know.")
    assert ask(lambda situation: none, LIED_ABOUT) == (none, False, None)


def test_that_a_planner_fell_back_itself_is_kept() -> None:
    assert ask(lambda s: replace(find_plan(s), fell_back=True), LIED_ABOUT).fell_back


def test_what_a_planner_raises_is_its_callers_to_see() -> None:
    class OwnError(Exception):
        pass

    def broken(situation: Situation) -> Plan | NoPlan:
        raise OwnError("no licence")

    with pytest.raises(OwnError, match="no licence"):
        ask(broken, LIED_ABOUT)


HIGH = replace(
    LIED_ABOUT,
    pursuer=replace(LIED_ABOUT.pursuer, altitude=11_000.0),
    leader=replace(LIED_ABOUT.leader, altitude=9_000.0),
)
"""The pursuer has to descend on its way."""


def test_a_plan_that_stays_at_its_level_does_not_join() -> None:
    flat = find_plan(LIED_ABOUT)
    answer = ask(lambda situation: replace(flat, planner="flat"), HIGH)
    assert answer.refusal is not None
    assert (answer.refusal.fault, answer.fell_back) == ("level", True)
    assert isinstance(answer.plan, Plan)
    assert answer.plan.levels[-1].to_altitude == 9_000.0


def test_changes_of_level_that_a_planner_plans_are_kept() -> None:
    exact = find_plan(HIGH)
    answer = ask(lambda situation: replace(exact, planner="own"), HIGH)
    assert answer.refusal is None
    assert isinstance(answer.plan, Plan)
    assert answer.plan.levels == exact.levels != ()
    assert answer.plan.certificate == exact.certificate


def test_who_is_in_the_way_of_a_plan_is_named() -> None:
    plain = find_plan(LIED_ABOUT)
    middle = plain.over_ground([0.6 * plain.time_to_converge])
    cell = Cell(ident="CB1", shape=Disc(x=middle.x[0], y=middle.y[0], radius=2_000.0))
    amid = replace(LIED_ABOUT, others=(cell,))
    answer = ask(lambda situation: replace(plain, planner="blind"), amid)
    assert answer.refusal is not None
    assert answer.refusal.fault == "separation"
    assert answer.refusal.message.endswith("NM into CB1.")
