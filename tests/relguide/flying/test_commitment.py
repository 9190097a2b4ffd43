"""What is flown is kept until there is a reason, and nothing uncertified is flown."""

from dataclasses import replace
from math import hypot

import pytest

from relguide.flying.aircraft import A300
from relguide.flying.commitment import Choice, Commitment, choose
from relguide.flying.scenarios import scenario
from relguide.flying.steering import remaining
from relguide.planning.plan import NoPlan, Plan, Planner, Reason, plan
from relguide.planning.situation import Situation
from relguide.planning.trajectory import Straight

SITUATION = scenario("fig_6a").situation
SITUATION = replace(SITUATION, leader=replace(SITUATION.leader, intent=()))


def planned(situation: Situation) -> Plan:
    answer = plan(situation)
    assert isinstance(answer, Plan)
    return answer


def later(seconds: float, *, aside: float = 0.0) -> Situation:
    """Along the plan, some metres beside it."""
    pose = planned(SITUATION).trajectory.pose_at(seconds)
    pursuer, leader = SITUATION.pursuer, SITUATION.leader
    return replace(
        SITUATION,
        pursuer=replace(pursuer, x=pose.x, y=pose.y + aside, heading=pose.heading),
        leader=replace(leader, x=leader.x + leader.tas * seconds),
    )


def chosen(situation: Situation, t: float, planner: Planner = plan) -> Choice | NoPlan:
    return choose(
        Commitment(plan=planned(SITUATION), made_at=0.0, due=planned(SITUATION).time_to_converge),
        t,
        preferred=situation,
        required=situation,
        planner=planner,
        model=A300,
    )


def helpless(situation: Situation) -> NoPlan:
    return NoPlan(reason=Reason.SLOT_UNREACHABLE, message="")


@pytest.mark.parametrize("aside", [-200.0, 0.0, 150.0])
@pytest.mark.parametrize("t", [1.0, 100.0, 500.0])
def test_same_way_is_continued_from_here(t: float, aside: float) -> None:
    choice = chosen(later(t, aside=aside), t)
    assert isinstance(choice, Choice)
    assert choice.cause == "continued"
    assert choice.plan.situation.pursuer.y == later(t, aside=aside).pursuer.y
    due = planned(SITUATION).time_to_converge - t
    assert choice.plan.time_to_converge == pytest.approx(due, abs=10.0)


def test_without_the_planner_the_same_strategy_is_solved_again() -> None:
    choice = chosen(later(100.0, aside=100.0), 100.0, helpless)
    assert isinstance(choice, Choice)
    assert choice.cause == "continued"
    assert choice.plan.certificate.holds


def test_a_little_better_is_not_enough() -> None:
    """Another way that wins by less than a second does not change the mind."""
    situation = later(100.0)
    kept = planned(situation)

    def tempting(asked: Situation) -> Plan:
        short = remaining(kept.trajectory, 0.5)
        return replace(kept, trajectory=replace(short, x=short.x - 5e3, y=short.y - 5e3))

    choice = chosen(situation, 100.0, tempting)
    assert isinstance(choice, Choice)
    assert choice.cause == "continued"
    assert choice.plan.time_to_converge == pytest.approx(kept.time_to_converge, abs=0.01)


def test_much_better_is() -> None:
    situation = later(100.0)

    def better(asked: Situation) -> Plan:
        kept = planned(asked)
        short = remaining(kept.trajectory, 60.0)
        return replace(kept, trajectory=replace(short, x=short.x - 30e3, y=short.y - 30e3))

    choice = chosen(situation, 100.0, better)
    assert isinstance(choice, Choice)
    assert choice.cause == "better_plan"


def test_leader_gone_another_way_ends_the_commitment() -> None:
    away = later(100.0)
    away = replace(away, leader=replace(away.leader, x=-60e3, y=-80e3, heading=3.0))
    choice = chosen(away, 100.0)
    assert isinstance(choice, Choice)
    assert choice.cause in ("deviation", "separation")
    assert chosen(away, 100.0, helpless) == helpless(away)


def test_answer_that_does_not_certify_is_replaced_and_counted() -> None:
    def careless(asked: Situation) -> Plan:
        kept = planned(asked)
        through = replace(
            kept.trajectory, x=asked.leader.x, y=asked.leader.y, segments=(Straight(length=1e3),)
        )
        return replace(kept, trajectory=through)

    choice = choose(
        None, 0.0, preferred=SITUATION, required=SITUATION, planner=careless, model=A300
    )
    assert isinstance(choice, Choice)
    assert choice.fell_back
    assert choice.plan.certificate.holds


def test_preferred_separation_is_given_up_before_the_plan_is() -> None:
    def strict(asked: Situation) -> Plan | NoPlan:
        wide = asked.min_separation > SITUATION.min_separation
        return helpless(asked) if wide else plan(asked)

    wide = replace(SITUATION, min_separation=SITUATION.min_separation + 100.0)
    choice = choose(None, 0.0, preferred=wide, required=SITUATION, planner=strict, model=A300)
    assert isinstance(choice, Choice)


@pytest.mark.parametrize(("apart", "limits"), [(500.0, [5.2e3, 5e3]), (-100.0, [5e3])])
def test_what_is_lost_already_is_not_asked_for(apart: float, limits: list[float]) -> None:
    """Between the required and the preferred separation only the required one can be kept."""
    asked: list[float] = []

    def never(situation: Situation) -> NoPlan:
        asked.append(situation.min_separation)
        return helpless(situation)

    leader = replace(SITUATION.leader, x=SITUATION.pursuer.x + 5.2e3 + apart, y=SITUATION.pursuer.y)
    required, preferred = (
        replace(SITUATION, leader=leader, min_separation=limit) for limit in (5e3, 5.2e3)
    )
    choose(None, 0.0, preferred=preferred, required=required, planner=never, model=A300)
    assert asked == limits


@pytest.mark.parametrize(("beside", "kept"), [(-200.0, True), (200.0, False)])
def test_a_path_is_judged_from_where_the_aircraft_is(beside: float, kept: bool) -> None:
    """Rolling late moves it towards the leader: the path keeps d_min, the aircraft would not."""
    pursuer = replace(SITUATION.pursuer, x=26e3, y=8e3, heading=4.0)
    touching = replace(SITUATION, pursuer=pursuer)
    around = planned(touching)
    assert around.certificate.least_separation == pytest.approx(touching.min_separation, abs=1.0)
    t = 0.5 * around.certificate.at_time
    pose, leader = around.trajectory.pose_at(t), touching.leader.trajectory.pose_at(t)
    away = hypot(leader.x - pose.x, leader.y - pose.y)
    here = replace(
        touching,
        pursuer=replace(
            pursuer,
            x=pose.x + beside * (leader.x - pose.x) / away,
            y=pose.y + beside * (leader.y - pose.y) / away,
            heading=pose.heading,
        ),
        leader=replace(touching.leader, x=leader.x, y=leader.y),
    )
    choice = choose(
        Commitment(plan=around, made_at=0.0, due=around.time_to_converge),
        t,
        preferred=here,
        required=here,
        planner=helpless,
        model=A300,
    )
    assert isinstance(choice, Choice) == kept


def test_last_turn_is_flown_as_planned_without_asking() -> None:
    t = planned(SITUATION).time_to_converge - 8.0  # within the last turn of 10 s

    def never(asked: Situation) -> Plan:
        raise AssertionError("asked")

    choice = chosen(later(t, aside=30.0), t, never)
    assert isinstance(choice, Choice)
    assert choice.plan.time_to_converge == pytest.approx(8.0, abs=0.1)
