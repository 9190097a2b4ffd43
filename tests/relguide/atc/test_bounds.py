"""How far an aircraft may be from its track without a caution."""

from math import pi

import numpy as np
import pytest

from relguide.atc.bounds import cleared_stray, largest_turn, stray_of
from relguide.atc.picture import Seen
from relguide.atc.settings import AtcSettings
from relguide.atc.tracks import path_track
from relguide.planning.trajectory import RIGHT, Arc, Straight, Trajectory
from relguide.units import NM
from tests.relguide.atc.pictures import NOW, drawn_path

SETTINGS = AtcSettings()


@pytest.mark.parametrize("seed", range(10))
def test_no_corner_of_the_thresholds_is_farther(seed):
    path = drawn_path(np.random.default_rng(seed))
    track = path_track(path, start=NOW, until=NOW + 500.0)
    t = np.arange(10.0, 490.0, 0.5)
    places = np.array([track.place(NOW + time) for time in t.tolist()])
    farthest = 0.0
    for late in (-5.0, -2.0, 0.0, 3.0, 5.0):
        for aside in (-0.25 * NM, 0.25 * NM):
            there = path.sample(t + late)
            x = there.x + aside * np.cos(there.track)
            y = there.y - aside * np.sin(there.track)
            farthest = max(farthest, float(np.hypot(x - places[:, 0], y - places[:, 1]).max()))
    bound = cleared_stray(track, SETTINGS)
    assert farthest <= bound + track.error
    assert farthest >= 0.85 * bound


def test_the_largest_turn_is_that_of_the_arc():
    tas, radius = 200.0, 8_000.0
    path = Trajectory(
        x=0.0, y=0.0, heading=0.0, tas=tas,
        segments=(
            Straight(length=20_000.0), Arc(turn=RIGHT, turn_angle=2.0 * pi, radius=radius),
            Straight(length=9_000.0),
        ),
    )  # fmt: skip
    track = path_track(path, start=NOW, until=NOW + 450.0)
    true = tas * 5.0 / radius
    chord = float(np.max(np.diff(track.t[5:-5]))) * tas / radius
    assert true <= largest_turn(track, 5.0) <= true + 2.0 * chord
    straight = path_track(path, start=NOW, until=NOW + 90.0)
    assert largest_turn(straight, 5.0) == pytest.approx(0.0, abs=1e-9)


def test_others_grow_unless_they_are_cleared():
    path = path_track(drawn_path(np.random.default_rng(1)), start=NOW, until=NOW + 500.0)
    seen = Seen(ident="T", t=NOW, x=0.0, y=0.0, track=0.0, ground_speed=200.0, path=path)
    filed = stray_of(seen, SETTINGS, 100.0)
    assert filed.at(NOW + 600.0) == pytest.approx(100.0 + 1.25 * NM)
    assert filed.at(NOW - 60.0) == filed.at(NOW)
    cleared = Seen(ident="T", t=NOW, x=0.0, y=0.0, track=0.0, ground_speed=200.0, path=path,
                   cleared=True)  # fmt: skip
    assert stray_of(cleared, SETTINGS, 0.0).at(NOW + 600.0) == cleared_stray(path, SETTINGS)
