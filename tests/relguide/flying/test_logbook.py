"""The figures of a flight's summary, step by step."""

from dataclasses import replace
from itertools import pairwise
from math import inf

import pytest

from relguide.flying.aircraft import AircraftState
from relguide.flying.documents import PlanChanged
from relguide.flying.logbook import Milestones, Tally, count_event, count_step
from relguide.units import DEG
from tests.server.flown import ideal_flight

NOTHING = Tally(inf, 0.0, 0.0, 0, 0)
LEADER = AircraftState(0.0, 5_000.0, 0.0, 0.0, 0.0, 200.0, 9_000.0)


def tally(*banks: float, joined: bool = False) -> Tally:
    """What is counted of an aircraft that rolls from bank to bank [deg], 200 m a step."""
    states = [
        AircraftState(200.0 * k, 0.0, 0.1 * k, bank * DEG, 0.0, 200.0, 9_000.0)
        for k, bank in enumerate(banks)
    ]
    total = NOTHING
    for before, now in pairwise(states):
        total = count_step(total, before, now, LEADER, joined)
    return total


@pytest.mark.parametrize(
    ("banks", "reversals", "side"),
    [
        ((0.0, 25.0, 0.0, -25.0), 1, -1),
        ((0.0, 3.1, 0.0, -3.1, 0.0, 3.1), 2, 1),
        ((0.0, 3.1, -2.9, 2.9), 0, 1),  # a correction, not a turn
        ((0.0, 2.9, -2.9), 0, 0),
        ((0.0, -25.0, -10.0, -25.0), 0, -1),
    ],
)
def test_a_reversal_is_a_turn_to_the_other_side(
    banks: tuple[float, ...], reversals: int, side: int
) -> None:
    total = tally(*banks)
    assert (total.bank_reversals, total.banked) == (reversals, side)


def test_track_and_swing_are_counted_until_joined_and_separation_always() -> None:
    total = tally(0.0, 25.0, -25.0)
    assert total.track == pytest.approx(400.0)
    assert total.heading_swing == pytest.approx(0.2)
    assert total.least_separation == pytest.approx((200.0**2 + 5_000.0**2) ** 0.5)
    assert tally(0.0, 25.0, -25.0, joined=True) == NOTHING._replace(
        least_separation=total.least_separation
    )


def test_new_plans_are_counted_whether_announced_or_not() -> None:
    engaged = next(d for d in ideal_flight() if isinstance(d, PlanChanged))
    news = replace(engaged, t=1.0, reason="better_plan")
    milestones = Milestones()
    for document in (engaged, news, replace(news, t=2.0, announced=False)):
        milestones = count_event(milestones, document)
    assert (milestones.replans, milestones.replans_announced) == (2, 1)
    assert milestones.promised == engaged.promised
