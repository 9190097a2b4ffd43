"""How far an aircraft is from its track, against dense sampling and what symmetry asks."""

from dataclasses import replace
from math import cos, hypot, sin

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from relguide.atc.off_path import WINDOW, heights, off_path
from relguide.atc.track import Track
from tests.relguide.atc.tracks import seen_on, track_of_legs, tracks

SHARES = st.floats(-0.2, 1.2)
ASIDE = st.floats(-5_000.0, 5_000.0)


@given(st.floats(-1_000.0, 1_000.0), st.floats(-25.0, 25.0), st.floats(0.0, 600.0))
def test_on_a_straight_both_are_what_was_put_in(right: float, early: float, t: float) -> None:
    track = track_of_legs([(300.0, 0.7, 220.0), (300.0, 0.7, 220.0)])
    seen = seen_on(track, t, right=right, early=early)
    across, along = off_path(track, t, seen.x, seen.y)
    assert abs(across) == pytest.approx(abs(right), abs=1e-2)  # a root of what is lost in squares
    assert across * right >= 0.0 or abs(right) < 1e-2
    assert along == pytest.approx(early, abs=1e-6)


@given(tracks(), SHARES, ASIDE, ASIDE)
def test_the_place_at_that_time_is_within_both(
    track: Track, share: float, east: float, north: float
) -> None:
    t = track.begin + share * (track.end - track.begin)
    x, y = track.place(t)
    across, along = off_path(track, t, x + east, y + north)
    assert hypot(east, north) <= hypot(across, track.fastest * along) * (1.0 + 1e-9) + 1e-3


@given(tracks(), st.floats(0.0, 1.0), ASIDE, ASIDE)
def test_the_nearest_place_is_that_of_dense_sampling(
    track: Track, share: float, east: float, north: float
) -> None:
    t = track.begin + share * (track.end - track.begin)
    x, y = track.place(t)
    x, y = x + east, y + north
    across, along = off_path(track, t, x, y)
    assert abs(along) <= WINDOW + 1e-9
    near = track.place(t + along)
    least = min(
        hypot(px - x, py - y)
        for px, py in (track.place(t + k * 0.25) for k in range(-int(4 * WINDOW), int(4 * WINDOW)))
    )
    found = hypot(near[0] - x, near[1] - y)
    assert least - 0.25 * track.fastest <= found <= least + 1e-6
    assert abs(across) >= found - 1e-6


@given(tracks(), st.floats(0.0, 1.0), ASIDE, ASIDE, st.floats(-3.0, 3.0))
def test_turned_shifted_and_delayed_it_is_the_same_and_mirrored_the_other_side(
    track: Track, share: float, east: float, north: float, turned: float
) -> None:
    t = track.begin + share * (track.end - track.begin)
    x, y = track.place(t)
    x, y = x + east, y + north
    across, along = off_path(track, t, x, y)
    s, c = sin(turned), cos(turned)
    moved = replace(
        track,
        t=track.t + 1_000.0,
        x=c * track.x + s * track.y + 7_000.0,
        y=c * track.y - s * track.x - 9_000.0,
    )
    again = off_path(moved, t + 1_000.0, c * x + s * y + 7_000.0, c * y - s * x - 9_000.0)
    mirrored = off_path(replace(track, x=-track.x), t, -x, y)
    for there, sign in ((again, 1.0), (mirrored, -1.0)):
        # two places may be as near; then either may be found
        assert (
            there == pytest.approx((sign * across, along), abs=0.1)
            or abs(_distance(track, t + there[1], x, y) - _distance(track, t + along, x, y)) < 1e-3
        )


def _distance(track: Track, t: float, x: float, y: float) -> float:
    px, py = track.place(t)
    return hypot(px - x, py - y)


def test_heights_are_held_beyond_the_ends_and_unknown_beside_unknown_ones() -> None:
    track = replace(
        track_of_legs([(100.0, 0.0, 200.0), (100.0, 0.0, 200.0), (100.0, 0.0, 200.0)]),
        low=np.array([8_000.0, 9_000.0, -np.inf, -np.inf]),
        high=np.array([8_500.0, 9_500.0, 9_500.0, np.inf]),
    )
    found = [heights(track, t) for t in (-50.0, 50.0, 150.0, 250.0, 400.0)]
    assert [low for low, _ in found] == [8_000.0, 8_500.0, -np.inf, -np.inf, -np.inf]
    assert [high for _, high in found] == [8_500.0, 9_000.0, 9_500.0, np.inf, np.inf]
