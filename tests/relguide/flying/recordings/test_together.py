"""Two tracks in one plane and on one clock are where they were, and as fast."""

from dataclasses import replace
from math import hypot

import numpy as np
import pytest

from relguide.flying.recordings.together import placed_on, together
from relguide.planning.frames import LocalPlane
from tests.recording import recording

PLANE = LocalPlane(49.5, 3.0)


def test_a_track_in_another_plane_is_where_it_was() -> None:
    track = recording(400, turns_at=60.0)
    moved = placed_on(PLANE, track)
    for t in (0.0, 60.0, 133.5, 400.0):
        one, other = track.state_at(t), moved.state_at(t)
        there = PLANE.to_local(*track.origin.to_geodetic(one.x, one.y))
        assert (other.x, other.y) == pytest.approx(there, abs=1.0)
    # its directions agree with its places, in the new plane too
    steps = np.hypot(np.diff(moved.x), np.diff(moved.y))
    along = np.unwrap(np.arctan2(np.diff(moved.x), np.diff(moved.y)))
    middle = 0.5 * (moved.track[1:] + moved.track[:-1])
    assert along == pytest.approx(middle, abs=1e-3)
    assert steps == pytest.approx(track.ground_speed[1:], rel=1e-3)


def test_both_begin_when_both_are_seen_and_end_when_one_is_not() -> None:
    first = replace(recording(400, turns_at=60.0), start=1000.0)
    other = replace(
        recording(300, turns_at=10.0), start=1100.5, ident="OTHER", origin=LocalPlane(49.1, 2.0)
    )
    leader, follower = together(first, other)
    assert leader.origin == follower.origin == first.origin
    assert (leader.start, follower.start) == (1100.5, 1100.5)
    assert leader.duration == follower.duration == 299.0
    there, was = leader.state_at(50.0), first.state_at(150.5)
    assert hypot(there.x - was.x, there.y - was.y) < 0.1
    assert (there.track, there.ground_speed) == pytest.approx((was.track, was.ground_speed), 1e-3)


def test_tracks_that_are_not_seen_together_are_refused() -> None:
    first = replace(recording(100, turns_at=60.0), start=1000.0)
    with pytest.raises(ValueError, match="REC1 and REC1 are not seen together for 30 s"):
        together(first, replace(first, start=1080.0))
