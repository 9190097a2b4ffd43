"""The pilot of the bar, held against transfer functions and against the autopilot."""

from collections.abc import Callable
from dataclasses import replace
from math import exp, pi

import control
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from relguide.flying.pilot_model import PilotModel
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.flight import by_hand
from relguide.kernels.flight.autopilot import aileron
from relguide.kernels.flight.by_hand import (
    HAND_BANK,
    NOISE,
    REACTS_AT,
    STICK,
    follow_bar,
    roll_by_stick,
    smooth_bar,
)
from relguide.kernels.flight.flight_records import Body
from relguide.kernels.flight.lateral import roll_step
from relguide.units import DEG
from tests.aloft import A306, LIMITS, MAX_BANK, STEP, STILL, level

ROLL_MODE = A306.roll_time_constant
PLAIN = PilotModel(remnant=0.0, threshold=0.0, reaction=0.0)
"""The crossover model and nothing else."""
pilots = st.builds(
    PilotModel,
    bandwidth=st.floats(0.5, 1.5),
    delay=st.floats(0.15, 0.45),
    remnant=st.floats(0.01, 0.03),
    threshold=st.floats(0.5, 1.5).map(lambda degrees: degrees * DEG),
)


def flown(
    pilot: PilotModel,
    commanded: Callable[[float], float],
    duration: float,
    *,
    whites: FloatArray | None = None,
    step: float = STEP,
) -> FloatArray:
    """Bank and stick at each step of an aircraft whose pilot follows a commanded bank.

    shape (n + 1, 2)
    """
    count = round(duration / step)
    hand, body = pilot.row(step), level()
    rows = [(body.bank, 0.0)]
    for k in range(count):
        before = hand[by_hand.BAR]
        smooth_bar(hand, commanded(k * step) - body.bank, step)
        white = 0.0 if whites is None else whites[k]
        follow_bar(hand, before, body, white, LIMITS, k * step, step)
        roll = roll_by_stick(hand[STICK], body, LIMITS)
        body = roll_step(body, roll, 0.0, body.tas, LIMITS, STILL, step)
        rows.append((body.bank, hand[STICK]))
    return np.array(rows)


def held(pilot: PilotModel, error: float, steps: int, rng: np.random.Generator) -> FloatArray:
    """The remnant of a pilot that sees one error all the time [rad]."""
    hand, body, found = pilot.row(STEP), level(), []
    hand[by_hand.BAR] = error
    for white in rng.standard_normal(steps):
        follow_bar(hand, error, body, white, LIMITS, 0.0, STEP)
        found.append(hand[NOISE])
    return np.array(found)


def crossover(pilot: PilotModel, omega: FloatArray, step: float) -> FloatArray:
    """ω_c e^(−τ s)/s · 1/(0.5 s + 1), and the half step that a stick is held for longer.

    A lead feeds the rate of roll back.
    """
    s = 1j * omega
    answer = pilot.bandwidth * np.exp(-(pilot.delay + 0.5 * step) * s)
    return answer / (s * (ROLL_MODE * s + 1.0 + answer * pilot.lead))


def open_loop(pilot: PilotModel, periods: FloatArray, step: float) -> FloatArray:
    """Bank over error, by the response to sines that all fit into the same time."""
    lasts, size = 64.0 * pi, 0.1 * DEG
    omega = 2.0 * pi * periods / lasts
    phases = np.arange(len(omega)) ** 2
    count = round(lasts / step)

    def commanded(t: float) -> float:
        return float(size * np.sum(np.sin(2.0 * pi * periods * t / (count * step) + phases)))

    whole = flown(pilot, commanded, 2 * count * step, step=step)[:, 0]
    asked = np.array([commanded(k * step) for k in range(2 * count)])
    last = slice(count, 2 * count)  # the first round settles
    over = [np.exp(-2j * pi * one * np.arange(count) / count) for one in periods]
    return np.array(
        [np.vdot(wave.conj(), whole[last]) / np.vdot(wave.conj(), (asked - whole[:-1])[last])
         for wave in over]
    )  # fmt: skip


