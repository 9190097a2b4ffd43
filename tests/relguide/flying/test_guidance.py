"""Guidance goes through its modes for reasons, says them, and answers ill-posed ends plainly."""

from dataclasses import replace
from math import pi

import pytest

from relguide.flying.aircraft import A300, AircraftState
from relguide.flying.announcements import ModeChange, NewPlan, PlanMissing
from relguide.flying.assignment import Assignment, Observation, situation_of
from relguide.flying.autopilot import HoldHeading, TurnRate
from relguide.flying.guidance import advise
from relguide.flying.memory import Advice, Memory, begin
from relguide.planning.plan import NoPlan, Reason, plan
from relguide.planning.situation import CALM, FlyStraight, Situation, TurnTo
from relguide.planning.trajectory import RIGHT
from relguide.units import DEG, NM

ASSIGNMENT = Assignment(
    model=A300,
    tas=240.0,
    max_bank=25.0 * DEG,
    slot_distance=10_000.0,
    min_separation=5.0 * NM,
    wind=CALM,
)


def aircraft(x: float, y: float, heading: float, tas: float) -> AircraftState:
    return AircraftState(x, y, heading * DEG, 0.0, 0.0, tas, 9449.0)


def seen(x: float, y: float, heading: float, *, tas: float = 240.0) -> Observation:
    """The pursuer there, the leader at the origin eastbound at 200 m/s."""
    return Observation(
        t=0.0,
        pursuer=aircraft(x, y, heading, tas),
        leader=aircraft(0.0, 0.0, 90.0, 200.0),
        leader_turn_rate=0.0,
        intent=(),
        intent_known=False,
    )


def asked(sight: Observation) -> tuple[Memory, Advice]:
    return advise(begin(sight, ASSIGNMENT), sight, ASSIGNMENT, plan)


def test_far_away_it_converges_and_says_so() -> None:
    memory, advice = asked(seen(-40e3, 40e3, 90.0))
    assert memory.mode == advice.mode == "converge"
    new, mode = advice.events
    assert isinstance(new, NewPlan)
    assert new.reason == "engaged"
    assert new.message.startswith("Relative guidance engaged: RSL joins in ")
    assert isinstance(mode, ModeChange)
    assert (mode.mode, mode.previous) == ("converge", "heading")
    assert advice.reference == TurnRate(pytest.approx(0.0191, abs=1e-4))
    assert advice.commanded_tas == 240.0
    assert advice.time_to_go == new.commitment.plan.time_to_converge


def test_nothing_new_nothing_said() -> None:
    memory, _ = asked(seen(-40e3, 40e3, 90.0))
    again = seen(-40e3 + 240.0, 40e3, 90.0)
    again = replace(again, t=1.0, leader=again.leader._replace(x=200.0))
    assert advise(memory, again, ASSIGNMENT, plan)[1].events == ()


@pytest.mark.parametrize("metres", [1.0, 100.0, 600.0])
def test_a_metre_too_close_is_no_full_circle(metres: float) -> None:
    """The exact answer would be a loop of minutes, or none at all."""
    sight = seen(-10_000.0 + metres, 0.0, 90.0, tas=200.0)
    exact = plan(situation_of(sight, ASSIGNMENT, ASSIGNMENT.min_separation))
    assert isinstance(exact, NoPlan) or exact.time_to_converge > 200.0
    _, advice = asked(sight)
    assert advice.mode in ("capture", "follow")
    assert isinstance(advice.reference, TurnRate)
    assert abs(advice.reference.turn_rate) < 0.1 * DEG
    assert advice.commanded_tas < 200.0


def test_at_the_slot_it_is_joined() -> None:
    memory, advice = asked(seen(-10_000.0, 50.0, 91.0, tas=200.0))
    assert advice.joined
    assert memory.mode == "follow"
    assert advice.time_to_go == 0.0


def test_slot_that_is_not_open_is_not_joined() -> None:
    """The leader still has a turn to come back to this heading."""
    sight = seen(-10_000.0, 0.0, 90.0, tas=200.0)
    turn = TurnTo(heading=91.0 * DEG, turn=RIGHT, bank=25.0 * DEG)
    sight = replace(sight, intent=(FlyStraight(duration=5.0), turn), intent_known=True)
    _, advice = asked(sight)
    assert not advice.slot_open
    assert not advice.joined


