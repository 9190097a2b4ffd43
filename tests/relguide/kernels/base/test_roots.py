"""All roots of the words' one equation, against a dense grid refined by scipy."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.optimize import brentq

from relguide.kernels.base.roots import MAX_CUTS, all_roots, insert_cut
from tests.situations import numbers


def cuts_of(*points: float) -> tuple[np.ndarray, int]:
    cuts = np.empty(MAX_CUTS)
    cuts[0], cuts[1] = 0.0, 2.0 * np.pi
    n = 2
    for point in points:
        n = insert_cut(cuts, n, point)
    return cuts, n


@given(alpha=numbers(0.1, 0.99), e=numbers(-30.0, 10.0), delta=numbers(-4.0, 4.0))
def test_no_root_of_the_three_turn_equation_is_missed(alpha: float, e: float, delta: float) -> None:
    k = np.array([4 * alpha**2, 4 * alpha * e, e * e + delta * delta - 8.0, 0.0, 0.0, 8.0])
    bend = np.arccos(alpha**2)
    cuts, n = cuts_of(bend, 2.0 * np.pi - bend)
    found = np.empty(2 * MAX_CUTS)
    found = found[: all_roots(k, cuts, n, found)]

    def f(m: float) -> float:
        return (2 * alpha * m + e) ** 2 + delta**2 - 8.0 * (1.0 - np.cos(m))

    grid = np.linspace(0.0, 2.0 * np.pi, 4_001)
    values = f(grid)
    # two roots closer than the grid are its own blind spot
    assume(np.abs(values).min() > 1e-9)
    brackets = np.flatnonzero(values[:-1] * values[1:] < 0.0)
    expected = [brentq(f, grid[i], grid[i + 1], xtol=1e-14) for i in brackets]
    assert len(found) >= len(expected)
    for root in expected:
        assert np.abs(found - root).min() < 1e-9
    assert all(abs(f(root)) < 1e-8 for root in found)
    assert list(found) == sorted(found)


@given(points=st.lists(numbers(-1.0, 8.0), max_size=8))
def test_cuts_stay_sorted_and_inside(points: list[float]) -> None:
    cuts, n = cuts_of(*points)
    assert n == 2 + sum(0.0 < p < 2.0 * np.pi for p in points)
    assert list(cuts[:n]) == sorted(cuts[:n])


@given(
    at=st.one_of(numbers(0.05, 6.2), st.sampled_from([0.5, 1.0, np.pi, 6.0])),
    bend=st.sampled_from([1.0, -1.0, 0.3, -7.0]),
)
def test_a_root_where_the_function_only_touches_zero_is_found_once(at: float, bend: float) -> None:
    """q (1 − cos(u − u₀)), which nowhere changes its sign; f′ is 0 there and half a turn on."""
    k = np.array([0.0, 0.0, bend, 0.0, -bend * np.sin(at), -bend * np.cos(at)])
    # cuts half way between the extremes, so that f′ has one zero in each interval
    cuts, n = cuts_of((at + 0.5 * np.pi) % (2.0 * np.pi), (at + 1.5 * np.pi) % (2.0 * np.pi))
    found = np.empty(2 * MAX_CUTS)
    found = found[: all_roots(k, cuts, n, found)]
    assert len(found) == 1
    assert abs(found[0] - at) < 1e-6


@given(at=numbers(0.5, 5.5), gap=st.sampled_from([1e-3, 1e-5, 1e-7, -1e-7, -1e-3]))
def test_beside_a_touch_there_are_two_roots_or_none(at: float, gap: float) -> None:
    """1 − cos(u − u₀) − c: two roots close to each other for c > 0, none for c < 0."""
    k = np.array([0.0, 0.0, 1.0 - gap, 0.0, -np.sin(at), -np.cos(at)])
    cuts, n = cuts_of((at + 0.5 * np.pi) % (2.0 * np.pi), (at + 1.5 * np.pi) % (2.0 * np.pi))
    found = np.empty(2 * MAX_CUTS)
    found = found[: all_roots(k, cuts, n, found)]
    away = np.arccos(1.0 - gap) if gap > 0.0 else None
    assert list(found) == (
        [] if away is None else [pytest.approx(at - away), pytest.approx(at + away)]
    )


def test_a_function_that_touches_zero_at_a_cut_or_an_end_has_a_root_there() -> None:
    found = np.empty(2 * MAX_CUTS)
    for at in (0.0, np.pi, 2.0 * np.pi):
        k = np.array([0.0, 0.0, 1.0, 0.0, -np.sin(at), -np.cos(at)])
        cuts, n = cuts_of(np.pi)
        roots = found[: all_roots(k, cuts, n, found)].tolist()
        expected = [np.pi] if at == np.pi else [0.0, 2.0 * np.pi]
        # where a cut lies at the very touch, both intervals may find it
        assert sorted({round(root, 6) for root in roots}) == pytest.approx(expected, abs=1e-6)