SINES = np.array([5.0, 9.0, 16.0, 32.0, 45.0, 64.0])
"""Rounds in 201 s: 0.16 … 2 rad/s."""


@pytest.mark.slow
@pytest.mark.parametrize("bandwidth", [0.5, 1.0, 1.5])
@pytest.mark.parametrize("delay", [0.0, 0.32, 0.45])
def test_pilot_and_aircraft_are_the_crossover_model(bandwidth: float, delay: float) -> None:
    pilot = replace(PLAIN, bandwidth=bandwidth, delay=delay)
    omega = SINES / 32.0
    found = open_loop(pilot, SINES, STEP)
    np.testing.assert_allclose(found, crossover(pilot, omega, STEP), rtol=0.01)


@pytest.mark.slow
def test_the_usual_pilot_has_45_degrees_of_phase_at_1_rad_per_second() -> None:
    (found,) = open_loop(PLAIN, np.array([32.0]), STEP)
    margin = 180.0 + np.angle(found) / DEG
    assert 44.0 < margin < 46.2
    assert abs(found) == pytest.approx(1.0 / np.hypot(1.0, ROLL_MODE), rel=0.01)


@pytest.mark.slow
def test_a_lead_damps_the_roll() -> None:
    pilot = replace(PLAIN, lead=ROLL_MODE, delay=0.2)
    found = open_loop(pilot, SINES, 0.01)
    np.testing.assert_allclose(found, crossover(pilot, SINES / 32.0, 0.01), rtol=0.01)


@pytest.mark.parametrize("delay", [0.0, 0.3, 0.45])
def test_a_step_is_answered_as_linear_theory_has_it(delay: float) -> None:
    pilot = replace(PLAIN, delay=delay)
    found = flown(pilot, lambda t: 2.0 * DEG, 20.0)[:, 0]
    plant = control.c2d(control.tf([pilot.bandwidth], [ROLL_MODE, 1.0, 0.0]), STEP, "zoh")
    late = control.tf([1.0], [1.0, *np.zeros(round(delay / STEP))], STEP)
    times = STEP * np.arange(len(found))
    closed = control.feedback(plant * late, 1)
    _, wanted = control.forced_response(closed, times, np.full(len(times), 2.0))
    np.testing.assert_allclose(found / DEG, wanted, atol=1e-6)


@pytest.mark.parametrize(("delay", "step"), [(0.0, 0.05), (0.3, 0.05), (0.4, 0.02), (1.5, 0.05)])
def test_the_stick_moves_exactly_the_delay_after_the_bar(delay: float, step: float) -> None:
    late = round(delay / step)
    sticks = flown(replace(PLAIN, delay=delay), lambda t: 3.0 * DEG, 3.0, step=step)[1:, 1]
    assert np.all(np.abs(sticks[:late]) < 1e-12)
    assert sticks[late] == pytest.approx(3.0 * DEG / LIMITS.max_roll_rate)


@given(st.floats(0.0, 1.5))
def test_a_delay_between_two_steps_is_no_less_exact(delay: float) -> None:
    """An error that grows evenly shows when it was seen."""
    pilot, body = replace(PLAIN, delay=delay), level()
    hand, rate = pilot.row(STEP), 0.1 * DEG
    for k in range(200):
        before = hand[by_hand.BAR]
        smooth_bar(hand, rate * k * STEP, STEP)
        follow_bar(hand, before, body, 0.0, LIMITS, k * STEP, STEP)
        t = k * STEP
    wanted = pilot.bandwidth * rate * (t - delay) / LIMITS.max_roll_rate
    assert hand[STICK] == pytest.approx(wanted, rel=1e-9)


