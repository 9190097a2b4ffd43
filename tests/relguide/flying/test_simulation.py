"""The closed loop: what it says in order, what it draws ahead, and how separation is lost in it."""

from dataclasses import replace
from itertools import pairwise
from math import hypot

import numpy as np
import pytest

from relguide.flying.airframe_files import airframe
from relguide.flying.documents import (
    Document,
    FlightEnded,
    FlightStarted,
    ForecastChanged,
    LeaderChanged,
    LeaderRoute,
    ModeChanged,
    PlanChanged,
    Sample,
    SeparationLost,
)
from relguide.flying.flight import (
    IntentKnown,
    LeaderHeading,
    LeaderSpeed,
    Scenario,
    fly,
    world_of,
)
from relguide.flying.guidance.settings import DEFAULT
from relguide.flying.metrics import RECENT
from relguide.flying.scenarios import fig_6, own_scenario
from relguide.flying.simulation import simulate, whole_steps
from relguide.flying.world import Aircraft, Declared, Guided, Link, World
from relguide.planning.aircraft import Leader, Pursuer
from relguide.planning.outcome import NoPlan, Plan
from relguide.planning.plan import plan
from relguide.planning.situation import Situation
from relguide.units import DEG, NM
from tests.flights import Flown, fly_whole, random_start, saying
from tests.recording import recording

FIG_6B = fig_6(intent_known=True)
LIMIT = 5.0 * NM


@pytest.fixture(scope="module")
def fig_6b() -> Flown:
    return fly_whole(FIG_6B)


def head_on(*, apart: float = 11_000.0) -> Scenario:
    """Too near to turn away."""
    situation = Situation(
        pursuer=Pursuer(x=0.0, y=-apart, heading=0.0, tas=230.0, max_bank=25.0 * DEG),
        leader=Leader(x=0.0, y=0.0, heading=180.0 * DEG, tas=200.0),
        slot_distance=10_000.0,
        min_separation=LIMIT,
    )
    return replace(own_scenario(situation), duration_limit=300.0)


def craft(ident: str, pilot: Guided | Declared, *, x: float, y: float, tas: float) -> Aircraft:
    type_ = airframe("A306")
    return Aircraft(
        ident=ident, airframe=type_, aircraft_type=type_.designator, x=x, y=y, heading=0.0,
        tas=tas, altitude=9_449.0, max_bank=25.0 * DEG, pilot=pilot,
    )  # fmt: skip


def chain() -> World:
    """C joins B, which joins A."""
    return World(
        aircraft=(
            craft("A", Declared(), x=0.0, y=0.0, tas=200.0),
            craft("B", Guided(), x=-9_000.0, y=-32_000.0, tas=225.0),
            craft("C", Guided(), x=12_000.0, y=-60_000.0, tas=235.0),
        ),
        links=(
            Link(pursuer="B", leader="A", slot_distance=10_000.0, min_separation=LIMIT),
            Link(pursuer="C", leader="B", slot_distance=11_000.0, min_separation=LIMIT),
        ),
    )


def test_documents_come_in_order_of_time_and_samples_as_often_as_asked() -> None:
    for period in (0.05, 0.5, 2.0):
        documents = list(fly(replace(FIG_6B, duration_limit=20.0), plan, sample_period=period))
        assert isinstance(documents[0], FlightStarted)
        assert isinstance(documents[-1], FlightEnded)
        assert all(a.t <= b.t for a, b in pairwise(documents))
        times = [d.t for d in documents if isinstance(d, Sample)]
        assert times == pytest.approx(list(np.arange(len(times)) * period))
        assert times[-1] == documents[-1].t == 20.0


def test_a_forecast_is_drawn_when_it_is_news_and_then_flown(fig_6b: Flown) -> None:
    first, *others = fig_6b.of(ForecastChanged)
    assert first.t == first.times[0] == 0.0
    assert len(others) < 10
    places = {s.t: s.pursuer for s in fig_6b.samples}
    off = [
        hypot(x - places[t].x, y - places[t].y)
        for t, x, y in zip(first.times, first.x, first.y, strict=True)
        if t in places
    ]
    assert max(off) < DEFAULT.own_off
    assert first.times[-1] >= fig_6b.result.join_time


