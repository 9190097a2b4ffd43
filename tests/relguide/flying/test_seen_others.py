"""Other aircraft as they are seen, and where each is expected to be."""

from dataclasses import replace

import numpy as np
import pytest

from relguide.flying.seen_others import SeenOther, pieces_along, prolonged
from relguide.kernels.base.turn import turn_rate
from relguide.kernels.flight.flight_records import Body
from relguide.planning.intent import FlyStraight, TurnTo
from relguide.planning.trajectory import RIGHT
from relguide.planning.wind import Wind
from relguide.units import DEG, NM

TURN = TurnTo(heading=120.0 * DEG, turn=RIGHT, bank=20.0 * DEG)
SEEN = SeenOther(
    ident="BAW12",
    body=Body(1_000.0, 2_000.0, 30.0 * DEG, 0.0, 0.0, 210.0, 0.0),
    heading=30.0 * DEG,
    wind=Wind(east=10.0, north=-5.0),
    min_separation=5.0 * NM,
    intent=(FlyStraight(duration=40.0), TURN),
    declared=True,
)


def test_it_is_expected_where_its_intent_leads_over_the_ground() -> None:
    places = SEEN.places(200)
    for t in (0, 30, 70, 150, 200):
        pose = SEEN.traffic.trajectory.pose_at(float(t))
        assert places[t] == pytest.approx((pose.x + 10.0 * t, pose.y - 5.0 * t), abs=1e-6)


@pytest.mark.parametrize("later", [10, 60, 150])
def test_the_same_some_time_later_goes_on_as_expected(later: int) -> None:
    assert SEEN.later(float(later)).places(100) == pytest.approx(
        SEEN.places(100 + later)[later:], abs=0.5
    )
    then = SEEN.after(float(later), wider=500.0)
    assert (then.x, then.y) == pytest.approx(SEEN.places(later)[later], abs=1e-6)
    assert then.min_separation == SEEN.min_separation + 500.0


def test_one_that_turns_and_has_said_nothing_may_turn_on_by_half_a_turn() -> None:
    body = SEEN.body._replace(bank=25.0 * DEG)
    turning = replace(SEEN, body=body, intent=(), declared=False, wind=Wind(east=0.0, north=0.0))
    assert turning.turns_unannounced
    assert not replace(turning, declared=True).turns_unannounced
    places = turning.places_turning_on(300)
    steps = np.diff(places, axis=0)
    headings = np.unwrap(np.arctan2(steps[:, 0], steps[:, 1]))
    assert headings[-1] - body.heading == pytest.approx(np.pi, abs=1e-6)
    rate = turn_rate(body.tas, body.bank)
    assert np.diff(headings)[:100] == pytest.approx(np.full(100, rate), rel=1e-6)


def test_a_shared_path_goes_on_straight_past_its_end() -> None:
    shared = np.column_stack((np.arange(50.0) * 200.0, np.zeros(50)))
    seen = replace(SEEN, shared=shared)
    places = seen.places(80)
    assert places[:, 0] == pytest.approx(np.arange(81.0) * 200.0)
    assert prolonged(shared, 10).shape == (11, 2)


def test_what_a_flight_ahead_does_is_told_in_pieces() -> None:
    flown = SEEN.traffic.trajectory.sample(np.arange(200.0))
    rows = np.zeros((200, 7))
    rows[:, 0], rows[:, 1], rows[:, 2], rows[:, 5] = (
        flown.x,
        flown.y,
        np.unwrap(flown.heading),
        210.0,
    )
    pieces = pieces_along(rows)
    straight, turn = pieces
    assert isinstance(straight, FlyStraight)
    assert isinstance(turn, TurnTo)
    assert straight.duration == pytest.approx(40.0, abs=1.0)
    assert (turn.turn, turn.heading) == (RIGHT, pytest.approx(TURN.heading, abs=1.0 * DEG))
    told = replace(SEEN, intent=pieces).places(199)
    assert np.max(np.hypot(*(told - SEEN.places(199)).T)) < 300.0


def test_height_may_keep_it_apart_for_a_while() -> None:
    seen = replace(SEEN, counts=((100.0, 160.0),))
    counts = seen.counts_at(300)
    assert not counts[:99].any()
    assert counts[100:160].all()
    assert not counts[162:].any()
    assert (seen.may_count(), seen.may_count(50.0)) == (True, False)
    assert not replace(SEEN, counts=()).may_count()
    assert seen.later(120.0).counts == ((0.0, 40.0),)
