"""The last contact after a first one: none that a plan has is left out."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from math import inf

import numpy as np

from benchmarks import draws
from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.records import Contact
from relguide.kernels.bounds.search.branch_and_bound import begin
from relguide.kernels.bounds.search.cell_facts import reach
from relguide.kernels.bounds.search.cell_tree import Problem, Tree, cell_at, halve, size_of
from relguide.kernels.bounds.search.narrowing import ask_lasts, lasts_of
from relguide.kernels.bounds.search.nodes import Search
from relguide.planning.outcome import Plan
from relguide.planning.plan import plan
from tests.planned_contacts import Flown, flown, problem_of

STEP, TOUCH, NEAR = 2e-3, 5e-6, 5e-3
"""A path is looked at so often [R/V_P], touches if it is no further outside d_min [R], and so near
contacts are the same [rad]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Passage:
    """A plan that slides along d_min, or touches it more than once."""

    path: Flown
    first: Contact
    at: float
    """When it is there [R/V_P]."""
    last: Contact
    last_at: float
    """Likewise."""


def passage_of(planned: Plan) -> Passage | None:
    """The first and the last contact of a plan, if it has more than one."""
    path = flown(planned)
    times = [float(t) for t in np.arange(STEP, path.time, STEP) if path.outside(float(t)) < TOUCH]
    if not times or times[-1] - times[0] < 0.1:
        return None
    (first, _), (last, _) = path.contact(times[0]), path.contact(times[-1])
    return Passage(path=path, first=first, at=times[0], last=last, last_at=times[-1])


def passages(seed: int, count: int) -> Iterator[Passage]:
    rng = np.random.default_rng(seed)
    for case in range(count):
        planned = plan(draws.active(rng, tight=case % 2 > 0, intent=True))
        if isinstance(planned, Plan) and planned.optimality.proof == "bound":
            passage = passage_of(planned)
            if passage is not None:
                yield passage


def search_for(passage: Passage, later: float) -> tuple[Search, Problem]:
    """A search that has only begun, for paths that arrive so much later than the plan [R/V_P]."""
    asked = passage.path.question
    problem = problem_of(asked, passage.path.time + later)
    first, spare = [*asked.first_contacts()], [*asked.spare_contacts()]
    last = np.array([*asked.last_contacts()])
    return begin(problem, np.array(first + spare), len(first), last), problem


def holds(tree: Tree, n: int, contact: Contact, t: float) -> bool:
    """Whether a contact lies in a cell, or right beside it."""
    cell = cell_at(tree, n)
    off = wrap_signed(contact.bearing - cell.bearing)
    return (
        cell.piece == contact.piece
        and cell.side == contact.side
        and abs(off) <= cell.half + NEAR
        and cell.start - NEAR <= t <= cell.end + NEAR
    )


def parts_of(
    tree: Tree, cells: Iterable[int], d_min: float, size: float, wanted: Callable[[int], bool]
) -> Iterator[int]:
    """Parts of cells that are no larger than that, and are wanted as what they are part of is."""
    open_cells = [*cells]
    while open_cells:
        n = open_cells.pop()
        if not wanted(n):
            continue
        if size_of(tree, n, d_min) <= size:
            yield n
            continue
        half = halve(tree, n, d_min)
        open_cells += [half, half + 1]


def cells_round(passage: Passage, search: Search, problem: Problem, size: float) -> list[int]:
    """The cells of first contacts of a size in which a plan's may lie."""
    tree = search.first

    def holds_first(n: int) -> bool:
        return holds(tree, n, passage.first, passage.at) and reach(tree, problem, n)[0] < inf

    begun = range(int(tree.halves[-1, 0]))
    return [*parts_of(tree, begun, problem.scene.d_min, size, holds_first)]


def test_the_last_contact_of_a_plan_is_never_left_out() -> None:
    asked = 0
    for passage in passages(5, 150):
        for later in (0.01, 0.3):
            search, problem = search_for(passage, later)
            left = []
            for n in cells_round(passage, search, problem, 0.02):
                ask_lasts(search, problem, n, inf)
                left += [*lasts_of(search, n)]
            assert any(holds(search.last, int(m), passage.last, passage.last_at) for m in left)
            asked += 1
    assert asked > 10


def test_halves_look_only_at_what_their_cell_has_left() -> None:
    asked, fewer = 0, 0
    for passage in passages(5, 150):
        search, problem = search_for(passage, 0.01)
        assert [*lasts_of(search, 0)] == [*search.roots]
        for n in cells_round(passage, search, problem, 0.1):
            ask_lasts(search, problem, n, inf)
            half, left = halve(search.first, n, problem.scene.d_min), lasts_of(search, n)
            assert [*lasts_of(search, half)] == [*left]
            # a look at all of them has room
            assert len(left) <= search.lasts.size[1]
            asked += 1
            fewer += len(left) < len(search.roots)
    assert asked > 10
    assert fewer > 0


def test_what_is_not_asked_in_time_is_kept() -> None:
    asked = 0
    for passage in passages(5, 60):
        search, problem = search_for(passage, 0.01)
        for n in cells_round(passage, search, problem, 0.05):
            ask_lasts(search, problem, n, -inf)
            assert sorted(lasts_of(search, n)) == sorted(search.roots)
            asked += 1
    assert asked > 0
