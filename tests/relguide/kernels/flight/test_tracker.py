"""The tracker is a Kalman filter to the last digit, as sure as it may be, and soon sees a turn."""

from datetime import datetime, timedelta
from math import cos, sin, tan

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.linalg import expm
from stonesoup.models.measurement.linear import LinearGaussian
from stonesoup.models.transition.nonlinear import ConstantTurn
from stonesoup.predictor.kalman import ExtendedKalmanPredictor
from stonesoup.types.detection import Detection
from stonesoup.types.hypothesis import SingleHypothesis
from stonesoup.types.state import GaussianState
from stonesoup.updater.kalman import ExtendedKalmanUpdater

from relguide.kernels.flight.tracker import (
    RATE,
    RATE_NOISE,
    SPEED,
    SPEED_NOISE,
    TRACK,
    begin,
    predict,
    update,
)
from relguide.units import DEG, G0

Array = NDArray[np.float64]
PLACE, MOTION = 37.8, 1.2255
"""σ of NACp 8 [m] and NACv 2 [m/s]."""
STEPS = 20
BANK, ROLL = 25.0, 3.75
"""An A320's turn [°, °/s]."""
V = 230.0

states = st.builds(
    lambda v, track, rate: np.array([1e3, -2e3, v, track, rate]),
    st.floats(80.0, 320.0),
    st.floats(-10.0, 10.0),
    st.one_of(st.just(0.0), st.floats(-0.06, 0.06), st.floats(-1e-4, 1e-4)),
)
seconds = st.floats(0.1, 30.0)


def moved(state: Array, dt: float) -> Array:
    return np.asarray(predict(state, np.zeros((5, 5)), dt)[0])


def covariance_of(state: Array) -> Array:
    root = np.random.default_rng(5).standard_normal((5, 5))
    scale = np.array([40.0, 40.0, 1.0, 0.005, 0.003])
    return (root @ root.T) * np.outer(scale, scale)


@given(states, seconds)
def test_motion_solves_its_equations(state: Array, dt: float) -> None:
    """By Gauss-Legendre of the velocity: 20 points are exact here to 1e-9."""
    nodes, weights = np.polynomial.legendre.leggauss(20)
    track = state[TRACK] + state[RATE] * 0.5 * dt * (nodes + 1.0)
    x, y, v, chi, rate = moved(state, dt)
    assert x - state[0] == pytest.approx(0.5 * dt * weights @ (state[SPEED] * np.sin(track)))
    assert y - state[1] == pytest.approx(0.5 * dt * weights @ (state[SPEED] * np.cos(track)))
    assert (v, rate) == (state[SPEED], state[RATE])
    assert chi == pytest.approx(state[TRACK] + state[RATE] * dt)


@given(states, seconds)
def test_covariance_follows_the_derivatives_of_the_motion(state: Array, dt: float) -> None:
    steps = np.array([1.0, 1.0, 1e-2, 1e-5, 1e-7])
    slopes = np.stack(
        [
            (moved(state + h * axis, dt) - moved(state - h * axis, dt)) / (2.0 * h)
            for h, axis in zip(steps, np.eye(5), strict=True)
        ],
        axis=1,
    )
    before = covariance_of(state)
    noise = predict(state, np.zeros((5, 5)), dt)[1]
    found = predict(state, before, dt)[1] - noise
    wanted = slopes @ before @ slopes.T
    size = np.sqrt(np.outer(np.diag(wanted), np.diag(wanted)))
    assert np.abs((found - wanted) / size).max() < 1e-4


