"""The loops capture a heading without overshoot and never bank beyond the limit."""

from math import pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.turn import turn_rate
from relguide.kernels.flight.autopilot import INTEGRATE_WITHIN, aileron, commanded_bank
from relguide.kernels.flight.flight_records import TURN_RATE, Body, Control
from relguide.kernels.flight.program import roll_lead
from relguide.units import DEG
from tests.aloft import LIMITS, MAX_BANK, STEP, fly, hold, level

ROUNDING = 1.0 + 1e-9


def turning(bank: float, tas: float = 240.0) -> Control:
    """The turn rate of a bank in degrees."""
    return Control(TURN_RATE, turn_rate(tas, bank * DEG), tas)


@pytest.mark.parametrize("tas", [130.0, 200.0, 245.0])
@pytest.mark.parametrize("change", [1.0, -4.0, 10.0, -45.0, 90.0, 170.0])
def test_a_heading_is_captured_without_overshoot(change: float, tas: float) -> None:
    flown = fly(hold(change % 360.0, tas), level(tas=tas), 200.0)
    errors = flown[:, 2] - change * DEG
    assert np.max(errors * np.sign(change)) < 0.2 * DEG
    assert abs(errors[-1]) < 0.1 * DEG
    assert np.max(np.abs(flown[:, 3])) <= LIMITS.max_bank * ROUNDING
    assert np.max(np.abs(flown[:, 4])) <= LIMITS.max_roll_rate * ROUNDING


@given(
    st.floats(-pi, pi), st.floats(-MAX_BANK, MAX_BANK), st.floats(120.0, 250.0),
    st.floats(5.0 * DEG, MAX_BANK),
)  # fmt: skip
def test_bank_is_never_above_the_limit(
    heading: float, bank: float, tas: float, limit: float
) -> None:
    limits = LIMITS._replace(max_bank=limit)
    begun = level(tas=tas)._replace(bank=min(max(bank, -limit), limit))
    for control in (hold(heading / DEG, tas), Control(TURN_RATE, heading, tas)):
        banks = fly(control, begun, 60.0, limits=limits)[:, 3]
        assert np.max(np.abs(banks)) <= limit * ROUNDING


@pytest.mark.parametrize("bank", [-25.0, -10.0, 5.0, 25.0])
def test_a_turn_rate_is_reached_and_kept(bank: float) -> None:
    banks = fly(turning(bank), level(), 60.0)[:, 3]
    assert banks[-1] == pytest.approx(bank * DEG, abs=0.01 * DEG)
    assert np.max(np.abs(banks)) <= abs(bank) * DEG * ROUNDING


def test_more_turn_than_the_bank_limit_gives_is_not_flown() -> None:
    banks = fly(Control(TURN_RATE, 0.2, 240.0), level(), 30.0)[:, 3]
    assert banks[-1] == pytest.approx(LIMITS.max_bank)


@pytest.mark.parametrize(("before", "after"), [(0.0, 25.0), (-25.0, 25.0), (10.0, -25.0)])
@pytest.mark.parametrize("tas", [120.0, 240.0])
def test_the_lag_of_a_roll_is_what_is_led(before: float, after: float, tas: float) -> None:
    """The heading lost against an instantaneous change of bank, in seconds of it."""
    end = fly(turning(after, tas), level(bank=before, tas=tas), 30.0)[-1, 2]
    rates = [turn_rate(tas, bank * DEG) for bank in (before, after)]
    late = (30.0 * rates[1] - end) / (rates[1] - rates[0])
    assert late == pytest.approx(roll_lead(LIMITS, before * DEG, after * DEG), abs=0.5)


def test_the_opposite_heading_is_turned_to_one_way() -> None:
    assert np.min(fly(hold(180.0 - 0.5), level(), 100.0)[:, 3]) > -0.5 * DEG


def test_a_heading_counted_on_is_held_as_the_same_direction() -> None:
    """Headings are continuous: after a full turn, north is 360°."""
    flown = fly(hold(0.0), level(heading=725.0), 60.0)
    assert flown[-1, 2] == pytest.approx(720.0 * DEG, abs=0.1 * DEG)


def test_the_integral_grows_near_the_heading_and_nowhere_else() -> None:
    near, far = 0.5 * INTEGRATE_WITHIN, 1.5 * INTEGRATE_WITHIN
    for error, before, after in ((near, 0.3, 0.3 + near * STEP), (far, 0.3, far * STEP)):
        body = level()._replace(integral=before)
        _, integral = commanded_bank(body, hold(error / DEG), LIMITS, STEP)
        assert integral == pytest.approx(after)
    assert commanded_bank(level()._replace(integral=0.3), turning(5.0), LIMITS, STEP)[1] == 0.0


def test_nothing_is_wound_up_at_the_limit() -> None:
    tight, wound = LIMITS._replace(max_bank=0.1 * DEG), 0.02
    away = level()._replace(integral=wound)
    assert commanded_bank(away, hold(1.5), tight, STEP)[1] == wound
    # but it unwinds: an integral that pushes away from the heading is not kept
    heavy = level()._replace(integral=50.0)
    assert commanded_bank(heavy, hold(-0.05), tight, STEP)[1] < 50.0


def test_a_steady_bias_is_removed() -> None:
    """Wings that fly level with 0.3° of bank: the heading comes back, the integral carries it."""
    body, bias = level(), 0.3 * DEG
    for _ in range(round(1500.0 / STEP)):
        felt = body._replace(bank=body.bank - bias)
        bank, integral = commanded_bank(felt, hold(0.0), LIMITS, STEP)
        asked = aileron(bank, felt, LIMITS)
        bank = body.bank + asked * STEP
        turned = body.heading + turn_rate(body.tas, bank) * STEP
        body = Body(0.0, 0.0, turned, bank, 0.0, body.tas, integral)
    assert abs(wrap_signed(body.heading)) < 0.02 * DEG
    assert abs(body.integral) > 0.0
