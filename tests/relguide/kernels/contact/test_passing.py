"""Which words may lead to a contact and on from it: all others break d_min at once."""

from math import pi

import numpy as np
import pytest

from relguide.kernels.base.records import Contact, Pose, Scene
from relguide.kernels.contact.clear_words import to_slot_frame, word_clears
from relguide.kernels.contact.contact import contact_at
from relguide.kernels.contact.passing import words_onward, words_toward
from relguide.kernels.contact.paths_to_contact import paths_to_contact
from relguide.kernels.separation.clearance import leader_at
from relguide.kernels.words.extremals import ALL_WORDS, MAX_ROWS, solve

LASTS = 0.01
"""A turn shorter than this may be flown within the rounding that contacts have [rad]."""


def scene_with(rate: float, alpha: float, d_min: float) -> Scene:
    """A leader that turns for 3 R/V_P, then keeps straight."""
    leader = np.zeros((2, 5))
    leader[0, 1], leader[0, 4], leader[1, 0] = 1.2 * d_min, rate, 3.0
    leader[1, 1:4] = leader_at(Scene(leader, alpha, d_min, 0.0), 0, 3.0)
    return Scene(leader, alpha, d_min, 0.0)


@pytest.mark.parametrize("rate", [0.0, -1.5, 0.6])
def test_no_word_that_keeps_the_limit_is_left_out(rate: float) -> None:
    rng = np.random.default_rng(12)
    rows, kept, allowed = np.empty((MAX_ROWS, 5)), 0, 0
    for _ in range(2_000):
        scene = scene_with(rate, rng.uniform(0.5, 0.98), rng.uniform(0.5, 4.0))
        start = Pose(*rng.uniform(-6.0, 6.0, 2), rng.uniform(0.0, 2.0 * pi))
        contact = Contact(0, rng.uniform(0.0, 2.0 * pi), rng.choice([1.0, -1.0]))
        toward = words_toward(scene, contact)
        for row in rows[: paths_to_contact(start, 0.0, scene, contact, 3.0, rows)]:
            if row[4] > LASTS and row[0] < 3.0 and word_clears(start, 0.0, row, scene):
                assert toward & (1 << int(row[1])), (scene, start, contact, row)
                kept += 1
        t = rng.uniform(0.0, 2.9)
        there = contact_at(scene, t, contact.bearing, contact.side)
        onward = words_onward(scene, contact.bearing, contact.side, t)
        allowed += (toward != ALL_WORDS) + (onward != ALL_WORDS)
        n = solve(to_slot_frame(there, t, scene.alpha), scene.alpha, 0.0, rows)
        for row in rows[:n]:
            if row[2] > LASTS and word_clears(there, t, row, scene):
                assert onward & (1 << int(row[1])), (scene, contact, t, row)
                kept += 1
    assert kept > 1_000
    assert allowed > 1_000
