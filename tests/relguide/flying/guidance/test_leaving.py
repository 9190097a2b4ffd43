"""What cannot be followed is left in time: said, on a heading that stays, and d_min kept."""

from dataclasses import replace
from itertools import pairwise
from math import inf

import pytest

from relguide.campaign.families import draw
from relguide.campaign.judge import fly_case
from relguide.flying.aircraft_documents import HeadingReference
from relguide.flying.belief import Belief
from relguide.flying.documents import Alert, ModeChanged, PlanUnavailable, SeparationLost, Unable
from relguide.flying.flight import LeaderHeading, LeaderSpeed, Scenario
from relguide.flying.guidance.assignment import Assignment
from relguide.flying.guidance.commit.committed import Committed
from relguide.flying.guidance.commit.proposal import Proposal
from relguide.flying.guidance.commit.propose import propose
from relguide.flying.guidance.leaving import must_leave
from relguide.flying.guidance.memory import begin
from relguide.flying.guidance.monitor import Outlook
from relguide.flying.orders import Command, IntentKnown
from relguide.flying.scenarios import own_scenario
from relguide.kernels.base.angles import wrap_signed
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.outcome import NoPlan, Reason
from relguide.planning.plan import plan
from relguide.planning.situation import Situation
from relguide.units import DEG, KT, NM
from tests.flights import Flown, fly_whole, random_start
from tests.relguide.flying.guidance.beliefs import FIG_6B, behind, observe
from tests.relguide.flying.guidance.test_forecast import make_forecast

FOLLOWED = replace(FIG_6B, after_joining=600.0)
JOINED = 950.0
"""By then Fig. 6b has joined, and the leader flies south-east [s]."""


def committed(belief: Belief, assignment: Assignment) -> Committed:
    found = propose(belief, assignment, None, plan)
    assert isinstance(found, Proposal)
    return found.committed


def held_headings(flight: Flown) -> list[tuple[float, float]]:
    """When a heading was held, and which."""
    held = [s for s in flight.samples if s.guidance.mode in ("heading", "escape")]
    assert all(isinstance(s.guidance.reference, HeadingReference) for s in held)
    return [(s.t, s.guidance.reference.heading) for s in held]  # type: ignore[union-attr]


def assert_steady(flight: Flown) -> None:
    """A held heading changes seldom: not from second to second, and never there and back."""
    held = held_headings(flight)
    jumps = [
        (later, wrap_signed(there - here))
        for (_, here), (later, there) in pairwise(held)
        if abs(wrap_signed(there - here)) > 0.5 * DEG
    ]
    assert len(jumps) <= 3
    assert all(later - before > 10.0 for (before, _), (later, _) in pairwise(jumps))


def unannounced_turns(seed: int) -> Scenario:
    scenario = own_scenario(random_start(seed), intent_known=False)
    return replace(scenario, duration_limit=3_000.0, after_joining=60.0)


@pytest.fixture(scope="module")
def slowed() -> Flown:
    return fly_whole(FOLLOWED, (JOINED, LeaderSpeed(tas=100.0)))


def test_a_leader_ordered_to_100_mps_is_left_before_d_min(slowed: Flown) -> None:
    end = slowed.result
    assert end.joined
    assert end.losses == ()
    assert slowed.of(SeparationLost) == []
    assert end.least_separation >= FOLLOWED.situation.min_separation
    (left,) = [d for d in slowed.of(ModeChanged) if d.mode == "escape"]
    (said,) = slowed.of(Unable)
    assert said.t == left.t
    assert said.reason == "speed"
    assert "is the least speed of this A306 at its level" in said.message
    speed = next(s.leader.tas for s in slowed.samples if s.t == said.t)
    assert f"the leader flies {speed / KT:.0f} kt" in said.message
    assert slowed.samples[-1].guidance.mode == "escape"
    assert not slowed.samples[-1].guidance.joined


def test_it_stays_away_on_one_heading(slowed: Flown) -> None:
    assert_steady(slowed)
    assert len(held_headings(slowed)) > 1_000


def test_it_comes_back_when_the_leader_is_fast_enough_again() -> None:
    back = (JOINED + 150.0, LeaderSpeed(tas=200.0))
    flight = fly_whole(FOLLOWED, (JOINED, LeaderSpeed(tas=100.0)), back)
    assert [d.mode for d in flight.of(ModeChanged)] == [
        "converge", "capture", "follow", "escape", "converge", "capture", "follow",
    ]  # fmt: skip
    assert flight.result.losses == ()
    assert flight.samples[-1].guidance.joined
    assert_steady(flight)


@pytest.mark.parametrize("direction", ["left", "right"])
@pytest.mark.parametrize("turned", [90.0, 150.0, 180.0, 210.0])
@pytest.mark.parametrize("known", [True, False])
def test_a_leader_that_turns_back_while_followed_is_not_met(
    direction: str, turned: float, known: bool
) -> None:
    """d_min is kept, or its loss is announced."""
    heading = (135.0 + (turned if direction == "right" else -turned)) * DEG
    order = LeaderHeading(heading=heading, direction=direction)  # type: ignore[arg-type]
    orders: list[tuple[float, Command]] = [(JOINED, order)]
    if not known:
        orders.insert(0, (JOINED - 20.0, IntentKnown(known=False)))
    flight = fly_whole(replace(FOLLOWED, after_joining=300.0), *orders)
    assert all(loss.announced for loss in flight.result.losses)
    if turned <= 180.0:
        assert flight.result.losses == ()
    assert_steady(flight)


