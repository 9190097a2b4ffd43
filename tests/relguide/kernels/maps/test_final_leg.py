"""The cheap tests of a map say of every extremal what the proof by windows says."""

from math import pi

import numpy as np
import pytest

from relguide.kernels.base.records import Pose, Scene, start_at
from relguide.kernels.contact.clear_words import word_clears
from relguide.kernels.maps.final_leg import keeps_clear, last_turns
from relguide.kernels.separation.clearance import leader_at, piece_clears
from relguide.kernels.words.extremals import MAX_ROWS, solve

AHEAD = 1.5
"""D, the slot behind the leader [R]."""
STRAIGHT = np.array([[0.0, AHEAD, 0.0, 0.0, 0.0]])


def turning(alpha: float) -> np.ndarray:
    """A leader that flies straight, then turns right on to its final leg."""
    turn = np.array([[0.0, 0.0, 0.0, 0.9, -0.6]])
    over, up, _ = leader_at(Scene(turn, alpha, 0.0, 0.0), 0, 1.5)
    x, y = alpha * 2.5 + AHEAD - over, -up
    along = alpha * np.array((np.cos(0.9), np.sin(0.9)))
    return np.array(
        [
            [0.0, x - along[0], y - along[1], 0.9, 0.0],
            [1.0, x, y, 0.9, -0.6],
            [2.5, alpha * 2.5 + AHEAD, 0.0, 0.0, 0.0],
        ]
    )


@pytest.mark.parametrize("turns", [False, True], ids=["straight", "turning"])
@pytest.mark.parametrize("limit", [0.2, 0.9, 1.45])
def test_it_says_what_the_windows_say(turns: bool, limit: float) -> None:
    rng = np.random.default_rng(int(10.0 * limit))
    rows = np.empty((MAX_ROWS, 5))
    said = []
    for alpha in (0.4, 0.83, 0.97):
        leader = turning(alpha) if turns else STRAIGHT
        scene = Scene(leader, alpha, limit, 0.0)
        longest = last_turns(scene)
        for x, y, h in rng.uniform((-5.0, -5.0, 0.0), (7.0, 5.0, 2.0 * pi), (1500, 3)).tolist():
            for row in rows[: solve(Pose(x, y, h), alpha, 0.0, rows)]:
                cheap = keeps_clear(
                    start_at(Pose(x, y, h)), 0.0, row, alpha * row[0], scene, longest
                )
                assert cheap == word_clears(Pose(x, y, h), 0.0, row, scene), (x, y, h)
                said.append(cheap)
    assert 0.1 < np.mean(said) < 0.98


@pytest.mark.parametrize("alpha", [0.4, 0.83, 0.97])
def test_last_turns_clear_up_to_the_longest_and_no_further(alpha: float) -> None:
    limit = 1.45
    longest = last_turns(Scene(STRAIGHT, alpha, limit, 0.0))
    assert longest[0] == pytest.approx(longest[1])
    for share in (0.5, 0.999, 1.001):
        turn = share * float(longest[1])
        # a left turn that ends in the slot when it is over
        x, y = alpha * turn - np.sin(turn), 1.0 - np.cos(turn)
        clears = piece_clears(Pose(x, y, -turn), 1.0, 0.0, turn, Scene(STRAIGHT, alpha, limit, 0.0))
        assert clears == (share < 1.0) or longest[1] > 6.28
