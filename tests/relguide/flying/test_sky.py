"""Flights amid others: who is seen, who is kept clear of, and what is said of it."""

from collections.abc import Iterable
from dataclasses import replace

import pytest

from relguide.contract.wire import to_wire
from relguide.flying.airframe_files import airframe
from relguide.flying.documents import (
    Alert,
    Document,
    FlightEnded,
    FlightStarted,
    ModeChanged,
    PlanChanged,
    SeparationLost,
    Unable,
)
from relguide.flying.fleet import Fleet
from relguide.flying.flight import Scenario, world_of
from relguide.flying.pursuit import begin_pursuit
from relguide.flying.scenarios import own_scenario, scenario
from relguide.flying.simulation import simulate
from relguide.flying.sky import DOUBTED_FOR, Sky
from relguide.flying.surveillance import Surveillance
from relguide.flying.world import Aircraft, Declared, Guided, Link, World
from relguide.planning.aircraft import Leader, Pursuer, Traffic
from relguide.planning.cells import Cell, Disc
from relguide.planning.intent import FlyStraight, TurnTo
from relguide.planning.plan import plan
from relguide.planning.situation import Other, Situation
from relguide.planning.trajectory import LEFT, RIGHT, Turn
from relguide.units import DEG, NM
from tests.flights import Flown, fly_whole

LIMIT = 5.0 * NM
CROSSING = Traffic(
    ident="BAW12", x=35_000.0, y=-10_000.0, heading=270.0 * DEG, tas=220.0, min_separation=LIMIT
)


def amid(*others: Other) -> Scenario:
    """Forty kilometres behind a leader that flies north, with others in the way."""
    return own_scenario(
        Situation(
            pursuer=Pursuer(x=0.0, y=-40_000.0, heading=0.0, tas=230.0, max_bank=25.0 * DEG),
            leader=Leader(x=0.0, y=0.0, heading=0.0, tas=180.0),
            slot_distance=11_000.0,
            min_separation=LIMIT,
            others=others,
        )
    )


def flown(world: World, until: float = 3600.0) -> Flown:
    return Flown(tuple(simulate(world, plan, sample_period=1.0, until=until)))


def breaking(scenario: Scenario, *, after: float, to: float, turn: Turn) -> World:
    """The other declares to fly straight on, and turns to another heading."""
    world = world_of(scenario)
    pilot = Declared(
        intent=(
            FlyStraight(duration=after),
            TurnTo(heading=to * DEG, turn=turn, bank=25.0 * DEG),
        ),
        declares=(),
    )
    pursuer, leader, other = world.aircraft
    return replace(world, aircraft=(pursuer, leader, replace(other, pilot=pilot)))


def separation_lost(documents: Iterable[Document]) -> list[SeparationLost]:
    return [document for document in documents if isinstance(document, SeparationLost)]


@pytest.mark.parametrize("name", ["crossing_stream", "thunderstorm_line"])
def test_named_flights_amid_others_join_and_keep_clear_of_all(name: str) -> None:
    flight = fly_whole(scenario(name))
    assert flight.end.reason == "joined"
    assert separation_lost(flight.documents) == []
    (nearest,) = flight.result.least_other
    assert 0.0 <= nearest.separation - nearest.min_separation < 1_000.0
    alone = replace(scenario(name), situation=replace(scenario(name).situation, others=()))
    assert fly_whole(alone).result.join_time < flight.result.join_time


def test_an_unlinked_aircraft_is_planned_around() -> None:
    """Alone the pursuer would come within a mile of it."""
    flight = fly_whole(amid(CROSSING))
    assert flight.end.reason == "joined"
    (nearest,) = flight.result.least_other
    assert nearest.ident == "BAW12"
    assert LIMIT <= nearest.separation < LIMIT + NM
    assert flight.of(Alert) == []


