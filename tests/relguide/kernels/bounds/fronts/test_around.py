"""The time round the disc by a table is that of an integral that others know."""

from math import cos, pi

import numpy as np
import pytest
from scipy.special import ellipeinc

from relguide.kernels.bounds.fronts.around import ROUND_SLACK, round_time, times_round


def exact(alpha: float, way: int, bearing: float) -> float:
    """The time from a bearing of -π on, for d_min = 1: an elliptic integral of the second kind."""
    arc = ellipeinc(bearing + 0.5 * pi, alpha * alpha) - ellipeinc(-0.5 * pi, alpha * alpha)
    ahead = (1.0 - 2.0 * way) * alpha * (cos(bearing) + 1.0)
    return float(arc + ahead) / (1.0 - alpha * alpha)


@pytest.mark.parametrize("way", [0, 1])
@pytest.mark.parametrize("alpha", [0.05, 0.5, 0.9, 0.99, 0.999])
def test_differences_are_right_to_less_than_is_reckoned_with(alpha: float, way: int) -> None:
    table, rng = times_round(alpha, 1.0), np.random.default_rng(1)
    off = [round_time(table, way, b) - exact(alpha, way, b) for b in rng.uniform(-pi, pi, 20_000)]
    assert max(off) - min(off) < ROUND_SLACK * table[way, -1]
