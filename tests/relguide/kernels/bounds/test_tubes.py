"""How paths differ that begin at the contacts of a cell, against such paths flown one by one."""

from math import inf, pi

import numpy as np
import pytest

from relguide.kernels.bounds.cells import Cell, poses_of
from relguide.kernels.bounds.goal import Goal
from relguide.kernels.bounds.tubes import (
    Course,
    Tube,
    bends_of,
    course_of,
    flown,
    seen_at,
    spread_of,
    touching,
    tube_from,
    with_piece,
    with_turn,
)
from relguide.kernels.words.extremals import fly_piece
from tests.relguide.kernels.bounds.test_after_spare import drawn_scene
from tests.relguide.kernels.bounds.test_first_order import contact_of

SLOT = Goal(2.0, 0.5, False)
LATE = 1e7
ROUNDING = 1e-9


def a_cell(rng: np.random.Generator, size: float) -> Cell:
    """Contacts while the leader turns, often not for much longer; in one quadrant."""
    half, start = size * rng.uniform(0.2, 1.0), rng.uniform(1.0, 5.9)
    bearing = 0.5 * pi * rng.integers(-2, 2) + rng.uniform(half, 0.5 * pi - half)
    return Cell(1, rng.choice((1.0, -1.0)), bearing, half, start, start + size * rng.uniform())


class Paths:
    """A turn from the contacts of a cell, a second piece, and a third, all known nearly."""

    def __init__(self, rng: np.random.Generator, size: float) -> None:
        self.scene, self.cell = drawn_scene(rng), a_cell(rng, size)
        self.halves = size * rng.uniform(0.0, 1.0, 2)
        self.amounts = rng.uniform(0.1, 2.0, 2)
        sense = rng.choice((1.0, -1.0))
        self.signs = sense, rng.choice((0.0, -sense)), rng.choice((1.0, -1.0))

    def tube(self) -> Tube:
        tube = tube_from(poses_of(self.scene, self.cell))
        tube = with_turn(flown(tube, self.signs[0], self.amounts[0]), self.signs[0], self.halves[0])
        tube = flown(tube, self.signs[1], self.amounts[1])
        return with_piece(tube, self.signs[1], self.halves[1])

    def course(self) -> Course:
        return course_of(self.scene, SLOT, self.cell, LATE)

    def seen(self, ways: np.ndarray, w: float) -> tuple[float, float]:
        """d and d′ so far along the third piece, of the path at these edges or between, ±1."""
        at, t = contact_of(self.scene, self.cell, ways[0], ways[1])
        for k in range(2):
            amount = self.amounts[k] + ways[2 + k] * self.halves[k]
            at, t = fly_piece(at, self.signs[k], amount), t + amount
        seen = seen_at(self.scene, fly_piece(at, self.signs[2], w), t + w)
        return seen.d, seen.ex * seen.vx + seen.ey * seen.vy


@pytest.mark.parametrize("size", [3e-2, 3e-3, 1e-4])
def test_no_path_differs_by_more_than_the_tube_may(size: float) -> None:
    rng, used = np.random.default_rng(5), []
    for _ in range(150):
        paths = Paths(rng, size)
        tube, course = paths.tube(), paths.course()
        for w in rng.uniform(0.0, 2.5, 4):
            at = fly_piece(tube.at, paths.signs[2], w)
            seen = seen_at(paths.scene, at, tube.t + w)
            spread = spread_of(course, tube, at, w, seen)
            opens, most = seen.ex * seen.vx + seen.ey * seen.vy, 0.0
            if seen.d < paths.scene.d_min:
                continue
            for _ in range(12):
                d, rate = paths.seen(rng.choice((-1.0, 1.0, rng.uniform(-1.0, 1.0)), 4), w)
                if d < paths.scene.d_min:
                    continue
                assert abs(d - seen.d) <= spread.gap + ROUNDING
                assert abs(rate - opens) <= spread.opens + ROUNDING
                most = max(most, abs(d - seen.d))
            used.append(most / spread.gap)
    assert len(used) > 200
    # all differ at once somewhere only
    assert np.median(used) > (0.1 if size > 1e-2 else 0.5)


