"""What is kept of fronts changes nothing, and no path that slides is sooner than they are."""

from math import acos, cos, inf, pi, sin

import numpy as np
import pytest

from relguide.kernels.base.records import Scene
from relguide.kernels.bounds.fronts.around import round_anywhere, times_round
from relguide.kernels.bounds.fronts.cell_fronts import (
    KEPT,
    _last_before,
    _last_unaware,
    begin_fronts,
    round_arrival,
    slides_from,
)
from relguide.kernels.bounds.fronts.front import Headings
from relguide.kernels.bounds.words.cells import Cell
from relguide.kernels.separation.clearance import leader_at, piece_at
from tests.relguide.kernels.bounds.fronts.test_front import contact, turning

CLOSE = 1e-9
"""Times that differ by no more are the same but for rounding [R/V_P]."""


def turning_gently_or_tightly(rng: np.random.Generator) -> Scene:
    """A leader that turns once or twice, gently or tightly, round a small disc or a large one."""
    turns = rng.integers(1, 3)
    leader = np.zeros((2 * turns + 1, 5))
    leader[1::2, 4] = rng.choice((-1.0, 1.0), turns) * rng.uniform(0.3, 2.9, turns)
    leader[1:, 0] = np.cumsum(rng.uniform(0.2, 4.0, 2 * turns))
    scene = Scene(leader, rng.uniform(0.3, 0.98), rng.uniform(0.35, 5.0), 0.0)
    for i in range(2 * turns):
        leader[i + 1, 1:4] = leader_at(scene, i, leader[i + 1, 0])
    return scene


def cell_after(rng: np.random.Generator, scene: Scene, since: float) -> Cell:
    """A cell of contacts, of any size, that lies in one quadrant and on one piece."""
    start = rng.uniform(since, scene.leader[-1, 0] + 3.0)
    piece, half = piece_at(scene.leader, start), 10.0 ** rng.uniform(-6.0, -1.0)
    ends = scene.leader[piece + 1, 0] if piece + 1 < len(scene.leader) else inf
    middle = pi / 8 + rng.integers(-4, 4) * pi / 4
    bearing = middle + rng.uniform(-1.0, 1.0) * (pi / 8 - half)
    lasts = half if scene.leader[piece, 4] != 0.0 else rng.choice((half, rng.uniform(0.0, 4.0)))
    return Cell(piece, rng.choice((-1.0, 1.0)), bearing, half, start, min(start + lasts, ends))


@pytest.mark.parametrize("seed", range(3))
def test_what_is_kept_of_a_front_changes_nothing(seed: int) -> None:
    rng = np.random.default_rng(seed)
    came = late = 0
    for _ in range(60):
        scene, kept = turning_gently_or_tightly(rng), begin_fronts()
        table = times_round(scene.alpha, scene.d_min)
        firsts = [cell_after(rng, scene, 0.0) for _ in range(4)]
        for _ in range(60):
            n = int(rng.integers(len(firsts)))
            cell = firsts[n]
            other = cell_after(rng, scene, cell.start)
            if cell.piece + 1 == len(scene.leader):
                continue
            latest = cell.start + rng.choice((inf, rng.uniform(0.0, 8.0)))
            anew = round_arrival(begin_fronts(), 0, scene, table, cell, other, latest)
            # two of them share a place
            again = round_arrival(kept, n // 2 + KEPT * (n % 2), scene, table, cell, other, latest)
            assert again == pytest.approx(anew, abs=CLOSE)
            came += cell.start < anew < inf
            late += anew == inf
    assert came > 200
    assert late > 200


def test_a_front_that_comes_back_has_swept_what_it_swept_before() -> None:
    fronts, swept = begin_fronts(), np.array((0.0, 0.5, 0.3, 0.6, 0.7))
    fronts.places[7, :5, 3], fronts.places[7, :5, 4] = swept, np.maximum.accumulate(swept)
    fronts.kept[7, 1] = 5
    for angle, last in ((0.2, 0.0), (0.4, 0.0), (0.55, 0.3), (0.65, 0.6), (0.8, 0.7)):
        assert _last_before(fronts, 7, angle).swept == last


def test_a_front_that_must_turn_back_at_its_end_is_followed_anew_from_there() -> None:
    fronts, there = begin_fronts(), np.arange(6.0)
    fronts.places[7, :6, 0] = fronts.places[7, :6, 3] = fronts.places[7, :6, 4] = there
    fronts.places[7, :6, 2] = 0.0  # e keeps its course
    fronts.kept[7, 1] = 6
    for last, differs, place in ((pi, 0.0, 2), (pi, 0.5, 3), (pi, 1.5, 4), (0.5, 0.0, 4)):
        headings = Headings(0.0, inf, 0.0, last, differs, 6.0)
        assert _last_unaware(fronts, 7, 4.5, headings).t == place


STEP = 1e-3
"""In which paths are flown [R/V_P]."""


def goes_round(scene: Scene, bearing: float, t: float, sense: float) -> float:
    """How fast the bearing of a pursuer changes that slides [V_P/R]."""
    there = leader_at(scene, piece_at(scene.leader, t), t)
    heading = bearing + sense * acos(scene.alpha * cos(bearing - there.h))
    return (sin(heading - bearing) - scene.alpha * sin(there.h - bearing)) / scene.d_min


def on_edge(scene: Scene, bearing: float, t: float, sense: float) -> float:
    """The bearing of a pursuer that slides, a step later."""
    half = bearing + 0.5 * STEP * goes_round(scene, bearing, t, sense)
    return bearing + STEP * goes_round(scene, half, t + 0.5 * STEP, sense)


def test_a_path_that_slides_is_on_the_final_leg_no_sooner_than_the_front() -> None:
    """Though the front may slide on only later than that."""
    rng, looked, later = np.random.default_rng(3), 0, 0
    while looked < 400:
        scene, way = turning(rng), int(rng.integers(2))
        sense, ends = 1.0 - 2.0 * way, float(scene.leader[2, 0])
        t, bearing = rng.uniform(scene.leader[1, 0], ends), rng.uniform(-pi, pi)
        start, latest = contact(scene, bearing, t, sense), ends + rng.uniform(0.01, 1.0)
        while t < ends:
            bearing, t = on_edge(scene, bearing, t, sense), t + STEP
        table = times_round(scene.alpha, scene.d_min)
        slid = t - sense * round_anywhere(table, way, bearing - scene.leader[2, 3])
        soonest = slides_from(scene, table, start, way, latest)
        assert soonest < slid + 1e-3
        later += soonest > slides_from(scene, table, start, way, inf) + 1e-3
        looked += 1
    assert later > 10
