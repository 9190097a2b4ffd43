"""The laws close what they are to close without overshoot, and winds are vector sums."""

from math import asin, atan2, cos, hypot, pi, sin

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.turn import bank_for_turn_rate, turn_rate
from relguide.kernels.flight.energy import idle_deceleration, most_acceleration
from relguide.kernels.flight.flight_records import HOLD_HEADING, TURN_RATE, Control, Drift, Limits
from relguide.kernels.flight.laws import (
    ALIGNED,
    NEAR,
    Way,
    closing_tas,
    ground_track,
    heading_for_track,
    look_ahead,
    parabola,
    tas_for_ground_speed,
    track,
)
from relguide.kernels.flight.path import lay_path, project
from relguide.units import DEG
from tests.aloft import A306, GAINS, LIMITS, STILL, fly, level, limits_of, tracking

angles = st.floats(-pi, pi)
speeds = st.floats(120.0, 250.0)
winds = st.builds(
    lambda speed, to: Drift(speed * sin(to), speed * cos(to)), st.floats(0.0, 60.0), angles
)
SLUGGISH = limits_of(max_bank=25.0 * DEG)._replace(
    max_roll_rate=0.7 * A306.max_roll_rate, roll_time=1.3 * A306.roll_time_constant
)


@pytest.mark.parametrize("tas", [120.0, 180.0, 250.0])
@pytest.mark.parametrize("across", [20.0, 100.0, -400.0, 1_500.0, -5_000.0])
@pytest.mark.parametrize("limits", [LIMITS, SLUGGISH], ids=["as it is", "slow in roll"])
def test_a_straight_path_is_reached_without_overshoot(
    across: float, tas: float, limits: Limits
) -> None:
    path = lay_path(0.0, 0.0, 0.0, np.zeros((0, 2)), tas, 0.0, 1.0)
    begun = level(across, tas=tas)
    x = fly(tracking(path, tas=tas, limits=limits), begun, 240.0, limits=limits)[:, 0]
    assert np.max(-x * np.sign(across)) < 5.0
    assert abs(x[-1]) < 3.0
    settled = np.abs(x[-60 * 20 :])
    assert np.max(settled) - np.min(settled) < 5.0


@pytest.mark.parametrize("tas", [120.0, 180.0, 250.0])
@pytest.mark.parametrize("side", [-1.0, 1.0])
@pytest.mark.parametrize("across", [-300.0, 0.0, 300.0])
def test_a_turn_is_tracked_from_beside_it(across: float, side: float, tas: float) -> None:
    """At 2.5° less than the limit, out of and into a straight: the path lies 14 m off there."""
    rate = side * turn_rate(tas, 22.5 * DEG)
    turn = (60.0 if tas > 150.0 else 30.0) * tas
    pieces = np.array([[60.0 * tas, 0.0], [turn, rate / tas]])
    path = lay_path(0.0, 0.0, 0.0, pieces, tas, 0.0, LIMITS.max_roll_rate)
    flown = fly(tracking(path, tas=tas), level(across, tas=tas), 240.0)
    beside, s = [], 0.0
    for row in flown[::20]:
        s, right = project(path, row[0], row[1], s + tas)
        beside.append(right)
    assert np.max(np.abs(beside[55:])) < 30.0
    assert abs(beside[-1]) < 3.0
    assert flown[-1, 2] == pytest.approx(turn * rate / tas, abs=0.1 * DEG)
    assert np.max(np.abs(flown[:, 3])) <= LIMITS.max_bank * (1.0 + 1e-9)


def test_a_reversal_is_tracked_within_its_tube() -> None:
    tas, rate = 240.0, turn_rate(240.0, 22.5 * DEG)
    pieces = np.array([[7_000.0, rate / tas], [20_000.0, -rate / tas]])
    path = lay_path(0.0, 0.0, 0.0, pieces, tas, 22.5 * DEG, LIMITS.max_roll_rate)
    flown = fly(tracking(path), level(bank=22.5), 160.0)
    beside, s = [], 0.0
    for row in flown[::20]:
        s, right = project(path, row[0], row[1], s + tas)
        beside.append(right)
    # V Δr T²/24 = 111 m is what the ramps displace it by; the feedback removes it
    assert 20.0 < np.max(np.abs(beside)) < 130.0
    assert abs(beside[-1]) < 5.0


def way(**known: float) -> Way:
    return Way(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)._replace(**known)


