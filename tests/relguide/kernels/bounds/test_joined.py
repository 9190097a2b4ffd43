"""Contacts as parts of plans: what is said of them lies below what is flown."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import atan2, floor, hypot, inf, pi

import numpy as np

from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.bounds.around import unknown_around
from relguide.kernels.bounds.cells import Cell
from relguide.kernels.bounds.contact_tree import (
    Problem,
    Tree,
    cell_at,
    halve,
    leave,
    plant,
    reach,
    size_of,
)
from relguide.kernels.bounds.joined import only_of
from relguide.kernels.bounds.round_time import times_round
from relguide.kernels.bounds.tangent_contacts import tangent_contacts
from relguide.kernels.contact.contact import contact_heading
from relguide.kernels.separation.clearance import leader_at, piece_at
from relguide.kernels.words.extremals import fly_piece
from relguide.planning.contact_search import Question
from relguide.planning.plan import Plan, plan
from relguide.planning.prove import question_of
from relguide.planning.words import candidates
from tests.bench import draws

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


def flown(start: Pose, pieces: list[tuple[float, float]], t: float) -> Pose:
    """Where a path is after a time."""
    for sign, amount in pieces:
        start = fly_piece(start, sign, min(t, amount))
        t -= amount
        if t <= 0.0:
            break
    return start


def touch_of(planned: Plan) -> Touch | None:
    """The contact of a plan that has one, and flies full-bank turns and straights."""
    pursuer = planned.situation.pursuer
    scale = pursuer.turn_radius / pursuer.tas
    # in the slot frame, where turns to the left are positive
    pieces = [(-rate * scale, took / scale) for took, rate in planned.trajectory.bends()]
    if any(min(abs(sign), abs(abs(sign) - 1.0)) > 1e-6 for sign, _ in pieces):
        return None
    pieces = [(round(sign), amount) for sign, amount in pieces]
    question, time = question_of(candidates(planned.situation)), planned.time_to_converge / scale
    scene = question.scene

    def separation(t: float) -> float:
        at, there = flown(question.start, pieces, t), leader_at(*_then(scene, t))
        return hypot(at.x - there.x, at.y - there.y) - scene.d_min

    times = np.arange(0.0, time, 2e-3)
    gaps = np.array([separation(t) for t in times])
    lows = np.flatnonzero((gaps[1:-1] < gaps[:-2]) & (gaps[1:-1] <= gaps[2:])) + 1
    near = [times[k] for k in lows if gaps[k] < 1e-5]
    if len(near) != 1:
        return None
    fine = near[0] + np.linspace(-2e-3, 2e-3, 401)
    t = float(fine[np.argmin([separation(float(at)) for at in fine])])
    at, there = flown(question.start, pieces, t), leader_at(*_then(scene, t))
    bearing = wrap_signed(atan2(at.y - there.y, at.x - there.x) - there.h)
    off = {
        side: abs(wrap_signed(at.h - there.h - contact_heading(bearing, side, scene.alpha)))
        for side in (1.0, -1.0)
    }
    side, piece = min(off, key=off.__getitem__), piece_at(scene.leader, t)
    final = piece + 1 == len(scene.leader)
    window = (float(scene.leader[piece, 0]), inf) if final else (t - HALF, t + HALF)
    if off[side] > 1e-3 or min(t, abs(bearing % (0.5 * pi))) < 2.0 * HALF:
        return None
    past, turning = 0.0, False
    for sign, amount in pieces:
        if past + HALF < t < past + amount - HALF:
            turning = sign != 0
        past += amount
    cell = Cell(piece, side, bearing, HALF, *window)
    return Touch(question=question, time=time, cell=cell, turning=turning)


def _then(scene: Scene, t: float) -> tuple[Scene, int, float]:
    return scene, piece_at(scene.leader, t), t


def touches(seed: int, count: int) -> Iterator[Touch]:
    rng = np.random.default_rng(seed)
    for case in range(count):
        drawn = draws.active(rng, tight=case % 3 > 0, intent=case % 2 == 0)
        planned = plan(drawn)
        if isinstance(planned, Plan) and planned.optimality.proof == "bound":
            touch = touch_of(planned)
            if touch is not None:
                yield touch


def problem_of(touch: Touch) -> Problem:
    """How soon at all, before a little later than the plan."""
    asked = touch.question
    table = times_round(asked.scene.alpha, asked.scene.d_min)
    return Problem(
        asked.start, asked.scene, asked.goal, table, 1.1 * touch.time, asked.paired,
        unknown_around(), tangent_contacts(asked.start, asked.scene, 1.1 * touch.time),
    )  # fmt: skip


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
        assert only_of(tree, problem_of(touch), 0) <= touch.time + 1e-3
        straight += not touch.turning
        turned += touch.turning
    assert straight > 2
    assert turned > 10


def test_a_part_of_a_cell_begins_with_what_is_left_of_the_cell() -> None:
    """No plan is sooner than what is said then."""
    parts = 0
    for touch in touches(33, 60):
        problem, cell = problem_of(touch), touch.cell
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
