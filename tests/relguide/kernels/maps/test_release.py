"""Paths that arrive as the slot opens: what the cheap tests leave out is not there."""

from math import pi

import numpy as np
import pytest

from relguide.kernels.base.records import Pose, Scene, start_at
from relguide.kernels.contact.clear_words import pieces_clear
from relguide.kernels.maps.final_leg import keeps_clear
from relguide.kernels.maps.release import reaches, release_clears
from relguide.kernels.words.branches import TO_POINT
from relguide.kernels.words.delay import DELAY_PIECES, MAX_DELAYS, straight_delays, turning_delays
from relguide.kernels.words.extremals import SIGNS, fly_piece
from relguide.kernels.words.to_point import word_to_point
from tests.relguide.kernels.maps.test_final_leg import turning

PIECE, ROW = np.empty(3), np.empty(5)


def ends(
    x: float, y: float, h: float, signs: np.ndarray, amounts: np.ndarray
) -> tuple[float, float, float]:
    """The place and the heading, within (−π, π], where pieces end."""
    for sign, amount in zip(signs, amounts, strict=True):
        x, y, h = fly_piece(Pose(x, y, h), sign, amount)
    return x, y, float(np.angle(np.exp(1j * h)))


def shortest_to(pose: Pose, end_x: float) -> float:
    """The shortest of all words to (end_x, 0) on heading 0."""
    lengths = [word_to_point(pose, end_x, branch, PIECE) for branch in TO_POINT]
    return min(length for length in lengths if length >= 0.0)


@pytest.mark.parametrize("length", [0.5, 3.0, 9.0])
def test_it_reaches_what_one_of_the_words_reaches(length: float) -> None:
    rng = np.random.default_rng(int(2.0 * length))
    end_x = 0.8 * length
    said = []
    for x, y, h in rng.uniform(
        (end_x - length, -length, 0.0), (end_x + length, length, 2.0 * pi), (4000, 3)
    ).tolist():
        pose = Pose(x, y, h)
        shortest = shortest_to(pose, end_x)
        found = reaches(start_at(pose), end_x, length, PIECE)
        assert found == (shortest <= length), (x, y, h)
        # and to the last digit, where a bound that is not one would show
        assert reaches(start_at(pose), end_x, shortest, PIECE), (x, y, h)
        said.append(found)
    assert 0.0 < np.mean(said) < 1.0


@pytest.mark.parametrize("h", [0.0, 0.5 * pi, pi, 1.5 * pi])
@pytest.mark.parametrize("x", [-4.0, -2.0, 0.0, 1.0, 2.0])
@pytest.mark.parametrize("y", [-2.0, -1.0, 0.0, 2.0])
def test_on_the_axes_and_at_round_angles_too(x: float, y: float, h: float) -> None:
    start, shortest = start_at(Pose(x, y, h)), shortest_to(Pose(x, y, h), 0.0)
    assert reaches(start, 0.0, shortest, PIECE)
    assert not reaches(start, 0.0, shortest - 1e-6, PIECE)


@pytest.mark.parametrize("limit", [0.3, 1.45])
def test_a_path_that_clears_is_one_of_the_many_families(limit: float) -> None:
    rng = np.random.default_rng(5)
    alpha, opens = 0.83, 2.5
    leader = turning(alpha)
    scene = Scene(leader, alpha, limit, opens)
    paths = np.empty((2, MAX_DELAYS, DELAY_PIECES))
    signs, amounts = paths
    said, same = [], []
    for x, y, h in rng.uniform((-0.5, -1.2, -1.0), (1.5, 1.2, 1.0), (4000, 3)).tolist():
        h %= 2.0 * pi
        start = start_at(Pose(x, y, h))
        if not reaches(start, alpha * opens, opens, PIECE):
            continue
        found = release_clears(start, scene, PIECE, ROW)
        n = straight_delays(Pose(x, y, h), alpha, opens, paths)
        n = turning_delays(Pose(x, y, h), alpha, opens, paths, n)
        turns = np.count_nonzero(signs[:n, 1:4], axis=1) == 2
        before = (signs[:n, 0] == 0.0) & (amounts[:n, 4] == 0.0) & turns
        behind = (signs[:n, 0] == 0.0) & (amounts[:n, 0] == 0.0) & turns
        simple = [
            pieces_clear(Pose(x, y, h), 0.0, signs[i], amounts[i], scene)
            for i in np.flatnonzero(before | behind)
        ]
        if found:
            straight, word = [opens - ROW[0]], ROW[2:].tolist()
            word_signs = SIGNS[int(ROW[1])].tolist()
            assert any(
                ends(x, y, h, *pieces) == pytest.approx((alpha * opens, 0.0, 0.0), abs=1e-6)
                and pieces_clear(Pose(x, y, h), 0.0, *pieces, scene)
                for pieces in (
                    (np.array([0.0, *word_signs]), np.array(straight + word)),
                    (np.array([*word_signs, 0.0]), np.array(word + straight)),
                )
            ), (x, y, h)
        said.append(found)
        same.append(found == any(simple))
    assert len(said) > 300
    assert 0.0 < np.mean(said) < 0.95
    # where a turn jumps by 2π another path may be found, or none; a grid of amounts may miss some
    assert np.mean(same) > 0.9


def test_a_word_that_begins_later_is_flown_later() -> None:
    alpha, t, longest = 0.83, 0.7, np.zeros(2)
    leader = turning(alpha)
    scene = Scene(leader, alpha, 1.2, 0.0)
    rng = np.random.default_rng(6)
    said = []
    for x, y, h, end_x in rng.uniform((-5.0, -4.0, 0.0, 0.0), (4.0, 4.0, 6.28, 4.0), (3000, 4)):
        for branch in range(4):
            length = word_to_point(Pose(x, y, h), end_x, branch, PIECE)
            if length < 0.0:
                continue
            row = np.array((length, branch, *PIECE))
            clears = keeps_clear(start_at(Pose(x, y, h)), t, row, end_x, scene, longest)
            assert clears == pieces_clear(Pose(x, y, h), t, SIGNS[branch], PIECE, scene)
            said.append(clears)
    assert 0.1 < np.mean(said) < 0.95
