"""The cells that a proof begins with: every contact lies in one, and halving loses none."""

from collections import defaultdict
from dataclasses import replace
from itertools import islice, pairwise
from math import inf, pi

import numpy as np
import pytest

from benchmarks import draws
from benchmarks.proofs import KINDS, draw
from relguide import Plan, candidates, plan
from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.bounds.search.cell_tree import cell_at, halve, plant
from relguide.kernels.bounds.words.cells import Cell
from relguide.kernels.bounds.words.sets import Goal
from relguide.planning.contact_search import Question
from relguide.planning.prove import question_of

LEADER = np.array(
    [[0.0, 1.0, 0.5, -0.7, 0.4], [2.0, 2.6, 0.2, 0.1, -0.2], [3.0, 3.5, 0.3, -0.1, 0.0]]
)
QUESTION = Question(
    start=Pose(0.0, 0.0, 0.0),
    scene=Scene(LEADER, 0.9, 0.8, 5.0),
    goal=Goal(-1.0, 0.9, False),
    horizon=inf,
)


def windows(question: Question) -> dict[tuple[int, float], dict[tuple[float, float], list[Cell]]]:
    """The cells by piece and side, and those by window of time."""
    found: dict[tuple[int, float], dict[tuple[float, float], list[Cell]]]
    found = defaultdict(lambda: defaultdict(list))
    for cell in question.first_contacts():
        found[cell.piece, cell.side][cell.start, cell.end].append(cell)
    return found


def test_cells_cover_every_bearing_once_and_none_reaches_into_two_quadrants() -> None:
    for by_window in windows(QUESTION).values():
        for cells in by_window.values():
            edges = [(cell.bearing - cell.half, cell.bearing + cell.half) for cell in cells]
            assert edges[0][0] == pytest.approx(-pi, abs=1e-12)
            assert edges[-1][1] == pytest.approx(pi, abs=1e-12)
            for (_, end), (begin, _) in pairwise(edges):
                assert begin == pytest.approx(end, abs=1e-12)
            for begin, end in edges:
                assert np.floor(begin / (0.5 * pi) + 1e-9) == np.floor(end / (0.5 * pi) - 1e-9)


@pytest.mark.parametrize(
    ("t_release", "last"),
    [(5.0, [(3.0, 5.0), (5.0, inf)]), (2.5, [(3.0, inf)]), (0.0, [(3.0, inf)])],
)
def test_cells_cover_every_time_and_are_cut_where_the_slot_opens(
    t_release: float, last: list[tuple[float, float]]
) -> None:
    found = windows(replace(QUESTION, scene=QUESTION.scene._replace(t_release=t_release)))
    assert set(found) == {(piece, side) for piece in range(3) for side in (-1.0, 1.0)}
    for (piece, _), by_window in found.items():
        assert sorted(by_window) == [[(0.0, 2.0)], [(2.0, 3.0)], last][piece]


def test_contacts_after_the_horizon_have_no_cell() -> None:
    found = windows(replace(QUESTION, horizon=2.5))
    assert {(piece, *window) for (piece, _), some in found.items() for window in some} == {
        (0, 0.0, 2.0),
        (1, 2.0, 2.5),
    }
    # … but there is always one: a question begins with a cell
    assert set(windows(replace(QUESTION, horizon=0.0))) == {(0, -1.0), (0, 1.0)}


def test_last_contacts_are_those_of_every_leg() -> None:
    seen: dict[int, set[tuple[float, float]]] = defaultdict(set)
    for cell in QUESTION.last_contacts():
        seen[cell.piece].add((cell.start, cell.end))
    assert seen == {0: {(0.0, 2.0)}, 1: {(2.0, 3.0)}, 2: {(3.0, inf)}}


@pytest.mark.parametrize(
    ("cell", "by_time"),
    [
        (Cell(0, 1.0, 0.3, 0.1, 0.0, 2.0), True),
        (Cell(0, 1.0, 0.3, 0.1, 1.9, 2.0), False),
        (Cell(0, 1.0, 0.3, 0.1, 1.83, 2.0), False),  # half of 0.17 against 0.9 times 0.1
        (Cell(0, 1.0, 0.3, 0.1, 1.81, 2.0), True),
        (Cell(2, -1.0, 0.3, 0.1, 5.0, inf), False),
    ],
)
def test_the_halves_of_a_cell_are_the_cell_cut_across_its_bearings_or_its_times(
    cell: Cell, by_time: bool
) -> None:
    tree = plant(np.array([cell]), 3)
    first = halve(tree, 0, QUESTION.scene.d_min)
    assert halve(tree, 0, QUESTION.scene.d_min) == first == 1
    assert halve(tree, 1, QUESTION.scene.d_min) == -1  # no room
    one, other = cell_at(tree, first), cell_at(tree, first + 1)
    assert (one.piece, one.side) == (other.piece, other.side) == (cell.piece, cell.side)
    if by_time:
        middle = 0.5 * (cell.start + cell.end)
        assert (one.start, one.end) == (cell.start, middle)
        assert (other.start, other.end) == (middle, cell.end)
        assert one.half == other.half == cell.half
        assert one.bearing == other.bearing == cell.bearing
    else:
        assert (one.start, one.end) == (other.start, other.end) == (cell.start, cell.end)
        assert one.half == other.half == 0.5 * cell.half
        assert one.bearing - one.half == pytest.approx(cell.bearing - cell.half)
        assert one.bearing + one.half == pytest.approx(other.bearing - other.half)
        assert other.bearing + other.half == pytest.approx(cell.bearing + cell.half)


def test_paths_with_time_to_spare_before_a_contact_are_reckoned_with() -> None:
    """Nothing depends on how they come there, so no word of just that length may lead to it.

    Direct transcription finds such a path that takes 577.85 s, 1.2 s less than the plan; it was
    excluded.
    """
    rng = np.random.default_rng([3003, 1509])
    planned = plan(draws.active(rng, tight=False, intent=True, slot_at_limit=True))
    assert isinstance(planned, Plan)
    assert planned.time_to_converge < 579.06
    question = question_of(candidates(planned.situation))
    pursuer = planned.situation.pursuer
    scale = pursuer.turn_radius / pursuer.tas
    proved = max(islice(question.bounds(579.05 / scale), 200))
    assert proved * scale < 577.85


def test_hops_are_reckoned_with_on_the_final_leg_of_a_leader_who_has_turned() -> None:
    """No bank is enough to slide from the first contact on: a tenth of a second stayed open."""
    kind, number = KINDS[2], 30
    rng = np.random.default_rng([205, KINDS.index(kind), number])
    planned = plan(draw(kind, rng, number))
    assert isinstance(planned, Plan)
    question = question_of(candidates(planned.situation))
    pursuer = planned.situation.pursuer
    incumbent = (planned.time_to_converge - 0.1) * pursuer.tas / pursuer.turn_radius
    assert max(islice(question.bounds(incumbent), 1_000)) == pytest.approx(incumbent, abs=1e-9)
