"""Contacts followed: each lies on a minimum, tangent to it, and the pieces told lead there."""

from math import hypot, inf

import numpy as np
import pytest

from relguide.kernels.base.records import Pose
from relguide.kernels.contact.contact_chains import (
    MOST_CONTACTS,
    add_piece,
    follow_contacts,
    no_places,
    pairs_by_way_of,
)
from relguide.kernels.contact.detours import close_detour
from relguide.kernels.contact.others import place_at, words_to_slot
from relguide.kernels.words.extremals import MAX_ROWS, fly_piece
from relguide.planning.others_table import others_of
from relguide.planning.slot import slot_frame
from tests.skies import any_sky, blocked, crossing


@pytest.mark.parametrize("seed", range(8))
def test_contacts_lie_on_minima_and_their_pairs_lead_there(seed: int) -> None:
    situation = any_sky(np.random.default_rng(seed), 8)
    frame = slot_frame(situation, situation.leader.trajectory)
    others = others_of(situation, frame)
    rows = np.empty((MAX_ROWS, 5))
    words_to_slot(frame.pose, 0.0, others, rows)
    places = no_places(frame.pose, rows[0, 0], len(others.limits))
    first = follow_contacts(places, others, 36, 24, np.array([0.0, 1.0, 2.0]), inf, 0.5, 3_000.0)
    for k in range(1, int(places.used[0])):
        x, y, h, t, bound = places.poses[k]
        i = int(places.contacts[k, 0])
        cx, cy = place_at(others, i, t)
        assert hypot(x - cx, y - cy) == pytest.approx(others.limits[i, 1], abs=1e-5)
        then = place_at(others, i, t + 1e-6)
        ahead = fly_piece(Pose(x, y, h), 0.0, 1e-6)
        gone = hypot(ahead.x - then[0], ahead.y - then[1]) - hypot(x - cx, y - cy)
        assert gone / 1e-6 == pytest.approx(0.0, abs=1e-4)  # tangent, seen from it
        assert places.parents[k, 1] <= MOST_CONTACTS
        if places.arrivals[k, 0] < inf:
            assert places.arrivals[k, 0] >= max(bound, first) - 1e-9
            pairs = np.zeros((3 * MOST_CONTACTS + 4, 3))
            n = pairs_by_way_of(places, k, pairs)
            arrival, _ = close_detour(frame.pose, 0.0, pairs[:n], others, inf, rows)
            assert arrival <= places.arrivals[k, 0] + 1e-6


def test_only_what_is_in_the_way_becomes_active() -> None:
    situation = blocked(crossing("ASIDE", y=300e3), crossing("BESIDE", x=80e3), crossing())
    frame = slot_frame(situation, situation.leader.trajectory)
    others = others_of(situation, frame)
    places = no_places(frame.pose, 0.0, 4)
    follow_contacts(places, others, 36, 24, np.array([0.0, 1.0]), inf, 0.5, 500.0)
    assert places.active[3]
    assert not places.active[1]


def test_pieces_alike_that_follow_each_other_are_one() -> None:
    pairs = np.zeros((4, 3))
    n = 0
    for sign, amount in ((0.0, 1.0), (0.0, 0.5), (1.0, 0.2), (1.0, 0.3), (-1.0, 0.0), (0.0, 2.0)):
        n = add_piece(pairs, n, sign, amount)
    assert pairs[:n].tolist() == [[1.0, 0.0, 1.5], [1.0, 0.5, 2.0]]
