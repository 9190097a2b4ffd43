"""Distances and times in sentences say something, whatever they are."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from relguide.planning.phrases import distance, duration, too_close
from relguide.units import NM


@pytest.mark.parametrize(
    ("length", "said"),
    [
        (9260.0, "5.00 NM"),
        (0.1 * NM, "0.10 NM"),
        (92.6, "92.6 m"),
        (9.0, "9 m"),
        (0.25, "0.25 m"),
        (1e-9, "0 m"),
        (0.0, "0 m"),
    ],
)
def test_short_distances_are_given_in_metres(length: float, said: str) -> None:
    assert distance(length) == said


@given(st.floats(0.0, 20_000.0), st.floats(0.0, 20_000.0))
def test_nobody_comes_within_what_reads_like_the_limit(least: float, limit: float) -> None:
    said = too_close(least, limit)
    assert said != f"within {distance(limit)}"
    assert "0.00 NM" not in said


def test_a_distance_that_reads_like_the_limit_is_given_by_its_difference() -> None:
    assert too_close(9259.0, 9260.0) == "1.0 m too close"
    assert too_close(1852.0, 9260.0) == "within 1.00 NM"
    assert too_close(3.0, 9260.0) == "within 3 m"


@pytest.mark.parametrize(
    ("time", "said"),
    [
        (0.0, "less than 0.1 s"),
        (0.06, "0.1 s"),
        (9.94, "9.9 s"),
        (9.96, "10 s"),
        (3600.4, "3,600 s"),
    ],
)
def test_times_have_no_more_digits_than_say_something(time: float, said: str) -> None:
    assert duration(time) == said
