"""Sine and cosine at once, against numpy's of numbers with more digits."""

from collections.abc import Callable
from math import copysign, cos, inf, isnan, nan, nextafter, pi, sin

import numpy as np
import pytest
from numba import njit

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.sine import LARGEST, sine_and_cosine

Both = Callable[[float], tuple[float, float]]

# the rest is rounded twice and each result once, and its last digit may be worth half the rest's
SHARE = 4e-16

# a compiled kernel may round less, where the processor can
both_ways = pytest.mark.parametrize("both", [sine_and_cosine, njit(sine_and_cosine)])


def far_apart(rng: np.random.Generator) -> FloatArray:
    return np.concatenate((rng.uniform(-7.0, 7.0, 4000), rng.uniform(-LARGEST, LARGEST, 4000)))


def near_quarter_turns(rng: np.random.Generator) -> FloatArray:
    most = int(LARGEST / (0.5 * pi))
    counts = np.concatenate((np.arange(-9, 10), rng.integers(-most, most, 1000)))
    at = counts * (0.5 * pi)
    beside = at + rng.normal(scale=1e-6, size=len(at))
    return np.concatenate((at, np.nextafter(at, inf), np.nextafter(at, -inf), beside))


def near_eighth_turns(rng: np.random.Generator) -> FloatArray:
    """Where another quarter turn becomes the nearest."""
    at = (rng.integers(-600_000, 600_000, 1000) + 0.5) * (0.5 * pi)
    return np.concatenate((at, np.nextafter(at, inf), np.nextafter(at, -inf)))


def tiny(rng: np.random.Generator) -> FloatArray:
    return rng.choice((-1.0, 1.0), 1000) * 10.0 ** rng.uniform(-300.0, 0.0, 1000)


@both_ways
@pytest.mark.parametrize("draw", [far_apart, near_quarter_turns, near_eighth_turns, tiny])
def test_both_are_right_to_the_last_digits(
    draw: Callable[[np.random.Generator], FloatArray], both: Both
) -> None:
    angles = draw(np.random.default_rng(1))
    found = np.array([both(angle) for angle in angles.tolist()])
    exact = np.array((np.sin(np.longdouble(angles)), np.cos(np.longdouble(angles)))).T
    assert np.all(np.abs(found - exact) <= SHARE * np.abs(exact))


@both_ways
def test_they_lie_on_the_unit_circle_and_mirror(both: Both) -> None:
    for angle in np.random.default_rng(2).uniform(-10.0, 10.0, 1000).tolist():
        s, c = both(angle)
        assert abs(s) <= 1.0
        assert abs(c) <= 1.0
        assert abs(s * s + c * c - 1.0) < 1e-15
        mirrored_s, mirrored_c = both(-angle)
        assert (mirrored_s, mirrored_c) == (-s, c)


@both_ways
def test_zeros_have_the_signs_of_the_library(both: Both) -> None:
    for angle in (0.0, -0.0, 5e-324, -5e-324):
        s, c = both(angle)
        assert (s, c) == (sin(angle), cos(angle))
        assert copysign(1.0, s) == copysign(1.0, angle)
    for quarters in range(-8, 9):
        s, c = both(quarters * 0.5 * pi)
        assert copysign(1.0, s) == copysign(1.0, sin(quarters * 0.5 * pi))
        assert copysign(1.0, c) == copysign(1.0, cos(quarters * 0.5 * pi))


@both_ways
@pytest.mark.parametrize("angle", [nan, inf, -inf, 1e300, -1e300, nextafter(LARGEST, inf)])
def test_what_is_not_known_is_not_a_number(angle: float, both: Both) -> None:
    s, c = both(angle)
    assert isnan(s)
    assert isnan(c)
    assert not any(map(isnan, both(copysign(LARGEST, angle))))
