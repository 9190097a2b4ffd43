"""The proved separation: below every sample, close to the least, also along a circle."""

from math import cos, hypot, pi, sin

import numpy as np
import pytest

from relguide.kernels.base.motion import Motion, advance
from relguide.kernels.separation.approach import least_by_squares, least_separation

TOLERANCE = 1e-3  # [m]


def sample(motion: Motion, times: np.ndarray) -> np.ndarray:
    """Where an aircraft is at ascending times."""
    x, y, heading, speed, pieces = motion
    begun, places = 0.0, []
    left = [*pieces.tolist(), [np.inf, 0.0]]
    for t in times.tolist():
        while t - begun > left[0][0]:
            duration, rate = left.pop(0)
            x, y, heading = advance(x, y, heading, speed, rate, duration)
            begun += duration
        places.append(advance(x, y, heading, speed, left[0][1], t - begun)[:2])
    return np.array(places)


def test_no_sample_lies_below_the_bound_and_the_bound_is_close() -> None:
    rng = np.random.default_rng(7)
    for _ in range(60):
        both = []
        for _ in range(2):
            x, y, heading = *rng.uniform(-2e4, 2e4, 2).tolist(), rng.uniform(0.0, 2 * pi)
            pieces = np.column_stack((rng.uniform(1.0, 200.0, 4), rng.uniform(-0.03, 0.03, 4)))
            both.append(Motion(x, y, heading, 200.0, pieces))
        horizon = 600.0
        least, at, bound = least_separation(*both, 0.0, horizon, TOLERANCE)
        times = np.linspace(0.0, horizon, 6001)
        away = np.hypot(*(sample(both[0], times) - sample(both[1], times)).T)
        assert away.min() >= bound
        assert least - TOLERANCE - 1e-4 <= bound <= least
        assert least <= away.min() + TOLERANCE
        place, other = (sample(one, np.array([at]))[0] for one in both)
        assert hypot(*(place - other)) == pytest.approx(least, abs=1e-6)


def test_a_circle_round_the_leader_is_proved_to_its_distance() -> None:
    # at 7 km round a leader at rest in the air mass, all the way round
    radius, speed = 7000.0, 200.0
    once = 2.0 * pi * radius / speed
    pursuer = Motion(radius, 0.0, 0.0, speed, np.array([[once, -speed / radius]]))
    leader = Motion(0.0, 0.0, 0.0, 0.0, np.empty((0, 2)))
    _, _, bound = least_separation(pursuer, leader, 0.0, once, TOLERANCE)
    assert bound == pytest.approx(radius, abs=TOLERANCE + 1e-5)


def test_the_bound_by_squares_holds_in_wide_windows() -> None:
    rng = np.random.default_rng(11)
    close = 0
    for _ in range(400):
        # both in the middle of a window, a few km apart
        poses = [(*rng.uniform(-5e3, 5e3, 2), rng.uniform(0.0, 2 * pi)) for _ in range(2)]
        speeds, rates = rng.uniform(100.0, 250.0, 2), rng.uniform(-0.04, 0.04, 2)
        # place and three derivatives of each
        told = [
            (x, y, v * sin(h), v * cos(h), v * r * cos(h), -v * r * sin(h),
             -v * r * r * sin(h), -v * r * r * cos(h))
            for (x, y, h), v, r in zip(poses, speeds, rates, strict=True)
        ]  # fmt: skip
        relative = [ours - theirs for ours, theirs in zip(*told, strict=True)]
        largest = [float(np.sum(speeds * np.abs(rates) ** k)) for k in (1, 2, 3)]
        for half in (4.0, 8.0, 40.0):
            bound = least_by_squares(*relative, *largest, half)
            places = [
                [advance(x, y, h, v, r, t)[:2] for t in np.linspace(-half, half, 201)]
                for (x, y, h), v, r in zip(poses, speeds, rates, strict=True)
            ]
            away = np.hypot(*(np.array(places[0]) - np.array(places[1])).T)
            assert bound <= away.min() + 1e-6
            close += bound > 0.5 * away.min()
    assert close > 400
