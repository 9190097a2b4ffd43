"""One aircraft in flight keeps to its differential equations and its limits."""

from itertools import pairwise
from math import cos, hypot, pi, sin, tan

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from relguide.flying.air import STANDARD_AIR
from relguide.flying.envelope import FL310
from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.turn import turn_rate
from relguide.kernels.flight.autopilot import (
    HEADING_KD,
    HEADING_KI,
    HEADING_KP,
    INTEGRATE_WITHIN,
    ROLL_KD,
    ROLL_KP,
    aileron,
    commanded_bank,
)
from relguide.kernels.flight.energy import full_deceleration, least_tas, most_acceleration
from relguide.kernels.flight.flight_records import HOLD_HEADING, TURN_RATE, Body, Control, Drift
from relguide.kernels.flight.lateral import lateral_step
from relguide.units import DEG, G0
from tests.aloft import A306, LIMITS, MAX_BANK, STEP, STILL, fly, hold, level

WIND = Drift(22.0, -13.0)
bodies = st.builds(
    Body,
    st.just(0.0),
    st.just(0.0),
    st.floats(-10.0, 10.0),
    st.floats(-MAX_BANK, MAX_BANK),
    st.floats(-LIMITS.max_roll_rate, LIMITS.max_roll_rate),
    st.floats(120.0, 250.0),
    st.just(0.0),
)
controls = st.one_of(
    st.builds(Control, st.just(HOLD_HEADING), st.floats(0.0, 6.28), st.floats(120.0, 250.0)),
    st.builds(Control, st.just(TURN_RATE), st.floats(-0.03, 0.03), st.floats(120.0, 250.0)),
)


def bank_rate(bank: float) -> Control:
    """The turn rate of a bank in degrees, at 240 m/s."""
    return Control(TURN_RATE, turn_rate(240.0, bank * DEG), 240.0)


def rates(state: np.ndarray, asked: float, tas: float, wind: Drift) -> list[float]:
    """The differential equations; state as `Body` without its integral, by an aileron."""
    _, _, heading, bank, roll_rate, v = state
    n2 = 1.0 / cos(bank) ** 2
    most = most_acceleration(LIMITS, v, n2)
    tas = max(tas, least_tas(LIMITS, n2))
    gain = max((tas - v) / A306.speed_time_constant, -full_deceleration(LIMITS, v, n2))
    return [
        v * sin(heading) + wind.east,
        v * cos(heading) + wind.north,
        G0 / v * tan(bank),
        roll_rate,
        (asked - roll_rate) / A306.roll_time_constant,
        min(gain, most),
    ]


@given(bodies, controls)
def test_a_step_is_what_the_differential_equations_give(body: Body, control: Control) -> None:
    asked = aileron(commanded_bank(body, control, LIMITS, STEP)[0], body, LIMITS)
    exact = solve_ivp(
        lambda t, state: rates(state, asked, control.tas, WIND),
        (0.0, STEP), body[:6], rtol=1e-9, atol=1e-9,
    ).y[:, -1]  # fmt: skip
    stepped = lateral_step(body, control, LIMITS, WIND, STEP)
    assert stepped[:2] == pytest.approx(exact[:2], abs=2e-4)  # of 12 m
    assert stepped.heading == pytest.approx(exact[2], abs=1e-6)  # of up to 0.01 rad
    assert stepped[3:5] == pytest.approx(exact[3:5], abs=1e-9)
    assert stepped.tas == pytest.approx(exact[5], abs=3e-4)  # a dt²/(2 τ_V), of 0.05 m/s


def autopilot(state: np.ndarray, control: Control) -> tuple[float, float]:
    """What the autopilot asks for if it acts all the time, and the rate of its integral."""
    _, _, heading, bank, roll_rate, v, integral = state
    most, wanted, growth = G0 / v * tan(MAX_BANK), control.value, 0.0
    if control.kind == HOLD_HEADING:
        error = wrap_signed(control.value - heading)
        near = abs(error) <= INTEGRATE_WITHIN
        wanted = HEADING_KP * error + HEADING_KI * integral * near
        wanted -= HEADING_KD * G0 / v * tan(bank)
        growth = error if near else 0.0
        wanted = min(max(wanted, -most), most)
    roll = ROLL_KP * (np.arctan(v * wanted / G0) - bank) - ROLL_KD * roll_rate
    limit = A306.max_roll_rate
    return min(max(roll, -limit), limit), growth


