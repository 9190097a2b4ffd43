"""The kernel finds every root of every word: what is made backward is found forward."""

from math import cos, pi, sin

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from relguide.kernels.base.records import Pose, Velocity, Window
from relguide.kernels.words.extremals import (
    ALL_WORDS,
    MAX_ROWS,
    SIGNS,
    WORDS,
    fly_piece,
    solve,
    solve_toward,
    solve_words,
)
from tests.situations import numbers

arcs = st.one_of(numbers(0.0, 2.0 * pi - 1e-6), st.sampled_from([0.0, 1e-7, pi, 2.0 * pi - 1e-5]))
# a middle arc of nearly nothing or a full turn leaves both end circles on one spot, in no direction
middles = numbers(1e-3, 2.0 * pi - 1e-3)
straights = st.one_of(numbers(0.0, 200.0), st.sampled_from([0.0, 1e-9]))


def rows_of(x: float, y: float, h: float, alpha: float, t_release: float = 0.0) -> np.ndarray:
    rows = np.empty((MAX_ROWS, 5))
    return rows[: solve(Pose(x, y, h % (2.0 * pi)), alpha, t_release, rows)]


def start_of(
    word: int, first: float, middle: float, last: float, alpha: float
) -> tuple[float, float, float]:
    """Where a path of given pieces must start to end at the slot."""
    x, y, h = 0.0, 0.0, 0.0
    for sign, amount in zip(SIGNS[word], (first, middle, last), strict=True):
        x, y, h = fly_piece(Pose(x, y, h), sign, amount)
    # turn the world by −h about the end, which is the slot at τ
    end = alpha * (first + middle + last)
    return end - x * cos(h) - y * sin(h), x * sin(h) - y * cos(h), -h % (2.0 * pi)


@given(
    word=st.integers(0, 5),
    first=arcs,
    last=arcs,
    turn=middles,
    straight=straights,
    alpha=st.one_of(numbers(0.3, 0.98), numbers(1.02, 1.6)),
)
def test_every_path_made_backward_is_found_forward(
    word: int, first: float, last: float, turn: float, straight: float, alpha: float
) -> None:
    middle = turn if word > 3 else straight
    time = first + middle + last
    rows = rows_of(*start_of(word, first, middle, last, alpha), alpha)
    nearest = np.abs(rows[:, 0] - time).min() if len(rows) else np.inf
    # 1e-5 R/V: near a tangency the time is only known to the square root of rounding
    assert nearest < 1e-5 * max(1.0, time), (WORDS[word], rows)


@given(
    word=st.integers(0, 5),
    first=arcs,
    last=arcs,
    turn=middles,
    straight=straights,
    alpha=numbers(0.3, 0.98),
    kappa=numbers(-pi, pi),
)
def test_a_target_that_moves_across_its_final_heading_is_met_too(
    word: int, first: float, last: float, turn: float, straight: float, alpha: float, kappa: float
) -> None:
    middle = turn if word > 3 else straight
    time = first + middle + last
    x, y, h = start_of(word, first, middle, last, 0.0)
    ax, ay = alpha * cos(kappa), alpha * sin(kappa)
    rows = np.empty((MAX_ROWS, 5))
    rows = rows[: solve_toward(Pose(x + ax * time, y + ay * time, h), Velocity(ax, ay), 0.0, rows)]
    nearest = np.abs(rows[:, 0] - time).min() if len(rows) else np.inf
    assert nearest < 1e-5 * max(1.0, time), (WORDS[word], rows)


