"""How contacts are reached: by which word, and for which time."""

from math import inf

import numpy as np
import pytest

from relguide.kernels.base.angles import TWO_PI
from relguide.kernels.base.records import Contact, Pose, Scene
from relguide.kernels.contact.chain import AGAIN, NAMED, contact_by, link_by
from relguide.kernels.contact.clear_words import word_clears
from relguide.kernels.contact.paths_to_contact import paths_by_words
from relguide.kernels.separation.clearance import leader_at
from relguide.kernels.words.extremals import ALL_WORDS, MAX_ROWS


def turning_scene() -> Scene:
    """A leader who turns left, nearly twice all the way round, and then keeps straight."""
    leader = np.array([[0.0, 0.0, 0.0, 0.3, 0.8], [14.0, 0.0, 0.0, 0.0, 0.0]])
    leader[1, 1:4] = leader_at(Scene(leader, 0.6, 0.4, 0.0), 0, 14.0)
    return Scene(leader, 0.6, 0.4, 0.0)


def test_each_way_to_a_contact_has_a_link_of_its_own_by_which_it_is_flown() -> None:
    scene, rng = turning_scene(), np.random.default_rng(3)
    rows, again = np.empty((MAX_ROWS, 5)), np.empty((MAX_ROWS, 5))
    flown, later = 0, 0
    for _ in range(300):
        start = Pose(*rng.uniform(-4.0, 4.0, 2), rng.uniform(0.0, TWO_PI))
        contact = Contact(0, rng.uniform(0.0, TWO_PI), rng.choice([-1.0, 1.0]))
        n = paths_by_words(start, 0.0, scene, contact, ALL_WORDS, 0.0, inf, rows)
        links = [link_by(rows[:n], k) for k in range(n)]
        assert len(set(links)) == n
        for k in range(n):
            before = np.sum((rows[:n, 1] == rows[k, 1]) & (rows[:n, 0] < rows[k, 0]))
            word = rows[k, 1]
            assert links[k] == (NAMED + word if before == 0 else AGAIN - word - 6 * (before - 1))
            if before == 0 or not word_clears(start, 0.0, rows[k], scene):
                continue
            t, at = contact_by(start, 0.0, scene, contact, links[k], ALL_WORDS, inf, again)
            if at >= 0:  # a contact that its word would pass turning toward the leader is none
                assert t == again[at, 0] == pytest.approx(rows[k, 0], abs=1e-9)
                assert again[at, 1] == word
                flown += 1
                later += before > 1
    assert flown > 30
    assert later > 0