def fly_exactly(legs: list[tuple[float, Control]], begun: Body, wind: Drift) -> np.ndarray:
    """Where legs end that an autopilot flies which acts all the time."""
    state = np.array(begun)
    for duration, control in legs:

        def slope(t: float, now: np.ndarray, control: Control = control) -> list[float]:
            asked, growth = autopilot(now, control)
            return [*rates(now[:6], asked, control.tas, wind), growth]

        state[6] = 0.0  # each leg begins far from its heading, and nothing is integrated there
        whole = solve_ivp(slope, (0.0, duration), state, rtol=1e-9, atol=1e-9, max_step=1.0)
        state = whole.y[:, -1]
    return state


LEGS = [
    (60.0, hold(0.0)),
    (100.0, bank_rate(22.5)),
    (140.0, bank_rate(-22.5)),
    (200.0, hold(70.0, tas=200.0)),
    (300.0, hold(250.0, tas=200.0)),
    (338.0, hold(180.0, tas=240.0)),
]
"""19 minutes with rolls, a reversal, captures, braking and speeding up."""


def fly_stepped(step: float) -> Body:
    now = level()
    for duration, control in LEGS:
        now = Body(*fly(control, now, duration, wind=WIND, step=step)[-1])
    return now


@pytest.mark.slow
@pytest.mark.parametrize(("step", "off"), [(0.05, 5.0), (0.01, 1.0)])
def test_whole_flights_end_where_the_differential_equations_do(step: float, off: float) -> None:
    """Off in proportion to the step: the autopilot acts on what was half a step ago."""
    exact, stepped = fly_exactly(LEGS, level(), WIND), fly_stepped(step)
    assert hypot(stepped.x - exact[0], stepped.y - exact[1]) < off
    assert stepped.heading == pytest.approx(exact[2], abs=1e-4)
    assert stepped.tas == pytest.approx(exact[5], abs=1e-4)


def test_straight_flight_goes_where_the_nose_points() -> None:
    x, y, heading, *_ = fly(hold(90.0), level(heading=90.0), 10.0)[-1]
    assert (x, y) == pytest.approx((2400.0, 0.0), abs=1e-6)
    assert heading == 90.0 * DEG


def test_wind_carries_but_does_not_turn() -> None:
    x, y, heading, *_ = fly(hold(0.0), level(), 10.0, wind=Drift(20.0, -5.0))[-1]
    assert (x, y) == pytest.approx((200.0, 2350.0))
    assert heading == 0.0


@pytest.mark.parametrize("bank", [-25.0, 10.0, 25.0])
def test_banked_flight_turns_as_eq_8_says(bank: float) -> None:
    flown = fly(bank_rate(bank), level(bank=bank), 30.0)
    assert flown[-1, 2] == pytest.approx(30.0 * G0 / 240.0 * tan(bank * DEG))


def test_full_circle_closes_and_its_heading_is_counted_on() -> None:
    period = 2.0 * pi * 240.0 / (G0 * tan(25.0 * DEG))
    body, step = level(bank=25.0), period / 3000
    for _ in range(3000):
        body = lateral_step(body, bank_rate(25.0), LIMITS, STILL, step)
    assert (body.x, body.y) == pytest.approx((0.0, 0.0), abs=1e-3)
    assert body.heading == pytest.approx(2.0 * pi)


def test_roll_follows_the_ailerons_with_their_lag_and_no_faster_than_the_limit() -> None:
    flown = fly(bank_rate(25.0), level(), 3.0)
    fastest, lag = A306.max_roll_rate, A306.roll_time_constant
    assert np.max(flown[:, 4]) == pytest.approx(fastest, rel=0.01)
    assert np.max(flown[:, 4]) <= fastest
    assert flown[-1, 3] == pytest.approx(fastest * (3.0 - lag), rel=0.01)


