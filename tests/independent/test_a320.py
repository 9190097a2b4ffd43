"""JSBSim's A320 under our autopilot: it rolls as ours does, and holds what it is to hold."""

import numpy as np
import pytest

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.base.turn import turn_rate
from relguide.kernels.flight.flight_records import TURN_RATE, Control
from relguide.planning.wind import CALM
from relguide.units import DEG, FT, Metre
from tests.aloft import LIMITS, MAX_BANK, STEP, fly, hold, level
from tests.independent.a320 import A320

FL246: Metre = 7_500.0


def _settled(banks: FloatArray) -> float:
    """From when on the bank is within 1° of the bank limit [s]."""
    return float(np.flatnonzero(np.abs(banks - MAX_BANK) > 1.0 * DEG)[-1] + 1) * STEP


@pytest.mark.parametrize("tas", [180.0, 200.0, 230.0])
def test_a_roll_to_25_degrees_is_ours(tas: float) -> None:
    control = Control(TURN_RATE, turn_rate(tas, MAX_BANK), tas)
    own = fly(control, level(tas=tas), 20.0)[:, 3]
    a320 = A320(level(tas=tas), FL246)
    flown, slips, heights = [a320.body], [0.0], [0.0]
    for _ in range(len(own) - 1):
        flown.append(a320.fly(control, LIMITS, CALM, STEP))
        slips.append(a320.fdm["aero/beta-rad"])
        heights.append(a320.fdm["position/h-sl-ft"] * FT - FL246)
    banks = np.array([body.bank for body in flown])
    assert _settled(banks) == pytest.approx(_settled(own), abs=0.2)
    assert np.max(np.abs(banks - own)) < 1.3 * DEG
    assert np.max(banks) < MAX_BANK + 0.05 * DEG
    assert max(body.roll_rate for body in flown) < 4.1 * DEG
    assert np.max(np.abs(slips)) < 0.2 * DEG
    assert np.max(np.abs(heights)) < 5.0
    assert flown[-1].tas == pytest.approx(tas, abs=0.5)


@pytest.mark.parametrize(("tas", "asked"), [(230.0, 190.0), (190.0, 230.0)])
def test_it_comes_to_another_speed_without_passing_it_by_far(tas: float, asked: float) -> None:
    a320 = A320(level(tas=tas), FL246)
    seconds = [a320.fly(hold(0.0, asked), LIMITS, CALM, 1.0).tas for _ in range(90)]
    passed = (asked - np.array(seconds)) * np.sign(tas - asked)
    assert np.max(passed) < 3.0
    assert np.max(np.abs(passed[-30:])) < 0.1
