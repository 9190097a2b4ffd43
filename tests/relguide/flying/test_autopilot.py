"""The loops capture a heading without overshoot and never bank beyond the limit."""

from math import pi, tan

import pytest

from relguide.flying.aircraft import A300, AircraftState, roll_lead, step
from relguide.flying.autopilot import Autopilot, HoldHeading, Reference, TurnRate
from relguide.units import DEG, G0


def flown(
    reference: Reference, duration: float, *, tas: float = 240.0, state: AircraftState | None = None
) -> list[AircraftState]:
    autopilot = Autopilot(model=A300)
    states = [state or AircraftState(0.0, 0.0, 0.0, 0.0, 0.0, tas, 9449.0)]
    for _ in range(round(duration / 0.05)):
        now = states[-1]
        states.append(
            step(
                A300,
                now,
                aileron=autopilot.aileron(reference, now, 0.05),
                commanded_tas=tas,
                wind_east=0.0,
                wind_north=0.0,
                duration=0.05,
            )
        )
    return states


def signed(angle: float) -> float:
    return (angle + pi) % (2.0 * pi) - pi


@pytest.mark.parametrize("tas", [130.0, 200.0, 245.0])
@pytest.mark.parametrize("change", [1.0, -4.0, 10.0, -45.0, 90.0, 170.0])
def test_heading_capture(change: float, tas: float) -> None:
    states = flown(HoldHeading(change * DEG % (2.0 * pi)), 200.0, tas=tas)
    errors = [signed(state.heading - change * DEG) for state in states]
    overshoot = max(error * (1.0 if change > 0.0 else -1.0) for error in errors)
    assert overshoot < 0.2 * DEG
    assert abs(errors[-1]) < 0.1 * DEG
    assert max(abs(state.bank) for state in states) <= A300.max_bank * (1.0 + 1e-9)
    assert max(abs(state.roll_rate) for state in states) <= A300.max_roll_rate * (1.0 + 1e-9)


@pytest.mark.parametrize("bank", [-25.0, -10.0, 5.0, 25.0])
def test_turn_rate_is_reached_and_kept(bank: float) -> None:
    rate = G0 / 240.0 * tan(bank * DEG)
    states = flown(TurnRate(rate), 60.0)
    assert states[-1].bank == pytest.approx(bank * DEG, abs=0.01 * DEG)
    assert max(abs(state.bank) for state in states) <= abs(bank) * DEG * (1.0 + 1e-9)


def test_more_turn_than_the_bank_limit_gives_is_not_flown() -> None:
    states = flown(TurnRate(0.2), 30.0)
    assert max(state.bank for state in states) <= A300.max_bank * (1.0 + 1e-9)


@pytest.mark.parametrize(("before", "after"), [(0.0, 25.0), (-25.0, 25.0), (10.0, -25.0)])
def test_roll_lead_is_what_the_loops_take(before: float, after: float) -> None:
    """The heading lost against an instantaneous change of bank, in seconds of it."""
    start = AircraftState(0.0, 0.0, 0.0, before * DEG, 0.0, 240.0, 9449.0)
    rates = [G0 / 240.0 * tan(bank * DEG) for bank in (before, after)]
    end = flown(TurnRate(rates[1]), 30.0, state=start)[-1]
    late = (30.0 * rates[1] - signed(end.heading)) / (rates[1] - rates[0])
    assert late == pytest.approx(roll_lead(A300, before * DEG, after * DEG), abs=0.5)


def test_opposite_heading_is_turned_to_one_way() -> None:
    banks = [state.bank for state in flown(HoldHeading(pi - 0.01), 100.0)]
    assert min(banks) > -0.5 * DEG
