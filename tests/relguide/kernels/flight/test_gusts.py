"""Gusts have Dryden's variance and spectrum, at any speed and step."""

from math import pi

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.signal import welch

from relguide.kernels.flight.gusts import SCALE, STATE, gust_steps

Array = NDArray[np.float64]


def gusts(sigma: float, tas: float, dt: float, steps: int, seed: int = 1) -> Array:
    white = np.random.default_rng(seed).standard_normal((steps + 1, 2))
    return gust_steps(np.zeros(STATE), sigma, tas, dt, white)


def spectra(sigma: float, tas: float, f: Array) -> Array:
    """Dryden's, of both gusts, one-sided in f [m²/s² per Hz]: 2π Φ(2πf)."""
    t = SCALE / tas
    w = (2.0 * pi * f * t) ** 2
    along = 4.0 * t / (1.0 + w)
    across = 2.0 * t * (1.0 + 3.0 * w) / (1.0 + w) ** 2
    return sigma * sigma * np.stack([along, across])


@pytest.mark.slow
@pytest.mark.parametrize("tas", [120.0, 240.0])
def test_variance_and_spectrum_are_drydens(tas: float) -> None:
    sigma, dt = 1.5, 0.05
    flown = gusts(sigma, tas, dt, 1_000_000)[2_000:]
    # 50,000 s are some 11,000 lengths of correlation or more: 2 % is two of their σ
    assert flown.var(axis=0) == pytest.approx(sigma * sigma, rel=0.04)
    f, found = welch(flown, fs=1.0 / dt, nperseg=8_192, axis=0)
    band = (f > 0.005) & (f < 1.0)  # above, what 20 samples a second fold back tells
    wanted = spectra(sigma, tas, f[band])
    # each of the bins is right to 1/√240, and their mean by a tenth of that
    ratio = found[band].T / wanted
    assert ratio.mean(axis=1) == pytest.approx(1.0, abs=0.02)
    assert np.abs(ratio - 1.0).max() < 0.4


@pytest.mark.parametrize(("tas", "dt"), [(240.0, 0.05), (120.0, 0.05), (230.0, 1.0), (150.0, 5.0)])
def test_covariances_of_the_filters_are_drydens(tas: float, dt: float) -> None:
    """By the response to one unit of white noise: R(k dt) = Σ h_i h_(i+k), for long enough."""
    steps = int(40.0 * SCALE / tas / dt) + 20
    white = np.zeros((steps + 1, 2))
    white[1] = 1.0
    response = gust_steps(np.zeros(STATE), 1.0, tas, dt, white)[1:]
    for lag in (0, 1, 2, 7):
        share = lag * dt * tas / SCALE
        found = (response[: len(response) - lag] * response[lag:]).sum(axis=0)
        wanted = np.exp(-share) * np.array([1.0, 1.0 - 0.5 * share])
        assert found == pytest.approx(wanted, abs=1e-9)


def test_a_second_goes_on_where_the_last_one_ended() -> None:
    white = np.random.default_rng(2).standard_normal((41, 2))
    whole = gust_steps(np.zeros(STATE), 2.0, 200.0, 0.05, white)
    state = np.zeros(STATE)
    first = gust_steps(state, 2.0, 200.0, 0.05, white[:21])
    second = gust_steps(state, 2.0, 200.0, 0.05, white[20:])
    assert np.array_equal(np.vstack([first, second[1:]]), whole)
    assert np.array_equal(first[-1], second[0])
    assert np.array_equal(whole[0], [0.0, 0.0])


def test_gusts_are_as_strong_as_asked() -> None:
    assert gusts(3.0, 200.0, 0.05, 100) == pytest.approx(3.0 * gusts(1.0, 200.0, 0.05, 100))
    assert not gusts(0.0, 200.0, 0.05, 100).any()