@pytest.mark.parametrize("seed", [12, 21])
def test_an_unannounced_turn_towards_it_is_left_before_there_is_no_way_out(seed: int) -> None:
    flight = fly_whole(unannounced_turns(seed))
    assert flight.result.joined
    assert flight.result.losses == ()
    (left,) = [d for d in flight.of(ModeChanged) if d.mode == "escape"]
    (said,) = [d for d in flight.of(Unable) if d.t == left.t]
    assert said.reason == "separation"
    assert "there may soon be no way to keep clear" in said.message
    assert "Turning to" in left.message
    caution = flight.of(Alert)[0]
    assert (caution.level, caution.cleared) == ("caution", False)
    assert caution.t <= left.t
    assert_steady(flight)


def test_a_loss_that_cannot_be_helped_is_announced_first_and_left_the_shortest_way() -> None:
    """Two aircraft 11 km apart, nearly head-on: nothing keeps d_min."""
    flight = fly_whole(unannounced_turns(9))
    (loss,) = flight.result.losses
    assert loss.announced == (0.0,)
    assert loss.t > 10.0
    assert flight.of(PlanUnavailable)[0].t == 0.0
    warning = next(d for d in flight.of(Alert) if d.level == "warning")
    assert warning.t - loss.t <= 1.0
    assert flight.result.joined
    assert_steady(flight)


def test_what_is_said_of_the_separation_is_true_of_that_second() -> None:
    flight = fly_whole(unannounced_turns(9))
    lost = [
        d for d in flight.of(PlanUnavailable) if d.answer.reason == Reason.SEPARATION_ALREADY_LOST
    ]
    assert lost
    for document in lost:
        apart = next(s.guidance.separation for s in flight.samples if s.t == document.t)
        assert f"{apart:,.0f} m" in document.answer.message


def test_without_a_plan_one_heading_is_held_that_keeps_clear() -> None:
    nothing = NoPlan(reason=Reason.SEPARATION_UNAVOIDABLE, message="Nothing found.")
    own = replace(FIG_6B.situation.pursuer, x=60e3, y=0.0, heading=270.0 * DEG)
    head_on = replace(FIG_6B, situation=replace(FIG_6B.situation, pursuer=own))
    flight = fly_whole(replace(head_on, duration_limit=400.0), planner=lambda situation: nothing)
    assert flight.result.losses == ()
    assert_steady(flight)
    (turning,) = [d for d in flight.of(Unable) if "Turning to" in d.message]
    ((_, heading),) = set(held_headings(flight)[-1:])
    assert f"{heading / DEG:03.0f}°" in turning.message


@pytest.mark.parametrize(("heading", "turns"), [(5.0, True), (75.0, False)])
def test_inside_d_min_it_turns_away_where_that_regains_it_much_sooner(
    heading: float, turns: bool
) -> None:
    """Side by side, 5 km apart: on almost the leader's heading it would take minutes."""
    situation = Situation(
        pursuer=Pursuer(x=5_000.0, y=0.0, heading=heading * DEG, tas=215.0, max_bank=25.0 * DEG),
        leader=Leader(x=0.0, y=0.0, heading=0.0, tas=200.0),
        slot_distance=12_000.0,
        min_separation=5.0 * NM,
    )
    flight = fly_whole(replace(own_scenario(situation), duration_limit=300.0))
    said = [d.message for d in flight.of(Unable) if "regain the separation" in d.message]
    assert bool(said) == turns
    (loss,) = flight.result.losses
    assert loss.separation >= 4_950.0
    outside = next(s.t for s in flight.samples if s.guidance.separation >= 5.0 * NM)
    assert outside < 60.0


def test_where_no_plan_keeps_a_buffer_a_forecast_next_to_d_min_is_not_trusted() -> None:
    belief, assignment = observe(behind(along=12_000.0))
    memory = begin(belief)._replace(mode="follow")
    for least, leaves in ((10.0, True), (30.0, False)):
        ahead = make_forecast([assignment.min_separation + least] * 200, t=belief.t)
        outlook = Outlook(ahead, assignment.min_separation + least, belief.t + 40.0, inf)
        assert must_leave(memory, belief, assignment, outlook) == leaves
        planned = memory._replace(mode="converge", committed=committed(belief, assignment))
        assert not must_leave(planned, belief, assignment, outlook)


@pytest.mark.slow
def test_a_turn_that_would_just_lose_d_min_is_planned_for_in_time() -> None:
    """D is 0.3 NM more than d_min, and the leader is ordered to turn by 90° while followed."""
    row = fly_case(draw("follow", 221))
    assert row.joined
    assert row.losses == ()
    assert row.least_share > 1.0
