"""The fan: it holds all that an aircraft may reach, and nothing else."""

from math import cos, pi, sin

import numpy as np
import pytest

from relguide.atc.bounds import Stray
from relguide.atc.fans import Fans
from relguide.atc.picture import Seen
from relguide.atc.probe import Other, probe
from relguide.atc.tracks import path_track, straight_track
from relguide.units import DEG, FT, NM
from tests.relguide.atc.pictures import NOW, drawn_path

SPEED, TRACK, HALF = 200.0, 0.7, 30.0 * DEG


def fan(half: float = HALF) -> Fans:
    one = np.ones(1)
    return Fans(0.0 * one, 0.0 * one, 0.0 * one, SPEED * sin(TRACK) * one, SPEED * cos(TRACK) * one,
                SPEED * one, half * one)  # fmt: skip


@pytest.mark.parametrize("half", [0.0, 10.0 * DEG, HALF, 80.0 * DEG, 120.0 * DEG])
def test_all_ways_within_the_fan_end_in_it(half):
    rng = np.random.default_rng(1)
    for _ in range(500):
        turns = rng.uniform(-half, half, 5)
        times = rng.uniform(0.0, 100.0, 5)
        x = float(np.sum(SPEED * times * np.sin(TRACK + turns)))
        y = float(np.sum(SPEED * times * np.cos(TRACK + turns)))
        at = np.array([times.sum()])
        assert fan(half).distance(np.array([x]), np.array([y]), at)[0] <= 1e-6


@pytest.mark.parametrize("half", [0.0, 10.0 * DEG, HALF, 80.0 * DEG])
def test_distance_is_that_to_the_hull_of_straight_ways(half):
    """Outside, by brute force: the hull of an arc is all means of two of its points."""
    rng = np.random.default_rng(2)
    t = 100.0
    angles = np.linspace(-half, half, 181)
    arc = SPEED * t * np.column_stack((np.sin(TRACK + angles), np.cos(TRACK + angles)))
    chord = arc[0] + np.linspace(0.0, 1.0, 400)[:, None] * (arc[-1] - arc[0])
    edge = np.concatenate((arc, chord))
    for _ in range(300):
        x, y = rng.uniform(-50_000.0, 50_000.0, 2)
        found = float(fan(half).distance(np.array([x]), np.array([y]), np.array([t]))[0])
        brute = float(np.min(np.hypot(edge[:, 0] - x, edge[:, 1] - y)))
        assert abs(found) == pytest.approx(brute, abs=60.0)


@pytest.mark.parametrize("seed", range(10))
def test_no_way_within_the_fan_comes_nearer_than_the_margin(seed):
    """Ways that turn twice, sampled ten times a second; and one of them comes about as near."""
    rng = np.random.default_rng(seed)
    own = drawn_path(rng)
    x, y = rng.uniform(-60_000.0, 60_000.0, 2)
    track, speed = rng.uniform(0.0, 2.0 * pi), rng.uniform(80.0, 250.0)
    seen = Seen(ident="T", t=NOW - 5.0, x=x, y=y, track=track, ground_speed=speed)
    path = path_track(own, start=NOW, until=NOW + 500.0)
    other = Other(
        track=straight_track(seen, until=NOW + 500.0),
        minimum=5.0 * NM,
        stray=Stray(0.0, 3.0, NOW - 5.0),
        fan=HALF,
    )
    found = probe(
        path, [other],
        begin=NOW, end=NOW + 500.0, vertical=1_000.0 * FT,
    )  # fmt: skip
    t = np.arange(0.0, 500.0, 0.5)
    ours = own.sample(t)
    nearest = np.inf
    corners = [(s, a, b) for s in np.linspace(0.0, 505.0, 40) for a in (-HALF, HALF)
               for b in (-HALF, HALF)]  # fmt: skip
    for turns, first, then in corners:
        before, after = np.minimum(t + 5.0, turns), np.maximum(t + 5.0 - turns, 0.0)
        east = x + speed * (before * sin(track + first) + after * sin(track + then))
        north = y + speed * (before * cos(track + first) + after * cos(track + then))
        apart = np.hypot(ours.x - east, ours.y - north) - 3.0 * (t + 5.0) - 5.0 * NM
        nearest = min(nearest, float(apart.min()))
    if not found:
        assert nearest > 0.0
        return
    assert found[0].margin <= nearest + 1e-6
