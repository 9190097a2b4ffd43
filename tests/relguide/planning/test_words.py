"""Candidates: every one reaches the slot; those that wait for it to open arrive exactly then."""

from math import pi

import pytest
from hypothesis import given

from relguide import RIGHT, Arc, FlyStraight, Leader, Pursuer, Situation, TurnTo, candidates
from relguide.units import DEG
from tests.oracle import arrival_error
from tests.situations import situations

WAITING = Situation(
    pursuer=Pursuer(x=30_000.0, y=-5_000.0, heading=pi, tas=220.0, max_bank=25 * DEG),
    leader=Leader(
        x=0.0,
        y=0.0,
        heading=0.5 * pi,
        tas=180.0,
        intent=(FlyStraight(duration=300.0), TurnTo(heading=pi, turn=RIGHT, bank=20 * DEG)),
    ),
    slot_distance=12_000.0,
    min_separation=5_000.0,
)


@given(situation=situations(reach=60_000.0))
def test_candidates_come_in_order_of_time(situation: Situation) -> None:
    times = [c.time_to_converge for c in candidates(situation)]
    assert times == pytest.approx(sorted(times), abs=1e-6)
    assert len(times) == len(candidates(situation)) > 0
    assert candidates(situation).bound <= times[0] + 1e-6


@given(situation=situations(reach=60_000.0, with_intent=False))
def test_a_leader_that_keeps_straight_has_its_slot_open_at_once(situation: Situation) -> None:
    found = candidates(situation)
    assert found.frame.t_release == 0.0
    assert list(found.at_release) == []


def test_a_slot_reached_too_soon_is_waited_for_by_paths_of_exact_length() -> None:
    found = candidates(WAITING)
    assert found.reachable_at_release
    waiting = list(found.at_release)
    assert len(waiting) > 5
    for candidate in waiting:
        assert candidate.time_to_converge == pytest.approx(found.bound, abs=1e-6)
        assert candidate.word == candidate.trajectory.letters
    for candidate in waiting[::7]:
        distance, heading_error, _ = arrival_error(WAITING, candidate.trajectory)
        assert distance < 0.02
        assert heading_error < 1e-6
    assert all(c.time_to_converge >= found.bound for c in found.later)
    paths = [c.trajectory for c in found.at_release]
    turning = [sum(s.turn_angle for s in path.segments if isinstance(s, Arc)) for path in paths]
    order = [(path.turns, angle) for path, angle in zip(paths, turning, strict=True)]
    assert order == sorted(order)
