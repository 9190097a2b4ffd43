"""Queues: links behind a head, the order in them, and errors that do not grow down the stream."""

from collections.abc import Iterable
from itertools import pairwise
from math import hypot

import numpy as np
import pytest

from relguide.flying.airframe_files import airframe
from relguide.flying.documents import Document, FlightEnded, Sample
from relguide.flying.orders import Command, LeaderHeading, LeaderSpeed
from relguide.flying.queues import behind_head, queue_up, soonest_first
from relguide.flying.simulation import simulate
from relguide.flying.surveillance import Surveillance
from relguide.flying.world import Aircraft, Declared, Guided, Link, World
from relguide.planning.intent import FlyStraight, TurnTo
from relguide.planning.trajectory import RIGHT
from relguide.units import DEG, NM
from tests.flights import saying

D, LIMIT = 12_000.0, 5.0 * NM
BUFFER = 185.2


def craft(
    ident: str, pilot: Guided | Declared, x: float, y: float, heading: float, tas: float,
    type_: str = "A306",
) -> Aircraft:  # fmt: skip
    return Aircraft(
        ident=ident, airframe=airframe(type_), aircraft_type=type_, x=x, y=y, heading=heading,
        tas=tas, altitude=9_449.0, max_bank=25.0 * DEG, pilot=pilot,
    )  # fmt: skip


def stream(count: int, *, spacing: float = 0.0, type_: str = "A306") -> tuple[Aircraft, ...]:
    """A head and so many in their slots behind it, at 220 m/s to the east."""
    gap, east = 220.0 * spacing or D, 90.0 * DEG
    return (
        craft("HEAD", Declared(), 0.0, 0.0, east, 220.0),
        *(craft(f"P{k}", Guided(), -gap * k, 0.0, east, 235.0, type_) for k in range(1, count + 1)),
    )


def links_of(count: int, spacing: float = 0.0) -> tuple[Link, ...]:
    idents = [f"P{k}" for k in range(1, count + 1)]
    return queue_up(idents, "HEAD", slot_distance=D, min_separation=LIMIT, spacing=spacing)


def test_each_is_behind_the_one_before() -> None:
    links = links_of(3)
    assert [(link.pursuer, link.leader) for link in links] == [
        ("P1", "HEAD"),
        ("P2", "P1"),
        ("P3", "P2"),
    ]
    assert {(link.slot_distance, link.min_separation) for link in links} == {(D, LIMIT)}


def test_it_is_flown_behind_the_head() -> None:
    links = links_of(3, spacing=60.0)
    flown = behind_head(links[2], links, BUFFER)
    assert (flown.pursuer, flown.leader) == ("P3", "HEAD")
    assert (flown.slot_distance, flown.spacing) == (3.0 * D, 180.0)
    assert behind_head(links[0], links, BUFFER) == links[0]


def test_where_d_has_no_room_for_the_buffer_those_ahead_take_up_more() -> None:
    links = queue_up(["P1", "P2"], "HEAD", slot_distance=LIMIT, min_separation=LIMIT)
    assert behind_head(links[1], links, BUFFER).slot_distance == 2.0 * LIMIT + BUFFER


def test_too_far_behind_the_head_it_is_flown_behind_one_ahead() -> None:
    idents = [f"P{k}" for k in range(1, 21)]
    links = queue_up(idents, "HEAD", slot_distance=D, min_separation=LIMIT)
    assert behind_head(links[15], links, BUFFER).leader == "HEAD"
    assert behind_head(links[16], links, BUFFER).leader == "P1"


def test_behind_others_that_keep_a_distance_a_time_is_kept_behind_the_one_before() -> None:
    links = (links_of(2)[0], links_of(2, spacing=60.0)[1])
    assert behind_head(links[1], links, BUFFER) == links[1]


def test_the_intent_is_known_if_all_ahead_know_it() -> None:
    one, two = queue_up(
        ["P1", "P2"], "HEAD", slot_distance=D, min_separation=LIMIT, intent_known=False
    )
    assert not behind_head(two, (one, two), BUFFER).intent_known


def test_each_place_goes_to_who_can_be_there_first() -> None:
    head = craft("HEAD", Declared(), 0.0, 0.0, 0.0, 200.0)
    far = craft("FAR", Guided(), 0.0, -90_000.0, 0.0, 240.0)
    near = craft("NEAR", Guided(), 0.0, -20_000.0, 0.0, 240.0)
    slow = craft("SLOW", Guided(), 0.0, -30_000.0, 0.0, 190.0)
    order = soonest_first((far, slow, near), head, slot_distance=D, min_separation=LIMIT)
    assert order == ("NEAR", "FAR", "SLOW")