def test_whom_a_forecast_is_of_is_said() -> None:
    documents = list(simulate(chain(), plan, sample_period=1.0, until=30.0))
    first = [d for d in documents if isinstance(d, ForecastChanged) and d.t == 0.0]
    assert [d.ident for d in first] == ["B", "C"]
    for document, start in zip(first, (-9_000.0, 12_000.0), strict=True):
        assert document.x[0] == start


def test_a_loss_is_a_document_with_its_place_cause_and_announcement() -> None:
    flight = fly_whole(head_on())
    (lost,) = flight.of(SeparationLost)
    (loss,) = flight.result.losses
    near = next(s for s in flight.samples if s.t == np.floor(lost.t))
    assert (lost.ident, lost.other) == ("PURSUER", "LEADER")
    assert LIMIT - 430.0 * 0.05 - 1.0 <= lost.separation < LIMIT  # found within a step
    assert hypot(lost.x - near.pursuer.x, lost.y - near.pursuer.y) < 240.0
    assert lost.cause == "There was no path that kept it."
    assert lost.announced == loss.announced == (0.0,)
    assert (loss.t, loss.cause) == (lost.t, lost.cause)
    # the summary has the least of it
    least = min(s.guidance.separation for s in flight.samples)
    assert loss.separation == flight.result.least_separation == pytest.approx(least, abs=30.0)


def test_a_loss_while_guidance_is_not_engaged_is_the_crews() -> None:
    """It said that there was no path, which guidance had not looked for."""
    documents = fly(head_on(), plan, engagement="off", sample_period=1.0)
    lost = next(document for document in documents if isinstance(document, SeparationLost))
    assert lost.cause == "Guidance was not engaged: the crew flew."


def test_the_least_separation_so_far_knows_nothing_of_what_comes() -> None:
    """Each second is flown as a whole, and then shown piece by piece."""
    least = np.inf
    for seen in fly_whole(head_on()).samples:
        least = min(least, seen.guidance.separation)
        assert seen.guidance.least_separation <= least
        # between two samples it may have been a little less
        assert seen.guidance.least_separation == pytest.approx(least, abs=30.0)


def test_a_loss_goes_on_until_the_separation_is_back() -> None:
    """Once below d_min is one loss, however long."""
    flight = fly_whole(head_on())
    below = [s.t for s in flight.samples if s.guidance.separation < LIMIT]
    assert len(below) > 20
    assert len(flight.of(SeparationLost)) == 1


def test_without_a_loss_none_is_said(fig_6b: Flown) -> None:
    assert fig_6b.of(SeparationLost) == []
    assert fig_6b.result.losses == ()


def test_what_the_leader_was_ordered_is_the_cause_for_a_while() -> None:
    for order, cause in (
        (LeaderSpeed(tas=210.0), "The leader was ordered to another speed."),
        (LeaderHeading(heading=180.5 * DEG), "The leader was ordered to turn."),
    ):
        (loss,) = fly_whole(head_on(), (1.0, order)).result.losses
        assert loss.cause == cause
        assert loss.t - 1.0 < RECENT
        assert loss.announced == (0.0,)


def test_orders_are_carried_out_at_whole_seconds_and_said_once() -> None:
    orders = (
        (10.0, LeaderSpeed(tas=190.0)),
        (20.4, LeaderHeading(heading=1.0)),
        (30.0, IntentKnown(known=False)),
        (30.0, IntentKnown(known=False)),
    )
    flight = fly_whole(replace(FIG_6B, duration_limit=40.0), *orders)
    said = [(d.t, d.change) for d in flight.of(LeaderChanged)]
    assert said[:3] == [(10.0, "speed"), (21.0, "heading"), (30.0, "intent_withdrawn")]
    assert [c for _, c in said].count("intent_withdrawn") == 1
    routes = {d.t: d.intent_known for d in flight.of(LeaderRoute)}
    assert routes[0.0] is routes[21.0] is True
    assert routes[30.0] is False


