"""The lateral model keeps to its physics and its limits."""

from dataclasses import replace
from math import pi, tan

import pytest

from relguide.flying.aircraft import A300, AircraftState, ground_velocity, roll_lead, step
from relguide.units import DEG, G0

CRUISE = AircraftState(0.0, 0.0, 0.0, 0.0, 0.0, 240.0, 9449.0)


def flown(state: AircraftState, duration: float, **controls: float) -> AircraftState:
    asked = {"aileron": 0.0, "commanded_tas": state.tas, "wind_east": 0.0, "wind_north": 0.0}
    for _ in range(round(duration / 0.05)):
        state = step(A300, state, **(asked | controls), duration=0.05)
    return state


def test_straight_flight_goes_where_the_nose_points() -> None:
    state = flown(CRUISE._replace(heading=90.0 * DEG), 10.0)
    assert state.x == pytest.approx(2400.0)
    assert state.y == pytest.approx(0.0, abs=1e-6)


def test_wind_carries_but_does_not_turn() -> None:
    state = flown(CRUISE, 10.0, wind_east=20.0, wind_north=-5.0)
    assert (state.x, state.y) == pytest.approx((200.0, 2350.0))
    assert state.heading == 0.0
    velocity = ground_velocity(state, 20.0, -5.0)
    assert velocity.speed == pytest.approx((20.0**2 + 235.0**2) ** 0.5)
    assert 0.0 < velocity.track < 10.0 * DEG


def test_banked_flight_turns_as_eq_8_says() -> None:
    state = flown(CRUISE._replace(bank=25.0 * DEG), 30.0)
    assert state.heading == pytest.approx(30.0 * G0 / 240.0 * tan(25.0 * DEG))


def test_full_circle_closes() -> None:
    period = 2.0 * pi * 240.0 / (G0 * tan(25.0 * DEG))
    state, step_length = CRUISE._replace(bank=25.0 * DEG), period / 3000
    for _ in range(3000):
        state = step(
            A300,
            state,
            aileron=0.0,
            commanded_tas=240.0,
            wind_east=0.0,
            wind_north=0.0,
            duration=step_length,
        )
    assert (state.x, state.y) == pytest.approx((0.0, 0.0), abs=1e-3)


def test_roll_follows_the_ailerons_with_their_lag_and_no_faster_than_the_limit() -> None:
    state = flown(CRUISE, 3.0, aileron=1.0)
    assert state.roll_rate == pytest.approx(A300.max_roll_rate, rel=0.01)
    ideal = 3.0 * A300.max_roll_rate
    lost = A300.roll_time_constant * A300.max_roll_rate
    assert state.bank == pytest.approx(ideal - lost, rel=0.01)


def test_roll_does_not_depend_on_the_step() -> None:
    coarse = step(
        A300,
        CRUISE,
        aileron=0.05,
        commanded_tas=240.0,
        wind_east=0.0,
        wind_north=0.0,
        duration=1.0,
    )
    assert flown(CRUISE, 1.0, aileron=0.05).bank == pytest.approx(coarse.bank)


@pytest.mark.parametrize(
    ("commanded", "least", "most"), [(250.0, 240.0, 250.0), (400.0, 240.0, 250.0), (0.0, 120, 240)]
)
def test_speed_stays_within_the_envelope(commanded: float, least: float, most: float) -> None:
    tas = flown(CRUISE, 200.0, commanded_tas=commanded).tas
    assert least <= tas <= most + 1e-9


def test_acceleration_is_limited_both_ways() -> None:
    faster = flown(CRUISE._replace(tas=200.0), 10.0, commanded_tas=250.0).tas - 200.0
    slower = 240.0 - flown(CRUISE, 10.0, commanded_tas=120.0).tas
    assert faster == pytest.approx(10.0 * A300.max_acceleration)
    assert slower == pytest.approx(10.0 * A300.max_deceleration)


def test_lead_is_half_the_roll_and_the_lag() -> None:
    assert 3.5 < roll_lead(A300, 0.0, 25.0 * DEG) < 5.0
    assert roll_lead(A300, -25.0 * DEG, 25.0 * DEG) > 1.7 * roll_lead(A300, 0.0, 25.0 * DEG)


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"max_bank": 2.0}, "max_bank must be below 90°"),
        ({"max_roll_rate": 0.0}, "max_roll_rate must be above 0"),
        ({"min_tas": 300.0}, "min_tas < max_tas"),
    ],
)
def test_impossible_models_are_refused(change: dict[str, float], sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        replace(A300, **change)