def errors(
    commands: Iterable[tuple[float, Command]], world: World, spacing: float, until: float
) -> np.ndarray:
    """Each pursuer's largest error behind the aircraft before it, and the least separation."""
    documents = list(
        simulate(world, commands=saying(*commands), sample_period=1.0, until=until,
                 after_joining=1e6)
    )  # fmt: skip
    places = np.array(
        [[(one.x, one.y) for one in d.aircraft] for d in documents if isinstance(d, Sample)]
    )
    worst = []
    for ahead, own in pairwise(range(places.shape[1])):
        # where on the head's path, which all fly, each of the two is
        along = [_along(places[:, 0], places[:, k]) for k in (ahead, own)]
        if spacing > 0.0:
            lag = int(spacing)
            gap = np.abs(along[0][:-lag] - along[1][lag:])
            worst.append(float(np.max(gap[200:])))
        else:
            worst.append(float(np.max(np.abs(along[0] - along[1] - D)[200:])))
    apart = np.hypot(*(places[:, :-1] - places[:, 1:]).transpose(2, 0, 1))
    assert np.min(apart) >= LIMIT
    return np.array(worst)


def _lengths(path: np.ndarray) -> np.ndarray:
    return np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(path, axis=0).T))))


def _along(head: np.ndarray, own: np.ndarray) -> np.ndarray:
    """How far along the head's path each place is; before it, straight back from its start."""
    lengths = _lengths(head)
    direction = (head[1] - head[0]) / np.hypot(*(head[1] - head[0]))
    found = []
    for place in own:
        before = float((place - head[0]) @ direction)
        if before < 0.0:
            found.append(before)
            continue
        k = int(np.argmin(np.hypot(*(head - place).T)))
        k = min(max(k, 1), len(head) - 2)
        tangent = head[k + 1] - head[k - 1]
        tangent = tangent / np.hypot(*tangent)
        found.append(float(lengths[k] + (place - head[k]) @ tangent))
    return np.array(found)


MANOEUVRES: dict[str, tuple[tuple[float, Command], ...]] = {
    "step": ((220.0, LeaderSpeed(tas=200.0)),),
    "ramp": tuple((220.0 + 10.0 * k, LeaderSpeed(tas=220.0 - 2.0 * k)) for k in range(1, 11)),
    "turn": ((220.0, LeaderHeading(heading=150.0 * DEG)),),
}


@pytest.mark.slow
@pytest.mark.parametrize("spacing", [0.0, 60.0])
@pytest.mark.parametrize("manoeuvre", MANOEUVRES)
def test_the_error_of_the_tenth_is_no_larger_than_that_of_the_first(
    manoeuvre: str, spacing: float
) -> None:
    world = World(aircraft=stream(10, spacing=spacing), links=links_of(10, spacing))
    # until the tenth has done as the head did, and for two minutes more
    reached = 600.0 if spacing > 0.0 or manoeuvre == "turn" else 100.0
    worst = errors(MANOEUVRES[manoeuvre], world, spacing, 220.0 + reached + 120.0)
    # a metre: places are found on chords of a second
    assert worst[9] <= worst[0] + 1.0
    assert np.max(worst) <= worst[0] + 1.0
    assert worst[0] < 60.0


@pytest.mark.slow
def test_a_stream_seen_by_reports_keeps_apart_behind_a_head_that_slows_down() -> None:
    world = World(
        aircraft=stream(5),
        links=links_of(5),
        surveillance=Surveillance(kind="adsb"),
    )
    documents = list(
        simulate(world, commands=saying(*MANOEUVRES["step"]), sample_period=1.0, until=900.0)
    )
    (ended,) = [d for d in documents if isinstance(d, FlightEnded)]
    assert all(result.joined and not result.losses for result in ended.results)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(4))
def test_three_followers_of_one_leader_queue_up_and_no_two_of_them_meet(seed: int) -> None:
    rng = np.random.default_rng(seed)
    head = craft("HEAD", Declared(intent=_intent(rng)), 0.0, 0.0, 0.0, 200.0)
    followers: list[Aircraft] = []
    while len(followers) < 3:
        x, y = rng.uniform(-60e3, 60e3, 2).tolist()
        if all(hypot(x - one.x, y - one.y) > 12_000.0 for one in (head, *followers)):
            heading, tas = float(rng.uniform(0.0, 6.28)), float(rng.uniform(220.0, 240.0))
            followers.append(craft(f"P{len(followers)}", Guided(), x, y, heading, tas))
    order = soonest_first(followers, head, slot_distance=D, min_separation=LIMIT)
    links = queue_up(order, "HEAD", slot_distance=D, min_separation=LIMIT)
    documents: list[Document] = list(
        simulate(World(aircraft=(head, *followers), links=links), sample_period=1.0)
    )
    (ended,) = [d for d in documents if isinstance(d, FlightEnded)]
    assert ended.reason == "joined"
    assert [(r.joined, r.losses) for r in ended.results] == [(True, ())] * 3
    last = [d for d in documents if isinstance(d, Sample)][-1]
    there = {one.ident: one for one in last.aircraft}
    for ahead, own in pairwise(("HEAD", *order)):
        apart = hypot(there[ahead].x - there[own].x, there[ahead].y - there[own].y)
        assert apart == pytest.approx(D, abs=100.0)


def _intent(rng: np.random.Generator) -> tuple[FlyStraight | TurnTo, ...]:
    heading = float(rng.uniform(0.2, 2.0))
    return (
        FlyStraight(duration=float(rng.uniform(30.0, 200.0))),
        TurnTo(heading=heading, turn=RIGHT, bank=25.0 * DEG),
    )