@pytest.mark.parametrize("size", [3e-2, 3e-3])
def test_no_path_bends_otherwise_than_the_tube_may(size: float) -> None:
    rng, used, brief = np.random.default_rng(7), [], 1e-4
    for _ in range(150):
        paths = Paths(rng, size)
        tube, course, sign = paths.tube(), paths.course(), paths.signs[2]
        for w in rng.uniform(2.0 * brief, 2.5, 4):
            at, t = fly_piece(tube.at, sign, w), tube.t + w
            seen = seen_at(paths.scene, at, t)
            spread, opens = (
                spread_of(course, tube, at, w, seen),
                seen.ex * seen.vx + seen.ey * seen.vy,
            )
            bends, differs, alike = bends_of(course, seen, spread, sign, t, opens)
            if seen.d < paths.scene.d_min or alike < 2.0 * brief:
                continue
            most = 0.0
            for _ in range(12):
                ways = rng.choice((-1.0, 1.0, rng.uniform(-1.0, 1.0)), 4)
                before, after = (paths.seen(ways, w + k * brief) for k in (-1.0, 1.0))
                if min(before[0], after[0]) < paths.scene.d_min:
                    continue
                bent = (after[1] - before[1]) / (2.0 * brief)
                assert abs(bent - bends) <= differs + 1e-4
                most = max(most, abs(bent - bends))
            used.append(most / differs)
    assert len(used) > 150
    assert max(used) > 0.1


def least_along(paths: Paths, ways: np.ndarray) -> tuple[float, float]:
    """Where along the third piece d is least, for the first time, and how far outside the limit."""
    steps = np.arange(0.0, 2.5, 0.02)
    d = [paths.seen(ways, float(w))[0] for w in steps]
    for k in range(1, len(steps) - 1):
        if d[k] <= d[k - 1] and d[k] < d[k + 1]:
            low, high = steps[k - 1], steps[k + 1]
            while high - low > 1e-9:
                middle = 0.5 * (low + high)
                if paths.seen(ways, middle)[1] < 0.0:
                    low = middle
                else:
                    high = middle
            return float(low), paths.seen(ways, float(low))[0] - paths.scene.d_min
    return inf, inf


@pytest.mark.parametrize("size", [1e-2, 1e-3])
def test_a_path_that_touches_is_found(size: float) -> None:
    rng, asked, narrow = np.random.default_rng(6), 0, 0
    for _ in range(200):
        paths = Paths(rng, size)
        ways = rng.uniform(-1.0, 1.0, 4)
        # a turn with which the path in the tube just touches
        turns = np.linspace(0.1, 2.5, 25)
        gaps = []
        for turn in turns:
            paths.amounts[0] = turn
            gaps.append(least_along(paths, ways))
        for k in range(len(turns) - 1):
            (at, one), (then, other) = gaps[k], gaps[k + 1]
            if not (one * other < 0.0 and abs(at - then) < 0.3):
                continue
            low, high = turns[k], turns[k + 1]
            for _ in range(45):
                middle = paths.amounts[0] = 0.5 * (low + high)
                if least_along(paths, ways)[1] * one > 0.0:
                    low = middle
                else:
                    high = middle
            where, gap = least_along(paths, ways)
            if abs(gap) > 1e-8 or any(
                paths.seen(ways, w)[0] < paths.scene.d_min for w in np.arange(0.0, where, 0.01)
            ):
                continue
            found, begin = False, 0.0
            while not found:
                zone = touching(paths.course(), paths.tube(), paths.signs[2], begin, 3.0)
                assert zone.begin < inf
                found = zone.begin <= where + 1e-6 and where <= zone.end + 1e-6
                narrow += found and zone.end - zone.begin < 0.3
                begin = zone.end
            asked += 1
            break
    assert asked > 10
    assert narrow > 0.5 * asked
