"""Aircraft of a world fly together: each by its own pilot, in one wind, and linked or not."""

from dataclasses import replace
from math import hypot, pi

import numpy as np
import pytest

from relguide.flying.abilities import limits_of
from relguide.flying.air import Air
from relguide.flying.airframe_files import airframe
from relguide.flying.documents import FlightEnded, FlightStarted, Sample, Unable
from relguide.flying.fleet import Fleet
from relguide.flying.flight import fly
from relguide.flying.knowledge import OFF_HEADING, OFF_INTENT, as_declared, breaks_its_word
from relguide.flying.pursuit import begin_pursuit
from relguide.flying.scenarios import scenario
from relguide.flying.simulation import simulate
from relguide.flying.world import (
    FLOWN_POSITION,
    Aircraft,
    Declared,
    Guided,
    Link,
    Pilot,
    Recorded,
    World,
)
from relguide.kernels.flight.energy import most_acceleration
from relguide.kernels.flight.flight_records import HOLD_HEADING, Control
from relguide.planning.intent import FlyStraight, TurnTo
from relguide.planning.limits import POSITION, TAS
from relguide.planning.plan import plan
from relguide.planning.trajectory import RIGHT
from relguide.planning.wind import Wind
from relguide.units import DEG, NM
from tests.flights import random_start
from tests.recording import SPEED, recording

A306 = airframe("A306")
TURNING = Declared(
    intent=(
        FlyStraight(duration=20.0),
        TurnTo(heading=180.0 * DEG, turn=RIGHT, bank=25.0 * DEG),
    )
)


def aircraft(
    ident: str, x: float = 0.0, y: float = 0.0, *, heading: float = 90.0, tas: float = 200.0,
    pilot: Pilot | None = None, weight: float = 0.0,
) -> Aircraft:  # fmt: skip
    return Aircraft(
        ident=ident, airframe=A306, aircraft_type="A306", x=x, y=y, heading=heading * DEG, tas=tas,
        altitude=9449.0, max_bank=25.0 * DEG, pilot=pilot or Guided(), weight=weight,
    )  # fmt: skip


def link(pursuer: str, leader: str) -> Link:
    return Link(pursuer=pursuer, leader=leader, slot_distance=12_000.0, min_separation=5.0 * NM)


def chain(*, wind: Wind | None = None) -> World:
    """C joins B, which joins A."""
    return World(
        aircraft=(
            aircraft("A", pilot=Declared(), tas=190.0),
            aircraft("B", -35_000.0, 8_000.0, tas=225.0),
            aircraft("C", -60_000.0, -20_000.0, tas=235.0),
        ),
        links=(link("B", "A"), link("C", "B")),
        air=Air(wind=wind) if wind else Air(),
    )


def fly_seconds(fleet: Fleet, seconds: int, begin: int = 0) -> np.ndarray:
    """All states each second. shape (seconds + 1, n, 7)"""
    rows = [fleet.states.copy()]
    for second in range(begin, begin + seconds):
        fleet.fly_second(float(second))
        rows.append(fleet.states.copy())
    return np.array(rows)


def test_a_leader_turns_as_declared_while_the_others_hold_on() -> None:
    fleet = Fleet(
        World(
            aircraft=(aircraft("P"), aircraft("L", 9e3, pilot=TURNING)),
            links=(link("P", "L"),),
            air=Air(wind=Wind(east=-20.0, north=5.0)),
        ),
        0.05,
    )
    rows = fly_seconds(fleet, 150)
    assert rows[-1, 0, :3] == pytest.approx([150.0 * 180.0, 150.0 * 5.0, 90.0 * DEG])
    assert rows[-1, 1, 2] == pytest.approx(180.0 * DEG, abs=0.2 * DEG)
    assert fleet.cursors[1] == 2
    assert fleet.tallies[1, 0] == pytest.approx(90.0 * DEG, abs=1.0 * DEG)
    assert fleet.state(1).heading == pytest.approx(fleet.body(1).heading)


