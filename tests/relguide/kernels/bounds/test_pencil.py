"""Where turns end after a contact, against λ_ψ along them, for changes of λ_p of all sizes."""

from math import atan2, cos, hypot, pi, sin

import numpy as np
import pytest

from relguide.kernels.base.angles import TWO_PI, wrap_signed
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.pencil import Arrived, off_line, pencil_of, straight_after

STEP = 1e-3
"""λ_ψ is looked at so often along a turn [rad]."""
CLOSE = 5e-3
"""What that may count for [rad]."""


def arrived(rng: np.random.Generator, three: bool, inward: bool) -> Arrived:
    """A turn after a straight, or after another turn that is longer."""
    arc = rng.uniform(0.3, 6.0)
    turn = rng.uniform(0.1, 0.9 * arc if three else 4.0)
    return Arrived(inward, three, turn, turn, arc, arc)


def costate(known: Arrived) -> tuple[float, float, float]:
    """λ_p and λ_ψ at the contact, seen along its heading, with |λ_p| = 1.

    The turn before it has begun on the line along λ_p on which λ_ψ = 0.
    """
    m = known.low
    # after a straight λ_p is along the heading there, −m; the chord of an arc heads ½n off its end
    along = 0.5 * known.least - pi - m if known.three else -m
    x, y = cos(along), sin(along)
    return x, y, x * (cos(m) - 1.0) - y * sin(m)


def switching(x: float, y: float, at_contact: float, turns: FloatArray) -> FloatArray:
    """λ_ψ along the turn that goes on."""
    return np.asarray(at_contact + x * (1.0 - np.cos(turns)) - y * np.sin(turns))


def ends(x: float, y: float, at_contact: float) -> float:
    """The turn after which λ_ψ first vanishes [rad]; more than a full one if it does not."""
    turns = np.arange(STEP, TWO_PI, STEP)
    below = np.flatnonzero(switching(x, y, at_contact, turns) < 0.0)
    return float(turns[below[0]]) if len(below) > 0 else 2.0 * TWO_PI


@pytest.mark.parametrize("three", [False, True])
@pytest.mark.parametrize("inward", [False, True])
@pytest.mark.parametrize("wide", [0.0, 1e-2])
def test_the_line_is_met_at_the_angle_that_is_said(three: bool, inward: bool, wide: float) -> None:
    rng = np.random.default_rng(11)
    told = 0
    for _ in range(300):
        known, eta = arrived(rng, three, inward), rng.uniform(0.1, 3.0) * (1.0 if inward else -1.0)
        x, y, at_contact = costate(known)
        change = np.exp(rng.uniform(-4.0, 4.0))
        x, y = x + change * cos(eta), y + change * sin(eta)
        turn = ends(x, y, at_contact)
        if turn > TWO_PI:
            continue
        around = known._replace(
            low=known.low - wide * rng.uniform(), high=known.high + wide * rng.uniform(),
            least=known.least - wide * rng.uniform(), most=known.most + wide * rng.uniform(),
        )  # fmt: skip
        off = wide * rng.uniform(-1.0, 1.0)
        pencil = pencil_of(around, abs(eta) + off, abs(off))
        half = STEP + wide * rng.uniform()
        middle = turn + rng.uniform(-1.0, 1.0) * (half - STEP)
        least, most = off_line(pencil, middle, half)
        angle = wrap_signed(atan2(y, x) - turn)
        assert least - CLOSE <= angle <= most + CLOSE
        told += most - least < pi
    assert told > 100


@pytest.mark.parametrize("three", [False, True])
@pytest.mark.parametrize("inward", [False, True])
def test_straights_begin_where_the_line_only_touches(three: bool, inward: bool) -> None:
    rng = np.random.default_rng(12)
    asked = 0
    for _ in range(60):
        known, eta = arrived(rng, three, inward), rng.uniform(0.1, 3.0) * (1.0 if inward else -1.0)
        x, y, at_contact = costate(known)
        if abs(wrap_signed(eta - atan2(y, x))) > 2.8:
            continue
        turns = np.arange(STEP, TWO_PI, STEP)
        changes = np.exp(np.linspace(-4.0, 4.0, 400))
        least = [
            float(np.min(switching(x + nu * cos(eta), y + nu * sin(eta), at_contact, turns)))
            for nu in changes
        ]
        pencil = pencil_of(known, abs(eta), 0.0)
        for k in np.flatnonzero(np.diff(np.sign(least))):
            nu = 0.5 * (changes[k] + changes[k + 1])
            px, py = x + nu * cos(eta), y + nu * sin(eta)
            at = int(np.argmin(switching(px, py, at_contact, turns)))
            # where λ_ψ has its least value the heading is along λ_p
            if not 0 < at < len(turns) - 1 or hypot(px, py) < 0.1:
                continue
            found = [straight_after(known, pencil, root) for root in range(2)]
            assert any(low - 0.1 <= turns[at] <= high + 0.1 for low, high in found)
            asked += 1
    assert asked > 10


def test_a_turn_after_a_straight_leads_on_to_a_straight_by_cotangents() -> None:
    known = Arrived(True, False, 1.0, 1.0, 0.0, 0.0)
    low, high = straight_after(known, pencil_of(known, 0.8, 0.0), 0)
    assert low == pytest.approx(high)
    assert 1.0 / np.tan(0.5 * low) == pytest.approx(2.0 / np.tan(0.8) + 1.0 / np.tan(0.5))