def test_orders_are_for_the_leader_of_the_first_link() -> None:
    orders = saying((5.0, LeaderSpeed(tas=190.0)))
    documents = list(simulate(chain(), commands=orders, sample_period=1.0, until=60.0))
    (said,) = [d for d in documents if isinstance(d, LeaderChanged) and d.change == "speed"]
    assert said.ident == "A"
    last = [d for d in documents if isinstance(d, Sample)][-1]
    assert [round(a.tas) for a in last.aircraft] == [190, 225, 235]


@pytest.fixture(scope="module")
def chained() -> list[Document]:
    return list(simulate(chain(), sample_period=1.0, after_joining=60.0))


def test_three_in_a_chain_all_join_and_the_flight_goes_on_a_while(chained: list[Document]) -> None:
    end = chained[-1]
    assert isinstance(end, FlightEnded)
    assert [(r.ident, r.leader) for r in end.results] == [("B", "A"), ("C", "B")]
    assert all(result.joined for result in end.results)
    assert all(result.losses == () for result in end.results)
    follows = [d.t for d in chained if isinstance(d, ModeChanged) and d.mode == "follow"]
    assert end.t == max(follows) + 60.0
    last = [d for d in chained if isinstance(d, Sample)][-1]
    assert [g.joined for g in last.guidance] == [True, True]
    a, b, c = last.aircraft
    assert hypot(a.x - b.x, a.y - b.y) == pytest.approx(10_000.0, abs=50.0)
    assert hypot(b.x - c.x, b.y - c.y) == pytest.approx(11_000.0, abs=50.0)


def test_each_document_says_whom_it_is_about(chained: list[Document]) -> None:
    plans = {d.ident for d in chained if isinstance(d, PlanChanged)}
    routes = {(d.ident, d.expected_by) for d in chained if isinstance(d, LeaderRoute)}
    assert plans == {"B", "C"}
    assert routes == {("A", "B"), ("B", "C")}
    (started,) = [d for d in chained if isinstance(d, FlightStarted)]
    assert [link.pursuer for link in started.links] == ["B", "C"]


def test_a_flight_ends_at_its_limit_or_once_followed_for_long_enough(fig_6b: Flown) -> None:
    assert fly_whole(replace(FIG_6B, duration_limit=77.0)).end.t == 77.0
    follow = next(d.t for d in fig_6b.of(ModeChanged) if d.mode == "follow")
    assert fig_6b.end.t == follow + FIG_6B.after_joining


def test_its_end_is_explained(fig_6b: Flown) -> None:
    track = replace(recording(90, turns_at=1e9), altitude=np.linspace(9_000.0, 8_000.0, 91))
    ends = [
        (fig_6b.end, "joined", "Joined, and followed for 120 s."),
        (
            fly_whole(replace(FIG_6B, duration_limit=77.0)).end,
            "time_over",
            "The flight ends at its time limit of 77 s.",
        ),
        (
            fly_whole(replace(FIG_6B, leader_source=track)).end,
            "recording_over",
            "The leader's recording ends after 90 s.",
        ),
    ]
    for end, reason, message in ends:
        assert (end.reason, end.message) == (reason, message)


def test_a_recorded_leader_is_shown_at_the_altitude_that_was_recorded() -> None:
    track = replace(recording(90, turns_at=1e9), altitude=np.linspace(9_000.0, 8_000.0, 91))
    flight = fly_whole(replace(FIG_6B, leader_source=track), (60.0, LeaderSpeed(tas=180.0)))
    altitudes = {d.t: [a.altitude for a in d.aircraft] for d in flight.of(Sample)}
    assert altitudes[0.0] == [FIG_6B.altitude, 9_000.0]
    assert altitudes[45.0][1] == pytest.approx(8_500.0)
    # it has left its recording, and levels off
    assert altitudes[80.0][1] == altitudes[89.0][1] > altitudes[60.0][1] - 100.0