@given(st.floats(80.0, 320.0), st.floats(-10.0, 10.0), seconds)
def test_process_noise_is_the_exact_one_of_a_straight(v: float, track: float, dt: float) -> None:
    """Van Loan's matrix exponential of the motion linear about a straight."""
    flow = np.zeros((5, 5))
    flow[0, SPEED], flow[0, TRACK] = sin(track), v * cos(track)
    flow[1, SPEED], flow[1, TRACK] = cos(track), -v * sin(track)
    flow[TRACK, RATE] = 1.0
    density = np.diag([0.0, 0.0, SPEED_NOISE, 0.0, RATE_NOISE])
    block = expm(np.block([[-flow, density], [np.zeros((5, 5)), flow.T]]) * dt)
    wanted = block[5:, 5:].T @ block[:5, 5:]
    found = predict(np.array([0.0, 0.0, v, track, 0.0]), np.zeros((5, 5)), dt)[1]
    size = np.sqrt(np.outer(np.diag(wanted), np.diag(wanted)))
    assert np.abs((found - wanted) / size).max() < 1e-6


@given(states)
def test_an_update_is_kalmans(state: Array) -> None:
    """Against all four measurements at once, in east and north, by the textbook's matrices."""
    before = covariance_of(state)
    s, c, v = sin(state[TRACK]), cos(state[TRACK]), state[SPEED]
    off = np.array([20.0, -30.0, 0.8, -0.5])
    seen = np.array([state[0], state[1], v * s, v * c]) + off
    measure = np.zeros((4, 5))
    measure[0, 0] = measure[1, 1] = 1.0
    measure[2, SPEED], measure[2, TRACK] = s, v * c
    measure[3, SPEED], measure[3, TRACK] = c, -v * s
    spread = measure @ before @ measure.T + np.diag([PLACE, PLACE, MOTION, MOTION]) ** 2
    gain = before @ measure.T @ np.linalg.inv(spread)
    after, covariance, surprise = update(state, before, *seen, PLACE, MOTION)
    assert after == pytest.approx(state + gain @ off, rel=1e-9, abs=1e-9)
    wanted = before - gain @ measure @ before
    size = np.sqrt(np.outer(np.diag(before), np.diag(before)))
    assert np.abs((covariance - wanted) / size).max() < 1e-9
    assert surprise == pytest.approx(off @ np.linalg.solve(spread, off))


def flown(turns: bool, seconds: int = 200, begins: float = 60.0, lasts: float = 60.0) -> Array:
    """A leader each second, straight or with one turn rolled into and out of. shape (n, 5)"""
    x, y, track, rate, rows = 0.0, 0.0, 0.5, 0.0, []
    for k in range(seconds * STEPS):
        t, dt = k / STEPS, 1.0 / STEPS
        if turns:
            bank = np.clip(ROLL * (t - begins), 0.0, BANK)
            bank -= np.clip(ROLL * (t - begins - lasts), 0.0, BANK)
            rate = G0 * tan(bank * DEG) / V
        if k % STEPS == 0:
            rows.append((x, y, V, track, rate))
        x += V * sin(track + 0.5 * rate * dt) * dt
        y += V * cos(track + 0.5 * rate * dt) * dt
        track += rate * dt
    return np.array(rows)


def reports(truth: Array, rng: np.random.Generator) -> Array:
    """x, y, east, north of each second, with noise. shape (n, 4)"""
    v, track = truth[:, SPEED], truth[:, TRACK]
    exact = np.column_stack([truth[:, :2], v * np.sin(track), v * np.cos(track)])
    noise = rng.standard_normal(exact.shape) * np.array([PLACE, PLACE, MOTION, MOTION])
    return np.asarray(exact + noise)


def tracked(seen: Array) -> tuple[Array, Array, Array]:
    """States, covariances and surprises after each report."""
    state, covariance = begin(*seen[0], PLACE, MOTION)
    found = [(state, covariance, 4.0)]
    for report in seen[1:]:
        state, covariance = predict(state, covariance, 1.0)
        state, covariance, surprise = update(state, covariance, *report, PLACE, MOTION)
        found.append((state, covariance, surprise))
    a, b, c = zip(*found, strict=True)
    return np.array(a), np.array(b), np.array(c)


