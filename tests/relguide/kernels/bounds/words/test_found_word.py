"""Words that no costate fits do not count; parts of a set search only what the set leaves open."""

from itertools import islice
from math import cos, pi, sin

import numpy as np
import pytest

from benchmarks import draws, proofs
from relguide import Plan, plan
from relguide.kernels.base.records import Pose, Velocity, Window
from relguide.kernels.bounds.words.cells import Cell
from relguide.kernels.bounds.words.contact_bound import cell_bound
from relguide.kernels.bounds.words.found_word import COLUMNS, MOST, UNKNOWN, OpenIntervals, all_open
from relguide.kernels.bounds.words.sets import Blur, unknown_sensitivity
from relguide.kernels.bounds.words.word_bound import soonest_kept
from relguide.kernels.words.extremals import MAX_ROWS, solve_toward
from relguide.planning.prove import question_of
from relguide.planning.words import candidates
from tests.costates import with_costate
from tests.relguide.kernels.bounds.words.test_word_bound import NO_SIEVE


def test_of_three_turns_that_are_not_two_the_middle_one_is_the_longest() -> None:
    """By three turns, the first of them hardly any, the last would be longer, and end at once."""
    rng = np.random.default_rng([205, 3, 118])
    question = question_of(candidates(proofs.draw(proofs.KINDS[3], rng, 118)))
    start, scene, goal = question.start, question.scene, question.goal
    cell = Cell(1, 1.0, 0.51197, 3.8e-4, 0.96904, 0.97181)
    for switch, least, most in ((True, 0.0, 0.01), (False, 1.5, 1.7)):
        passed, _, _ = cell_bound(
            start, scene, goal, cell, 10.0, True, switch, all_open(), all_open()
        )  # fmt: skip
        assert least <= passed.turned - passed.outward <= most


@pytest.mark.parametrize("seed", range(3))
def test_no_pose_in_part_of_part_of_a_set_meets_the_target_sooner(seed: int) -> None:
    rng = np.random.default_rng(seed)
    rows, table = np.empty((MAX_ROWS, 5)), np.empty((2 * (MOST + 1), COLUMNS))
    met = 0
    for _ in range(3_000):
        at, h = rng.uniform(-2.0, 2.0, 2) * rng.choice((0.1, 1.0, 3.0)), rng.uniform(0.0, 2.0 * pi)
        speed, blur, beat = rng.choice((0.3, 0.8, 0.98)), rng.choice((0.1, 0.5)), rng.uniform(1, 9)
        known = UNKNOWN
        for level in range(9):
            room = (level % 2) * (MOST + 1)
            soon, _ = soonest_kept(
                Pose(*at, h),
                Blur(blur, blur, blur, 0.0, unknown_sensitivity(), unknown_sensitivity()),
                Velocity(speed, 0.0), Window(0.0, beat), NO_SIEVE,
                OpenIntervals(table, known, room),
            )  # fmt: skip
            known = room if 0.0 <= table[room, 0] <= MOST else UNKNOWN
            # a part of it, well inside
            way, blur = rng.uniform(0.0, 2.0 * pi), 0.5 * blur
            at = at + 0.4 * blur * np.array([cos(way), sin(way)])
            h += rng.uniform(-0.2, 0.2) * blur
        n = solve_toward(Pose(*at, h % (2.0 * pi)), Velocity(speed, 0.0), 0.0, rows)
        times = with_costate(rows[:n])[:, 0]
        if (times < beat).any():
            assert soon <= times.min() * (1.0 + 1e-9)
            met += 1
    assert met > 500


def test_words_that_were_too_late_to_matter_to_a_cell_are_left_to_its_halves() -> None:
    """A path that arrives at the very limit was excluded: 10.7 s above its time."""
    rng = np.random.default_rng([1201, 141])
    situation = draws.active(rng, tight=False, intent=True, slot_at_limit=True)
    planned = plan(situation)
    assert isinstance(planned, Plan)
    found = candidates(situation)
    time = planned.time_to_converge * situation.pursuer.tas / found.frame.radius
    for later in (1.002, 1.01, 1.03, 1.1):
        for bound in islice(question_of(found).bounds(later * time), 25):
            assert bound < time + 1e-6
