"""The next extremal that clears is the one that a search of all of them finds."""

from math import pi

import numpy as np
import pytest

from relguide.kernels.base.records import Pose, Scene, start_at
from relguide.kernels.contact.clear_words import word_clears
from relguide.kernels.maps.final_leg import last_turns
from relguide.kernels.maps.next_clear import next_clear
from relguide.kernels.words.extremals import MAX_ROWS, solve
from relguide.kernels.words.sooner import make_scratch
from tests.relguide.kernels.maps.test_final_leg import STRAIGHT, turning

SCRATCH, TRIED = make_scratch(), np.empty(5)


@pytest.mark.parametrize("turns", [False, True], ids=["straight", "turning"])
@pytest.mark.parametrize("alpha", [0.0, 0.4, 0.83, 0.97, 1.1])
def test_it_is_the_first_that_clears(turns: bool, alpha: float) -> None:
    limit, opens = 1.4, 2.5 if turns else 0.0
    leader = turning(alpha) if turns else STRAIGHT
    scene = Scene(leader, alpha, limit, opens)
    longest = last_turns(scene)
    rng = np.random.default_rng(int(100.0 * alpha))
    rows = np.empty((MAX_ROWS, 5))
    lost = none = 0
    for i, (x, y, h) in enumerate(
        rng.uniform((-5.0, -5.0, 0.0), (7.0, 5.0, 2.0 * pi), (4000, 3)).tolist()
    ):
        n = solve(Pose(x, y, h), alpha, opens, rows)
        if n == 0 or word_clears(Pose(x, y, h), 0.0, rows[0], scene):
            continue
        expected = [row for row in rows[1:n] if word_clears(Pose(x, y, h), 0.0, row, scene)]
        row = rows[0].copy()
        # the hint may be right or wrong
        start = start_at(Pose(x, y, h))
        found = next_clear(start, scene, i % 6, longest, SCRATCH, TRIED, row)
        assert found == bool(expected), (x, y, h)
        if found:
            assert row[1] == expected[0][1], (x, y, h)
            assert abs(row - expected[0]).max() <= 1e-9 * max(1.0, row[0])
        lost += 1
        none += not found
    assert lost > 100
    assert none < lost or alpha > 1.0  # a slot that is faster is met once