def test_guided_aircraft_fly_what_is_asked_and_documents_wrap_headings() -> None:
    fleet = Fleet(World(aircraft=(aircraft("P", heading=350.0),), links=()), 0.05)
    fleet.control(0, Control(HOLD_HEADING, 10.0 * DEG, 210.0))
    fly_seconds(fleet, 120)
    assert fleet.body(0).heading == pytest.approx(370.0 * DEG, abs=0.1 * DEG)
    state = fleet.state(0)
    assert state.heading == pytest.approx(10.0 * DEG, abs=0.1 * DEG)
    assert state.tas == pytest.approx(210.0, abs=0.1)
    assert fleet.state(0, 0).x < fleet.state(0, 10).x < state.x


def test_a_recorded_leader_is_where_it_was_recorded() -> None:
    track = recording(90, turns_at=30.0)
    fleet = Fleet(World(aircraft=(aircraft("R", pilot=Recorded(track=track)),), links=()), 0.05)
    assert fleet.recorded_until() == 90.0
    for t, row in enumerate(fly_seconds(fleet, 90)):
        there = track.state_at(float(t))
        assert tuple(row[0, :2]) == pytest.approx((there.x, there.y))
    assert fleet.state(0, 10).x == pytest.approx(track.state_at(89.5).x)


@pytest.mark.parametrize("order", ["turn", "speed"])
def test_an_ordered_leader_leaves_its_recording(order: str) -> None:
    track = recording(200, turns_at=30.0)
    fleet = Fleet(World(aircraft=(aircraft("R", pilot=Recorded(track=track)),), links=()), 0.05)
    fly_seconds(fleet, 60)
    before = fleet.body(0)
    if order == "turn":
        fleet.turn(0, 350.0 * DEG, "left", 25.0 * DEG)
    else:
        fleet.set_speed(0, 160.0)
    assert fleet.recorded_until() == np.inf
    after = fly_seconds(fleet, 120, begin=60)[:, 0]
    # on from where it was: nothing jumps
    assert np.max(np.hypot(*np.diff(after[:, :2], axis=0).T)) < SPEED + 1.0
    assert np.max(np.abs(np.diff(after[:, 2]))) < 3.0 * DEG
    there = track.state_at(180.0)
    assert hypot(after[-1, 0] - there.x, after[-1, 1] - there.y) > 1_000.0
    if order == "turn":
        assert after[-1, 2] == pytest.approx(-10.0 * DEG, abs=0.2 * DEG)
        assert after[-1, 5] == pytest.approx(SPEED, abs=0.1)
    else:
        assert after[-1, 2] == pytest.approx(before.heading, abs=0.2 * DEG)
        assert after[-1, 5] == pytest.approx(160.0, abs=0.1)


@pytest.mark.parametrize(("heading", "direction", "turned"), [
    (85.0, "right", 355.0), (91.0, "left", -359.0), (95.0, "shorter", 5.0),
])  # fmt: skip
def test_an_ordered_turn_goes_the_way_round_that_was_said(
    heading: float, direction: str, turned: float
) -> None:
    fleet = Fleet(World(aircraft=(aircraft("L", pilot=Declared()),), links=()), 0.05)
    fleet.turn(0, heading * DEG, direction, 25.0 * DEG)  # type: ignore[arg-type]
    rows = fly_seconds(fleet, 340)
    assert rows[-1, 0, 2] == pytest.approx((90.0 + turned) * DEG, abs=0.2 * DEG)


def test_a_speed_is_taken_up_and_the_intent_kept() -> None:
    fleet = Fleet(World(aircraft=(aircraft("L", pilot=TURNING),), links=()), 0.05)
    fleet.set_speed(0, 170.0)
    rows = fly_seconds(fleet, 200)
    assert rows[-1, 0, 5] == pytest.approx(170.0, abs=0.1)
    assert rows[-1, 0, 2] == pytest.approx(180.0 * DEG, abs=0.2 * DEG)
    idle = A306.idle_deceleration(9449.0, 200.0, Air())
    assert np.min(np.diff(rows[:, 0, 5])) >= -idle - 1e-9