def test_roll_does_not_depend_on_the_step() -> None:
    # at its limit for all of the second, the aileron is the same however often it is asked for
    coarse = lateral_step(level(), bank_rate(25.0), LIMITS, STILL, 1.0)
    fine = fly(bank_rate(25.0), level(), 1.0, step=0.01)[-1]
    assert fine[3:5] == pytest.approx((coarse.bank, coarse.roll_rate))


@pytest.mark.parametrize(
    ("asked", "least", "most"),
    [(250.0, 240.0, 250.0), (400.0, 240.0, LIMITS.max_tas), (0.0, LIMITS.min_tas, 240.0)],
)
def test_speed_stays_within_what_the_autothrust_accepts(
    asked: float, least: float, most: float
) -> None:
    tas = fly(hold(0.0, tas=asked), level(), 200.0)[:, 5]
    assert np.min(tas) >= least
    assert np.max(tas) <= most
    assert min(abs(tas[-1] - least), abs(tas[-1] - most)) < 1e-3


def test_acceleration_is_what_thrust_and_drag_give_both_ways() -> None:
    faster = fly(hold(0.0, tas=250.0), level(tas=200.0), 1.0)[-1, 5] - 200.0
    slower = 240.0 - fly(hold(0.0, tas=120.0), level(), 1.0)[-1, 5]
    assert faster == pytest.approx(A306.excess_acceleration(FL310, 200.0, STANDARD_AIR), rel=0.01)
    brakes = 240.0**2 * LIMITS.brakes
    idle = A306.idle_deceleration(FL310, 240.0, STANDARD_AIR)
    assert slower == pytest.approx(idle + brakes, rel=0.01)


def test_a_turn_costs_what_the_drag_of_its_lift_is() -> None:
    straight = fly(hold(0.0, tas=270.0), level(tas=220.0), 10.0)[-1, 5]
    turning = fly(Control(TURN_RATE, turn_rate(220.0, 25.0 * DEG), 270.0),
                  level(bank=25.0, tas=220.0), 10.0)[-1, 5]  # fmt: skip
    more = LIMITS.induced * tan(25.0 * DEG) ** 2 / 220.0**2
    assert straight - turning == pytest.approx(10.0 * more, rel=0.05)
    assert 0.03 < more < 0.06


def test_an_aircraft_whose_thrust_is_too_little_for_its_bank_loses_speed() -> None:
    weak = LIMITS._replace(climb_0=LIMITS.climb_0 - 0.25)
    tas = fly(bank_rate(25.0), level(bank=25.0), 60.0, limits=weak)[:, 5]
    assert np.all(np.diff(tas) < 0.0)
    assert 180.0 < tas[-1] < 239.0


def test_no_speed_is_lost_below_the_least() -> None:
    weak = LIMITS._replace(climb_0=LIMITS.climb_0 - 3.0, min_tas=150.0)
    tas = fly(hold(0.0, tas=200.0), level(tas=160.0), 60.0, limits=weak)[:, 5]
    assert tas[-1] == pytest.approx(150.0, abs=0.2)


def test_the_autothrust_keeps_a_higher_least_speed_in_a_bank() -> None:
    limits = LIMITS._replace(min_tas=150.0)
    slow = fly(bank_rate(25.0)._replace(tas=100.0), level(bank=25.0, tas=200.0), 120.0,
               limits=limits)[-1]  # fmt: skip
    assert slow[5] == pytest.approx(150.0 / cos(slow[3]) ** 0.5, abs=0.1)


@given(bodies, controls, st.floats(0.01, 0.1))
def test_the_mirror_image_is_flown_in_the_mirror(body: Body, control: Control, dt: float) -> None:
    def mirrored(body: Body) -> tuple[float, ...]:
        return -body.x, body.y, -body.heading, -body.bank, -body.roll_rate, body.tas, -body.integral

    image = lateral_step(
        Body(*mirrored(body)), control._replace(value=-control.value), LIMITS, Drift(-9.0, 4.0), dt
    )
    there = lateral_step(body, control, LIMITS, Drift(9.0, 4.0), dt)
    assert image == pytest.approx(mirrored(there), abs=1e-9)


def test_track_is_as_long_as_the_speed_says() -> None:
    flown = fly(bank_rate(25.0), level(), 60.0)
    length = sum(hypot(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(flown))
    assert length == pytest.approx(60.0 * 240.0, rel=1e-6)