def test_what_the_path_will_turn_when_it_is_felt_is_fed_forward() -> None:
    rate = turn_rate(240.0, 15.0 * DEG)
    ahead = way(felt=0.1, felt_after=0.1 + rate, later=0.05)
    asked = track(ahead, 0.05, level(), LIMITS.max_bank, 0.13, GAINS)
    assert (asked.kind, asked.value) == (TURN_RATE, pytest.approx(rate))


def test_next_to_a_straight_a_heading_is_held_and_else_a_turn_rate() -> None:
    def kind(offset: float, off: float = 0.0, **known: float) -> float:
        here = way(offset=offset, offset_later=offset, **known)
        return track(here, off, level(heading=off / DEG), LIMITS.max_bank, 0.13, GAINS).kind

    assert kind(0.9 * NEAR) == kind(-0.9 * NEAR, 0.9 * ALIGNED) == HOLD_HEADING
    assert kind(1.1 * NEAR) == kind(0.0, 1.1 * ALIGNED) == TURN_RATE
    assert kind(0.0, felt_after=0.001) == TURN_RATE


@given(st.floats(-3_000.0, 3_000.0), angles, speeds, st.floats(-0.02, 0.02))
def test_what_is_asked_for_is_within_the_limit_and_mirrors(
    offset: float, heading: float, tas: float, rate: float
) -> None:
    def asked(side: float) -> float:
        here = way(
            offset=side * offset, offset_later=side * offset, felt_after=side * rate,
            later=side * rate,
        )  # fmt: skip
        body = level(heading=side * heading / DEG, tas=tas)
        found = track(here, side * heading, body, LIMITS.max_bank, 0.13, GAINS)
        if found.kind == TURN_RATE:
            assert abs(bank_for_turn_rate(tas, found.value)) <= LIMITS.max_bank * (1.0 + 1e-9)
        return found.value

    assume(abs(abs(heading) - pi) > 0.3 and offset != 0.0)
    assume(abs(abs(wrap_signed(heading - rate)) - pi) > asin(sin(GAINS.intercept)) + 0.01)
    assert asked(1.0) == pytest.approx(-asked(-1.0))


def test_a_path_is_closed_on_no_steeper_than_asked() -> None:
    path = lay_path(0.0, 0.0, 0.0, np.zeros((0, 2)), 240.0, 0.0, 1.0)
    headings = fly(tracking(path), level(20_000.0), 150.0)[:, 2]
    assert np.min(headings) == pytest.approx(-GAINS.intercept, abs=1.0 * DEG)


@given(st.floats(0.0, 1e5), st.floats(0.1, 2.0), st.floats(1.0, 30.0))
def test_a_parabola_stops_within_its_error(error: float, deceleration: float, tau: float) -> None:
    v = parabola(error, deceleration, tau)
    assert v >= 0.0
    assert v == parabola(-error, deceleration, tau)
    # v² / 2a to stop, and v τ for the lag: together all of it
    assert v * v / (2.0 * deceleration) + v * tau == pytest.approx(error, rel=1e-6, abs=1e-6)
    assert v <= error / tau + 1e-9


def flown_spacing(error: float, tas: float, slot_tas: float) -> list[tuple[float, float]]:
    """Distance left to close and closing speed, each step of 20 minutes; asked once a second."""
    rows, asked = [], tas
    for k in range(24_000):
        if k % 20 == 0:
            most = most_acceleration(LIMITS, tas, 1.0)
            asked = closing_tas(error, slot_tas, 240.0, most, GAINS)
        change = (asked - tas) / LIMITS.speed_time
        idle = idle_deceleration(LIMITS, tas, 1.0)
        tas += 0.05 * min(max(change, -idle), most_acceleration(LIMITS, tas, 1.0))
        error -= 0.05 * (tas - slot_tas)
        rows.append((error, tas - slot_tas))
    return rows


def braking_distance(closing: float) -> float:
    """How far behind the slot the parabola is as fast as the closing speed [m]."""
    return closing * GAINS.speed_time + closing**2 / (2.0 * GAINS.braking)


@pytest.mark.parametrize("closing", [5.0, 40.0, 90.0])
def test_spacing_closes_within_its_error_at_idle_thrust(closing: float) -> None:
    begun = braking_distance(closing) + 1_000.0
    rows = flown_spacing(begun, 240.0, 240.0 - closing)
    assert min(error for error, _ in rows) > -5.0
    assert abs(rows[-1][0]) < 1.0
    assert abs(rows[-1][1]) < 0.1