def test_braking_begins_in_time() -> None:
    far, near = asked(seen(-25e3, 0.0, 90.0))[1], asked(seen(-11e3, 0.0, 90.0))[1]
    assert far.commanded_tas == 240.0
    assert 200.0 < near.commanded_tas < 240.0


@pytest.mark.parametrize(
    ("change", "reason", "words"),
    [
        ({"leader": aircraft(200.0, 0.0, 94.0, 200.0)}, "leader_turned", "094°"),
        ({"leader": aircraft(200.0, 0.0, 90.0, 190.0)}, "leader_changed_speed", "369 kt"),
        ({"intent_known": True}, "intent_received", "intent is known"),
        (
            {
                "intent_known": True,
                "intent": (TurnTo(heading=2.0, turn=RIGHT, bank=0.4),),
            },
            "intent_received",
            "intent is known",
        ),
    ],
)
def test_reason_of_a_new_plan(change: dict[str, object], reason: str, words: str) -> None:
    memory, _ = asked(seen(-40e3, 40e3, 90.0))
    now = replace(seen(-40e3 + 240.0, 40e3, 90.0), t=1.0)
    now = replace(now, leader=now.leader._replace(x=200.0))
    _, advice = advise(memory, replace(now, **change), ASSIGNMENT, plan)  # type: ignore[arg-type]
    new = advice.events[0]
    assert isinstance(new, NewPlan)
    assert new.reason == reason
    assert words in new.message


def test_missing_plan_is_said_once_and_a_heading_held() -> None:
    def helpless(situation: Situation) -> NoPlan:
        return NoPlan(reason=Reason.SLOT_UNREACHABLE, message="Too slow.")

    sight = seen(-40e3, 40e3, 60.0)
    memory, advice = advise(begin(sight, ASSIGNMENT), sight, ASSIGNMENT, helpless)
    assert advice.mode == "heading"
    assert advice.reference == HoldHeading(pytest.approx(60.0 * DEG))
    assert any(isinstance(event, PlanMissing) for event in advice.events)
    assert advise(memory, replace(sight, t=1.0), ASSIGNMENT, helpless)[1].events == ()


def test_leader_who_turns_towards_it_unannounced_is_given_way_in_time() -> None:
    """As if he stopped turning now there is a plan, and a second later there may be none."""
    meeting = seen(14e3, 12e3, 250.0)
    assert asked(meeting)[1].mode == "converge"
    turning = replace(meeting, leader_turn_rate=-1.2 * DEG)
    memory, advice = asked(turning)
    assert advice.mode == "heading"
    assert isinstance(advice.reference, HoldHeading)
    assert 270.0 * DEG < advice.reference.heading < 330.0 * DEG
    missing = next(event for event in advice.events if isinstance(event, PlanMissing))
    assert missing.answer.message.startswith("The leader is turning; if it goes on")
    # it is left when there is room to spare, and at once if he says where his turn ends
    told = replace(turning, intent_known=True, t=1.0)
    assert advise(memory, told, ASSIGNMENT, plan)[1].mode == "converge"
    assert asked(replace(turning, leader_turn_rate=1.2 * DEG))[1].mode == "converge"


def test_lost_path_is_converged_to_again() -> None:
    memory, _ = asked(seen(-10_000.0, 0.0, 90.0, tas=200.0))
    assert memory.mode == "follow"
    blown_off = replace(seen(-14_000.0, 6_000.0, 90.0), t=1.0)
    _, advice = advise(memory, blown_off, ASSIGNMENT, plan)
    assert advice.mode == "converge"
    assert any(isinstance(event, NewPlan) for event in advice.events)


def test_too_little_room_is_answered_by_speed() -> None:
    memory, _ = asked(seen(-10_000.0, 0.0, 90.0, tas=200.0))
    closer = replace(seen(-9_300.0, 0.0, 90.0, tas=205.0), t=1.0)
    _, advice = advise(memory, closer, ASSIGNMENT, plan)
    assert advice.mode == "follow"
    assert advice.commanded_tas <= 190.0


def test_headings_stay_in_range() -> None:
    _, advice = asked(seen(-40e3, -40e3, 350.0))
    match advice.reference:
        case HoldHeading(heading=heading):
            assert 0.0 <= heading < 2.0 * pi
        case TurnRate(turn_rate=rate):
            assert abs(rate) < 2.0 * DEG
