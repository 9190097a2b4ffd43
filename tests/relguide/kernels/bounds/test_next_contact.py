"""Whether paths touch again after a first contact, against plans that do, and by how often."""

from collections.abc import Iterable, Iterator
from itertools import islice

import numpy as np

from benchmarks import draws
from relguide.kernels.bounds.bundles import Search
from relguide.kernels.bounds.contact_tree import Problem, Tree, cell_at, reach
from relguide.kernels.bounds.joined import asked_next, may_touch_again
from relguide.kernels.bounds.proof_search import begin
from relguide.kernels.bounds.tangent_contacts import may_be_tangent
from relguide.planning.plan import Plan, plan
from tests.planned_contacts import flown, problem_of
from tests.relguide.kernels.bounds.test_last_contacts import (
    Passage,
    cells_round,
    parts_of,
    passages,
    search_for,
)

LEFT, OUTSIDE = 0.05, 1e-4
"""So long after a contact a plan that does not slide is so far outside d_min [R/V_P, R]."""


def passed_in_a_turn(passage: Passage, search: Search, problem: Problem, size: float) -> list[int]:
    """The cells of a size in which a plan's first contact may lie, if that is passed in a turn.

    Where a plan slides λ_ψ = 0: one that begins to out of a turn is not quite optimal.
    """
    if passage.path.outside(passage.at + LEFT) < OUTSIDE:
        return []
    tree = search.first
    cells, final = cells_round(passage, search, problem, size), len(problem.scene.leader) - 1
    exact = [n for n in cells if not tree.spare[n]]
    tangent = any(may_be_tangent(problem.tangents, cell_at(tree, n)) for n in exact)
    return [] if passage.first.piece == final or tangent else exact


def test_plans_that_touch_again_are_never_ruled_out() -> None:
    asked = 0
    for passage in (one for seed in (5, 6, 8) for one in passages(seed, 120)):
        for later, size in ((1e-3, 5e-3), (0.03, 1e-3), (0.3, 2e-4)):
            search, problem = search_for(passage, later)
            cells = passed_in_a_turn(passage, search, problem, size)
            if cells:
                assert any(may_touch_again(search.first, problem, n)[0] for n in cells)
                asked += 1
    assert asked > 10


def small_cells(tree: Tree, problem: Problem, begun: Iterable[int]) -> Iterator[int]:
    """Cells of first contacts, not on the final leg, from which the goal may be reached in time."""
    final = len(problem.scene.leader) - 1

    def may_be_in_time(n: int) -> bool:
        soon, onward = reach(tree, problem, n)
        return tree.cells[n, 0] != final and soon + onward < problem.beat

    return parts_of(tree, begun, problem.scene.d_min, 1e-3, may_be_in_time)


def test_of_many_first_contacts_it_is_found_out_that_no_other_comes_next() -> None:
    rng, asked, ruled_out = np.random.default_rng(8), [0, 0], [0, 0]
    for case in range(80):
        planned = plan(draws.active(rng, tight=case % 2 > 0, intent=True))
        if not isinstance(planned, Plan) or planned.optimality.proof != "bound":
            continue
        path = flown(planned)
        problem = problem_of(path.question, path.time)
        first, spare = [*path.question.first_contacts()], [*path.question.spare_contacts()]
        last = np.array([*path.question.last_contacts()])
        tree = begin(problem, np.array(first + spare), len(first), last).first
        kinds = range(len(first)), range(len(first), len(first) + len(spare))
        for n in (n for kind in kinds for n in islice(small_cells(tree, problem, kind), 30)):
            may, pieces = may_touch_again(tree, problem, n)
            assert asked_next(tree, n) == may
            # what is known is not asked again
            assert may_touch_again(tree, problem, n) == (may, 0)
            assert pieces >= 0
            asked[int(tree.spare[n])] += 1
            ruled_out[int(tree.spare[n])] += not may
    assert min(asked) > 100
    assert ruled_out[0] > 0.2 * asked[0]
    assert ruled_out[1] > 0.2 * asked[1]