def test_one_that_breaks_its_word_is_avoided_and_named() -> None:
    oncoming = replace(CROSSING, x=16_000.0, y=60_000.0, heading=180.0 * DEG)
    flight = flown(breaking(amid(oncoming), after=100.0, to=225.0, turn=RIGHT))
    replanned = [d for d in flight.of(PlanChanged) if d.reason == "traffic"]
    assert replanned
    assert replanned[0].message.startswith("BAW12 ")
    for lost in separation_lost(flight.documents):
        assert lost.announced
    assert flight.end.reason == "joined"


def test_a_loss_to_another_names_it_and_was_announced() -> None:
    """It turns toward the pursuer where there is no way out."""
    abeam = replace(CROSSING, x=LIMIT + 300.0, y=-40_000.0, heading=0.0, tas=230.0)
    flight = flown(breaking(amid(abeam), after=5.0, to=270.0, turn=LEFT), until=200.0)
    (lost,) = separation_lost(flight.documents)
    (loss,) = flight.result.losses
    assert (lost.other, loss.other) == ("BAW12", "BAW12")
    assert lost.announced
    assert lost.announced[0] < lost.t
    alerts = [d for d in flight.of(Alert) if d.other == "BAW12"]
    assert [d.level for d in alerts][:2] == ["caution", "warning"]
    (unable,) = (d for d in flight.of(Unable) if d.reason == "separation")
    assert unable.message.startswith("Unable: In ")
    assert "before another path can begin, the pursuer is 4." in unable.message
    assert any(d.reason == "traffic" for d in flight.of(Unable))
    assert to_wire(flight.end)["results"][0]["losses"][0]["other"] == "BAW12"


def test_weather_is_flown_around() -> None:
    cell = Cell(ident="CB1", shape=Disc(x=3_000.0, y=15_000.0, radius=9_000.0), growth=2.0)
    flight = fly_whole(amid(cell))
    assert flight.end.reason == "joined"
    (nearest,) = flight.result.least_other
    assert (nearest.ident, nearest.min_separation) == ("CB1", 0.0)
    assert nearest.separation >= 0.0
    (started,) = flight.of(FlightStarted)
    (card,) = started.cells
    assert (card.ident, card.x, card.radius, card.growth) == ("CB1", (3_000.0,), 9_000.0, 2.0)


def test_traffic_at_another_level_is_no_matter() -> None:
    above = replace(CROSSING, altitude=amid().altitude + 700.0)
    flight = fly_whole(amid(above))
    assert flight.result.least_other == ()
    assert flight.result.join_time == fly_whole(amid()).result.join_time
    assert not any(isinstance(d, Alert | SeparationLost) for d in flight.documents)


def test_without_others_no_document_says_a_word_of_them() -> None:
    flight = fly_whole(amid())
    written = [to_wire(document) for document in flight.documents]
    assert "cells" not in written[0]
    (result,) = written[-1]["results"]
    assert "least_other" not in result
    assert flight.result.least_other == ()


def guided(ident: str, x: float, y: float, heading: float) -> Aircraft:
    return Aircraft(
        ident=ident,
        airframe=airframe("A306"),
        aircraft_type="A306",
        x=x,
        y=y,
        heading=heading * DEG,
        tas=230.0,
        altitude=9_000.0,
        max_bank=25.0 * DEG,
        pilot=Guided(),
    )


def leader(ident: str, x: float, y: float, heading: float) -> Aircraft:
    return replace(guided(ident, x, y, heading), tas=190.0, pilot=Declared())


def two_pairs() -> World:
    """Their ways cross: each makes for the leader on the other side."""
    return World(
        aircraft=(
            guided("P1", -45_000.0, 0.0, 45.0),
            leader("L1", 20_000.0, 45_000.0, 0.0),
            guided("P2", 45_000.0, 0.0, 315.0),
            leader("L2", -20_000.0, 45_000.0, 0.0),
        ),
        links=tuple(
            Link(pursuer=p, leader=l, slot_distance=10_500.0, min_separation=LIMIT)
            for p, l in (("P1", "L1"), ("P2", "L2"))
        ),
    )


def test_two_pursuers_whose_ways_cross_keep_clear_of_each_other() -> None:
    flight = flown(two_pairs())
    assert flight.end.reason == "joined"
    assert separation_lost(flight.documents) == []
    for result in flight.end.results:
        (nearest,) = result.least_other
        assert nearest.separation >= LIMIT


