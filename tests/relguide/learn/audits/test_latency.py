"""Latencies are summed up so that a few slow queries show."""

import pytest

from relguide.learn.audits.latency import Latency, latency_as_json, latency_of


def test_a_slow_query_counts_in_the_mean_alone() -> None:
    found = latency_of([1.0, 3.0, 2.0, 94.0] + [2.0] * 96)
    assert found.median == 2.0
    assert found.mean == pytest.approx(2.92)
    assert found.late == pytest.approx(3.91)  # between the slowest and the next
    (told,) = latency_as_json({"network": found}).values()
    assert told == {"p50_us": 2.0, "mean_us": found.mean, "p99_us": found.late}


def test_one_query_is_all_there_is() -> None:
    assert latency_of([5.0]) == Latency(5.0, 5.0, 5.0)
