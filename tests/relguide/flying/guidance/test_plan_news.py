"""What a crew is told of plans: what is news, once, when the leader has settled; all is kept."""

from dataclasses import replace
from itertools import pairwise

import pytest

from relguide.flying.documents import LeaderChanged, PlanChanged, PromiseChanged
from relguide.flying.flight import IntentKnown, LeaderHeading, LeaderSpeed, Scenario
from relguide.flying.guidance.announcements import (
    Expectation,
    UnableTo,
    leader_change,
    reason_sentence,
    summary,
)
from relguide.flying.guidance.commit.proposal import Proposal
from relguide.flying.guidance.commit.propose import propose
from relguide.flying.guidance.memory import begin
from relguide.flying.guidance.plan_news import say_no_plan
from relguide.flying.guidance.settings import DEFAULT
from relguide.flying.scenarios import fig_6, own_scenario
from relguide.planning.outcome import NoPlan, Reason
from relguide.planning.plan import plan
from relguide.units import DEG, KT
from tests.flights import Flown, fly_whole, random_start
from tests.relguide.flying.guidance.beliefs import FIG_6B, behind, observe

TURNED_AT = 820.0
"""The leader of Fig. 6 turns 45° to the right there, for some 35 s, rolling included [s]."""


@pytest.fixture(scope="module")
def fig_6a() -> Flown:
    return fly_whole(fig_6(intent_known=False))


def unannounced_turns(seed: int) -> Scenario:
    return replace(own_scenario(random_start(seed), intent_known=False), duration_limit=3_000.0)


def announcements(flight: Flown) -> list[PlanChanged]:
    return [d for d in flight.of(PlanChanged) if d.announced]


def test_an_untold_turn_is_announced_once_when_it_is_over(fig_6a: Flown) -> None:
    (turning,) = fig_6a.of(LeaderChanged)
    assert turning.t == pytest.approx(TURNED_AT, abs=2.0)
    assert turning.message == (
        "The leader turns right and its intent is not known: the join is uncertain."
    )
    engaged, over = announcements(fig_6a)
    assert engaged.t == 0.0
    assert over.reason == "leader_turned"
    assert over.message.startswith("The leader's heading is 135°: ")
    leader = {s.t: s.leader for s in fig_6a.samples}
    assert abs(leader[over.t].bank) < 3.0 * DEG
    assert abs(leader[over.t].heading - 135.0 * DEG) < 1.0 * DEG
    rolled_out = min(t for t, now in leader.items() if t > 830.0 and abs(now.bank) < 5.0 * DEG)
    assert over.t <= rolled_out + 2.0 * DEFAULT.settled_for
    assert fig_6a.result.replans_announced == 1


def test_a_join_that_moves_is_said_within_5_s_and_the_last_word_is_the_plan_s(
    fig_6a: Flown,
) -> None:
    """The join once moved from 00:43 to 04:06 in five seconds, and 39 s went by in silence."""
    plans, promises = fig_6a.of(PlanChanged), fig_6a.of(PromiseChanged)
    jump = next(d for d in plans if d.t > TURNED_AT - 5.0 and d.promised > 120.0)
    assert 1 <= len(promises) <= 4
    said = [d for d in promises if jump.t <= d.t <= jump.t + 5.0]
    assert len(said) == 1
    assert said[0].promised > said[0].was + 120.0
    assert said[0].message == "Joins in 3 min 38 s, was 0 min 48 s."
    assert max(d.t for d in promises) < announcements(fig_6a)[-1].t


def test_every_plan_flown_is_kept_whether_announced_or_not(fig_6a: Flown) -> None:
    silent = [d for d in fig_6a.of(PlanChanged) if not d.announced]
    assert len(silent) > 10  # a second each, while it turns
    assert {d.reason for d in silent} <= {"leader_turned", "leader_elsewhere"}
    assert fig_6a.result.replans == len(fig_6a.of(PlanChanged)) - 1


@pytest.mark.slow
@pytest.mark.parametrize("seed", [2, 3, 5, 6, 12, 13, 21, 27, 40, 43, 46, 49])
def test_plans_are_announced_no_more_often_than_the_settings_say(seed: int) -> None:
    flight = fly_whole(unannounced_turns(seed))
    told = announcements(flight)
    followed = [d for d in told if d.reason not in ("engaged", "separation")]
    assert all(b.t - a.t >= DEFAULT.announce_after for a, b in pairwise(followed))
    assert flight.result.replans_announced == len(told) - 1 <= 5
    banks = {s.t: abs(s.leader.bank) for s in flight.samples}
    for document in followed:  # none while the leader turns
        assert banks[document.t] < 5.0 * DEG


def test_a_leader_that_keeps_his_word_gives_nothing_to_announce() -> None:
    flight = fly_whole(FIG_6B)
    assert [(d.t, d.reason, d.announced) for d in flight.of(PlanChanged)] == [
        (0.0, "engaged", True)
    ]
    assert flight.of(LeaderChanged) == []


