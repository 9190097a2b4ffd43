"""Which path is flown: only one that keeps d_min as it is flown."""

from dataclasses import replace
from math import inf

import pytest

from relguide.flying.airframe_files import airframe
from relguide.flying.fleet import Fleet
from relguide.flying.flight import world_of
from relguide.flying.guidance.assignment import IN_GATE
from relguide.flying.guidance.commit.proposal import NoProposal, Proposal
from relguide.flying.guidance.commit.propose import propose
from relguide.flying.guidance.settings import DEFAULT
from relguide.flying.pursuit import begin_pursuit
from relguide.flying.scenarios import own_scenario
from relguide.kernels.flight.ahead import MODE
from relguide.kernels.flight.guide import CONVERGE
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.heights import Heights
from relguide.planning.intent import FlyStraight, TurnTo
from relguide.planning.outcome import NoPlan, Plan, Reason
from relguide.planning.phrases import distance
from relguide.planning.plan import plan
from relguide.planning.situation import Situation
from relguide.planning.trajectory import LEFT, RIGHT
from relguide.planning.wind import Wind
from relguide.units import DEG, KT, NM
from tests.flights import fly_whole, random_start
from tests.liars import ends_beside
from tests.relguide.flying.guidance.beliefs import FIG_6B, behind, observe
from tests.relguide.flying.guidance.commit.proposals import propose_with

START = random_start(267)
GRAZING = own_scenario(
    replace(START, pursuer=replace(START.pursuer, max_bank=airframe("A306").max_bank))
)
"""Asked for all the bank of its type, it has little in hand: planned for d_min alone, its path is
flown within 39 m less than that."""


BARE = replace(DEFAULT, separation_buffer=1.0)
"""As good as no buffer."""


def test_a_proposal_promises_what_is_flown() -> None:
    committed = propose_with().committed
    flight = fly_whole(FIG_6B)
    assert flight.result.join_time == pytest.approx(committed.forecast.join_time, abs=1.0)
    assert committed.forecast.join_time > committed.due  # braking comes on top
    least, _ = committed.forecast.least(0.0)
    assert flight.result.least_separation == pytest.approx(least, abs=1.0)


def test_a_path_far_from_the_leaders_is_not_left_for_it() -> None:
    """In line with a piece of the leader's path, 60 km from it, and pointing the same way."""
    intent = (
        FlyStraight(duration=283.36550760514945),
        TurnTo(heading=5.583534337214632, turn=RIGHT, bank=0.2999313218701669),
        FlyStraight(duration=513.9957729660855),
        TurnTo(heading=4.070729323640768, turn=RIGHT, bank=0.4161859928167952),
        FlyStraight(duration=547.4762239247898),
        TurnTo(heading=3.9702299961192646, turn=LEFT, bank=0.40307321269826096),
    )
    situation = Situation(
        pursuer=Pursuer(
            x=-40_300.92781480177,
            y=18_177.16285078416,
            heading=4.4671182951359665,
            tas=240.32350060217098,
            max_bank=25.0 * DEG,
        ),
        leader=Leader(
            x=0.0, y=0.0, heading=3.1933427559437537, tas=151.03640149653864, intent=intent
        ),
        slot_distance=11_466.21554566015,
        min_separation=9_583.241282706625,
        wind=Wind(east=8.745426093515643, north=-9.80802859323714),
    )
    scenario = replace(own_scenario(situation), altitude=7_500.0)
    world = world_of(scenario, seed=53)
    pursuer, other = world.aircraft
    world = replace(world, aircraft=(replace(pursuer, believed=pursuer.airframe), other))
    fleet = Fleet(world, 0.05)
    pursuit = begin_pursuit(world, fleet, world.links[0])
    found = propose(pursuit.belief(fleet, 0.0), pursuit.assignment, None, plan)
    assert isinstance(found, Proposal)
    ahead, due = found.committed.forecast, found.committed.due
    modes = ahead.account[: int(due), MODE]
    assert set(modes[: int(due - 100.0)]) == {CONVERGE}
    assert due < ahead.join_time < due + 120.0  # never, while it chased the wrong piece


def test_plans_keep_d_min_and_the_buffer() -> None:
    belief, assignment = observe(GRAZING)
    found = propose(belief, assignment, None, plan)
    assert isinstance(found, Proposal)
    wanted = assignment.min_separation + DEFAULT.separation_buffer
    assert found.committed.plan.situation.min_separation == wanted
    assert found.committed.plan.certificate.least_separation >= wanted
    assert found.committed.forecast.least(0.0)[0] >= assignment.min_separation


def test_what_is_flown_too_close_is_planned_with_a_wider_berth() -> None:
    belief, assignment = observe(GRAZING, BARE)
    asked = list[float]()

    def planner(situation: Situation) -> Plan | NoPlan:
        asked.append(situation.min_separation)
        return plan(situation)

    found = propose(belief, assignment, None, planner)
    assert isinstance(found, Proposal)
    first, second = asked
    assert first == assignment.min_separation + 1.0
    assert second > first + 100.0
    assert found.committed.forecast.least(0.0)[0] >= assignment.min_separation


