"""What is said of a plan's flight before it is flown is what is flown: the cockpit's gallery."""

from dataclasses import replace
from functools import cache
from math import hypot

import pytest

from relguide.contract.bodies import NamedSituationBody, situation_from_body, situation_from_json
from relguide.contract.refusal import parse
from relguide.flying.flown_plan import flown_card
from relguide.flying.plan_documents import FlownCard, NotFlownCard
from relguide.flying.scenarios import own_scenario
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.cells import Cell, Disc
from relguide.planning.deadline import end_of
from relguide.planning.outcome import Plan
from relguide.planning.plan import plan
from relguide.planning.situation import Situation
from relguide.units import DEG, Metre
from tests.flights import Flown, fly_whole, random_start
from tests.pages import ROOT

NEAR: Metre = 50.0
"""Chords of 3° lie so near to what they draw, and a forecast of four steps a second to twenty."""
DRAWN = 25
"""So many situations are looked at, to hold each sentence against its times."""


@cache
def gallery() -> dict[str, Situation]:
    """By name; `web/test/map/gallery.test.ts` holds the file to what the cockpit lays out."""
    lines = (ROOT / "tests/golden/gallery.situations.jsonl").read_text("utf-8").splitlines()
    bodies = [parse(NamedSituationBody, line) for line in lines]
    return {str(body.id): situation_from_body(body)[0] for body in bodies}


NAMES = tuple(gallery())
FLOWN = tuple(name for name in NAMES if name != "none")


def planned(name: str) -> Plan:
    found = plan(gallery()[name])
    assert isinstance(found, Plan)
    return found


@cache
def card_of(name: str) -> FlownCard:
    card = flown_card(planned(name), plan)
    assert isinstance(card, FlownCard)
    return card


@cache
def flight_of(name: str) -> Flown:
    return fly_whole(own_scenario(gallery()[name]))


def test_the_gallery_has_twelve_of_which_one_has_no_plan() -> None:
    assert len(NAMES) == 12
    assert not isinstance(plan(gallery()["none"]), Plan)


@pytest.mark.parametrize("name", FLOWN)
def test_the_flight_joins_when_it_was_said_and_keeps_what_was_said(name: str) -> None:
    card, flight = card_of(name), flight_of(name)
    assert flight.result.joined
    assert card.join == pytest.approx(flight.result.join_time, abs=max(0.01 * card.join, 2.0))
    least = min(one.guidance.separation for one in flight.samples if one.t <= card.join)
    assert card.least == pytest.approx(least, abs=NEAR)


@pytest.mark.parametrize("name", FLOWN)
def test_its_points_are_where_it_flies(name: str) -> None:
    card = card_of(name)
    assert (card.points[0].t, card.points[-1].t) == (0.0, card.join)
    at = {one.t: one.pursuer for one in flight_of(name).samples}
    for point in card.points:
        here = at[point.t]
        assert (here.x, here.y) == pytest.approx((point.x, point.y), abs=NEAR)
        assert here.tas == pytest.approx(point.tas, abs=1.0)


def test_another_time_has_its_reason() -> None:
    assert card_of("beside").word != planned("beside").word
    assert card_of("beside").reason == (
        "It begins to turn 7 s later and flies LRL in place of RSL: 26 s more."
    )
    assert card_of("limit").reason == (
        "It begins to turn 7 s later and keeps 5.10 NM: 49 s more. "
        "It slows from 465 to 419 kt before it joins: 11 s more."
    )


@pytest.mark.parametrize("seed", range(DRAWN))
def test_a_reason_is_given_where_the_times_differ_and_nowhere_else(seed: int) -> None:
    found = plan(random_start(seed))
    if not isinstance(found, Plan):
        return
    match flown_card(found, plan):
        case FlownCard() as card:
            assert bool(card.reason) == (abs(card.join - found.time_to_converge) > 1.0)
        case NotFlownCard(reason=reason):
            assert reason.endswith(".")


def test_what_the_type_cannot_fly_says_so() -> None:
    situation = gallery()["6b"]
    slow = replace(
        situation,
        pursuer=replace(situation.pursuer, tas=60.0),
        leader=replace(situation.leader, tas=50.0),
    )
    found = plan(slow)
    assert isinstance(found, Plan)
    card = flown_card(found, plan)
    assert isinstance(card, NotFlownCard)
    assert "A306" in card.reason


def test_straight_behind_the_leader_its_route_is_captured_at_once() -> None:
    situation = gallery()["6a"]
    behind = replace(situation, pursuer=replace(situation.pursuer, x=-200e3, y=0.0))
    found = plan(behind)
    assert isinstance(found, Plan)
    card = flown_card(found, plan)
    assert isinstance(card, FlownCard)
    assert card.join == pytest.approx(found.time_to_converge, rel=0.02)
    assert card.reason


def test_a_flight_that_is_late_is_planned_by_what_is_found_by_then() -> None:
    card = flown_card(planned("head-on"), plan, until=end_of(0.0))
    assert card.reason


def test_amid_others_it_is_what_is_flown() -> None:
    situation = situation_from_json((ROOT / "examples/amid.json").read_bytes())[0]
    made = plan(situation)
    assert isinstance(made, Plan)
    card = flown_card(made, plan)
    assert isinstance(card, FlownCard)
    flown = fly_whole(own_scenario(situation))
    assert card.join == pytest.approx(flown.result.join_time, abs=2.0, rel=0.01)
    alone = flown_card(replace(made, situation=replace(situation, others=())), plan)
    assert isinstance(alone, FlownCard)
    assert card.join > alone.join + 5.0


def test_the_flight_keeps_clear_of_all_that_the_plan_keeps_clear_of() -> None:
    cell = Cell(ident="CB1", shape=Disc(x=-5e3, y=25e3, radius=9e3))
    situation = Situation(
        pursuer=Pursuer(x=-40e3, y=20e3, heading=90 * DEG, tas=235.0, max_bank=25 * DEG),
        leader=Leader(x=0.0, y=0.0, heading=90 * DEG, tas=200.0),
        slot_distance=12e3,
        min_separation=9260.0,
        others=(cell,),
    )
    found = plan(situation)
    assert isinstance(found, Plan)
    alone = plan(replace(situation, others=()))
    assert isinstance(alone, Plan)
    assert alone.word != found.word  # the cell is in the way
    card = flown_card(found, plan)
    assert isinstance(card, FlownCard)
    assert all(hypot(point.x + 5e3, point.y - 25e3) >= 9e3 for point in card.points)
