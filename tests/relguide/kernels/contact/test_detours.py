"""Detours: what a grid says is what the detour does, and descents only ever descend."""

from math import inf, pi

import numpy as np
import pytest

from relguide.kernels.contact.detour_search import MOST_PAIRS, fastest_clear_of_all
from relguide.kernels.contact.detours import close_detour, descend, lowest_of, scan_detours
from relguide.kernels.words.extremals import MAX_ROWS
from relguide.planning.others_table import others_of
from relguide.planning.slot import slot_frame
from tests.skies import any_sky, mirrored

STRAIGHTS = np.array([0.0, 0.5, 1.0, 2.0, 4.0])
TURNS = 24


@pytest.mark.parametrize("seed", range(8))
def test_a_grid_says_what_each_detour_does_and_descents_go_on_from_its_lowest(seed: int) -> None:
    situation = any_sky(np.random.default_rng(seed), 6)
    frame = slot_frame(situation, situation.leader.trajectory)
    others, rows = others_of(situation, frame), np.empty((MAX_ROWS, 5))
    grid = np.empty((2, TURNS + 1, len(STRAIGHTS)))
    best = scan_detours(frame.pose, 0.0, TURNS, STRAIGHTS, others, inf, inf, grid)
    for side, j, k in np.argwhere(grid < inf).tolist():
        pairs = np.array([[1.0 - 2.0 * side, 2.0 * pi * j / TURNS, STRAIGHTS[k]]])
        arrival, _ = close_detour(frame.pose, 0.0, pairs, others, inf, rows)
        assert arrival == pytest.approx(grid[side, j, k], abs=1e-6)
    places = np.empty((4, 4))
    n = lowest_of(grid, inf, places)
    assert n == 0 or places[0, 0] == best == grid.min()
    for arrival, side, j, k in places[:n]:
        pairs = np.array([[1.0 - 2.0 * side, 2.0 * pi * j / TURNS, STRAIGHTS[int(k)]]])
        low = descend(frame.pose, 0.0, pairs, 0.2, others, arrival + 1e-6, inf)
        assert low <= arrival + 1e-6
        again, _ = close_detour(frame.pose, 0.0, pairs, others, inf, rows)
        assert again == pytest.approx(min(low, arrival), abs=1e-6)


@pytest.mark.parametrize("seed", range(8))
def test_the_search_is_no_later_than_any_detour_and_the_same_in_the_mirror(seed: int) -> None:
    situation = any_sky(np.random.default_rng(seed), 6, cells=False, turns=False)
    times = []
    for seen in (situation, mirrored(situation)):
        frame = slot_frame(seen, seen.leader.trajectory)
        others = others_of(seen, frame)
        pairs, row = np.zeros((MOST_PAIRS, 3)), np.empty(5)
        time, n = fastest_clear_of_all(frame.pose, others, pairs, row)
        grid = np.empty((2, 37, len(STRAIGHTS)))
        scanned = scan_detours(frame.pose, 0.0, 36, STRAIGHTS, others, inf, inf, grid)
        assert time <= scanned + 0.02 or n < 0
        times.append(time)
    assert times[1] == pytest.approx(times[0], abs=6e-3)  # 0.3 s
