"""Closest approaches in closed form, against dense sampling of the true arcs."""

from math import nan, pi

import numpy as np
import pytest

from relguide.atc.bounds import NONE, Stray
from relguide.atc.probe import SHOWN, Other, probe
from relguide.atc.tracks import CHORD, COARSE, intent_track, path_track
from relguide.planning.aircraft import Traffic
from relguide.planning.heights import Heights
from relguide.planning.trajectory import LEFT, RIGHT, Arc, Straight, Trajectory
from relguide.planning.wind import CALM, Wind
from relguide.units import FT, NM
from tests.relguide.atc.pictures import NOW, drawn_path, drawn_traffic

VERTICAL = 1_000.0 * FT
UNTIL = 500.0
TIMES = np.arange(0.0, UNTIL + 0.05, 0.1)


def apart(own: Trajectory, other: Traffic) -> np.ndarray:
    """Ten times a second, along the true arcs; the wind moves both alike."""
    ours, theirs = own.sample(TIMES), other.trajectory.sample(TIMES)
    return np.hypot(ours.x - theirs.x, ours.y - theirs.y)


def probed(own, others, *, growth=0.0, first=0.0, wind=CALM, fan=nan):
    stray = Stray(first, growth, NOW)
    tracks = [intent_track(one, start=NOW, until=NOW + UNTIL, wind=wind) for one in others]
    return probe(
        path_track(own, start=NOW, until=NOW + UNTIL, wind=wind),
        [Other(track=track, minimum=5.0 * NM, stray=stray, fan=fan) for track in tracks],
        begin=NOW,
        end=NOW + UNTIL,
        vertical=VERTICAL,
    )


@pytest.mark.parametrize("seed", range(8))
def test_least_is_that_of_dense_sampling_within_the_tracks_errors(seed):
    rng = np.random.default_rng(seed)
    own = drawn_path(rng)
    others = [drawn_traffic(rng, f"T{i}", span=40_000.0) for i in range(40)]
    found = {approach.number: approach for approach in probed(own, others)}
    error = CHORD + COARSE
    step = 0.1 * 500.0 / 2.0  # between two samples
    for i, other in enumerate(others):
        dense = apart(own, other)
        if i not in found:
            assert dense.min() > 5.0 * NM + SHOWN - error
            continue
        assert found[i].least <= dense.min() + error
        assert found[i].least >= dense.min() - error - step
        assert abs(dense[round(10 * (found[i].at - NOW))] - found[i].least) < error + 2.0 * step


@pytest.mark.parametrize("seed", range(8))
def test_margin_is_that_of_dense_sampling_with_a_bound_that_grows(seed):
    rng = np.random.default_rng(100 + seed)
    own = drawn_path(rng)
    others = [drawn_traffic(rng, f"T{i}", span=40_000.0) for i in range(40)]
    growth, first = rng.uniform(0.0, 20.0), rng.uniform(0.0, 2_000.0)
    for approach in probed(own, others, growth=growth, first=first):
        dense = apart(own, others[approach.number]) - first - growth * TIMES - 5.0 * NM
        assert -2.0 * (CHORD + COARSE) - 25.0 < approach.margin - dense.min() < 1e-6  # a step: 25 m
        lost = TIMES[dense < 0.0]
        if len(lost):
            assert approach.margin < 0.0
            assert approach.since - NOW <= lost[0]
            assert approach.until - NOW >= lost[-1]


@pytest.mark.parametrize("seed", range(4))
def test_all_that_is_said_of_others_that_may_turn_is_finite(seed):
    rng = np.random.default_rng(seed)
    own = drawn_path(rng)
    others = [drawn_traffic(rng, f"T{i}", span=80_000.0) for i in range(60)]
    found = probed(own, others, fan=pi / 6.0)
    assert any(approach.margin > 0.0 for approach in found)
    assert np.isfinite(np.array(found)).all()


def test_two_that_turn_are_found_where_samples_five_seconds_apart_miss_them():
    """Head-on arcs: they are below the minimum for less than five seconds."""
    radius, tas = 6_000.0, 230.0
    own = Trajectory(
        x=0.0, y=0.0, heading=0.0, tas=tas,
        segments=(Arc(turn=RIGHT, turn_angle=1.5 * pi, radius=radius), Straight(length=50_000.0)),
    )  # fmt: skip
    missed = 0
    for aside in np.linspace(9_100.0, 9_700.0, 61):
        other = Traffic(
            ident="T", x=4.0 * radius + aside, y=0.0, heading=0.0, tas=tas, min_separation=5.0 * NM
        )
        mirrored = Trajectory(
            x=other.x, y=0.0, heading=0.0, tas=tas,
            segments=(Arc(turn=LEFT, turn_angle=1.5 * pi, radius=radius), Straight(length=5e4)),
        )  # fmt: skip
        tracks = [path_track(one, start=NOW, until=NOW + 200.0) for one in (own, mirrored)]
        (found,) = probe(
            tracks[0], [Other(track=tracks[1], minimum=5.0 * NM, stray=NONE)],
            begin=NOW, end=NOW + 200.0, vertical=VERTICAL,
        )  # fmt: skip
        t = np.arange(0.0, 200.0, 5.0)
        a, b = own.sample(t), mirrored.sample(t)
        sampled = np.hypot(a.x - b.x, a.y - b.y).min()
        fine = np.arange(0.0, 200.0, 0.01)
        a, b = own.sample(fine), mirrored.sample(fine)
        true = np.hypot(a.x - b.x, a.y - b.y).min()
        assert found.least - 4.0 <= true <= found.least + 4.0
        missed += sampled >= 5.0 * NM > found.least
    assert missed > 0


def test_height_that_is_certain_keeps_apart():
    rng = np.random.default_rng(5)
    own = drawn_path(rng)
    other = Traffic(
        ident="T", x=own.x, y=own.y, heading=own.heading, tas=own.tas, min_separation=5.0 * NM,
        altitude=10_000.0,
    )  # fmt: skip
    track = intent_track(other, start=NOW, until=NOW + UNTIL)
    for altitude, seen in ((10_000.0, 1), (10_000.0 + 1_000.0 * FT, 0), (10_280.0, 1)):
        path = path_track(own, start=NOW, until=NOW + UNTIL, heights=Heights(altitude=altitude))
        found = probe(
            path, [Other(track=track, minimum=5.0 * NM, stray=NONE)],
            begin=NOW, end=NOW + UNTIL, vertical=VERTICAL,
        )  # fmt: skip
        assert len(found) == seen


@pytest.mark.parametrize("seed", range(4))
def test_wind_moves_all_alike(seed):
    rng = np.random.default_rng(40 + seed)
    own = drawn_path(rng)
    others = [drawn_traffic(rng, f"T{i}", span=40_000.0) for i in range(30)]
    calm = probed(own, others)
    windy = probed(own, others, wind=Wind(east=30.0, north=-20.0))
    assert [one.number for one in calm] == [one.number for one in windy]
    for a, b in zip(calm, windy, strict=True):
        assert a.least == pytest.approx(b.least, abs=1e-3)
        assert a.at == pytest.approx(b.at, abs=1e-2)