@pytest.mark.parametrize("remnant", [0.01, 0.02, 0.03])
def test_the_remnant_has_its_share_of_the_errors_variance_and_its_spectrum(remnant: float) -> None:
    error, step = 4.0 * DEG, STEP
    noise = held(replace(PLAIN, remnant=remnant), error, 400_000, np.random.default_rng(3))[4_000:]
    # 20,000 s with a correlation time of 1 s: the variance is known to 1 %
    assert np.var(noise) == pytest.approx(remnant * error**2, rel=0.04)
    assert np.mean(noise) == pytest.approx(0.0, abs=0.02 * error)
    for lag in (0.5, 1.0, 2.0):
        k = round(lag / step)
        assert np.mean(noise[k:] * noise[:-k]) / np.var(noise) == pytest.approx(exp(-lag), abs=0.03)


def test_without_errors_there_is_no_remnant() -> None:
    noise = held(PLAIN, 0.0, 1_000, np.random.default_rng(3))
    assert not noise.any()


def test_small_errors_stand_and_larger_ones_are_answered_in_full() -> None:
    pilot = replace(PLAIN, threshold=1.0 * DEG)
    assert not flown(pilot, lambda t: 0.99 * DEG, 10.0)[:, 0].any()
    above = flown(pilot, lambda t: 1.5 * DEG, 2.0)[:, 1]
    assert above.max() == pytest.approx(1.5 * DEG / LIMITS.max_roll_rate)


def test_the_stick_is_neutral_until_the_pilot_reacts() -> None:
    hand, body = PLAIN.row(STEP), level()
    hand[REACTS_AT] = 2.0
    for k in range(60):
        before = hand[by_hand.BAR]
        smooth_bar(hand, 5.0 * DEG, STEP)
        follow_bar(hand, before, body, 0.0, LIMITS, k * STEP, STEP)
        assert (hand[STICK] != 0.0) == (k * STEP >= 2.0)


@given(pilots, st.integers(0, 100))
def test_a_mirrored_flight_is_the_mirror_image(pilot: PilotModel, seed: int) -> None:
    whites = np.random.default_rng(seed).standard_normal(200)
    found = flown(pilot, lambda t: 15.0 * DEG, 10.0, whites=whites)
    mirrored = flown(pilot, lambda t: -15.0 * DEG, 10.0, whites=-whites)
    np.testing.assert_array_equal(mirrored, -found)


@given(
    st.floats(-MAX_BANK, MAX_BANK),
    st.floats(-MAX_BANK, MAX_BANK),
    st.floats(-LIMITS.max_roll_rate, LIMITS.max_roll_rate),
    st.floats(-HAND_BANK, HAND_BANK),
)
def test_the_perfect_pilot_asks_what_the_autopilot_asks(
    commanded: float, bank: float, roll_rate: float, before: float
) -> None:
    body = Body(0.0, 0.0, 0.0, bank, roll_rate, 240.0, 0.0)
    hand = PilotModel.perfect().row(STEP)
    hand[by_hand.BAR] = before
    smooth_bar(hand, commanded - bank, STEP)
    follow_bar(hand, before, body, 1.0, LIMITS, 0.0, STEP)
    asked = roll_by_stick(hand[STICK], body, LIMITS)
    assert asked == pytest.approx(aileron(commanded, body, LIMITS), abs=1e-12)


def test_a_pilot_nears_the_autopilot_as_it_nears_its_law() -> None:
    perfect, usual = PilotModel.perfect(), replace(PLAIN, threshold=1.0 * DEG)
    best = flown(perfect, lambda t: 20.0 * DEG, 20.0)[:, 0]
    names = "bandwidth", "delay", "threshold", "lead"
    off = []
    for share in (1.0, 0.5, 0.2, 0.05, 0.0):
        changed = {
            name: (1.0 - share) * getattr(perfect, name) + share * getattr(usual, name)
            for name in names
        }
        found = flown(replace(PLAIN, **changed), lambda t: 20.0 * DEG, 20.0)[:, 0]
        off.append(float(np.max(np.abs(found - best))))
    assert off == sorted(off, reverse=True)
    assert off[-2] < 0.1 * off[0]
    assert off[-1] == 0.0
