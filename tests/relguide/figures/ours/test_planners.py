"""Times are said to two digits or so, with their unit."""

import pytest

from relguide.figures.ours.planners import time_in_words


@pytest.mark.parametrize(
    ("seconds", "said"),
    [(7e-6, "7.0 µs"), (36e-6, "36 µs"), (2.197e-3, "2.2 ms"), (1.155, "1.2 s"), (42.0, "42 s")],
)
def test_times_in_words(seconds: float, said: str) -> None:
    assert time_in_words(seconds) == said
