"""The last contact after a first one: none that a plan has is left out."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import atan2, cos, hypot, inf, sin

import numpy as np

from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.records import Contact, Pose, Scene
from relguide.kernels.bounds.around import unknown_around
from relguide.kernels.bounds.bundles import Search
from relguide.kernels.bounds.contact_tree import Problem, Tree, cell_at, halve, reach, size_of
from relguide.kernels.bounds.last_contacts import ask_lasts, lasts_of
from relguide.kernels.bounds.proof_search import begin
from relguide.kernels.bounds.round_time import times_round
from relguide.kernels.bounds.tangent_contacts import tangent_contacts
from relguide.kernels.contact.contact import contact_heading
from relguide.kernels.separation.clearance import leader_at, piece_at
from relguide.planning.contact_search import Question
from relguide.planning.plan import Plan, plan
from relguide.planning.prove import question_of
from relguide.planning.words import candidates
from tests.bench import draws

STEP, TOUCH, NEAR = 2e-3, 5e-6, 5e-3
"""A path is looked at so often [R/V_P], touches if it is no further outside d_min [R], and so near
contacts are the same [rad]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Passage:
    """A plan that touches d_min again after its first contact."""

    question: Question
    time: float
    """Of the plan [R/V_P]."""
    first: Contact
    at: float
    """When it is there [R/V_P]."""
    last: Contact
    last_at: float
    """Likewise."""


def flown(start: Pose, planned: Plan, scale: float, t: float) -> Pose:
    """Where a plan is after a time, in the slot frame, where turns to the left are positive."""
    x, y, h = start
    for took, rate in planned.trajectory.bends():
        amount, turn = min(t, took / scale), -rate * scale
        if abs(turn) < 1e-9:
            x, y = x + amount * cos(h), y + amount * sin(h)
        else:
            x += (sin(h + turn * amount) - sin(h)) / turn
            y -= (cos(h + turn * amount) - cos(h)) / turn
        h, t = h + turn * amount, t - amount
        if t <= 0.0:
            break
    return Pose(x, y, h)


def passage_of(planned: Plan) -> Passage | None:
    """The first and the last contact of a plan that slides or touches more than once."""
    pursuer = planned.situation.pursuer
    scale = pursuer.turn_radius / pursuer.tas
    question, time = question_of(candidates(planned.situation)), planned.time_to_converge / scale
    scene = question.scene

    def seen(t: float) -> tuple[Pose, Pose]:
        at = flown(question.start, planned, scale, t)
        return at, leader_at(scene, piece_at(scene.leader, t), t)

    times = [
        float(t) for t in np.arange(STEP, time, STEP)
        if hypot(seen(t)[0].x - seen(t)[1].x, seen(t)[0].y - seen(t)[1].y) < scene.d_min + TOUCH
    ]  # fmt: skip
    if not times or times[-1] - times[0] < 0.1:
        return None
    contacts = []
    for t in (times[0], times[-1]):
        at, there = seen(t)
        bearing = wrap_signed(atan2(at.y - there.y, at.x - there.x) - there.h)
        off = {
            side: abs(wrap_signed(at.h - there.h - contact_heading(bearing, side, scene.alpha)))
            for side in (1.0, -1.0)
        }
        contacts.append(Contact(piece_at(scene.leader, t), bearing, min(off, key=off.__getitem__)))
    return Passage(
        question=question, time=time, first=contacts[0], at=times[0], last=contacts[1],
        last_at=times[-1],
    )  # fmt: skip


def passages(seed: int, count: int) -> Iterator[Passage]:
    rng = np.random.default_rng(seed)
    for case in range(count):
        planned = plan(draws.active(rng, tight=case % 2 > 0, intent=True))
        if isinstance(planned, Plan) and planned.optimality.proof == "bound":
            passage = passage_of(planned)
            if passage is not None:
                yield passage


def search_for(passage: Passage, beat: float) -> tuple[Search, Problem]:
    """A search that has only begun, for paths that arrive before a time."""
    asked = passage.question
    scene: Scene = asked.scene
    problem = Problem(
        asked.start, scene, asked.goal, times_round(scene.alpha, scene.d_min), beat, asked.paired,
        unknown_around(), tangent_contacts(asked.start, scene, beat),
    )  # fmt: skip
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


def cells_round(passage: Passage, search: Search, problem: Problem, size: float) -> list[int]:
    """The cells of first contacts of a size in which a plan's may lie."""
    tree, d_min = search.first, problem.scene.d_min
    open_cells, found = list(range(int(tree.halves[-1, 0]))), []
    while open_cells:
        n = open_cells.pop()
        if not holds(tree, n, passage.first, passage.at) or reach(tree, problem, n)[0] == inf:
            continue
        if size_of(tree, n, d_min) <= size:
            found.append(n)
            continue
        half = halve(tree, n, d_min)
        open_cells += [half, half + 1]
    return found


def test_the_last_contact_of_a_plan_is_never_left_out() -> None:
    asked = 0
    for passage in passages(5, 150):
        for later in (0.01, 0.3):
            search, problem = search_for(passage, passage.time + later)
            left = []
            for n in cells_round(passage, search, problem, 0.02):
                ask_lasts(search, problem, n, inf)
                left += [*lasts_of(search, n)]
            assert any(holds(search.last, int(m), passage.last, passage.last_at) for m in left)
            asked += 1
    assert asked > 10


def test_halves_look_only_at_what_their_cell_has_left() -> None:
    for passage in passages(6, 30):
        search, problem = search_for(passage, passage.time + 0.01)
        roots = lasts_of(search, 0)
        assert set(roots) == set(range(len(roots)))
        for n in cells_round(passage, search, problem, 0.1):
            ask_lasts(search, problem, n, inf)
            half = halve(search.first, n, problem.scene.d_min)
            assert [*lasts_of(search, half)] == [*lasts_of(search, n)]


def test_what_is_not_asked_in_time_is_kept() -> None:
    passage = next(passages(7, 60))
    search, problem = search_for(passage, passage.time + 0.01)
    for n in cells_round(passage, search, problem, 0.05):
        ask_lasts(search, problem, n, -inf)
        assert sorted(lasts_of(search, n)) == sorted(search.roots)
