"""The wind is found from air data and ground track, and then wanders no more than it must."""

from math import hypot, sqrt

import numpy as np
import pytest

from relguide.kernels.flight.flight_records import Drift
from relguide.kernels.flight.wind_estimate import (
    MEASURED_VARIANCE,
    UNKNOWN_VARIANCE,
    WANDERING,
    estimate,
)

TRUE = Drift(20.0, -5.0)


def estimates(seconds: int, first: Drift, noise: float, rng: np.random.Generator) -> list[Drift]:
    w, variance, found = first, UNKNOWN_VARIANCE, []
    for east, north in noise * rng.standard_normal((seconds, 2)):
        seen = Drift(TRUE.east + east, TRUE.north + north)
        w, variance = estimate(w, variance, seen, MEASURED_VARIANCE, WANDERING, 1.0)
        found.append(w)
    return found


def test_ten_metres_a_second_wrong_are_half_after_a_quarter_of_a_minute() -> None:
    rng = np.random.default_rng(3)
    first = Drift(TRUE.east + 8.0, TRUE.north - 6.0)
    (w,) = estimates(15, first, 0.0, rng)[-1:]
    assert hypot(w.east - TRUE.east, w.north - TRUE.north) < 0.1  # what is left of the prior
    ends = [estimates(15, first, 2.0, rng)[-1] for _ in range(2_000)]
    off = np.array(ends) - np.array(TRUE)
    # 15 measurements of σ = 2 m/s, the later ones counted more for a wind that wanders
    assert np.median(np.abs(off)) < 0.5
    assert np.abs(off.mean(axis=0)).max() < 0.1


def test_the_steady_error_is_the_one_it_states() -> None:
    rng = np.random.default_rng(4)
    steps, q, r = 40_000, WANDERING, MEASURED_VARIANCE
    truth = np.cumsum(sqrt(q) * rng.standard_normal((steps, 2)), axis=0)
    seen = truth + sqrt(r) * rng.standard_normal((steps, 2))
    w, variance, off = Drift(0.0, 0.0), UNKNOWN_VARIANCE, []
    for true, measured in zip(truth.tolist(), seen.tolist(), strict=True):
        w, variance = estimate(w, variance, Drift(*measured), r, q, 1.0)
        off.append((w.east - true[0], w.north - true[1]))
    # P = (1 − K)(P + q) with K = (P + q)/(P + q + r), solved
    steady = 0.5 * (sqrt(q * q + 4.0 * q * r) - q)
    assert variance == pytest.approx(steady)
    assert np.std(off[100:]) == pytest.approx(sqrt(steady), rel=0.03)
    assert sqrt(steady) == pytest.approx(0.65, abs=0.01)  # m/s


def test_a_perfect_measurement_is_believed_almost_at_once() -> None:
    w, variance = estimate(Drift(0.0, 0.0), UNKNOWN_VARIANCE, TRUE, 1e-9, 0.0, 1.0)
    assert w == pytest.approx(TRUE, abs=1e-6)
    assert variance == pytest.approx(1e-9, rel=1e-6)
