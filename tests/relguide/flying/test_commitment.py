"""What is flown is kept until there is a reason, and nothing uncertified is flown."""

from dataclasses import replace
from math import hypot, pi

import pytest

from relguide import Leader, Pursuer
from relguide.flying.aircraft import A300
from relguide.flying.commitment import Choice, Commitment, NoChoice, choose
from relguide.flying.scenarios import scenario
from relguide.planning.plan import NoPlan, Plan, Planner, Reason, plan
from relguide.planning.situation import Situation
from relguide.planning.trajectory import Straight
from relguide.planning.words import candidates
from relguide.units import DEG

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


def chosen(situation: Situation, t: float, planner: Planner = plan) -> Choice | NoChoice:
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


def test_without_the_planner_the_same_branch_is_solved_again() -> None:
    choice = chosen(later(100.0, aside=100.0), 100.0, helpless)
    assert isinstance(choice, Choice)
    assert choice.cause == "continued"
    assert choice.plan.certificate.holds


def nearly_tied(leader_tas: float, gain: float) -> tuple[Situation, Commitment]:
    """Flying away from the slot, a little off: one way round is faster, by `gain`, than the other.

    Returns:
        the situation, and a commitment to the slower way.
    """
    low, high = 0.0, 0.5
    while True:
        off = 0.5 * (low + high)
        pursuer = Pursuer(x=0.0, y=-20e3, heading=pi + off, tas=240.0, max_bank=45.0 * DEG)
        leader = Leader(x=0.0, y=0.0, heading=0.0, tas=leader_tas)
        situation = Situation(
            pursuer=pursuer, leader=leader, slot_distance=10e3, min_separation=5e3
        )
        fast = planned(situation)
        mirrored = fast.word.translate(str.maketrans("LR", "RL"))
        other = next(c for c in candidates(situation) if c.word == mirrored)
        by = other.time_to_converge - fast.time_to_converge
        if abs(by - gain) < 1e-3:
            slow = replace(fast, trajectory=other.trajectory, word=other.word)
            due = other.time_to_converge
            return situation, Commitment(plan=slow, made_at=0.0, due=due)
        low, high = (off, high) if by < gain else (low, off)


@pytest.mark.parametrize(
    ("leader_tas", "takes", "gain", "cause"),
    [
        (180.0, 488.0, 2.3, "continued"),  # half a percent of 488 s is 2.44 s
        (180.0, 488.0, 2.6, "better_plan"),
        (80.0, 190.0, 0.95, "continued"),  # and it must be a second at least
        (80.0, 190.0, 1.05, "better_plan"),
    ],
)
def test_a_little_better_is_not_enough(
    leader_tas: float, takes: float, gain: float, cause: str
) -> None:
    situation, committed = nearly_tied(leader_tas, gain)
    slow = committed.plan.time_to_converge
    assert slow == pytest.approx(takes, abs=10.0)
    choice = choose(
        committed, 0.0, preferred=situation, required=situation, planner=plan, model=A300
    )
    assert isinstance(choice, Choice)
    assert choice.cause == cause
    kept = slow if cause == "continued" else slow - gain
    assert choice.plan.time_to_converge == pytest.approx(kept, abs=1e-2)


@pytest.mark.parametrize(
    ("share", "flown"),
    [(0.027, "the answer"), (0.033, "solved again"), (0.057, "solved again"), (0.063, "another")],
)
def test_the_same_way_is_one_that_lies_near(share: float, flown: str) -> None:
    """300 m, and 3 % of the way while rolling; the branch itself is found at twice that."""
    here = planned(SITUATION)
    aside = 300.0 + share * here.trajectory.length
    shifted = replace(here.trajectory, x=here.trajectory.x - aside)
    choice = choose(
        Commitment(plan=replace(here, trajectory=shifted), made_at=0.0, due=here.time_to_converge),
        0.0,
        preferred=SITUATION,
        required=SITUATION,
        planner=lambda situation: replace(planned(situation), planner="own"),
        model=A300,
    )
    assert isinstance(choice, Choice)
    assert (choice.cause, choice.plan.planner) == {
        "the answer": ("continued", "own"),
        "solved again": ("continued", "exact"),
        "another": ("deviation", "own"),
    }[flown]


def test_leader_gone_another_way_ends_the_commitment() -> None:
    away = later(100.0)
    away = replace(away, leader=replace(away.leader, x=-60e3, y=-80e3, heading=3.0))
    choice = chosen(away, 100.0)
    assert isinstance(choice, Choice)
    assert choice.cause in ("deviation", "separation")
    nothing = chosen(away, 100.0, helpless)
    assert nothing == NoChoice(answer=helpless(away), fell_back=False, refusal=None)


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
