"""Numbers equal to the last digit, behind a leader that turns. Laws that need no oracle."""

from collections.abc import Iterator
from dataclasses import replace
from math import hypot, inf, pi

import numpy as np
import pytest

from relguide import Plan, Situation, plan, prove
from tests.coincidences import TURNING
from tests.oracle import arrival_error

pytestmark = pytest.mark.slow

MILLIMETRE = 1e-3
BILLIONTH = 1e-9  # [rad]
ALIKE = 0.01
"""What a millimetre may cost, where it makes no other path best [s]."""
JUMP = 0.1
"""More than this is a jump, and must be proved [s]."""
DRAWN = 5
PROVED = 5.0
"""How long a jump is to be proved at most [s]; it takes a tenth of a second."""


def drawn(kind: str) -> Iterator[Situation]:
    found, case = 0, 0
    while found < DRAWN:
        situation = TURNING[kind](np.random.default_rng([7, case]))
        case += 1
        if situation is not None:
            found += 1
            yield situation


def arrival_time(situation: Situation) -> float:
    answer = plan(situation)
    return answer.time_to_converge if isinstance(answer, Plan) else inf


@pytest.mark.parametrize("kind", TURNING)
def test_what_asks_for_less_is_reached_no_later(kind: str) -> None:
    for situation in drawn(kind):
        answer = plan(situation)
        time = arrival_time(situation)
        if isinstance(answer, Plan) and time > 0.0:
            assert answer.certificate.holds
            assert answer.arrival.holds
            distance, heading_error, least = arrival_error(situation, answer.trajectory)
            assert distance < 0.02
            assert heading_error < 1e-6
            assert least > situation.min_separation - 0.5  # interpolated between samples
        pursuer, limit = situation.pursuer, situation.min_separation
        nearer = replace(situation, min_separation=limit - MILLIMETRE)
        assert arrival_time(nearer) <= time + ALIKE
        steeper = replace(pursuer, max_bank=pursuer.max_bank + BILLIONTH)
        assert arrival_time(replace(situation, pursuer=steeper)) <= time + ALIKE
        if situation.slot_distance == limit:
            assert (
                time <= arrival_time(replace(situation, slot_distance=limit + MILLIMETRE)) + ALIKE
            )


def beside(situation: Situation) -> Iterator[Situation]:
    """A millimetre and a billionth away, on either side, where d_min is still kept."""
    pursuer, leader = situation.pursuer, situation.leader
    for sign in (1.0, -1.0):
        for x, y, heading in (
            (MILLIMETRE, 0.0, 0.0),
            (0.0, MILLIMETRE, 0.0),
            (0.0, 0.0, BILLIONTH),
        ):
            moved = replace(
                pursuer,
                x=pursuer.x + sign * x,
                y=pursuer.y + sign * y,
                heading=(pursuer.heading + sign * heading) % (2.0 * pi),
            )
            if hypot(moved.x - leader.x, moved.y - leader.y) >= situation.min_separation:
                yield replace(situation, pursuer=moved)


@pytest.mark.parametrize("kind", TURNING)
def test_a_millimetre_moves_the_arrival_little_or_by_a_proved_jump(kind: str) -> None:
    for situation in drawn(kind):
        answers = [plan(other) for other in (situation, *beside(situation))]
        plans = [answer for answer in answers if isinstance(answer, Plan)]
        if not plans:
            continue
        soonest = min(found.time_to_converge for found in plans)
        for found in plans:
            if found.time_to_converge > soonest + JUMP:
                proved = prove(found, seconds=PROVED)
                assert proved.optimality.lower_bound > soonest + 0.5 * JUMP
