"""What a set has left of its words is all that a part of it needs to look at."""

from itertools import islice
from math import cos, pi, sin

import numpy as np
import pytest

from benchmarks import draws
from relguide import Plan, plan
from relguide.kernels.base.records import Pose, Velocity, Window
from relguide.kernels.bounds.rest import COLUMNS, MOST, UNKNOWN, Rest
from relguide.kernels.bounds.ways import no_ways
from relguide.kernels.bounds.word_bound import soonest_kept
from relguide.kernels.bounds.word_intervals import Blur
from relguide.kernels.words.extremals import MAX_ROWS, solve_toward
from relguide.planning.prove import question_of
from relguide.planning.words import candidates
from tests.costates import with_costate
from tests.relguide.kernels.bounds.test_word_bound import NO_SIEVE


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
                Pose(*at, h), Blur(blur, blur, blur, 0.0, no_ways(), no_ways()),
                Velocity(speed, 0.0), Window(0.0, beat), NO_SIEVE, Rest(table, known, room),
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
