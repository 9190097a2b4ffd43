"""A second of all aircraft is each of them flown alone, and nothing comes closer than is said."""

from math import hypot, pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.turn import turn_rate
from relguide.kernels.flight.flight_records import TURN_RATE, Body, Control, Drift
from relguide.kernels.flight.second import (
    GUIDED,
    PROGRAMMED,
    RECORDED,
    REVERSALS,
    SIDE,
    SWING,
    TRACK,
    least_between,
)
from relguide.units import DEG
from tests.aloft import LIMITS, STEP, STILL, fly, fly_second, hold, level, steady

WIND = Drift(15.0, -20.0)
STEPS = round(1.0 / STEP)


def turning(bank: float) -> Control:
    return Control(TURN_RATE, turn_rate(240.0, bank * DEG), 240.0)


def test_three_aircraft_fly_as_each_alone() -> None:
    begun = [level(heading=30.0), level(5e3, 0.0, 90.0, tas=200.0), level(0.0, 9e3, bank=10.0)]
    recording = fly(turning(10.0), begun[2], 3.0, wind=WIND)
    programs = np.zeros((3, 4, 3))
    programs[1, 0] = 1.0, 2.0, 20.0 * DEG
    states = np.array(begun)
    trace, tallies = np.zeros((3, STEPS + 1, 7)), np.zeros((3, 4))
    cursors = np.zeros(3, dtype=np.int64)
    for second in range(3):
        trace[2] = recording[second * STEPS : (second + 1) * STEPS + 1]
        fly_second(
            states, np.array([LIMITS] * 3), np.array([GUIDED, PROGRAMMED, RECORDED]),
            np.array([turning(-15.0), hold(0.0, tas=200.0), hold(0.0)]), programs,
            np.array([0, 1, 0]), cursors, np.array([0.0, 90.0 * DEG, 0.0]), steady(WIND, 3),
            float(second), STEP, trace, tallies,
        )  # fmt: skip
    assert tuple(states[0]) == tuple(fly(turning(-15.0), begun[0], 3.0, wind=WIND)[-1])
    alone = Control(TURN_RATE, turn_rate(200.0, 20.0 * DEG), 200.0)
    assert tuple(states[1]) == tuple(fly(alone, begun[1], 3.0, wind=WIND)[-1])
    assert tuple(states[2]) == tuple(recording[-1])
    assert np.array_equal(trace[:, -1], states)


