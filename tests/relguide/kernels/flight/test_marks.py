"""The leader's flown path is remembered well enough to turn where it turned."""

from math import cos, hypot, pi, sin

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.flight.marks import (
    HEADING,
    SPEED,
    TRACK,
    S,
    T,
    X,
    Y,
    beside_marks,
    index_at,
    mark_at,
    sharpest_bend,
    speed_when,
    straight_for,
)
from relguide.units import DEG

SPEED_FLOWN = 200.0
RADIUS = 9_000.0
DRIFT = 8.0 * DEG
"""The track is so much to the right of the heading."""


def fly_marks(seconds: int, *, turn_at: int = 10_000, turn_until: int = 10_000) -> FloatArray:
    """North at 200 m/s; between two times, right on a circle of 9 km. A mark a second, and one D
    behind the first.
    """
    rows = np.zeros((seconds + 2, 7))
    rows[0] = -30_000.0, 0.0, -30_000.0, -DRIFT, 0.0, SPEED_FLOWN, -150.0
    x, y, angle = 0.0, 0.0, 0.0
    for k in range(seconds + 1):
        rows[k + 1] = SPEED_FLOWN * k, x, y, angle - DRIFT, angle, SPEED_FLOWN, k
        turned = SPEED_FLOWN / RADIUS if turn_at <= k < turn_until else 0.0
        chord = SPEED_FLOWN * (sin(0.5 * turned) / (0.5 * turned) if turned else 1.0)
        x, y = x + chord * sin(angle + 0.5 * turned), y + chord * cos(angle + 0.5 * turned)
        angle += turned
    return rows


TURNED = fly_marks(250, turn_at=100, turn_until=150)


@given(st.floats(0.0, 50_000.0))
def test_between_marks_all_is_linear(s: float) -> None:
    at = mark_at(TURNED, S, s)
    i = min(int(s // SPEED_FLOWN) + 1, len(TURNED) - 2)
    share = (s - TURNED[i, S]) / SPEED_FLOWN
    between = TURNED[i] + share * (TURNED[i + 1] - TURNED[i])
    assert at == pytest.approx(between[[S, X, Y, HEADING, TRACK]], abs=1e-6)
    assert mark_at(TURNED, T, s / SPEED_FLOWN) == pytest.approx(at, abs=1e-6)


def test_beyond_its_ends_the_path_goes_straight_on() -> None:
    last = TURNED[-1]
    s, x, y, heading, track = mark_at(TURNED, S, last[S] + 1_000.0)
    ahead = last[X] + 1_000.0 * sin(last[TRACK]), last[Y] + 1_000.0 * cos(last[TRACK])
    assert s == pytest.approx(last[S] + 1_000.0)
    assert (x, y) == pytest.approx(ahead)
    assert (heading, track) == (last[HEADING], last[TRACK])
    before = mark_at(TURNED, S, -31_000.0)
    assert before[:3] == pytest.approx((-31_000.0, 0.0, -31_000.0))


@pytest.mark.parametrize("column", [S, T])
def test_a_mark_is_found_by_any_column_that_rises(column: int) -> None:
    for i in range(len(TURNED) - 1):
        middle = 0.5 * (TURNED[i, column] + TURNED[i + 1, column])
        assert index_at(TURNED, column, middle) == i
        assert index_at(TURNED, column, TURNED[i, column]) == i
    assert index_at(TURNED, column, -1e9) == 0
    assert index_at(TURNED, column, 1e9) == len(TURNED) - 2


@given(st.floats(-25_000.0, 49_000.0), st.floats(-900.0, 900.0), st.floats(-4_000.0, 4_000.0))
def test_a_place_beside_the_path_is_found_on_it(s: float, right: float, wrong: float) -> None:
    _, x, y, _, track = mark_at(TURNED, S, s)
    place = x + right * cos(track), y - right * sin(track)
    found, off = beside_marks(TURNED, *place, s + wrong)
    # marks 200 m apart on a circle of 9 km: corners of 1.3°, beside which lengths are ambiguous
    assert found == pytest.approx(s, abs=0.5 + 0.025 * abs(right))
    assert off == pytest.approx(right, abs=0.5)


def test_offsets_in_the_turn_are_those_of_the_circle() -> None:
    outside, angle = RADIUS + 80.0, 30.0 * SPEED_FLOWN / RADIUS
    place = RADIUS - outside * cos(angle), 20_000.0 + outside * sin(angle)
    s, right = beside_marks(TURNED, *place, 25_000.0)
    assert s == pytest.approx(26_000.0, abs=5.0)
    assert right == pytest.approx(-80.0, abs=1.0)


def test_of_a_path_that_comes_back_the_part_expected_is_meant() -> None:
    """Round a full circle: 40 m beside it, a length is that of the lap expected."""
    lap = 2.0 * pi * RADIUS
    circling = fly_marks(700, turn_at=0, turn_until=700)
    for laps in (0, 1):
        s, right = beside_marks(circling, 40.0, 0.0, 300.0 + laps * lap)
        assert s == pytest.approx(laps * lap, abs=5.0)
        assert right == pytest.approx(40.0, abs=1.0)


def test_a_place_far_from_all_marks_is_taken_where_it_is_expected() -> None:
    """Between the first two marks, 30 km apart, there is none near."""
    s, right = beside_marks(TURNED, 150.0, -15_000.0, -15_400.0)
    assert (s, right) == pytest.approx((-15_000.0, 150.0))


@pytest.mark.parametrize("distance", [2_000.0, 10_000.0, 18_000.0])
def test_straight_is_what_has_been_flown_on_the_present_heading(distance: float) -> None:
    """From the mark at which it is within 2° of it: 314 m of the turn are, and a mark a second."""
    for after in range(100):
        marks = fly_marks(150 + after, turn_at=100, turn_until=150)
        flown_straight = SPEED_FLOWN * after
        if straight_for(marks, distance):
            assert flown_straight > distance - 2.0 * DEG * RADIUS - 1e-6
        else:
            assert flown_straight < distance


def test_one_that_never_turned_has_flown_straight() -> None:
    assert straight_for(fly_marks(0), 25_000.0)
    assert straight_for(fly_marks(30), 1e9)
    assert not straight_for(fly_marks(120, turn_at=100, turn_until=120), 1_000.0)


def test_the_sharpest_bend_is_that_of_the_turn() -> None:
    assert sharpest_bend(TURNED, 0.0, 15_000.0, 240.0) == 0.0
    assert sharpest_bend(TURNED, 15_000.0, 26_000.0, 240.0) == pytest.approx(1.0 / RADIUS)
    assert sharpest_bend(TURNED, 31_000.0, 1e9, 240.0) == 0.0


def test_all_columns_are_told_apart() -> None:
    assert sorted((S, X, Y, HEADING, TRACK, SPEED, T)) == list(range(7))
    step = TURNED[100] - TURNED[99]
    assert hypot(step[X], step[Y]) == pytest.approx(step[S])


def test_the_speed_at_a_time_is_that_of_the_marks_beside_it() -> None:
    marks = TURNED.copy()
    marks[:, SPEED] = 200.0 - 0.5 * marks[:, T]
    times = marks[2:-2, T]
    for t in (float(times[0]), float(times[len(times) // 2]) + 0.25):
        assert speed_when(marks, t) == pytest.approx(200.0 - 0.5 * t)
    assert speed_when(marks, float(marks[-1, T]) + 50.0) == pytest.approx(float(marks[-1, SPEED]))
    assert speed_when(marks, float(marks[0, T]) - 50.0) == pytest.approx(float(marks[0, SPEED]))
