"""Whole turns of the line of sight are counted."""

from math import inf, pi

import numpy as np
import pytest

from relguide.kernels.separation.winding import sight_turn


@pytest.mark.parametrize("rate", [0.01, -0.01])
@pytest.mark.parametrize("laps", [0.3, 1.0, 2.5])
def test_circles_round_a_leader_that_stands(rate: float, laps: float) -> None:
    """The pursuer's circle has the leader at its centre, to the right if it turns right."""
    radius, duration = 100.0 / abs(rate), laps * 2.0 * pi / abs(rate)
    beside = radius if rate > 0.0 else -radius
    turned = sight_turn(
        np.array((0.0, 0.0, 0.0, 100.0, 100.0 * duration, rate / 100.0)),
        np.array((beside, 0.0, 1.0, 0.0)),
        duration,
        10.0,
    )
    assert turned == pytest.approx(laps * 2.0 * pi * (1.0 if rate > 0.0 else -1.0))


def test_passing_each_other_turns_it_by_half() -> None:
    """Opposite ways on parallel lines 100 m apart, each on the other's right, 4,000 km a side."""
    turned = sight_turn(
        np.array((0.0, -2e6, 0.0, 200.0)),
        np.array((100.0, 2e6, pi, 200.0, 1e6, 0.0, 200.0, 0.0)),
        2e4,
        1.0,
    )
    assert turned == pytest.approx(pi, abs=1e-4)


def test_aircraft_that_meet_cost_no_endless_work() -> None:
    turned = sight_turn(
        np.array((0.0, -1e4, 0.0, 200.0)),
        np.array((0.0, 1e4, pi, 200.0)),
        100.0,
        10.0,
    )
    assert abs(turned) < inf