def many(turns: bool, runs: int = 200) -> tuple[Array, Array, Array, Array]:
    """Truth; errors (runs, n, 5); normalised estimation errors squared, and surprises (runs, n)."""
    truth, rng = flown(turns), np.random.default_rng(11)
    errors, nees, surprises = [], [], []
    for _ in range(runs):
        state, covariance, surprise = tracked(reports(truth, rng))
        off = state - truth
        errors.append(off)
        nees.append(
            np.einsum("ki,ki->k", off, np.linalg.solve(covariance, off[:, :, None])[..., 0])
        )
        surprises.append(surprise)
    return truth, np.array(errors), np.array(nees), np.array(surprises)


def test_straights_are_calm_and_no_less_certain_than_said() -> None:
    _, errors, nees, surprises = many(turns=False)
    settled = errors[:, 30:]
    assert settled[..., RATE].std() < 0.09 * DEG
    assert settled[..., TRACK].std() < 0.25 * DEG
    assert settled[..., SPEED].std() < 0.6
    assert settled[..., :2].std() < 12.0
    # a truth that never wanders is a little better known than a filter thinks that expects it to
    assert 3.0 < nees[:, 30:].mean() < 5.0
    assert 3.0 < surprises[:, 30:].mean() < 4.2


def test_a_turn_is_seen_within_four_seconds_and_the_end_of_it_too() -> None:
    truth, errors, nees, _ = many(turns=True)
    rate = (errors[..., RATE] + truth[:, RATE]) / DEG
    after = np.arange(rate.shape[1])
    seen = np.array([after[(after >= 60) & (run > 0.2)][0] - 60 for run in rate])
    ended = np.array([after[(after >= 120) & (run < 0.84)][0] - 120 for run in rate])
    assert seen.mean() < 4.0  # from the first roll; full bank is reached after 6.7 s
    assert np.quantile(seen, 0.95) <= 5
    assert ended.mean() < 4.5
    assert (np.abs(rate[:, 30:60]) > 0.3).mean() < 0.002
    assert np.abs(rate[:, 75:118].mean() - truth[75:118, RATE].mean() / DEG) < 0.02
    # in the steady turn it is as sure as it may be; while it rolls, less right than it says
    assert nees[:, 75:118].mean() < 5.0
    assert nees[:, 60:70].mean() < 20.0


def test_braking_is_followed() -> None:
    """At 0.7 m/s² for a minute: speed brakes."""
    t = np.arange(150.0)
    braked = np.clip(t - 60.0, 0.0, 60.0)
    v = V - 0.7 * braked
    y = V * t - 0.35 * braked**2 - 42.0 * np.clip(t - 120.0, 0.0, None)
    truth = np.column_stack([np.zeros(150), y, v, np.zeros(150), np.zeros(150)])
    rng = np.random.default_rng(13)
    off = np.mean([tracked(reports(truth, rng))[0] - truth for _ in range(100)], axis=0)
    assert 1.0 < off[80:120, SPEED].mean() < 2.0  # a filter without acceleration lags
    assert np.abs(off[130:, SPEED]).max() < 0.3
    assert np.abs(off[80:120, 1]).max() < 15.0


def test_who_flies_as_it_assumes_has_the_error_it_states() -> None:
    """A truth that wanders by the filter's own noise: mean of 200 · 60 squares of 5 degrees."""
    rng, nees = np.random.default_rng(12), []
    for _ in range(200):
        state = np.array([0.0, 0.0, V, 1.0, 0.0])
        rows = []
        for _ in range(60):
            rows.append(state)
            after, noise = predict(state, np.zeros((5, 5)), 1.0)
            state = after + np.linalg.cholesky(noise + 1e-12 * np.eye(5)) @ rng.standard_normal(5)
        truth = np.array(rows)
        found, covariance, _ = tracked(reports(truth, rng))
        off = (found - truth)[20:]
        nees.append([e @ np.linalg.solve(p, e) for e, p in zip(off, covariance[20:], strict=True)])
    # 95 % of means of 200 squares lie within 5 ± 0.44
    assert np.mean(nees) == pytest.approx(5.0, abs=0.44)


