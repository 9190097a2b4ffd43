"""A recorded track is smooth, goes on straight beyond its ends, and checks itself."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from relguide.flying.recordings.files import load_track
from relguide.units import DEG
from tests.written_flights import rows, write_csv


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "track.csv"


def test_position_and_velocity_are_continuous_and_agree(file: Path) -> None:
    track = load_track(write_csv(file, rows()))
    dt = 1e-3
    for t in np.arange(190.0, 275.0, 0.31):
        before, after = track.state_at(float(t)), track.state_at(float(t) + dt)
        vx, vy = (after.x - before.x) / dt, (after.y - before.y) / dt
        assert math.hypot(vx, vy) == pytest.approx(before.ground_speed, rel=1e-3)
        assert math.remainder(math.atan2(vx, vy) - before.track, 2 * math.pi) == pytest.approx(
            0.0, abs=1e-3
        )
        assert abs(math.remainder(after.track - before.track, 2 * math.pi)) < 3.0 * DEG * dt


def test_beyond_its_ends_it_flies_straight_on(file: Path) -> None:
    track = load_track(write_csv(file, rows()))
    end, later = track.state_at(track.duration), track.state_at(track.duration + 10.0)
    assert later.track == end.track
    assert math.hypot(later.x - end.x, later.y - end.y) == pytest.approx(10.0 * end.ground_speed)
    start, earlier = track.state_at(0.0), track.state_at(-10.0)
    assert math.hypot(start.x - earlier.x, start.y - earlier.y) == pytest.approx(
        10.0 * start.ground_speed
    )


def test_a_track_checks_itself(file: Path) -> None:
    track = load_track(write_csv(file, rows(100)))
    for bad in (
        {"x": track.x[:-1]},
        {"x": np.where(track.t == 3.0, math.nan, track.x)},
        {"t": track.t + 1.0},
        {"t": track.t**2},
    ):
        with pytest.raises(ValueError, match="track"):
            replace(track, **bad)  # type: ignore[arg-type]
