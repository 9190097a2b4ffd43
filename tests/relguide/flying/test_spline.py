"""Smoothing splines, against scipy's and against what they minimise."""

import numpy as np
import pytest
from scipy.interpolate import make_smoothing_spline

from relguide.flying.spline import smoothing_spline


def clock(n: int, seed: int) -> np.ndarray:
    """Uneven times, about one a second."""
    return np.arange(n) + np.random.default_rng(seed).uniform(-0.45, 0.45, n)


def walk(n: int, seed: int) -> np.ndarray:
    """Two columns of what wanders and is noisy."""
    rng = np.random.default_rng(seed)
    return np.column_stack((np.cumsum(rng.normal(0.0, 100.0, n)), rng.normal(0.0, 30.0, n)))


@pytest.mark.parametrize("n", [5, 30, 1000])
@pytest.mark.parametrize("seconds", [0.1, 2.0, 8.0, 40.0])
def test_it_is_scipys_spline(n: int, seconds: float) -> None:
    t, values = clock(n, n), walk(n, n)
    ours = smoothing_spline(t, values, seconds**4)
    oracle = make_smoothing_spline(t, values, lam=seconds**4)
    between = np.linspace(t[0], t[-1], 3 * n)
    # scipy's own rounding: ours is within 1e-7 of it in higher precision
    assert ours.at(between) == pytest.approx(oracle(between), abs=1e-4)
    assert ours.slope_at(between) == pytest.approx(oracle(between, 1), abs=1e-4)


def test_beyond_its_knots_the_outermost_cubics_go_on() -> None:
    t, values = clock(30, 1), walk(30, 1)
    ours, oracle = smoothing_spline(t, values, 16.0), make_smoothing_spline(t, values, lam=16.0)
    beyond = np.array((t[0] - 2.0, t[-1] + 2.0))
    assert ours.at(beyond) == pytest.approx(oracle(beyond), rel=1e-6, abs=1e-6)
    assert ours.slope_at(beyond) == pytest.approx(oracle(beyond, 1), rel=1e-6, abs=1e-6)


@pytest.mark.parametrize("n", [3, 4])
def test_few_knots_are_enough(n: int) -> None:
    t = clock(n, n)
    straight = np.column_stack((2.0 - 3.0 * t, t))
    spline = smoothing_spline(t, straight, 1e3)
    assert spline.at(t) == pytest.approx(straight, abs=1e-12)
    assert spline.slope_at(t) == pytest.approx(np.tile((-3.0, 1.0), (n, 1)), abs=1e-12)


def test_without_weight_it_passes_through_its_values() -> None:
    t, values = clock(50, 2), walk(50, 2)
    assert smoothing_spline(t, values, 0.0).at(t) == pytest.approx(values, abs=1e-12)


def test_no_neighbour_has_less_of_what_is_minimised() -> None:
    t, values, weight = clock(12, 3), walk(12, 3)[:, :1], 5.0
    spline = smoothing_spline(t, values, weight)
    # Σ (v − f)² + λ ∫ f″² is stationary: −2 (v − f(t)) · g(t) + 2 λ ∫ f″ g″ = 0 for a bump g
    fine = np.linspace(t[0], t[-1], 200_001)
    curvature = np.interp(fine, t, spline.bends[:, 0])
    for centre in (2.0, 5.5, 9.0):
        bump = np.exp(-((fine - centre) ** 2))
        bent = (4.0 * (fine - centre) ** 2 - 2.0) * bump
        at_knots = np.exp(-((t - centre) ** 2))
        misses = float(np.sum((values - spline.at(t))[:, 0] * at_knots))
        assert misses == pytest.approx(weight * np.trapezoid(curvature * bent, fine), rel=1e-6)
