"""Who has time to spare comes to a contact just when it is there, and keeps d_min on the way."""

from math import cos, hypot, inf, pi, sin

import numpy as np
import pytest

from relguide.kernels.base.records import Contact, Pose, Scene
from relguide.kernels.contact.clear_delay import delay_until_contact
from relguide.kernels.contact.contact import contact_on
from relguide.kernels.separation.clearance import leader_at, piece_at
from relguide.kernels.words.delay import DELAY_PIECES
from relguide.kernels.words.extremals import fly_piece

LEADER = np.array([[0.0, 2.0, 1.5, 0.3, 0.4], [9.0, 2.0, -2.0, 0.0, 0.0]])
SCENE = Scene(LEADER, 0.8, 0.9, inf)


def test_a_delay_path_to_a_contact_ends_there_just_in_time_and_keeps_the_limit() -> None:
    rng = np.random.default_rng(12)
    start, pieces, found = Pose(0.0, 0.0, 0.3), np.empty((DELAY_PIECES, 2)), 0
    for _ in range(300):
        contact = Contact(0, rng.uniform(-pi, pi), rng.choice([1.0, -1.0]))
        at = rng.uniform(3.0, 9.0)
        there = contact_on(SCENE, contact, at)
        if not delay_until_contact(start, 0.0, SCENE, there, at, pieces):
            continue
        found += 1
        pose, t = start, 0.0
        for sign, amount in pieces.tolist():
            for along in np.linspace(0.0, amount, 50).tolist():
                passed = fly_piece(pose, sign, along)
                leader = leader_at(SCENE, piece_at(LEADER, t + along), t + along)
                far = hypot(passed.x - leader.x, passed.y - leader.y)
                assert far >= SCENE.d_min - 1e-6
            pose, t = fly_piece(pose, sign, amount), t + amount
        assert t == pytest.approx(at, abs=1e-8)
        assert (pose.x, pose.y) == pytest.approx((there.x, there.y), abs=1e-6)
        assert (cos(pose.h), sin(pose.h)) == pytest.approx((cos(there.h), sin(there.h)), abs=1e-6)
    assert found > 30


def test_there_is_none_to_a_contact_that_is_too_far_away() -> None:
    there = contact_on(SCENE, Contact(0, 0.5, 1.0), 2.0)
    far = Pose(there.x - 2.1, there.y, 0.0)
    assert not delay_until_contact(far, 0.0, SCENE, there, 2.0, np.empty((DELAY_PIECES, 2)))