@pytest.mark.parametrize("error", [-5_000.0, -300.0])
def test_spacing_opens_again_without_falling_back_too_far(error: float) -> None:
    rows = flown_spacing(error, 200.0, 200.0)
    assert min(closing for _, closing in rows) >= -GAINS.falling_back - 1e-9
    assert max(left for left, _ in rows) < 5.0
    assert abs(rows[-1][0]) < 1.0


def test_spacing_speed_rises_with_the_error_up_to_the_fastest() -> None:
    errors = [-5_000.0, -500.0, -50.0, 0.0, 50.0, 500.0, 5_000.0, 50_000.0]
    asked = [closing_tas(error, 200.0, 240.0, 0.4, GAINS) for error in errors]
    assert asked == sorted(asked)
    assert asked[3] == 200.0
    assert asked[-1] == 240.0
    assert asked[0] == 200.0 - GAINS.falling_back


def test_a_leader_as_fast_as_the_pursuer_can_still_be_caught_up_with() -> None:
    assert closing_tas(2_000.0, 240.0, 240.0, 0.4, GAINS) == 240.0 + GAINS.catching_up


def test_braking_begins_where_the_parabola_does() -> None:
    distance = braking_distance(40.0)
    assert distance > 40.0**2 / (2.0 * GAINS.braking)
    assert closing_tas(distance + 1.0, 200.0, 240.0, 0.4, GAINS) == 240.0
    assert closing_tas(0.99 * distance, 200.0, 240.0, 0.4, GAINS) < 240.0


@given(angles, speeds, winds)
def test_the_heading_for_a_track_moves_along_it(chi: float, tas: float, wind: Drift) -> None:
    heading = heading_for_track(chi, tas, wind)
    east, north = tas * sin(heading) + wind.east, tas * cos(heading) + wind.north
    assert wrap_signed(atan2(east, north) - chi) == pytest.approx(0.0, abs=1e-9)
    assert abs(heading - chi) <= asin(60.0 / tas) + 1e-9


def test_a_wind_faster_than_the_aircraft_is_met_as_well_as_can_be() -> None:
    assert heading_for_track(0.0, 50.0, Drift(60.0, 0.0)) == pytest.approx(-90.0 * DEG)


@given(st.floats(-20.0, 20.0), speeds, winds)
def test_the_ground_track_is_the_vector_sum_near_the_heading(
    heading: float, tas: float, wind: Drift
) -> None:
    chi, speed = ground_track(level(heading=heading / DEG, tas=tas), wind)
    east, north = tas * sin(heading) + wind.east, tas * cos(heading) + wind.north
    assert (speed * sin(chi), speed * cos(chi)) == pytest.approx((east, north), abs=1e-9)
    assert abs(chi - heading) <= asin(60.0 / tas) + 1e-9


@given(angles, st.floats(100.0, 300.0), winds)
def test_the_airspeed_for_a_ground_speed_gives_it(
    heading: float, speed: float, wind: Drift
) -> None:
    tas = tas_for_ground_speed(heading, speed, wind)
    east, north = tas * sin(heading) + wind.east, tas * cos(heading) + wind.north
    assert hypot(east, north) == pytest.approx(speed)


def test_no_airspeed_is_slow_enough_where_the_wind_alone_is_faster() -> None:
    assert tas_for_ground_speed(0.0, 50.0, Drift(60.0, 0.0)) == 0.0


@given(speeds, st.floats(-25.0, 25.0), st.floats(-10.0, 10.0), winds)
def test_a_moment_later_the_aircraft_is_where_it_looked(
    tas: float, bank: float, turned: float, wind: Drift
) -> None:
    """At its bank it is there exactly; a look-ahead of a bank that is kept."""
    body = level(heading=turned / DEG, bank=bank, tas=tas)
    asked = Control(TURN_RATE, turn_rate(tas, bank * DEG), tas)
    there = fly(asked, body, 2.0, wind=wind)[-1]
    assert look_ahead(body, wind, 2.0) == pytest.approx(tuple(there[:3]), abs=1e-6)


def test_half_of_the_roll_that_goes_on_is_reckoned_with() -> None:
    rolling = level(bank=10.0)._replace(roll_rate=2.0 * DEG)
    _, _, heading = look_ahead(rolling, STILL, 1.5)
    assert heading == pytest.approx(1.5 * turn_rate(240.0, 11.5 * DEG))