def test_after_a_silence_it_is_as_unsure_as_a_straight_flight_makes_it() -> None:
    state, covariance, _ = tracked(reports(flown(turns=False), np.random.default_rng(1)))
    sigmas = []
    late = state[-1], covariance[-1]
    for _ in range(30):
        late = predict(*late, 1.0)
        sigmas.append(np.sqrt(np.diag(late[1])))
    assert np.all(np.diff(np.array(sigmas), axis=0) >= -1e-9)
    once = predict(state[-1], covariance[-1], 30.0)
    # all at once, the noise acts across the track of the middle
    assert np.diag(once[1]) == pytest.approx(np.diag(late[1]), rel=0.06)


def test_an_aircraft_that_stands_has_a_track_of_no_certainty() -> None:
    state, covariance = begin(0.0, 0.0, 0.3, 0.0, PLACE, MOTION)
    for _ in range(5):
        state, covariance = predict(state, covariance, 1.0)
        state, covariance, _ = update(state, covariance, 0.0, 0.0, 0.2, -0.1, PLACE, MOTION)
    assert np.isfinite(state).all()
    assert np.linalg.eigvalsh(covariance).min() > 0.0


def stone_soup(seen: Array) -> tuple[Array, Array]:
    """States of ours and σ of the turn rate by Stone Soup's filter of x, ẋ, y, ẏ and turn rate."""
    motion = ConstantTurn(linear_noise_coeffs=[SPEED_NOISE] * 2, turn_noise_coeff=RATE_NOISE)
    measured = LinearGaussian(5, (0, 2, 1, 3), np.diag([PLACE, PLACE, MOTION, MOTION]) ** 2)
    predictor, updater = ExtendedKalmanPredictor(motion), ExtendedKalmanUpdater(measured)
    start, (x, y, east, north) = datetime(2026, 1, 1), seen[0]
    covariance = np.diag([PLACE, MOTION, PLACE, MOTION, 0.7 * DEG]) ** 2
    known = GaussianState([x, east, y, north, 1e-9], covariance, timestamp=start)
    states, sigmas = [], []
    for k, report in enumerate(seen):
        if k > 0:
            now = start + timedelta(seconds=k)
            expected = predictor.predict(known, timestamp=now)
            detection = Detection(report[:, None], timestamp=now, measurement_model=measured)
            known = updater.update(SingleHypothesis(expected, detection))
        x, east, y, north, left = np.asarray(known.state_vector, dtype=float)[:, 0]
        states.append((x, y, np.hypot(east, north), np.arctan2(east, north), -left))
        sigmas.append(np.sqrt(known.covar[4, 4]))
    return np.array(states), np.array(sigmas)


@pytest.mark.slow
def test_stone_soup_sees_the_same() -> None:
    """The same motion in other coordinates, at the same noise, in a straight and a steady turn.

    Its turn noise acts a second late and its speed noise on all sides: so the two differ, by less
    than their errors.
    """
    for rate in (0.0, 1.1 * DEG):
        track = 0.3 + rate * np.arange(100.0)
        radius = V / rate if rate else 0.0
        x = radius * (np.cos(0.3) - np.cos(track)) if rate else V * np.sin(0.3) * np.arange(100.0)
        y = radius * (np.sin(track) - np.sin(0.3)) if rate else V * np.cos(0.3) * np.arange(100.0)
        truth = np.column_stack([x, y, np.full(100, V), track, np.full(100, rate)])
        seen = reports(truth, np.random.default_rng(21))
        ours, covariance, _ = tracked(seen)
        theirs, sigmas = stone_soup(seen)
        off = (ours - theirs)[20:]
        off[:, TRACK] = np.angle(np.exp(1j * off[:, TRACK]))
        assert np.abs(off[:, :2]).max() < 12.0
        assert np.abs(off[:, SPEED]).max() < 1.0
        assert np.abs(off[:, TRACK]).max() < 0.3 * DEG
        assert np.abs(off[:, RATE]).max() < 0.15 * DEG
        assert np.sqrt(covariance[-1, RATE, RATE]) == pytest.approx(sigmas[-1], rel=0.35)