def test_a_new_speed_is_announced_once() -> None:
    """It takes 10 s and more to be reached; what is announced joins when it does."""
    flight = fly_whole(FIG_6B, (300.0, LeaderSpeed(tas=190.0)))
    _, over = announcements(flight)
    assert over.reason == "leader_changed_speed"
    speed = next(s.leader.tas for s in flight.samples if s.t == over.t)
    assert speed == pytest.approx(190.0, abs=0.6)
    assert f"The leader flies {speed / KT:.0f} kt: " in over.message
    assert 300.0 < over.t < 360.0
    later = [d for d in flight.of(PlanChanged) if d.t > over.t]
    assert not any(d.announced for d in later)
    assert flight.result.join_time == pytest.approx(over.t + over.promised, abs=10.0)


def test_a_small_change_is_kept_but_not_announced() -> None:
    """A knot and a half: the path stays where it was, and joins some seconds sooner."""
    flight = fly_whole(FIG_6B, (300.0, LeaderSpeed(tas=200.0 - 1.5 * KT)))
    assert [d.t for d in flight.of(PlanChanged) if d.announced] == [0.0]
    assert flight.result.join_time == pytest.approx(flight.result.promised, abs=15.0)


def test_orders_known_at_once_are_announced_at_once_and_with_a_pause_between() -> None:
    orders = [(300.0 + 10.0 * k, LeaderHeading(heading=(100.0 + 20.0 * k) * DEG)) for k in range(4)]
    flight = fly_whole(FIG_6B, *orders)
    told = [d.t for d in announcements(flight)]
    assert told[:2] == [0.0, 300.0]
    assert told[2] == 300.0 + DEFAULT.announce_after  # all that came between, in one
    assert len(told) == 3
    assert "160°" in announcements(flight)[-1].message


def test_what_was_withdrawn_and_given_back_is_said_of_both() -> None:
    flight = fly_whole(FIG_6B, (100.0, IntentKnown(known=False)), (200.0, IntentKnown(known=True)))
    told = [(d.t, d.reason) for d in announcements(flight)]
    assert told == [
        (0.0, "engaged"),
        (100.0 + DEFAULT.settled_for, "intent_withdrawn"),
        (200.0 + DEFAULT.settled_for, "intent_received"),
    ]


def test_what_is_announced_can_be_drawn() -> None:
    """From where the aircraft is, to the slot, and with a word of its own."""
    flight = fly_whole(FIG_6B, (100.0, IntentKnown(known=False)))
    last = announcements(flight)[-1]
    own = next(s.pursuer for s in flight.samples if s.t == last.t)
    start = last.plan.segments[0].start
    assert (start.x, start.y) == pytest.approx((own.x, own.y), abs=60.0)  # the tube
    assert last.plan.word in last.message
    assert not any(pair in last.plan.word for pair in ("SS", "RR", "LL"))
    assert last.plan.separation.least >= 5.0 * 1852.0


WAS = Expectation(final_heading=1.0, tas=200.0, intent_known=True)


@pytest.mark.parametrize(
    ("now", "change"),
    [
        (WAS, None),
        (replace(WAS, final_heading=1.0 + 0.9 * DEG), None),
        (replace(WAS, final_heading=1.0 - 1.1 * DEG), "leader_turned"),
        (replace(WAS, tas=201.0), None),
        (replace(WAS, tas=198.9), "leader_changed_speed"),
        (replace(WAS, intent_known=False, tas=150.0), "intent_withdrawn"),
    ],
)
def test_a_change_is_what_a_crew_would_call_one(now: Expectation, change: str | None) -> None:
    assert leader_change(WAS, now, DEFAULT.leader_turned, DEFAULT.leader_speed) == change


def test_a_heading_across_north_is_a_small_change() -> None:
    one, other = replace(WAS, final_heading=0.005), replace(WAS, final_heading=6.28)
    assert leader_change(one, other, DEFAULT.leader_turned, DEFAULT.leader_speed) is None
    received = leader_change(replace(WAS, intent_known=False), WAS, 1.0, 1.0)
    assert received == "intent_received"


def test_sentences_say_why_and_what_comes() -> None:
    belief, _ = observe(FIG_6B)
    assert reason_sentence("leader_turned", belief) == "The leader will turn to 135°"
    straight, assignment = observe(behind(along=30_000.0, abeam=10_000.0))
    assert reason_sentence("leader_turned", straight) == "The leader's heading is 000°"
    assert reason_sentence("leader_changed_speed", straight) == "The leader flies 389 kt"
    found = propose(straight, assignment, None, plan)
    assert isinstance(found, Proposal)
    assert summary(found.committed.plan, 59.6) == "LSR joins in 1 min 00 s and keeps 5.4 NM"


@pytest.mark.parametrize("reason", [Reason.SLOT_UNREACHABLE, Reason.BEYOND_HORIZON])
def test_a_slot_that_is_not_caught_or_only_in_13_hours_is_a_matter_of_speed(reason: Reason) -> None:
    belief, assignment = observe(FIG_6B)
    answer = NoPlan(reason=reason, message="A larger speed difference helps.")
    _, events = say_no_plan(begin(belief), belief, assignment, answer, [])
    said = [event for event in events if isinstance(event, UnableTo)]
    assert [(one.reason, one.message) for one in said] == [("speed", f"Unable: {answer.message}")]
