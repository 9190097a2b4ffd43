"""In a queue: no faster than the aircraft ahead allows, not joined before it; its route shown."""

from itertools import pairwise
from math import hypot

import pytest

from relguide.flying.airframe_files import airframe
from relguide.flying.documents import Document, FlightEnded, LeaderRoute, Sample
from relguide.flying.orders import Command, LeaderSpeed, SetEngagement
from relguide.flying.queues import queue_up
from relguide.flying.simulation import simulate
from relguide.flying.world import Aircraft, Declared, Guided, World
from relguide.units import DEG, NM
from tests.flights import saying

D, LIMIT = 12_000.0, 5.0 * NM


def craft(ident: str, pilot: Guided | Declared, y: float, tas: float) -> Aircraft:
    return Aircraft(
        ident=ident, airframe=airframe("A306"), aircraft_type="A306", x=0.0, y=y, heading=0.0,
        tas=tas, altitude=9_449.0, max_bank=25.0 * DEG, pilot=pilot,
    )  # fmt: skip


def flown(
    *said: tuple[float, Command],
    until: float,
    first: float = -D - 1_500.0,
    second: float = -2.0 * D - 3_000.0,
) -> list[Document]:
    """Two behind a head that flies north at 200 m/s."""
    world = World(
        aircraft=(
            craft("HEAD", Declared(), 0.0, 200.0),
            craft("P1", Guided(), first, 225.0),
            craft("P2", Guided(), second, 225.0),
        ),
        links=queue_up(("P1", "P2"), "HEAD", slot_distance=D, min_separation=LIMIT),
    )
    return list(
        simulate(world, commands=saying(*said), sample_period=1.0, until=until, after_joining=1e6)
    )


def apart(sample: Sample) -> float:
    _, one, two = sample.aircraft
    return hypot(one.x - two.x, one.y - two.y)


@pytest.mark.slow
def test_behind_an_aircraft_that_falls_back_it_keeps_d_min() -> None:
    """The first is disengaged and keeps its speed; the head flies away at 215 m/s."""
    off = SetEngagement(engagement="off", ident="P1")
    documents = flown((200.0, off), (210.0, LeaderSpeed(tas=215.0)), until=1_200.0)
    samples = [d for d in documents if isinstance(d, Sample)]
    assert min(apart(sample) for sample in samples) >= LIMIT
    last = samples[-1]
    assert apart(last) < LIMIT + 1_000.0
    assert last.guidance[1].mode == "follow"
    assert last.aircraft[2].tas == pytest.approx(last.aircraft[1].tas, abs=1.0)


def test_it_has_not_joined_before_the_aircraft_ahead_has() -> None:
    """The first begins 3 km late, the second in its place."""
    documents = flown(until=420.0, first=-D - 4_000.0, second=-2.0 * D - 2_000.0)
    samples = [d for d in documents if isinstance(d, Sample)]
    ended = documents[-1]
    assert isinstance(ended, FlightEnded)
    one, two = ended.results
    assert one.joined
    assert two.joined
    assert 60.0 < one.join_time <= two.join_time
    assert not any(sample.guidance[1].joined for sample in samples if sample.t < one.join_time)


def test_the_route_of_the_aircraft_ahead_is_shown_and_not_over_and_over() -> None:
    documents = flown(until=300.0)
    routes = [d for d in documents if isinstance(d, LeaderRoute)]
    assert {(d.ident, d.expected_by) for d in routes} == {("HEAD", "P1"), ("P1", "P2")}
    assert len(routes) < 8
    times = [d.t for d in routes if d.ident == "P1"]
    assert all(before < after for before, after in pairwise(times))
