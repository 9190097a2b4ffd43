"""Behind leaders who turn, where the limit binds: plans that were late, and why."""

from math import inf

import numpy as np
import pytest

from benchmarks import draws
from relguide import Situation, candidates
from relguide.kernels.contact.boundary_arc import (
    MAX_NODES,
    boundary_arc_arrival,
    boundary_arc_pieces,
)
from relguide.kernels.contact.chain import BOUNDARY_ARC
from relguide.kernels.contact.contact import contact_at
from relguide.planning.tables import scene_of
from tests.relguide.planning.test_path_round_turning_leader import limit_case, sound_plan


@pytest.mark.parametrize(
    ("seed", "case", "tight", "slot_at_limit", "best"),
    [(2213, 61, False, False, 491.36), (1305, 743, False, False, 580.93)],
)
def test_contacts_reached_with_hardly_a_turn_are_not_missed(
    seed: int, case: int, tight: bool, slot_at_limit: bool, best: float
) -> None:
    """Words of which a turn is almost none were missed; they came 392.7 s and 2.2 s later."""
    situation = limit_case(seed, case, tight=tight, slot_at_limit=slot_at_limit)
    assert sound_plan(situation).time_to_converge < best


@pytest.mark.parametrize(("seed", "case", "best"), [(2121, 7, 333.92), (2112, 14, 398.71)])
def test_no_plan_is_later_than_what_direct_transcription_found(
    seed: int, case: int, best: float
) -> None:
    """They came 5.9 s and 0.85 s later: a word to the first contact was missed; and the best one
    to it is not the soonest.
    """
    rng = np.random.default_rng([seed, case])
    assert rng.random() < 0.7
    calm = bool(rng.random() < 0.5)
    situation = draws.active(rng, tight=case % 2 == 0, intent=True, calm=calm)
    assert sound_plan(situation).time_to_converge < best


def test_a_word_that_hugs_the_disc_hides_no_other() -> None:
    """Reached as a boundary arc reaches it, a contact had no room for a later word: 73.7 s lost."""
    situation = limit_case(1304, 257, tight=False, slot_at_limit=True)
    assert sound_plan(situation).time_to_converge < 314.2


def test_a_boundary_arc_that_only_just_can_be_flown_is_flown() -> None:
    """It slides until the leader goes on, where it gets nowhere any more: begun a trifle sooner,
    by rounding, it came there too soon, and the path was lost.
    """
    situation = limit_case(1304, 141, tight=False, slot_at_limit=True)
    scene = scene_of(situation, candidates(situation).frame)
    planned, pieces = 6.976645507937059, np.empty((2 * MAX_NODES, 2))
    leg = np.array([BOUNDARY_ARC, -1.0, 3.229147357347429, 3.0083916798021013, 2.0, 0.0])
    assert boundary_arc_arrival(scene, planned, leg[2], leg[3], leg[1], 2) < inf
    begun = planned - 1e-7
    pose = contact_at(scene, begun, leg[2], leg[1])
    n, _, _ = boundary_arc_pieces(pose, begun, planned, scene, leg, pieces)
    assert n > 0


@pytest.mark.parametrize(("case", "best"), [((1801, 158), 599.04), ((1402, 78), 475.9)])
def test_what_a_contact_led_to_is_kept_when_it_is_reached_sooner(
    case: tuple[int, int], best: float
) -> None:
    """The chain from there was lost with its label; they came 27 s and 2 s later."""
    situation = limit_case(*case, tight=True, slot_at_limit=True)
    assert sound_plan(situation).time_to_converge < best


def active_case(seed: int, case: int) -> Situation:
    """As the bench of proofs of late plans drew it."""
    rng = np.random.default_rng([seed, case])
    return draws.active(rng, tight=case % 2 == 0, intent=True, slot_at_limit=case % 3 == 0)


@pytest.mark.parametrize("case", [16, 544])
def test_time_to_spare_may_be_spent_before_the_last_contact(case: int) -> None:
    """The slot can be reached as it opens, by way of several contacts; they came 0.6 s and 4.2 s
    later: only after the last contact was a wait looked for.
    """
    assert sound_plan(active_case(6001, case)).optimality.proof == "relaxation"


@pytest.mark.parametrize(
    ("seed", "case", "best"), [(6001, 120, 495.74), (6003, 297, 463.2), (7301, 412, 678.72)]
)
def test_a_last_word_to_a_contact_leads_on_to_others(seed: int, case: int, best: float) -> None:
    """Only boundary arcs began with one; they came 4.0 s, 3.0 s and 11.0 s later."""
    assert sound_plan(active_case(seed, case)).time_to_converge < best


def test_a_word_that_leads_to_a_contact_twice_is_flown_as_it_was_found() -> None:
    """The second time was found, the first flown: the plan arrived 162 s later."""
    assert sound_plan(active_case(7302, 400)).time_to_converge < 336.74


def test_a_straight_touches_again_where_it_did() -> None:
    """Once bearings had been moved it was looked for elsewhere, and the chain lost: 0.47 s late."""
    assert sound_plan(active_case(6001, 36)).time_to_converge < 247.5