@given(
    x=numbers(-4.0, 4.0), y=numbers(-4.0, 4.0), h=numbers(0.0, 6.28), alpha=numbers(0.0, 1.3),
    kappa=numbers(-pi, pi), words=st.sampled_from([ALL_WORDS, 12, 50, 5, 0]),
    which=st.integers(0, MAX_ROWS - 1), off=st.sampled_from([-1e-3, 1e-9, 1e-3, 2.0]),
)  # fmt: skip
def test_of_some_words_all_that_arrive_before_a_time_are_found(
    x: float, y: float, h: float, alpha: float, kappa: float, words: int, which: int, off: float
) -> None:
    pose, target = Pose(x, y, h), Velocity(alpha * cos(kappa), alpha * sin(kappa))
    rows, some = np.empty((MAX_ROWS, 5)), np.empty((MAX_ROWS, 5))
    rows = rows[: solve_toward(pose, target, 0.0, rows)]
    beat = off + (rows[which % len(rows), 0] if len(rows) else 3.0)
    some = some[: solve_words(pose, target, words, Window(0.0, beat), some)]
    wanted = [row for row in rows.tolist() if row[0] < beat and words & 1 << int(row[1])]
    found = [row for row in some.tolist() if row[0] < beat]
    assert [row[1] for row in found] == [row[1] for row in wanted]
    assert np.allclose(found, wanted, atol=1e-6)
    assert {int(row[1]) for row in some} <= {word for word in range(6) if words & 1 << word}


@given(
    x=numbers(-50.0, 50.0),
    y=numbers(-50.0, 50.0),
    h=numbers(0.0, 2.0 * pi),
    alpha=numbers(0.2, 1.5),
)
def test_every_row_ends_at_the_slot_in_time_on_heading(
    x: float, y: float, h: float, alpha: float
) -> None:
    for row in rows_of(x, y, h, alpha):
        px, py, heading = x, y, h
        for sign, amount in zip(SIGNS[int(row[1])], row[2:], strict=True):
            assert amount >= 0.0
            px, py, heading = fly_piece(Pose(px, py, heading), sign, amount)
        assert row[0] == pytest.approx(row[2:].sum(), abs=1e-9)
        assert px == pytest.approx(alpha * row[0], abs=1e-6 + 1e-11 * row[0])
        assert py == pytest.approx(0.0, abs=1e-6)
        assert sin(0.5 * heading) == pytest.approx(0.0, abs=1e-7)


@given(
    x=numbers(-50.0, 50.0), y=numbers(-50.0, 50.0), h=numbers(0.0, 6.28), alpha=numbers(0.2, 0.98)
)
def test_mirrored_situations_have_mirrored_words_and_equal_times(
    x: float, y: float, h: float, alpha: float
) -> None:
    ours, mirrored = rows_of(x, y, h, alpha), rows_of(x, -y, -h, alpha)
    # tangential roots may be one or two by rounding; the distinct times agree
    times, others = np.unique(ours[:, 0].round(5)), np.unique(mirrored[:, 0].round(5))
    assert ours[0, 0] == pytest.approx(mirrored[0, 0], abs=1e-7)
    assert all(np.abs(others - t).min() < 1e-4 for t in times)
    exchanged = WORDS[int(ours[0, 1])].translate(str.maketrans("LR", "RL"))
    ties = {WORDS[int(r[1])] for r in mirrored if r[0] < mirrored[0, 0] + 1e-6}
    # with a piece of no length the same path has two names
    assert exchanged in ties or ours[0, 2:].min() < 1e-6


@given(
    x=numbers(-50.0, 50.0), y=numbers(-50.0, 50.0), h=numbers(0.0, 6.28), alpha=numbers(0.2, 0.999)
)
def test_a_slower_slot_can_always_be_reached(x: float, y: float, h: float, alpha: float) -> None:
    assert len(rows_of(x, y, h, alpha)) > 0


def test_no_row_arrives_before_the_slot_opens() -> None:
    everything = rows_of(-10.0, 4.0, 1.0, 0.8)
    later = rows_of(-10.0, 4.0, 1.0, 0.8, t_release=everything[1, 0] + 1e-3)
    assert 0 < len(later) < len(everything)
    assert later[0, 0] > everything[1, 0]


def test_equal_speeds_straight_behind_never_close_in() -> None:
    assert len(rows_of(-3.0, 0.0, 0.0, 1.0)) == 0
    assert rows_of(0.0, 0.0, 0.0, 1.0)[0, 0] == pytest.approx(0.0, abs=1e-9)
