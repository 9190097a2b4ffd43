"""Scenarios of several followers: all join, in order, and no two of all that fly meet."""

from itertools import combinations
from math import hypot

import pytest

from relguide.flying.documents import Document, FlightEnded, FlightStarted, LeaderRoute, Sample
from relguide.flying.flight import fly, world_of
from relguide.flying.scenarios import SCENARIOS, scenario
from relguide.planning.plan import plan
from relguide.units import NM

NAMES = ("stream_of_five", "overtaking_queue")


@pytest.fixture(scope="module", params=NAMES)
def flown(request: pytest.FixtureRequest) -> list[Document]:
    return list(fly(scenario(request.param), plan, sample_period=1.0))


@pytest.mark.slow
def test_all_join_and_all_keep_apart(flown: list[Document]) -> None:
    ended = flown[-1]
    assert isinstance(ended, FlightEnded)
    assert ended.reason == "joined"
    assert all(result.joined and not result.losses for result in ended.results)
    for sample in (d for d in flown if isinstance(d, Sample)):
        for one, other in combinations(sample.aircraft, 2):
            assert hypot(one.x - other.x, one.y - other.y) >= 5.0 * NM


@pytest.mark.slow
def test_nobody_joins_before_the_aircraft_ahead(flown: list[Document]) -> None:
    ended = flown[-1]
    assert isinstance(ended, FlightEnded)
    times = {result.ident: result.join_time for result in ended.results}
    for result in ended.results:
        assert times.get(result.leader, 0.0) <= result.join_time


@pytest.mark.slow
def test_each_is_shown_where_its_own_leader_will_fly(flown: list[Document]) -> None:
    started = flown[0]
    assert isinstance(started, FlightStarted)
    routes = [d for d in flown if isinstance(d, LeaderRoute)]
    assert {(d.ident, d.expected_by) for d in routes} == {
        (link.leader, link.pursuer) for link in started.links
    }
    first = {d.ident: d for d in reversed(routes)}
    places = {one.ident: one for d in flown[:60] if isinstance(d, Sample) for one in d.aircraft}
    for ident, route in first.items():
        start = route.segments[0].start
        assert hypot(start.x - places[ident].x, start.y - places[ident].y) < 20_000.0


@pytest.mark.parametrize("name", NAMES)
def test_the_link_of_the_pursuer_comes_first(name: str) -> None:
    found = scenario(name)
    world = world_of(found)
    assert world.links[0].pursuer == found.pursuer_ident
    assert len(world.links) == 1 + len(found.ahead) + len(found.followers)
    assert (found.title, found.description) == (SCENARIOS[name].title, SCENARIOS[name].description)
