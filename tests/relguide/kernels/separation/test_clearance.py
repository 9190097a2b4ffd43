"""The pieces of a leader's intent, and whether one of the pursuer's keeps d_min beside them."""

from math import inf, nextafter, pi

import numpy as np
import pytest

from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.contact.contact import contact_at, contact_exists
from relguide.kernels.separation.clearance import fly_rate, piece_at, piece_clears, piece_end

BEGINS = [0.0, 0.5, 2.25, 7.0]


@pytest.mark.parametrize("pieces", [1, 2, 4])
def test_a_piece_ends_where_the_next_begins(pieces: int) -> None:
    leader = np.zeros((pieces, 5))
    leader[:, 0] = BEGINS[:pieces]
    for i in range(pieces - 1):
        end = piece_end(leader, i)
        assert piece_at(leader, nextafter(end, 0.0)) == i
        assert piece_at(leader, end) == i + 1
    assert piece_end(leader, pieces - 1) == inf


def places(pose: Pose, speed: float, rate: float, t: FloatArray) -> FloatArray:
    """Where somebody is after these times. shape (2, n)"""
    h = pose.h + 0.5 * rate * t
    chord = speed * t * np.sinc(0.5 * rate * t / pi)
    return np.array([pose.x + chord * np.cos(h), pose.y + chord * np.sin(h)])


def least_distance(pose: Pose, rate: float, t: float, duration: float, scene: Scene) -> float:
    """The least distance along a piece beside the leader's first one, looked at closely [R]."""
    _, x, y, h, turning = scene.leader[0]
    begin, end, least = 0.0, duration, inf
    for _ in range(3):
        at = np.linspace(begin, end, 801)
        led = places(Pose(x, y, h), scene.alpha, turning, t + at)
        apart = np.hypot(*(places(pose, 1.0, rate, at) - led))
        k = int(np.argmin(apart))
        least = min(least, float(apart[k]))
        begin, end = at[max(k - 2, 0)], at[min(k + 2, 800)]
    return least


@pytest.mark.parametrize("deeper", [-1e-3, -1e-5, -1e-6, 1e-6, 1e-5, 1e-3, 0.03])
def test_a_piece_that_touches_keeps_a_little_less_and_not_a_little_more(deeper: float) -> None:
    """From shortly before a contact, or from there, until after it; mostly the disc is touched."""
    rng, told = np.random.default_rng(5), [0, 0]
    for _ in range(1_500):
        leader = np.array([[0.0, 0.0, 0.0, rng.uniform(-pi, pi), rng.uniform(-1.5, 1.5)]])
        scene = Scene(leader, rng.uniform(0.5, 1.1), 10.0 ** rng.uniform(-0.5, 0.8), 0.0)
        bearing, side = rng.uniform(-pi, pi), rng.choice([-1.0, 1.0])
        if not contact_exists(bearing, scene.alpha):
            continue
        rate, t = rng.choice([-1.0, 0.0, 1.0]), rng.uniform(0.0, 5.0)
        before, after = (rng.uniform(0.0, 3.0) * (rng.random() < 0.7) for _ in range(2))
        begin = max(t - before, 0.0)
        start = fly_rate(contact_at(scene, t, bearing, side), rate, begin - t)
        harder = scene._replace(d_min=scene.d_min + deeper)
        duration = t + after - begin
        least = least_distance(start, rate, begin, duration, scene)
        if abs(least - harder.d_min) > 2e-7 and duration > 0.0:
            clears = piece_clears(start, rate, begin, duration, harder)
            assert clears == (least > harder.d_min)
            told[clears] += 1
    assert min(told) > 200 or (deeper > 0.0 and told[0] > 1_000)
