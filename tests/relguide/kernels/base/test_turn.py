"""Bank, turn rate and turn radius of one turn agree."""

import numpy as np
import pytest

from relguide.kernels.base.turn import (
    bank_for_turn_radius,
    bank_for_turn_rate,
    turn_radii,
    turn_radius,
    turn_rate,
)
from relguide.units import DEG

SPEEDS = (80.0, 240.0)


@pytest.mark.parametrize("speed", SPEEDS)
@pytest.mark.parametrize("bank", [5.0 * DEG, 25.0 * DEG, 60.0 * DEG])
def test_each_gives_the_bank_back(speed: float, bank: float) -> None:
    rate, radius = turn_rate(speed, bank), turn_radius(speed, bank)
    assert rate * radius == pytest.approx(speed)
    assert bank_for_turn_rate(speed, rate) == pytest.approx(bank)
    assert bank_for_turn_rate(speed, -rate) == pytest.approx(-bank)
    assert bank_for_turn_radius(speed, radius) == pytest.approx(bank)
    assert turn_radius(speed, -bank) == radius


def test_an_array_of_turns_has_the_radii_of_each() -> None:
    banks = np.array((10.0, 30.0)) * DEG
    expected = [turn_radius(*turn) for turn in zip(SPEEDS, banks.tolist(), strict=True)]
    assert turn_radii(np.array(SPEEDS), banks) == pytest.approx(expected)
