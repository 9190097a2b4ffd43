"""The fastest extremal is the first of all, though words that cannot win are not solved."""

from math import pi

import numpy as np
import pytest

from relguide.kernels.extremals import MAX_ROWS, solve
from relguide.kernels.fastest import fastest

ROOM = np.empty((MAX_ROWS, 4))


@pytest.mark.parametrize("within", [2.0, 6.0, 25.0])
@pytest.mark.parametrize("opens", [0.0, 12.0])
def test_it_is_the_first_of_all(within: float, opens: float) -> None:
    rng = np.random.default_rng(int(within + opens))
    first, every = np.empty((MAX_ROWS, 5)), np.empty((MAX_ROWS, 5))
    for x, y, h, alpha, t in rng.uniform(
        (-within, -within, 0.0, 0.0, 0.0), (within, within, 2.0 * pi, 1.2, opens), (4000, 5)
    ).tolist():
        n = solve(x, y, h, alpha, t, every)
        found = fastest(x, y, h, alpha, t, ROOM, first)
        assert (found > 0) == (n > 0)
        assert found <= n
        if n > 0:
            assert first[0].tolist() == every[0].tolist(), (x, y, h, alpha, t)


def test_on_the_axes_and_at_round_angles_too() -> None:
    first, every = np.empty((MAX_ROWS, 5)), np.empty((MAX_ROWS, 5))
    for x in (-4.0, -2.0, 0.0, 2.0, 4.0):
        for y in (-6.0, -4.0, -2.0, 0.0, 2.0, 4.0, 6.0):
            for h in (0.0, 0.5 * pi, pi, 1.5 * pi):
                for alpha in (0.0, 0.5, 1.0 - 1e-9):
                    solve(x, y, h, alpha, 0.0, every)
                    fastest(x, y, h, alpha, 0.0, ROOM, first)
                    assert first[0].tolist() == every[0].tolist(), (x, y, h, alpha)
