"""A recorded leader is where it was recorded, and headed and banked as its wind says."""

from math import cos, hypot, pi, sin

import numpy as np
import pytest

from relguide.flying.leaders.recorded import steps_of_track
from relguide.kernels.base.turn import turn_rate
from relguide.planning.wind import CALM, Wind
from tests.recording import RATE, SPEED, recording

TURNS = 60.0
"""When it begins to turn [s]."""


@pytest.mark.parametrize("step", [0.05, 0.25])
def test_it_is_where_it_was_recorded(step: float) -> None:
    track = recording(200, turns_at=TURNS)
    rows = steps_of_track(track, CALM, step).rows
    assert len(rows) == round(200.0 / step) + 1
    for t in (0.0, 17.25, 60.0, 133.5, 200.0):
        there, row = track.state_at(t), rows[round(t / step)]
        assert tuple(row[:2]) == pytest.approx((there.x, there.y))
        assert row[5] == pytest.approx(there.ground_speed)
        assert (row[2] - there.track + pi) % (2.0 * pi) - pi == pytest.approx(0.0, abs=1e-9)


def test_it_banks_as_it_turns() -> None:
    rows = steps_of_track(recording(200, turns_at=TURNS), CALM, 0.05).rows
    assert rows[round(20.0 / 0.05), 3] == pytest.approx(0.0, abs=1e-6)
    turning = rows[round(100.0 / 0.05)]
    assert turn_rate(turning[5], turning[3]) == pytest.approx(RATE, rel=1e-3)


def test_its_heading_is_counted_on_round_a_full_turn() -> None:
    headings = steps_of_track(recording(600, turns_at=TURNS), CALM, 0.05).rows[:, 2]
    assert np.max(np.abs(np.diff(headings))) < 1.1 * RATE * 0.05
    assert headings[-1] - headings[0] == pytest.approx(540.0 * RATE, rel=1e-3)
    assert headings[-1] > 2.0 * pi


def test_the_wind_is_taken_off_its_ground_velocity() -> None:
    wind = Wind(east=30.0, north=-10.0)
    rows = steps_of_track(recording(60, turns_at=1e9), wind, 0.05).rows
    heading, tas = rows[500, 2], rows[500, 5]
    assert tas * sin(heading) + wind.east == pytest.approx(0.0, abs=1e-9)
    assert tas * cos(heading) + wind.north == pytest.approx(SPEED)
    assert tas == pytest.approx(hypot(30.0, SPEED + 10.0))
