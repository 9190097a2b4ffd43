"""Angles are wrapped as by the remainder of a division, to the last bit."""

from math import nextafter, pi

import numpy as np
from numba import njit

from relguide.kernels.base.angles import TWO_PI, modulo, turn_to, wrap, wrap_each, wrap_signed


def test_the_short_way_is_the_remainder() -> None:
    ends = [k * TWO_PI for k in range(-3, 4)]
    brinks = [nextafter(end, to) for end in ends for to in (-100.0, 100.0)]
    angles = np.random.default_rng(1).uniform(-40.0, 40.0, 4000).tolist()
    compiled = njit(modulo)
    for angle in (*ends, *brinks, *angles, -1e-17, 0.0, 1e300):
        assert modulo(angle) == compiled(angle) == angle % TWO_PI


def test_a_full_turn_is_none() -> None:
    assert wrap(-1e-17) == 0.0
    assert turn_to(-1e-10) == 0.0
    assert turn_to(TWO_PI + 1.0) == (TWO_PI + 1.0) % TWO_PI
    assert wrap_signed(pi) == -pi
    assert wrap_each(np.array((-1e-17, TWO_PI, 7.0, -1.0))).tolist() == [
        wrap(angle) for angle in (-1e-17, TWO_PI, 7.0, -1.0)
    ]
