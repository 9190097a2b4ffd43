"""Margins are none on the surfaces that they tell of, and nowhere a trap."""

from math import cos, inf, pi, sin, sqrt

import numpy as np
import pytest

from relguide.kernels.base.records import Pose, Velocity
from relguide.kernels.networks.margins import INPUTS, SIDE, inputs
from relguide.kernels.words.branches import FEATURES, features
from relguide.kernels.words.ccc import lrl
from relguide.kernels.words.extremals import fly_piece

NO_STRAIGHT, HALF_CIRCLE, NO_FIRST, NO_LAST = (1, 3), (5, 7), (14,), (17,)
"""Places of the margins among the numbers of a side, at the larger scale."""
BOTH_BEGIN = (9, 10, 11, 12)
DRAWN = 200


def margins_of(x: float, y: float, h: float, alpha: float) -> np.ndarray:
    out = np.full(INPUTS, np.nan)
    inputs(Pose(x, y, h), alpha, out)
    return out


def laid_back(alpha: float, *pieces: tuple[float, float]) -> tuple[float, float, float]:
    """Where a path of such pieces to the slot begins, on either side of the route."""
    x, y, h = alpha * sum(amount for _, amount in pieces), 0.0, 0.0
    for sign, amount in reversed(pieces):
        x, y, h = fly_piece(Pose(x, y, h), sign, -amount)
    return x, y, h % (2.0 * pi)


@pytest.mark.parametrize(
    ("shape", "places"),
    [
        # signs by that of the first turn, and what they are worth; none is drawn
        (((1, None), (-1, None)), NO_STRAIGHT),
        (((1, None), (-1, pi), (1, None)), HALF_CIRCLE),
        (((0, None), (1, None)), NO_FIRST),
        (((1, None), (0, None)), NO_LAST),
    ],
)
@pytest.mark.parametrize("side", [0, 1])
def test_on_a_surface_its_margin_is_none(
    shape: tuple[tuple[int, float | None], ...], places: tuple[int, ...], side: int
) -> None:
    rng = np.random.default_rng(3)
    begin = FEATURES + SIDE * side
    for _ in range(DRAWN):
        alpha = rng.uniform(0.3, 0.97)
        pieces = [
            (sign * (1.0 - 2.0 * side), rng.uniform(0.1, 3.0) if amount is None else amount)
            for sign, amount in shape
        ]
        here = laid_back(alpha, *pieces)
        on = margins_of(*here, alpha)
        off = margins_of(here[0] + 0.01, here[1] + 0.01, here[2], alpha)
        assert min(abs(on[begin + at]) for at in places) < 1e-9
        # the smaller scale beside it has the same zero, and tells more of what is near
        for at in places[:1] if len(places) == 1 else ():
            assert abs(on[begin + at + 1]) < 1e-7
            assert abs(off[begin + at + 1]) >= abs(off[begin + at])


def test_where_roots_of_three_turns_begin_in_pairs_a_margin_is_none() -> None:
    rng = np.random.default_rng(4)
    found, rows = 0, np.empty((96, 5))
    for _ in range(10 * DRAWN):
        alpha, middle, h = rng.uniform(0.5, 0.97), rng.uniform(0.3, 6.0), rng.uniform(0.0, 2.0 * pi)
        ahead = 2.0 * sin(middle) / alpha
        beside = 16.0 * sin(0.5 * middle) ** 2 - ahead**2
        if beside <= 0.01:
            continue
        w = 2.0 * pi - h
        cx, cy = alpha * (2.0 * middle + w) - ahead, 1.0 + rng.choice((-1.0, 1.0)) * sqrt(beside)
        x, y = cx + sin(h), cy - cos(h)
        at_begin = margins_of(x, y, h, alpha)[FEATURES : FEATURES + SIDE]
        assert min(abs(at_begin[at]) for at in BOTH_BEGIN) < 1e-9
        either = [
            lrl(Pose(x + by, y, h), Velocity(alpha, 0.0), inf, rows, 0) for by in (-1e-5, 1e-5)
        ]
        # the turns do not add up for each pair; those that do come and go by twos
        found += abs(either[0] - either[1]) == 2
    assert found > DRAWN


def test_two_turns_the_same_way_are_as_fast_where_their_margin_is_none() -> None:
    """Behind the slot, and along the route, left and right are one."""
    for h in (0.0, pi):
        assert margins_of(-8.0, 0.0, h, 0.7)[-2:] == pytest.approx((0.0, 0.0), abs=1e-12)


@pytest.mark.parametrize(
    "situation",
    [
        (0.0, 0.0, 0.0, 0.8),
        (0.0, 0.0, 0.0, 0.0),
        (1.0, 0.0, pi, 0.0),
        (0.0, 1e-300, 2.0 * pi, 0.3),
        (-3.0, 4.0, 0.0, 0.97),
        (1e9, 1e9, 1.0, 0.5),
    ],
)
def test_no_situation_is_a_trap(situation: tuple[float, float, float, float]) -> None:
    out = margins_of(*situation)
    assert np.isfinite(out).all()
    plain = np.empty(FEATURES)
    features(*situation, plain)
    assert np.array_equal(out[:FEATURES], plain)
