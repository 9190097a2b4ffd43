"""No path that touches nothing is sooner than is said of all of them, with a loop or without."""

from math import inf

import numpy as np

from relguide.kernels.base.angles import TWO_PI
from relguide.kernels.base.records import Pose
from relguide.kernels.bounds.words.contact_bound import untouched_bound
from relguide.kernels.bounds.words.sets import Goal
from relguide.kernels.contact.clear_words import best_word
from relguide.kernels.contact.looped_word import looped_word
from relguide.kernels.words.extremals import MAX_ROWS, solve
from tests.relguide.kernels.contact.test_looped_word import crossing


def test_they_are_as_soon_as_the_best_word_that_keeps_clear_or_the_best_with_a_loop() -> None:
    rng = np.random.default_rng(2)
    rows, legs = np.empty((MAX_ROWS, 5)), np.zeros((2, 6))
    known = looped = left_out = 0
    for _ in range(3000):
        start, scene = crossing(rng)
        soonest, _ = best_word(start, 0.0, scene, inf, rows)
        with_loop, count = looped_word(start, scene, soonest, legs)
        bound = untouched_bound(start, scene, Goal(0.0, scene.alpha, False), with_loop)
        assert bound <= with_loop
        seen = Pose(start.x - scene.alpha * TWO_PI, start.y, start.h)
        solve(seen, scene.alpha, 0.0, rows)
        known += bound == with_loop
        looped += bound == with_loop and count > 0
        left_out += bound == with_loop > rows[0, 0] + TWO_PI
    assert known > 2500
    assert looped > 20
    assert left_out > 5
