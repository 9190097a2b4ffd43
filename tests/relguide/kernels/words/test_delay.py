"""Paths of one exact length, against a fine grid of the straight that makes them long enough."""

from math import pi

import numpy as np
import pytest

from relguide.kernels.base.records import Pose
from relguide.kernels.words.branches import WORD_OF
from relguide.kernels.words.delay import (
    CSC,
    DELAY_PIECES,
    MAX_DELAYS,
    straight_delays,
    turning_delays,
)
from relguide.kernels.words.extremals import SIGNS, fly_piece
from relguide.kernels.words.to_point import word_to_point

FINE = 4_000
"""Steps of the free length."""


def draw(rng: np.random.Generator) -> tuple[Pose, float, float]:
    """A pursuer that may have time to spare, V_L/V_P and when the slot opens."""
    opens = float(rng.uniform(1.0, 30.0))
    x, y = rng.normal(size=2) * opens * (0.5, 0.3)
    return Pose(float(x), float(y), float(rng.uniform(0.0, 2.0 * pi))), rng.uniform(0.5, 1), opens


def crossings(pose: Pose, end_x: float, opens: float, branch: int, *, last: bool) -> list[float]:
    """Free lengths at which the total crosses, on a fine grid; jumps by a full turn left out."""
    piece = np.empty(3)
    amounts = np.linspace(0.0, opens, FINE + 1)
    gaps = []
    for amount in amounts.tolist():
        if last:
            word = word_to_point(pose, end_x - amount, branch, piece)
        else:
            word = word_to_point(fly_piece(pose, 0.0, amount), end_x, branch, piece)
        gaps.append(word + amount - opens if word >= 0.0 else np.nan)
    before, after = np.array(gaps[:-1]), np.array(gaps[1:])
    with np.errstate(invalid="ignore"):
        found = (before < 0.0) & (after > 0.0) & (after - before < 1.0)
    return amounts[:-1][found].tolist()


def test_every_straight_that_delays_a_word_is_found() -> None:
    rng = np.random.default_rng(11)
    paths = np.empty((2, MAX_DELAYS, DELAY_PIECES))
    signs, amounts = paths
    expected = 0
    for _ in range(60):
        pose, alpha, opens = draw(rng)
        end_x = alpha * opens
        n = straight_delays(pose, alpha, opens, paths)
        for branch in range(CSC):
            word = SIGNS[WORD_OF[branch]]
            for last in (False, True):
                free, other = (4, 0) if last else (0, 4)
                same = (signs[:n, 1:4] == word).all(axis=1) & (amounts[:n, other] == 0.0)
                mine = amounts[:n, free][same]
                for amount in crossings(pose, end_x, opens, branch, last=last):
                    expected += 1
                    assert np.min(np.abs(mine - amount), initial=9.0) < 2.0 * opens / FINE
    assert expected > 60


def test_all_delays_arrive_at_the_slot_as_it_opens() -> None:
    rng = np.random.default_rng(12)
    paths = np.empty((2, MAX_DELAYS, DELAY_PIECES))
    many = 0
    for _ in range(200):
        pose, alpha, opens = draw(rng)
        few = straight_delays(pose, alpha, opens, paths)
        n = turning_delays(pose, alpha, opens, paths, few)
        many += n
        for i in range(n):
            end = pose
            for sign, amount in zip(*paths[:, i].tolist(), strict=True):
                end = fly_piece(end, sign, amount)
            assert end[:2] == pytest.approx((alpha * opens, 0.0), abs=1e-8)
            assert np.sin(end.h) == pytest.approx(0.0, abs=1e-8)
            assert paths[1, i].sum() == pytest.approx(opens, abs=1e-8)
            turns = np.count_nonzero(paths[0, i] * (paths[1, i] > 1e-9))
            assert turns <= 2 or i >= few
    assert many > 300
