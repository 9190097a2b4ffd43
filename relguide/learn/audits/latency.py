"""latency_of(spent) → Latency: how long a query takes, by its median, its mean and its 99 %.

The mean says what many queries cost together: where a few take long, it is far above the median.
"""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np


class Latency(NamedTuple):
    """CPU time of a query [µs]."""

    median: float
    mean: float
    late: float
    """99th percentile."""


def latency_of(spent: Sequence[float]) -> Latency:
    """Sum up what queries took [µs]."""
    middle, late = np.percentile(spent, (50.0, 99.0))
    return Latency(float(middle), float(np.mean(spent)), float(late))


def latency_as_json(asked: Mapping[str, Latency]) -> dict[str, dict[str, float]]:
    """By who is asked, as JSON names them."""
    return {
        name: {"p50_us": found.median, "mean_us": found.mean, "p99_us": found.late}
        for name, found in asked.items()
    }