def test_aircraft_that_join_nobody_fly_until_the_end() -> None:
    alone = replace(chain(), links=())
    *_, last, end = simulate(alone, until=10.0, sample_period=1.0)
    assert isinstance(last, Sample)
    assert isinstance(end, FlightEnded)
    assert (last.t, last.aircraft[0].y, end.results) == (10.0, pytest.approx(2_000.0), ())


def test_without_a_plan_one_is_asked_for_ever_more_seldom_until_the_leader_moves() -> None:
    asked = list[float]()

    def counting(situation: Situation) -> Plan | NoPlan:
        asked.append(situation.leader.tas)
        return plan(situation)

    faster = Situation(
        pursuer=Pursuer(x=0.0, y=-20_000.0, heading=0.0, tas=200.0, max_bank=25.0 * DEG),
        leader=Leader(x=0.0, y=0.0, heading=0.0, tas=220.0),
        slot_distance=10_000.0,
        min_separation=LIMIT,
    )
    scenario = replace(own_scenario(faster), duration_limit=700.0)
    counts, begun = list[int](), list[float]()
    for settings in (DEFAULT, replace(DEFAULT, retry_longest=DEFAULT.retry)):
        asked.clear()
        slower = saying((600.0, LeaderSpeed(tas=180.0)))
        flight = fly(scenario, counting, commands=slower, sample_period=1.0, settings=settings)
        begun.append(next(d.t for d in flight if isinstance(d, PlanChanged)))
        counts.append(len([tas for tas in asked if tas == 220.0]))
    assert counts[0] < counts[1] / 3
    assert abs(begun[0] - begun[1]) <= DEFAULT.retry  # as soon as it has slowed down


def test_a_turn_that_was_ordered_is_said_once() -> None:
    scenario = replace(FIG_6B, intent_known=False, duration_limit=220.0)
    orders = (10.0, LeaderHeading(heading=90.0 * DEG)), (150.0, LeaderHeading(heading=0.0))
    said = [d.message for d in fly_whole(scenario, *orders).of(LeaderChanged)]
    assert said == [
        "The leader is instructed to turn to 090°.",
        "The leader is instructed to turn to 000°.",
    ]


def test_a_world_is_flown_by_the_exact_planner_where_none_is_given() -> None:
    world = world_of(replace(FIG_6B, duration_limit=5.0))
    given = list(simulate(world, plan, until=5.0, sample_period=1.0))
    own = list(simulate(world, until=5.0, sample_period=1.0))
    kinds = (Sample, ForecastChanged)
    assert [d for d in own if isinstance(d, kinds)] == [d for d in given if isinstance(d, kinds)]


def test_the_same_flight_is_flown_again() -> None:
    scenario = replace(own_scenario(random_start(3), intent_known=False), duration_limit=400.0)
    one, other = fly_whole(scenario), fly_whole(scenario)
    assert one.samples == other.samples
    assert one.result == other.result


@pytest.mark.parametrize(
    ("duration", "step", "steps"), [(1.0, 0.05, 20), (0.5, 0.5, 1), (2.0, 0.1, 20)]
)
def test_durations_are_whole_steps(duration: float, step: float, steps: int) -> None:
    assert whole_steps(duration, step) == steps


@pytest.mark.parametrize(("duration", "step"), [(1.0, 0.3), (0.04, 0.05), (1.0, 0.0), (1.0, -0.5)])
def test_and_nothing_else(duration: float, step: float) -> None:
    with pytest.raises(ValueError, match="must be a whole number of steps"):
        whole_steps(duration, step)


def test_steps_and_periods_must_fit() -> None:
    with pytest.raises(ValueError, match="whole number of steps"):
        fly(FIG_6B, plan, step=0.3)
    with pytest.raises(ValueError, match="whole number of steps"):
        fly(FIG_6B, plan, sample_period=0.07)
