"""Closing in: onto the line without overshoot, up to the slot without closing speed."""

from math import cos, pi, sin

import pytest

from relguide.flying.aircraft import A300, AircraftState, roll_lead, step
from relguide.flying.autopilot import Autopilot, TurnRate
from relguide.flying.capture import (
    BRAKING,
    Slot,
    braking_distance,
    closing_turn_rate,
    distance_to_slot,
    offsets,
    spacing_tas,
)
from relguide.kernels.base.turn import turn_radius
from relguide.units import DEG

NORTH = Slot(0.0, 0.0, 0.0, 200.0)


def at(x: float, y: float, heading_deg: float, tas: float = 240.0) -> AircraftState:
    return AircraftState(x, y, heading_deg * DEG % (2.0 * pi), 0.0, 0.0, tas, 9449.0)


def test_offsets_are_seen_from_the_slot() -> None:
    seen = offsets(at(300.0, -2000.0, 350.0), NORTH)
    assert seen == pytest.approx((-2000.0, 300.0, -10.0 * DEG))
    eastward = Slot(1000.0, 0.0, 90.0 * DEG, 200.0)
    assert offsets(at(0.0, -50.0, 90.0), eastward) == pytest.approx((-1000.0, 50.0, 0.0))


def test_distance_on_the_route_is_what_is_left_along_it() -> None:
    assert distance_to_slot(offsets(at(0.0, -2000.0, 0.0), NORTH)) == pytest.approx(2000.0)
    assert distance_to_slot(offsets(at(0.0, 500.0, 0.0), NORTH)) == pytest.approx(-500.0)


@pytest.mark.parametrize("turn", [20.0, 90.0, 150.0])
def test_distance_of_a_tangent_arc_is_its_length(turn: float) -> None:
    radius, angle = 12_000.0, turn * DEG
    # coming from the right of the line, on an arc that ends on it at the slot
    start = at(radius * (1.0 - cos(angle)), -radius * sin(angle), -turn)
    assert distance_to_slot(offsets(start, NORTH)) == pytest.approx(radius * angle)


@pytest.mark.parametrize("turn", [-10.0, 30.0, -60.0, 100.0, -150.0])
@pytest.mark.parametrize("late", [-300.0, 0.0, 300.0])
def test_final_turn_ends_on_the_line(turn: float, late: float) -> None:
    """From a turn begun in time, or 300 m off, to within 100 m of the line and on its heading."""
    radius = turn_radius(240.0, A300.max_bank)
    side = -1.0 if turn > 0.0 else 1.0
    lead = 240.0 * roll_lead(A300, 0.0, A300.max_bank)
    x = side * (radius * (1.0 - cos(turn * DEG)) + lead * abs(sin(turn * DEG)) + late)
    state, autopilot = at(x, -30_000.0, turn), Autopilot(model=A300)
    beyond = 0.0
    for second in range(260):
        seen = offsets(state, NORTH)
        if second > 200:
            assert abs(seen.right) < 30.0
            assert abs(seen.heading) < 1.0 * DEG
        beyond = max(beyond, -side * seen.right)
        ahead = roll_lead(A300, state.bank, side * A300.max_bank)
        rate = closing_turn_rate(
            seen, state, model=A300, lead=min(ahead, roll_lead(A300, 0.0, A300.max_bank))
        )
        for _ in range(20):
            state = step(
                A300,
                state,
                aileron=autopilot.aileron(TurnRate(rate), state, 0.05),
                commanded_tas=240.0,
                wind_east=0.0,
                wind_north=0.0,
                duration=0.05,
            )
            assert abs(state.bank) <= A300.max_bank * (1.0 + 1e-9)
    assert beyond < 150.0 + max(-late, 0.0)  # what is too late at full bank must overshoot


def test_spacing_speed_is_monotonic_and_bounded() -> None:
    errors = [-5000.0, -500.0, -50.0, 0.0, 50.0, 500.0, 5000.0, 50_000.0]
    speeds = [spacing_tas(e, 200.0, model=A300, fastest=240.0) for e in errors]
    assert speeds == sorted(speeds)
    assert speeds[3] == 200.0
    assert speeds[-1] == 240.0
    assert speeds[0] >= A300.min_tas


def test_a_leader_as_fast_as_the_pursuer_can_still_be_caught_up_with() -> None:
    assert spacing_tas(2000.0, 240.0, model=A300, fastest=240.0) > 240.0


@pytest.mark.parametrize("closing", [10.0, 40.0, 90.0])
def test_spacing_closes_without_overshoot(closing: float) -> None:
    tas, slot_tas = 240.0, 240.0 - closing
    error = braking_distance(tas, slot_tas) + 1000.0
    least = error
    for _ in range(12_000):
        asked = spacing_tas(error, slot_tas, model=A300, fastest=240.0)
        change = (asked - tas) / A300.speed_time_constant
        tas += 0.05 * min(max(change, -A300.max_deceleration), A300.max_acceleration)
        error -= 0.05 * (tas - slot_tas)
        least = min(least, error)
    assert abs(error) < 1.0
    assert least > -5.0


def test_braking_distance_is_that_of_the_parabola() -> None:
    assert braking_distance(200.0, 240.0) == 0.0
    distance = braking_distance(240.0, 200.0)
    assert distance > 40.0**2 / (2.0 * BRAKING)
    assert spacing_tas(distance + 1.0, 200.0, model=A300, fastest=240.0) == 240.0
    assert spacing_tas(0.99 * distance, 200.0, model=A300, fastest=240.0) < 240.0