def test_a_leader_slows_down_nearly_as_fast_as_it_can_without_brakes() -> None:
    fleet = Fleet(World(aircraft=(aircraft("L", pilot=Declared()),), links=()), 0.05)
    fleet.set_speed(0, 150.0)
    fastest = -np.min(np.diff(fly_seconds(fleet, 60)[:, 0, 5]))
    idle = A306.idle_deceleration(9449.0, 200.0, Air())
    assert 0.95 * idle < fastest <= idle + 1e-9


def test_leaders_fly_any_speed_and_pursuers_only_what_their_type_can() -> None:
    fleet = Fleet(World(aircraft=(aircraft("P"), aircraft("L", pilot=Declared())), links=()), 0.05)
    envelope = A306.tas_range(9449.0, Air())
    assert tuple(fleet.limits[0, -2:]) == (envelope.least, envelope.most)
    assert tuple(fleet.limits[1, -2:]) == (TAS.low, TAS.high)


def test_a_heavy_aircraft_speeds_up_and_turns_as_its_weight_lets_it() -> None:
    light, heavy = (
        limits_of(aircraft("P", weight=weight), A306, Air()) for weight in (90e3, 140e3)
    )
    assert heavy.min_tas == A306.tas_range(9449.0, Air(), 140e3).least > light.min_tas
    assert heavy.induced == pytest.approx(light.induced * 140.0 / 90.0)
    assert most_acceleration(heavy, 230.0, 1.0) == pytest.approx(
        A306.excess_acceleration(9449.0, 230.0, Air(), 140e3), abs=0.01
    )


def test_a_weight_that_its_type_does_not_fly_at_is_refused() -> None:
    with pytest.raises(ValueError, match=r"weight must lie in 90,000 … 171,700 kg for the A306"):
        aircraft("P", weight=60e3)
    assert aircraft("P", weight=171e3).weight == 171e3


def test_guidance_may_believe_another_airframe_than_flies() -> None:
    slow = replace(A306, max_roll_rate=0.7 * A306.max_roll_rate)
    world = World(
        aircraft=(replace(aircraft("P"), airframe=slow, believed=A306),
                  aircraft("L", 3e4, pilot=Declared())),
        links=(link("P", "L"),),
    )  # fmt: skip
    fleet = Fleet(world, 0.05)
    belief = begin_pursuit(world, fleet, world.links[0]).belief(fleet, 0.0)
    assert belief.limits.max_roll_rate == A306.max_roll_rate
    assert fleet.limits[0, 1] == slow.max_roll_rate


def test_least_distances_are_those_within_the_second() -> None:
    """Head on, 30 m beside each other."""
    world = World(
        aircraft=(
            aircraft("A", pilot=Declared()),
            aircraft("B", 5_050.0, 30.0, heading=270.0, tas=210.0, pilot=Declared()),
        ),
        links=(),
    )
    fleet = Fleet(world, 0.05)
    fly_seconds(fleet, 12)
    assert fleet.apart(0, 1) > 90.0
    fleet.fly_second(12.0)
    assert fleet.least_apart(0, 1) == pytest.approx(30.0, abs=0.01)
    assert fleet.apart(0, 1) > 200.0


def test_the_edge_of_the_plane_is_noticed_before_plans_are_refused_for_it() -> None:
    x = FLOWN_POSITION.high - 500.0
    fleet = Fleet(World(aircraft=(aircraft("A"), aircraft("B", x)), links=()), 0.05)
    assert fleet.beyond_edge() == ""
    fly_seconds(fleet, 3)
    assert fleet.beyond_edge() == "B"
    assert np.max(np.abs(fleet.states[:, :2])) < POSITION.high


