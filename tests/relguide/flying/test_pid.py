"""The controller sums its three terms and does not wind up."""

import pytest

from relguide.flying.pid import Gains, Pid


def test_three_terms() -> None:
    pid = Pid(gains=Gains(kp=2.0, ki=0.5, kd=0.1))
    assert pid.update(1.0, -3.0, 10.0, 1.0) == pytest.approx(2.0 - 0.3)
    assert pid.update(1.0, 0.0, 10.0, 1.0) == pytest.approx(2.0 + 0.5)


def test_output_is_limited_both_ways() -> None:
    pid = Pid(gains=Gains(kp=1.0, ki=0.0, kd=0.0))
    assert pid.update(9.0, 0.0, 2.0, 1.0) == 2.0
    assert pid.update(-9.0, 0.0, 2.0, 1.0) == -2.0


def test_integrator_stands_still_at_the_limit_and_comes_back_at_once() -> None:
    pid = Pid(gains=Gains(kp=1.0, ki=0.1, kd=0.0))
    for _ in range(1000):
        pid.update(5.0, 0.0, 1.0, 1.0)
    assert pid.integral == 0.0
    assert pid.update(-0.5, 0.0, 1.0, 1.0) == pytest.approx(-0.5)


def test_integrator_unwinds_while_saturated() -> None:
    pid = Pid(gains=Gains(kp=0.0, ki=1.0, kd=0.0), integral=5.0)
    pid.update(-1.0, 0.0, 1.0, 1.0)
    assert pid.integral == 4.0


def test_integral_removes_a_steady_error() -> None:
    pid, state = Pid(gains=Gains(kp=0.5, ki=0.2, kd=0.0)), 0.0
    for _ in range(4000):
        state += 0.05 * (pid.update(1.0 - state, 0.0, 10.0, 0.05) - 0.3)  # a bias of 0.3
    assert state == pytest.approx(1.0, abs=1e-3)


def test_reset_forgets() -> None:
    pid = Pid(gains=Gains(kp=1.0, ki=1.0, kd=0.0))
    pid.update(1.0, 0.0, 10.0, 1.0)
    pid.reset()
    assert pid.integral == 0.0