def test_all_are_seen_but_oneself_and_the_leader() -> None:
    world = two_pairs()
    fleet = Fleet(world, 0.05)
    sky = Sky(world, fleet)
    pursuits = [begin_pursuit(world, fleet, link) for link in world.links]
    first = pursuits[0]
    seen = sky.seen_by(first, pursuits, first.belief(fleet, 0.0))
    assert [other.ident for other in seen.others] == ["P2", "L2"]
    assert [other.declared for other in seen.others] == [False, True]  # P2 has no path yet
    assert {other.min_separation for other in seen.others} == {LIMIT}


def test_the_minimum_of_an_aircraft_itself_counts_before_that_of_the_link() -> None:
    world = world_of(amid(replace(CROSSING, min_separation=12_000.0)))
    fleet = Fleet(world, 0.05)
    one = begin_pursuit(world, fleet, world.links[0])
    (other,) = Sky(world, fleet).seen_by(one, [one], one.belief(fleet, 0.0)).others
    assert other.min_separation == 12_000.0


def test_a_broken_word_is_found_out_and_no_longer_relied_on() -> None:
    world = breaking(amid(CROSSING), after=20.0, to=180.0, turn=LEFT)
    fleet = Fleet(world, 0.05)
    sky = Sky(world, fleet)
    one = begin_pursuit(world, fleet, world.links[0])
    found = []
    for second in range(60):
        t = float(second)
        (other,) = sky.seen_by(one, [one], one.belief(fleet, t)).others
        found.append((other.declared, other.broke_its_word))
        fleet.fly_second(t)
        sky.fly_second(t)
    since = found.index((False, True))
    assert 20 + DOUBTED_FOR <= since <= 45
    assert found == [(True, False)] * since + [(False, True)] * (60 - since)


def test_others_are_seen_through_the_same_surveillance() -> None:
    world = replace(world_of(amid(CROSSING)), surveillance=Surveillance(kind="adsb"))
    fleet = Fleet(world, 0.05)
    sky = Sky(world, fleet)
    one = begin_pursuit(world, fleet, world.links[0])
    offs = []
    for second in range(30):
        (other,) = sky.seen_by(one, [one], one.belief(fleet, float(second))).others
        true = fleet.body(2)
        offs.append(abs(other.body.x - true.x) + abs(other.body.y - true.y))
        assert other.margin > 0.0
        fleet.fly_second(float(second))
        sky.fly_second(float(second))
    assert 0.0 < max(offs) < 200.0


def test_results_are_one_for_each_link() -> None:
    (end,) = [d for d in simulate(two_pairs(), plan, until=5.0) if isinstance(d, FlightEnded)]
    assert len(end.results) == 2


def test_a_pursuer_that_follows_leaves_for_another_and_comes_back() -> None:
    """The other crosses six minutes after joining, later than any plan looks."""
    crossing = replace(CROSSING, x=100_000.0, y=61_000.0)
    situation = Situation(
        pursuer=Pursuer(x=0.0, y=-12_000.0, heading=0.0, tas=200.0, max_bank=25.0 * DEG),
        leader=Leader(x=0.0, y=0.0, heading=0.0, tas=180.0),
        slot_distance=11_000.0,
        min_separation=LIMIT,
        others=(crossing,),
    )
    flight = fly_whole(replace(own_scenario(situation), after_joining=500.0))
    modes = [(d.t, d.mode) for d in flight.of(ModeChanged)]
    joined = next(t for t, mode in modes if mode == "follow")
    left = next(t for t, mode in modes if t > joined)
    assert left > joined + 120.0
    said = [d for d in flight.documents if d.t == left and isinstance(d, PlanChanged | Unable)]
    assert any("BAW12" in d.message and d.reason == "traffic" for d in said)
    assert separation_lost(flight.documents) == []
    assert flight.result.least_other[0].separation >= LIMIT
    assert modes[-1][1] == "follow"