def test_a_leader_breaks_its_word_once_it_is_far_from_what_it_declared() -> None:
    fleet = Fleet(World(aircraft=(aircraft("L", pilot=TURNING),), links=()), 0.05)
    told = as_declared(fleet, 0, ())
    for second in range(80):
        fleet.fly_second(float(second))
        told.fly_second(float(second))
        here, there = fleet.states[0], told.states[0]
        far = hypot(here[0] - there[0], here[1] - there[1]) > OFF_INTENT
        assert breaks_its_word(fleet, 0, told) == (far or abs(here[2] - there[2]) > OFF_HEADING)
    assert breaks_its_word(fleet, 0, told)
    assert not breaks_its_word(fleet, 0, fleet)


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"links": (link("P", "Q"),)}, "There is no aircraft 'Q' to link"),
        ({"links": (link("P", "P"),)}, "'P' cannot follow itself"),
        ({"aircraft": (aircraft("P"), aircraft("P"))}, "an ident of its own"),
    ],
)
def test_impossible_worlds_are_refused(change: dict[str, object], sentence: str) -> None:
    world = World(aircraft=(aircraft("P"), aircraft("L", pilot=Declared())), links=())
    with pytest.raises(ValueError, match=sentence):
        replace(world, **change)  # type: ignore[arg-type]


@pytest.mark.slow
def test_a_chain_of_two_links_joins_link_by_link() -> None:
    documents = list(
        simulate(
            chain(wind=Wind(east=10.0, north=15.0)),
            plan,
            scenario="chain",
            title="A chain",
            sample_period=1.0,
            until=2_400.0,
            after_joining=60.0,
        )
    )
    first, last = documents[0], documents[-1]
    assert isinstance(first, FlightStarted)
    assert [card.ident for card in first.aircraft] == ["A", "B", "C"]
    assert [(card.pursuer, card.leader) for card in first.links] == [("B", "A"), ("C", "B")]
    assert isinstance(last, FlightEnded)
    assert [(result.ident, result.joined) for result in last.results] == [("B", True), ("C", True)]
    for result in last.results:
        assert result.least_separation >= 5.0 * NM
        assert not result.losses
    end = [document for document in documents if isinstance(document, Sample)][-1]
    a, b, c = end.aircraft
    for one, other in ((a, b), (b, c)):
        assert hypot(one.x - other.x, one.y - other.y) == pytest.approx(12_000.0, abs=400.0)
        turned = (one.heading - other.heading + pi) % (2.0 * pi) - pi
        assert abs(turned) < 2.0 * DEG


def test_a_flight_ends_with_a_sentence_where_an_aircraft_leaves_the_plane() -> None:
    x = FLOWN_POSITION.high - 5_000.0
    world = World(
        aircraft=(aircraft("P", x - 40_000.0, tas=230.0), aircraft("L", x, pilot=Declared())),
        links=(link("P", "L"),),
    )
    documents = list(
        simulate(
            world,
            plan,
            scenario="edge",
            title="The edge",
            sample_period=1.0,
            until=600.0,
            after_joining=60.0,
        )
    )
    (said,) = [document for document in documents if isinstance(document, Unable)]
    assert (said.reason, said.t) == ("geometry", 26.0)
    assert said.message.startswith("L leaves the plane of this flight")
    ended = documents[-1]
    assert isinstance(ended, FlightEnded)
    assert (ended.t, ended.reason, ended.message) == (said.t, "plane_left", said.message)


@pytest.mark.slow
@pytest.mark.parametrize("drawn", [None, 1, 2])
def test_whole_flights_hardly_depend_on_the_step(drawn: int | None) -> None:
    """Planning included, within a metre a minute; measured: 0.4 m."""
    flight = scenario("fig_6a")
    if drawn is not None:
        flight = replace(flight, situation=random_start(drawn, wind=20.0))
    coarse, fine = (
        [
            document
            for document in fly(flight, plan, step=step, sample_period=1.0)
            if isinstance(document, Sample)
        ]
        for step in (0.05, 0.01)
    )
    assert len(coarse) == len(fine)
    for one, other in zip(coarse, fine, strict=True):
        for here, there in zip(one.aircraft, other.aircraft, strict=True):
            assert hypot(here.x - there.x, here.y - there.y) < max(one.t / 60.0, 1.0)
