"""The fastest extremal is the first of all, though roots are sought only where one could win."""

from math import inf, pi

import numpy as np
import pytest

from relguide.kernels.base.records import Pose, Window, start_at
from relguide.kernels.words.extremals import MAX_ROWS, solve
from relguide.kernels.words.fastest import fastest, may_arrive_before, word_before
from relguide.kernels.words.sooner import make_scratch

SCRATCH = make_scratch()
CLOSE = 1e-9
"""Roots next to a tangency are as ill-conditioned as that [R/V_P]; others agree to 1e-14."""


def same(row: np.ndarray, every: np.ndarray) -> bool:
    return bool(row[1] == every[1] and abs(row - every).max() <= CLOSE * max(1.0, every[0]))


@pytest.mark.parametrize("within", [2.0, 6.0, 25.0, 3000.0])
@pytest.mark.parametrize("opens", [0.0, 12.0])
def test_it_is_the_first_of_all(within: float, opens: float) -> None:
    rng = np.random.default_rng(int(within + opens))
    row, every = np.empty(5), np.empty((MAX_ROWS, 5))
    for i, (x, y, h, alpha, t) in enumerate(
        rng.uniform(
            (-within, -within, 0.0, 0.0, 0.0), (within, within, 2.0 * pi, 1.2, opens), (4000, 5)
        ).tolist()
    ):
        n = solve(Pose(x, y, h), alpha, t, every)
        # the hint may be right or wrong
        assert fastest(Pose(x, y, h), alpha, t, i % 6, SCRATCH, row) == (n > 0)
        if n > 0:
            assert same(row, every[0]), (x, y, h, alpha, t)


def test_on_the_axes_and_at_round_angles_too() -> None:
    row, every = np.empty(5), np.empty((MAX_ROWS, 5))
    for x in (-4.0, -2.0, 0.0, 2.0, 4.0):
        for y in (-6.0, -4.0, -2.0, 0.0, 2.0, 4.0, 6.0):
            for h in (0.0, 0.5 * pi, pi, 1.5 * pi):
                for alpha in (0.0, 1e-9, 0.5, 1.0 - 1e-9, 1.0):
                    found = fastest(Pose(x, y, h), alpha, 0.0, 0, SCRATCH, row)
                    n = solve(Pose(x, y, h), alpha, 0.0, every)
                    assert found == (n > 0)
                    if found:
                        # nearly as fast as the leader: rounding counts 1/(1 − α) times
                        rounding = 1e-15 / max(1.0 - alpha, 1e-3 if alpha == 1.0 else 0.0)
                        assert row[0] == pytest.approx(every[0, 0], rel=rounding, abs=1e-9)


@pytest.mark.parametrize("word", [2, 3, 4, 5])
def test_all_of_a_word_before_a_time_are_found(word: int) -> None:
    rng = np.random.default_rng(word)
    every = np.empty((MAX_ROWS, 5))
    seen = 0
    for x, y, h, alpha, beat in rng.uniform(
        (-6.0, -6.0, 0.0, 0.1, 0.0), (6.0, 6.0, 2.0 * pi, 0.99, 30.0), (4000, 5)
    ).tolist():
        n = solve(Pose(x, y, h), alpha, 0.0, every)
        expected = [row[0] for row in every[:n] if row[1] == word and row[0] < beat]
        start = start_at(Pose(x, y, h))
        count = word_before(start, alpha, word, Window(0.0, beat), True, SCRATCH)
        found = sorted(SCRATCH.found[:count, 0].tolist())
        for time in expected:
            assert min((abs(time - t) for t in found), default=inf) <= CLOSE, (x, y, h, alpha, beat)
        assert all(t <= beat + 2e-6 for t in found) or word >= 4
        seen += len(expected)
    assert seen > 300


@pytest.mark.parametrize("within", [2.0, 6.0, 25.0])
def test_what_may_arrive_before_a_time_does(within: float) -> None:
    rng = np.random.default_rng(int(within))
    every, seen = np.empty((MAX_ROWS, 5)), 0
    for x, y, h, alpha, share in rng.uniform(
        (-within, -within, 0.0, 0.1, 0.9), (within, within, 2.0 * pi, 0.99, 1.1), (4000, 5)
    ).tolist():
        pose = Pose(x, y, h)
        assert solve(pose, alpha, 0.0, every) > 0
        beat = share * every[0, 0]
        may = may_arrive_before(pose, alpha, beat, SCRATCH)
        assert may or beat <= every[0, 0] + CLOSE, (x, y, h, alpha, share)
        seen += may and beat < every[0, 0]
    # nothing is lost if it is said of some that arrive a little later, or beside the slot
    assert seen < 40


def test_of_a_slot_at_rest_or_no_slower_nothing_is_said() -> None:
    for alpha in (0.0, 1.0, 1.1):
        assert may_arrive_before(Pose(9.0, 9.0, 1.0), alpha, 0.1, SCRATCH)