def gusted(begun: Body, gust: Drift, *, pilot: int = GUIDED) -> tuple[FloatArray, FloatArray]:
    """A second in `WIND` whose second half has a gust as well: the winds and where it is."""
    winds = steady(WIND)
    winds[0, STEPS // 2 :] += gust
    trace = np.tile(np.array(begun), (1, STEPS + 1, 1))
    fly_second(
        np.array([begun]), np.array([LIMITS]), np.full(1, pilot),
        np.array([hold(begun.heading / DEG, begun.tas)]), np.zeros((1, 0, 3)),
        np.zeros(1, np.int64), np.zeros(1, np.int64), np.full(1, begun.heading), winds, 0.0, STEP,
        trace, np.zeros((1, 4)),
    )  # fmt: skip
    return winds[0], trace[0]


@pytest.mark.parametrize("pilot", [GUIDED, PROGRAMMED])
@pytest.mark.parametrize("heading", [0.0, 90.0, 215.0])
def test_a_gust_changes_the_airspeed_by_minus_what_it_blows_along(
    heading: float, pilot: int
) -> None:
    gust = Drift(3.0, -4.0)
    _, rows = gusted(level(heading=heading), gust, pilot=pilot)
    k = STEPS // 2
    along = gust.east * np.sin(heading * DEG) + gust.north * np.cos(heading * DEG)
    assert rows[:k, 5] == pytest.approx(240.0)
    assert rows[k, 5] - rows[k - 1, 5] == pytest.approx(-along, abs=1e-9)


@pytest.mark.parametrize("heading", [0.0, 90.0, 215.0])
def test_in_a_gust_along_its_heading_an_aircraft_keeps_its_speed_over_the_ground(
    heading: float,
) -> None:
    """It then loses what its autothrust brings back of the airspeed: less than 1 m/s²."""
    ahead = np.sin(heading * DEG), np.cos(heading * DEG)
    winds, rows = gusted(level(heading=heading), Drift(5.0 * ahead[0], 5.0 * ahead[1]))
    east = rows[:, 5] * np.sin(rows[:, 2]) + winds[:, 0]
    north = rows[:, 5] * np.cos(rows[:, 2]) + winds[:, 1]
    jumps = np.hypot(np.diff(east), np.diff(north))
    assert np.max(jumps) < 1.0 * STEP
    moved = np.diff(rows[:, :2], axis=0) / STEP
    assert moved == pytest.approx(np.column_stack([east, north])[:-1], abs=1.0 * STEP)


def test_a_gust_across_carries_an_aircraft_with_it() -> None:
    _, rows = gusted(level(), Drift(6.0, 0.0))
    moved = np.diff(rows[:, 0]) / STEP
    k = STEPS // 2
    assert rows[:, 5] == pytest.approx(240.0, abs=1e-6)
    assert moved[:k] == pytest.approx(WIND.east, abs=0.01)
    assert moved[k:] == pytest.approx(WIND.east + 6.0, abs=0.01)


def test_a_recorded_aircraft_flies_as_it_was_recorded_whatever_blows() -> None:
    _, rows = gusted(level(), Drift(6.0, 3.0), pilot=RECORDED)
    assert np.array_equal(rows, np.tile(np.array(level()), (STEPS + 1, 1)))


def flown_tallies(begun: Body, banks: tuple[float, ...]) -> FloatArray:
    """Half a minute at each bank."""
    states, tallies = np.array([begun]), np.zeros((1, 4))
    for second in range(30 * len(banks)):
        control = turning(banks[second // 30])
        fly_second(
            states, np.array([LIMITS]), np.full(1, GUIDED), np.array([control]),
            np.zeros((1, 0, 3)), np.zeros(1, np.int64), np.zeros(1, np.int64), np.zeros(1),
            steady(STILL), float(second), STEP, np.zeros((1, STEPS + 1, 7)), tallies,
        )  # fmt: skip
    return tallies[0]


def test_swing_track_and_reversals_are_counted() -> None:
    tallies = flown_tallies(level(), (20.0, -20.0, 2.0, -2.0, 20.0, 20.0))
    rate = turn_rate(240.0, 20.0 * DEG)
    # four times half a minute at 20°, less what the rolls cost
    assert tallies[SWING] == pytest.approx(4.0 * 30.0 * rate, rel=0.12)
    assert tallies[TRACK] == pytest.approx(180.0 * 240.0, rel=1e-3)
    assert tallies[SIDE] == 1.0
    # right to left, and back; 2° to a side is a correction
    assert tallies[REVERSALS] == 2.0


def test_four_degrees_of_bank_are_a_turn() -> None:
    assert flown_tallies(level(), (4.0, -4.0, 4.0))[REVERSALS] == 2.0


def test_a_full_turn_swings_through_a_full_turn() -> None:
    seconds = 2.0 * pi / turn_rate(240.0, 25.0 * DEG)
    tallies = flown_tallies(level(bank=25.0), (25.0,) * 4)
    assert tallies[SWING] == pytest.approx(2.0 * pi * 120.0 / seconds)
    assert tallies[REVERSALS] == 0.0


def traces(*bodies: Body, bank: float = 0.0) -> list[FloatArray]:
    return [
        fly(turning(bank * side), body, 1.0) for side, body in zip((1, -1), bodies, strict=True)
    ]


@given(
    st.floats(-300.0, 300.0), st.floats(-300.0, 300.0), st.floats(-pi, pi), st.floats(120.0, 250.0),
    st.floats(-25.0, 25.0),
)  # fmt: skip
def test_the_least_distance_is_that_of_dense_sampling(
    x: float, y: float, heading: float, tas: float, bank: float
) -> None:
    one, other = traces(
        level(bank=bank), level(x, y, heading / DEG, bank=-bank, tas=tas), bank=bank
    )
    least, at = least_between(one, other)
    t = np.linspace(0.0, STEPS, 40 * STEPS + 1)
    k = np.arange(STEPS + 1.0)
    apart = np.hypot(*(np.interp(t, k, one[:, i]) - np.interp(t, k, other[:, i]) for i in (0, 1)))
    assert least <= np.min(apart) + 1e-9
    assert least >= np.min(apart) - 0.5 * 500.0 * STEP / 40  # half a sample at 500 m/s
    there = [np.interp(at, k, one[:, i]) - np.interp(at, k, other[:, i]) for i in (0, 1)]
    assert hypot(*there) == pytest.approx(least, abs=1e-6)


def test_between_two_steps_they_pass_closer_than_at_either() -> None:
    rows = np.zeros((2, 7))
    other = rows.copy()
    other[:, 0], other[:, 1] = (-6.0, 10.0), 30.0
    assert least_between(rows, other) == pytest.approx((30.0, 0.375))
    assert least_between(rows, rows + 1.0) == pytest.approx((2.0**0.5, 0.0))