def test_where_no_wider_berth_is_found_it_is_not_flown_at_all() -> None:
    belief, assignment = observe(GRAZING, BARE)

    def planner(situation: Situation) -> Plan | NoPlan:
        if situation.min_separation > assignment.min_separation + 1.0:
            return NoPlan(reason=Reason.SEPARATION_UNAVOIDABLE, message="Nothing wider.")
        return plan(situation)

    found = propose(belief, assignment, None, planner)
    assert isinstance(found, NoProposal)
    assert found.answer.reason == Reason.SEPARATION_UNAVOIDABLE
    assert "an aircraft that has to roll and brake would come within" in found.answer.message
    assert "closer than 5.00 NM" in found.answer.message


def test_what_keeps_d_min_and_not_its_margin_is_refused_with_both() -> None:
    """A sentence that says "within 5.10 NM, closer than 5.00 NM" would be no reason."""
    belief, exact = observe(GRAZING, BARE)
    assignment = replace(exact, margin=300.0)

    def planner(situation: Situation) -> Plan | NoPlan:
        if situation.min_separation > assignment.buffered_separation:
            return NoPlan(reason=Reason.SEPARATION_UNAVOIDABLE, message="Nothing wider.")
        return plan(situation)

    found = propose(belief, assignment, None, planner)
    assert isinstance(found, NoProposal)
    beside = distance(assignment.kept_separation - assignment.min_separation)
    assert f"closer than 5.00 NM and the {beside} kept beside it." in found.answer.message


def test_where_nothing_keeps_the_buffer_d_min_alone_is_kept() -> None:
    belief, assignment = observe(FIG_6B)

    def planner(situation: Situation) -> Plan | NoPlan:
        if situation.min_separation > assignment.min_separation:
            return NoPlan(reason=Reason.SEPARATION_UNAVOIDABLE, message="No room for a buffer.")
        return plan(situation)

    found = propose(belief, assignment, None, planner)
    assert isinstance(found, Proposal)
    assert found.committed.plan.situation.min_separation == assignment.min_separation


def test_why_there_is_no_plan_is_passed_on() -> None:
    answer = NoPlan(reason=Reason.SLOT_UNREACHABLE, message="Too slow.")
    found = propose(*observe(FIG_6B), None, lambda situation: answer)
    assert isinstance(found, NoProposal)
    assert found.answer == answer


def test_a_lie_gives_way_to_the_exact_plan_and_is_passed_on() -> None:
    found = propose_with(ends_beside)
    assert found.fell_back
    assert found.refusal is not None
    assert found.refusal.fault == "slot"
    assert found.committed.plan.planner == "exact"


@pytest.mark.parametrize("slot_distance", [5.0 * NM, 5.05 * NM])
def test_with_d_at_d_min_it_goes_to_a_place_within_the_gate(slot_distance: float) -> None:
    """The buffer fits in the gate: it joins, and d_min is kept."""
    near = behind(along=30_000.0, abeam=8_000.0)
    situation = replace(near.situation, slot_distance=slot_distance)
    tight = replace(near, situation=situation)
    _, assignment = observe(tight)
    assert assignment.aim == situation.min_separation + DEFAULT.separation_buffer
    assert assignment.aim <= slot_distance + IN_GATE * DEFAULT.joined_along
    end = fly_whole(tight).result
    assert end.joined
    assert end.losses == ()
    assert end.join_time == pytest.approx(end.promised, abs=1.0)


def test_a_large_buffer_does_not_lead_out_of_the_gate() -> None:
    """Then what the gate has room for is kept beyond d_min."""
    near = behind(along=30_000.0)
    situation = replace(near.situation, slot_distance=near.situation.min_separation)
    tight = replace(near, situation=situation)
    _, assignment = observe(tight, replace(DEFAULT, separation_buffer=2_000.0))
    assert assignment.aim == situation.slot_distance + IN_GATE * DEFAULT.joined_along
    assert assignment.buffered_separation == assignment.aim


@pytest.mark.parametrize("tas", [230.0, 140.0])
def test_what_is_too_near_only_where_a_path_would_begin_is_not_said_of_now(tas: float) -> None:
    """1,000 ft keep both apart; plans begin at V_P, though the aircraft flies slower at first."""
    belief, assignment = observe(behind(along=5.0 * NM + 100.0, leader_tas=150.0))
    apart = replace(
        belief,
        own=belief.own._replace(tas=tas),
        intent_known=False,
        own_heights=Heights(altitude=5_000.0),
        leader_heights=Heights(altitude=5_400.0),
    )
    assert apart.counted_separation == inf
    found = propose(apart, assignment, None, plan)
    assert isinstance(found, NoProposal)
    assert found.answer.reason == Reason.SEPARATION_UNAVOIDABLE
    then = distance(5.0 * NM + 100.0 - 7.0 * (assignment.planned_tas - 150.0))
    assert found.answer.message == (
        f"In 7 s at {assignment.planned_tas / KT:.0f} kt, before another path can begin, the "
        f"aircraft would be {then} apart, closer than 5.00 NM."
    )
