"""What a flight says of itself, as tracks and manoeuvres: compared with what was planned."""

from dataclasses import replace
from itertools import islice

import numpy as np
import pytest
from relguide_server.flights.history import History

from relguide.atc.of_flight import (
    LinkNews,
    Placing,
    leader_track,
    manoeuvre_of,
    seen_in_flight,
    segments_track,
    situation_of,
)
from relguide.flying.documents import (
    AssignmentChanged,
    ForecastChanged,
    PlanChanged,
    PlanProposed,
    Sample,
)
from relguide.flying.flight import fly
from relguide.flying.scenarios import scenario
from relguide.planning.frames import LocalPlane
from relguide.planning.outcome import Plan
from relguide.planning.plan import plan
from relguide.units import NM
from tests.server.flown import SITUATION, ideal_flight

HERE = LocalPlane(50.0, 8.0)
THERE = LocalPlane(51.0, 9.0)


def news_of(documents: list[object]) -> LinkNews:
    history = History()
    for document in documents:
        history.add(document)  # type: ignore[arg-type]
    (started,), (sample,) = history.started, history.newest
    link = started.links[0]
    who = link.pursuer
    return LinkNews(
        started=started,
        sample=sample,
        link=link,
        route=next(iter(history.routes()), None),
        plan=history.find(PlanChanged, who),
        proposal=history.find(PlanProposed, who),
        forecast=history.find(ForecastChanged, who),
        assignment=history.find(AssignmentChanged, who),
    )


@pytest.fixture(scope="module")
def engaged() -> LinkNews:
    return news_of(list(islice(fly(scenario("fig_6b"), plan), 60)))


@pytest.fixture(scope="module")
def proposed() -> LinkNews:
    return news_of(list(islice(fly(scenario("fig_6b"), plan, engagement="designated"), 60)))


@pytest.fixture(scope="module")
def ideal() -> LinkNews:
    """With a wind, and a leader that turns."""
    return news_of(list(islice(ideal_flight(duration=20.0), 240)))


def test_a_path_of_a_document_is_where_the_plan_is(ideal: LinkNews) -> None:
    answer = plan(SITUATION)
    assert isinstance(answer, Plan)
    assert ideal.plan is not None
    track = segments_track(ideal.plan.plan.segments, Placing(), wind=SITUATION.wind)
    times = np.linspace(0.0, answer.time_to_converge, 500)
    flown = answer.trajectory.sample(times).over_ground(SITUATION.wind)
    places = np.array([track.place(t) for t in times.tolist()])
    off = np.hypot(places[:, 0] - flown.x, places[:, 1] - flown.y)
    assert np.max(off) < track.error + 0.1
    assert track.error < 20.0  # 3° of a turn at R = 13 km: 4 m, by a bound of twice that


def test_a_leader_s_route_is_where_it_flies(ideal: LinkNews) -> None:
    track = leader_track(ideal, Placing(later=1_000.0))
    times = np.linspace(0.0, 600.0, 200)
    flown = SITUATION.leader.trajectory.sample(times).over_ground(SITUATION.wind)
    places = np.array([track.place(1_000.0 + t) for t in times.tolist()])
    assert np.max(np.hypot(places[:, 0] - flown.x, places[:, 1] - flown.y)) < track.error + 0.1


def test_what_is_engaged_and_what_is_proposed_are_forecast_alike(
    engaged: LinkNews, proposed: LinkNews
) -> None:
    """Guidance would fly its proposal as it flies its plan."""
    flown, would = (manoeuvre_of(one, Placing(), "A", "B") for one in (engaged, proposed))
    times = np.linspace(5.0, would.joins, 200)
    assert max(flown.path.distance(would.path, t) for t in times.tolist()) < 30.0
    assert abs(flown.joins - would.joins) < 2.0
    assert flown.word == would.word
    assert (flown.spacing_type, flown.spacing) == ("distance", engaged.link.slot_distance)
    assert flown.path.error < 0.25 * NM


def test_a_manoeuvre_ends_in_its_place_behind_its_leader(engaged: LinkNews) -> None:
    asked = manoeuvre_of(engaged, Placing(), "A", "B")
    off = [
        abs(asked.path.distance(asked.leader_path, asked.joins + after) - asked.spacing)
        for after in range(0, 121, 10)
    ]
    assert max(off) < 0.3 * NM  # it has joined a while before it is at D
    assert off[-1] < 60.0


def test_a_sky_is_another_plane_and_another_clock(engaged: LinkNews) -> None:
    """The same places on the earth, and the same distances, to what a plane bends them."""
    own = manoeuvre_of(engaged, Placing(of=HERE, to=HERE), "A", "B")
    placed = Placing(later=1e9, of=HERE, to=THERE)
    moved = manoeuvre_of(engaged, placed, "A", "B")
    for t in np.linspace(0.0, own.joins, 30).tolist():
        here = HERE.to_geodetic(*own.path.place(t))
        there = THERE.to_geodetic(*moved.path.place(1e9 + t))
        assert np.allclose(here, there, atol=2e-4)  # 20 m: chords are straight in each plane
        apart = own.path.distance(own.leader_path, t)
        assert moved.path.distance(moved.leader_path, 1e9 + t) == pytest.approx(apart, rel=2e-3)
    assert moved.joins == 1e9 + own.joins
    seen = seen_in_flight(engaged.pursuer, engaged.sample.t, placed, "A")
    assert (seen.x, seen.y) == pytest.approx(moved.path.place(seen.t), abs=60.0)
    east, north = moved.path.velocity(seen.t)
    assert np.arctan2(east, north) == pytest.approx(seen.track, abs=0.01)


def test_what_is_planned_from_now_is_what_was_planned(ideal: LinkNews) -> None:
    """The rest of the leader's intent is the intent now."""
    found = situation_of(ideal, Placing())
    t = ideal.sample.t
    assert 5.0 < t < 20.0
    then = SITUATION.leader.trajectory
    for after in (0.0, 50.0, 95.0, 120.0, 300.0):
        ahead = found.leader.trajectory.pose_at(after)
        known = then.pose_at(t + after)
        drift = SITUATION.wind.east * t, SITUATION.wind.north * t
        assert ahead.x == pytest.approx(known.x + drift[0], abs=5.0)
        assert ahead.y == pytest.approx(known.y + drift[1], abs=5.0)
    answer = plan(found)
    assert isinstance(answer, Plan)
    assert ideal.plan is not None
    rest = ideal.plan.plan.time_to_converge - t
    assert answer.time_to_converge == pytest.approx(rest, abs=0.5)


def test_who_flies_no_plan_has_nothing_to_be_cleared(engaged: LinkNews) -> None:
    with pytest.raises(ValueError, match="flies no plan"):
        manoeuvre_of(replace(engaged, plan=None), Placing(), "A", "B")
    (guidance,) = engaged.sample.guidance
    off = replace(engaged.sample, guidance=(replace(guidance, engagement="off"),))
    assert isinstance(off, Sample)
    with pytest.raises(ValueError, match="designate its leader first"):
        manoeuvre_of(replace(engaged, sample=off), Placing(), "A", "B")


def test_a_leader_that_climbs_may_be_at_any_level(engaged: LinkNews) -> None:
    level = leader_track(engaged, Placing())
    assert level.low[0] == level.high[0] == engaged.leader.altitude
    climbing = replace(engaged, climbing=frozenset({engaged.link.leader}))
    track = leader_track(climbing, Placing())
    assert np.all(np.isinf(track.low))
    assert np.all(np.isinf(track.high))
