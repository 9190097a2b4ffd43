"""Tracks: what is flown strays from them by no more than they say."""

from dataclasses import replace
from math import pi

import numpy as np
import pytest

from relguide.atc.picture import Seen
from relguide.atc.settings import AtcSettings
from relguide.atc.track import Track
from relguide.atc.tracks import (
    CHORD,
    followed_track,
    intent_track,
    path_track,
    plan_track,
    points_track,
    straight_track,
)
from relguide.flying.documents import Sample
from relguide.flying.guidance.forecast import rows_to_draw
from relguide.flying.scenarios import fig_6
from relguide.planning.aircraft import Traffic
from relguide.planning.heights import Heights, heights_of
from relguide.planning.intent import ChangeLevel, FlyStraight, LevelChange
from relguide.planning.outcome import Plan
from relguide.planning.plan import plan
from relguide.planning.wind import Wind
from relguide.units import FT, NM
from tests.flights import fly_whole
from tests.relguide.atc.pictures import LEVEL, NOW, drawn_path, drawn_traffic

WIND = Wind(east=25.0, north=-10.0)
SETTINGS = AtcSettings()


def off(track: Track, t: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    places = np.array([track.place(time) for time in t.tolist()])
    return np.hypot(places[:, 0] - x, places[:, 1] - y)


@pytest.mark.parametrize("seed", range(6))
def test_path_strays_from_its_chords_by_no_more_than_the_error(seed):
    path = drawn_path(np.random.default_rng(seed))
    track = path_track(path, start=NOW, until=NOW + 700.0, wind=WIND)
    t = np.arange(0.0, 700.0, 0.1)
    true = path.sample(t).over_ground(WIND)
    strays = off(track, NOW + t, true.x, true.y)
    assert strays.max() <= track.error + 1e-3
    assert strays.max() > 0.4 * track.error  # and it is no mere guess
    assert track.error <= CHORD


def test_drawn_points_of_a_flight_hold_all_that_is_flown_between_them():
    """By the rule that forecasts are drawn by: braking, rolls and captures of a whole flight."""
    flown = fly_whole(fig_6(intent_known=True))
    own = [sample.aircraft[1] for sample in flown.of(Sample)]
    rows = np.array([(a.x, a.y, a.heading) for a in own])
    t = np.array([sample.t for sample in flown.of(Sample)])
    for first in range(0, len(t) - 120, 60):
        kept = [first + k for k in rows_to_draw(rows[first:])]
        track = points_track(t[kept], *(rows[kept, column] for column in range(3)))
        strays = off(track, t[first:], rows[first:, 0], rows[first:, 1])
        assert strays.max() <= track.error
        assert track.error < 80.0


@pytest.mark.parametrize("seed", range(20))
def test_bounds_on_the_altitude_hold_those_of_the_intent(seed):
    rng = np.random.default_rng(seed)
    changes = (
        FlyStraight(duration=rng.uniform(0.0, 100.0)),
        ChangeLevel(
            to_altitude=LEVEL + rng.uniform(-2_000.0, 2_000.0), rate=rng.uniform(3.0, 15.0)
        ),
        FlyStraight(duration=rng.uniform(0.0, 300.0)),
        ChangeLevel(to_altitude=LEVEL, rate=rng.uniform(3.0, 15.0)),
    )
    traffic = replace(drawn_traffic(rng, "T", altitude=LEVEL), intent=changes)
    track = intent_track(traffic, start=NOW, until=NOW + 900.0)
    heights = heights_of(traffic)
    for t in rng.uniform(0.0, 900.0, 400).tolist():
        low, high = heights.bounds(t)
        assert np.interp(NOW + t, track.t, track.low) <= low + 1e-6
        assert np.interp(NOW + t, track.t, track.high) >= high - 1e-6


def test_one_without_intent_flies_straight_on_its_level():
    seen = Seen(ident="T", t=NOW, x=0.0, y=0.0, track=0.5 * pi, ground_speed=200.0,
                altitude=LEVEL + 100.0 * FT)  # fmt: skip
    track = straight_track(seen, until=NOW + 600.0)
    assert track.place(NOW + 100.0) == pytest.approx((20_000.0, 0.0), abs=1e-6)
    assert set(track.low) == set(track.high) == {LEVEL}
    between = straight_track(replace(seen, altitude=LEVEL + 450.0 * FT), until=NOW + 600.0)
    assert between.low[0] == between.high[0] == LEVEL + 450.0 * FT


def test_one_that_climbs_may_stop_or_be_faster():
    seen = Seen(ident="T", t=NOW, x=0.0, y=0.0, track=0.0, ground_speed=200.0, altitude=LEVEL,
                climb=10.0)  # fmt: skip
    track = straight_track(seen, until=NOW + 100.0)
    assert track.low[-1] == LEVEL - SETTINGS.level_buffer
    assert track.high[-1] == pytest.approx(LEVEL + 1_200.0 + SETTINGS.climb_buffer)


def test_altitude_that_is_not_known_is_unbounded():
    seen = Seen(ident="T", t=NOW, x=0.0, y=0.0, track=0.0, ground_speed=200.0)
    track = straight_track(seen, until=NOW + 100.0)
    assert np.isneginf(track.low).all()
    assert np.isposinf(track.high).all()


def test_plan_ends_in_its_place_behind_the_leader():
    found = plan(fig_6(intent_known=True).situation)
    assert isinstance(found, Plan)
    track = plan_track(found, start=NOW)
    leader = intent_track(found.situation.leader, start=NOW, until=track.end)
    assert track.end == pytest.approx(NOW + found.time_to_converge + SETTINGS.followed)
    for t in (NOW + found.time_to_converge, track.end):
        assert track.distance(leader, t) == pytest.approx(found.situation.slot_distance, abs=1.0)


@pytest.mark.parametrize("seed", range(4))
def test_track_goes_on_as_its_leader_flew(seed):
    """An aircraft that flies what its leader flew, known for a while only."""
    rng = np.random.default_rng(seed)
    traffic: Traffic = drawn_traffic(rng, "LEAD")
    leader = intent_track(traffic, start=NOW, until=NOW + 900.0, wind=WIND)
    delay = 5.0 * NM / 200.0
    t = np.linspace(NOW + delay, NOW + 200.0, 120)
    places = np.array([leader.place(time - delay) for time in t.tolist()])
    unknown = np.full(len(t), np.inf)
    own = Track(t=t, x=places[:, 0], y=places[:, 1], low=-unknown, high=unknown, error=0.0)
    track = followed_track(own, leader, NOW + 500.0)
    assert track.end == NOW + 500.0
    for time in np.linspace(NOW + 201.0, NOW + 499.0, 50).tolist():
        there = leader.place(time - delay)
        assert np.hypot(*np.subtract(track.place(time), there)) < 60.0
    assert followed_track(track, leader, NOW + 300.0).end >= NOW + 300.0


def test_points_that_are_none_are_refused():
    with pytest.raises(ValueError, match="two points or more, at ascending times"):
        points_track([0.0], [0.0], [0.0], [0.0])
    with pytest.raises(ValueError, match="two points or more, at ascending times"):
        points_track([0.0, 0.0], [0.0, 1.0], [0.0, 1.0], [0.0, 0.0])


def test_heights_count_from_when_they_are_told():
    change = LevelChange(at=100.0, to_altitude=LEVEL + 600.0, rate=10.0)
    track = points_track(
        [50.0, 400.0], [0.0, 70_000.0], [0.0, 0.0], [0.5 * pi] * 2,
        heights=Heights(altitude=LEVEL, changes=(change,)), heights_at=50.0,
    )  # fmt: skip
    assert np.interp(140.0, track.t, track.high) == LEVEL
    assert np.interp(160.0, track.t, track.high) > LEVEL
