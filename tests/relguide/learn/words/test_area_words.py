"""By network: where it is sure one word is solved, and the times are the exact ones."""

from dataclasses import replace
from math import inf, pi

import numpy as np
import pytest

from relguide import Leader, Pursuer, Situation
from relguide.learn.words.area_words import area_words
from relguide.learn.words.branch_network import BranchNetwork, load_network
from relguide.maps.isochrones import Grid, isochrones, times_around
from relguide.units import DEG

GRID = Grid(x=0.0, y=0.0)
SITUATION = Situation(
    pursuer=Pursuer(x=-40e3, y=40e3, heading=0.0, tas=240.0, max_bank=25 * DEG),
    leader=Leader(x=0.0, y=0.0, heading=60 * DEG, tas=200.0),
    slot_distance=12e3,
    min_separation=9260.0,
)


@pytest.fixture(scope="module")
def network() -> BranchNetwork:
    return load_network()


def places(grid: Grid) -> tuple[np.ndarray, np.ndarray]:
    x, y = np.meshgrid(*grid.axes)
    return x.ravel(), y.ravel()


def situation_on(heading: float, ratio: float) -> Situation:
    return replace(
        SITUATION,
        pursuer=replace(SITUATION.pursuer, heading=heading),
        leader=replace(SITUATION.leader, tas=240.0 * ratio),
    )


def test_times_are_the_exact_ones_and_seldom_later(network: BranchNetwork) -> None:
    rng = np.random.default_rng(11)
    x, y = places(GRID)
    late = sure = 0
    for heading, ratio in rng.uniform((0.0, 0.3), (2.0 * pi, 0.97), (8, 2)).tolist():
        situation = situation_on(heading, ratio)
        exact = times_around(situation)(x, y)
        words = area_words(network, situation, GRID)
        found = times_around(situation, words=words)(x, y)
        assert np.array_equal(found.time < inf, exact.time < inf)
        planned = exact.time < inf
        off = found.time[planned] - exact.time[planned]
        assert off.min() >= -1e-6
        late += int((off > 1e-6).sum())
        assert np.all(found.lower_bound <= exact.lower_bound + 1e-6)
        assert np.all(found.proved <= exact.proved)
        alone = words(x, y)
        sure += int((alone >= 0).sum())
        assert np.all(alone <= 5)
        assert np.array_equal(found.proved, exact.proved & (found.lower_bound == found.time))
    assert sure > 0.5 * 8 * len(x)
    assert late <= 8


def test_lines_and_regions_are_those_of_the_exact_area(network: BranchNetwork) -> None:
    situation = situation_on(100 * DEG, 0.83)
    words = area_words(network, situation, GRID)
    exact = isochrones(situation, GRID)
    found = isochrones(situation, GRID, evaluate=times_around(situation, words=words))
    assert [c.level for c in found.contours] == [c.level for c in exact.contours]
    for one, other in zip(found.contours, exact.contours, strict=True):
        assert len(one.lines) == len(other.lines)
        for a, b in zip(one.lines, other.lines, strict=True):
            np.testing.assert_allclose(a, b, atol=0.01)
    assert [(r.word, r.limited) for r in found.regions] == [
        (r.word, r.limited) for r in exact.regions
    ]


@pytest.mark.parametrize("ratio", [0.29, 0.98])
def test_outside_its_box_the_network_is_not_asked(network: BranchNetwork, ratio: float) -> None:
    situation = situation_on(100 * DEG, ratio)
    assert np.all(area_words(network, situation, GRID)(*places(GRID)) == -1)


def test_beyond_its_range_neither(network: BranchNetwork) -> None:
    wide = Grid(x=0.0, y=0.0, width=1.9e6, height=1.9e6, columns=64, rows=64)
    x, y = places(wide)
    words = area_words(network, situation_on(100 * DEG, 0.83), wide)(x, y)
    assert np.all(words[np.hypot(x, y) > 42 * 12.7e3] == -1)


def test_a_grid_of_few_nodes_will_do(network: BranchNetwork) -> None:
    small = Grid(x=0.0, y=0.0, columns=2, rows=3)
    assert len(area_words(network, situation_on(1.0, 0.5), small)(*places(small))) == 6
