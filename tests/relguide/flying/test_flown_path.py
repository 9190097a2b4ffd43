"""The leader's path is remembered well enough to turn where it turned."""

from math import cos, pi, sin

import pytest

from relguide.flying.aircraft import AircraftState, GroundVelocity
from relguide.flying.flown_path import FlownPath, begin_path, extend_path
from relguide.units import DEG

D = 10_000.0
RADIUS = 9_000.0


def leader(x: float, y: float, heading: float) -> AircraftState:
    return AircraftState(x, y, heading % (2.0 * pi), 0.0, 0.0, 200.0, 9449.0)


def path(seconds: int, *, turn_at: int = 10_000) -> FlownPath:
    """North at 200 m/s; from `turn_at` on, right on a circle of 9 km."""
    remembered = begin_path(leader(0.0, 0.0, 0.0), GroundVelocity(0.0, 200.0), D)
    for second in range(1, seconds + 1):
        angle = max(second - turn_at, 0) * 200.0 / RADIUS
        before = min(second, turn_at) * 200.0
        state = leader(RADIUS * (1.0 - cos(angle)), before + RADIUS * sin(angle), angle)
        velocity = GroundVelocity(200.0 * sin(angle), 200.0 * cos(angle))
        rate = 200.0 / RADIUS if second > turn_at else 0.0
        remembered = extend_path(remembered, state, velocity, rate, D)
    return remembered


def test_slot_is_open_at_once_if_the_leader_never_turned() -> None:
    assert path(0).slot_open(D)
    assert path(30).slot_open(D)


def test_slot_is_closed_until_d_is_flown_on_the_new_heading() -> None:
    remembered = path(100, turn_at=70)
    assert not remembered.slot_open(D)
    last = remembered.last
    for second in range(1, 80):
        flown = 200.0 * second
        state = leader(
            last.x + flown * sin(last.track), last.y + flown * cos(last.track), last.heading
        )
        velocity = GroundVelocity(200.0 * sin(last.track), 200.0 * cos(last.track))
        remembered = extend_path(remembered, state, velocity, 0.0, D)
        # 2° of tolerance are 310 m of the turn's end
        assert remembered.slot_open(D) == (flown > D - 320.0) or abs(flown - D) < 600.0
    assert remembered.slot_open(D)


def test_offsets_on_the_straight_behind_the_first_sight() -> None:
    seen = path(10).offsets(leader(150.0, 2000.0 - D - 400.0, 5.0 * DEG), D)
    assert seen == pytest.approx((-400.0, 150.0, 5.0 * DEG), abs=1.0)


def test_offsets_in_the_turn_are_those_of_the_circle() -> None:
    remembered = path(180, turn_at=60)
    angle = 70.0 * 200.0 / RADIUS  # ahead of the slot: it is 50 s back, 70 s into the turn
    outside = RADIUS + 80.0  # to the left of a right turn
    state = leader(RADIUS - outside * cos(angle), 12_000.0 + outside * sin(angle), angle)
    seen = remembered.offsets(state, D)
    assert seen.ahead == pytest.approx(0.0, abs=15.0)
    assert seen.right == pytest.approx(-80.0, abs=3.0)
    assert seen.heading == pytest.approx(0.0, abs=0.2 * DEG)


def test_memory_is_bounded() -> None:
    assert len(path(2000).marks) < 200


def test_repeated_report_changes_nothing() -> None:
    remembered = path(5)
    same = extend_path(remembered, leader(0.0, 1000.0, 0.0), GroundVelocity(0.0, 200.0), 0.0, D)
    assert same is remembered
