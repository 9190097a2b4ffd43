"""What is said of a cell lies below what is flown, and a cell learns from its halves."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import floor, inf, pi

import numpy as np

from benchmarks import draws
from relguide.kernels.bounds.search.cell_facts import bury, is_buried, learn, leave, only_of, reach
from relguide.kernels.bounds.search.cell_tree import Problem, Tree, cell_at, halve, plant, size_of
from relguide.kernels.bounds.words.cells import Cell
from relguide.planning.contact_search import Question
from relguide.planning.outcome import Plan
from relguide.planning.plan import plan
from tests.planned_contacts import flown, problem_of


def test_a_cell_is_buried_once_both_its_halves_are() -> None:
    tree = plant(np.array([[0.0, 1.0, pi / 8, pi / 8, 0.0, inf]]), 16)
    half = halve(tree, 0, 1.0)
    quarter = halve(tree, half, 1.0)
    tree.known[:7] = 1.0  # whatever is known is no less
    for n in (half + 1, quarter):
        bury(tree, n)
        learn(tree, half)
        learn(tree, 0)
        assert is_buried(tree, n)
        assert not is_buried(tree, half)
        assert not is_buried(tree, 0)
    bury(tree, quarter + 1)
    learn(tree, half)
    assert is_buried(tree, half)
    assert is_buried(tree, 0)


def test_nothing_is_learned_of_halves_that_have_not_been_looked_at() -> None:
    tree = plant(np.array([[0.0, 1.0, pi / 8, pi / 8, 0.0, inf]]), 16)
    half = halve(tree, 0, 1.0)
    tree.known[0] = 1.0
    bury(tree, half)
    learn(tree, 0)
    assert not is_buried(tree, 0)


HALF = 1e-4
"""Of a cell round a contact; plans keep 3e-7 R outside d_min [rad]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Touch:
    """A plan's only contact."""

    question: Question
    time: float
    """Of the plan [R/V_P]."""
    cell: Cell
    """That holds hardly more than the contact."""
    turning: bool
    """Whether the path turns there."""


def touch_of(planned: Plan) -> Touch | None:
    """The contact of a plan that has one, and flies full-bank turns and straights."""
    path = flown(planned)
    if any(min(abs(rate), abs(abs(rate) - 1.0)) > 1e-6 for rate, _ in path.pieces):
        return None
    scene = path.question.scene
    times = np.arange(0.0, path.time, 2e-3)
    gaps = np.array([path.outside(float(t)) for t in times])
    lows = np.flatnonzero((gaps[1:-1] < gaps[:-2]) & (gaps[1:-1] <= gaps[2:])) + 1
    near = [times[k] for k in lows if gaps[k] < 1e-5]
    if len(near) != 1:
        return None
    fine = near[0] + np.linspace(-2e-3, 2e-3, 401)
    t = float(fine[np.argmin([path.outside(float(at)) for at in fine])])
    (piece, bearing, side), off = path.contact(t)
    final = piece + 1 == len(scene.leader)
    window = (float(scene.leader[piece, 0]), inf) if final else (t - HALF, t + HALF)
    if off > 1e-3 or min(t, abs(bearing % (0.5 * pi))) < 2.0 * HALF:
        return None
    past, turning = 0.0, False
    for rate, lasts in path.pieces:
        if past + HALF < t < past + lasts - HALF:
            turning = abs(rate) > 0.5
        past += lasts
    cell = Cell(piece, side, bearing, HALF, *window)
    return Touch(question=path.question, time=path.time, cell=cell, turning=turning)


def touches(seed: int, count: int) -> Iterator[Touch]:
    rng = np.random.default_rng(seed)
    for case in range(count):
        drawn = draws.active(rng, tight=case % 3 > 0, intent=case % 2 == 0)
        planned = plan(drawn)
        if isinstance(planned, Plan) and planned.optimality.proof == "bound":
            touch = touch_of(planned)
            if touch is not None:
                yield touch


def later_than(touch: Touch) -> Problem:
    """How soon at all, before a little later than the plan."""
    return problem_of(touch.question, 1.1 * touch.time)


def toward(tree: Tree, n: int, touch: Touch) -> int:
    """The half of a cell in which the contact lies."""
    half = halve(tree, n, touch.question.scene.d_min)
    one, other = cell_at(tree, half), cell_at(tree, half + 1)
    if one.bearing == other.bearing:
        return half + (0.5 * (touch.cell.start + touch.cell.end) > one.end)
    return half + (touch.cell.bearing > one.bearing + one.half)


def test_no_plan_with_one_contact_is_sooner_than_what_is_said_of_that() -> None:
    straight = turned = 0
    for touch in touches(31, 150):
        tree = plant(np.array([touch.cell]), 4)
        assert only_of(tree, later_than(touch), 0) <= touch.time + 1e-3
        straight += not touch.turning
        turned += touch.turning
    assert straight > 2
    assert turned > 10


def test_a_part_of_a_cell_begins_with_what_is_left_of_the_cell() -> None:
    """No plan is sooner than what is said then."""
    parts = 0
    for touch in touches(33, 80):
        problem, cell = later_than(touch), touch.cell
        wide, leader, d_min = 0.125 * pi, problem.scene.leader, problem.scene.d_min
        middle = (floor(cell.bearing / (2.0 * wide)) + 0.5) * 2.0 * wide
        end = leader[cell.piece + 1, 0] if cell.piece + 1 < len(leader) else inf
        root = Cell(cell.piece, cell.side, middle, wide, leader[cell.piece, 0], end)
        tree, n = plant(np.array([root]), 99), 0
        while size_of(tree, n, d_min) > 10.0 * HALF:
            soon, onward = reach(tree, problem, n)
            assert soon + max(onward, leave(tree, problem, n)) <= touch.time + 1e-3
            parts += 1
            n = toward(tree, n, touch)
    assert parts > 200
