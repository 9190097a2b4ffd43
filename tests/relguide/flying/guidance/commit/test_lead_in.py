"""Plans are led in: from what is flown now, without a jump of place or heading."""

from dataclasses import replace
from math import hypot

import numpy as np
import pytest

from relguide.flying.flight import Scenario
from relguide.flying.guidance.commit.lead_in import lead_in, lead_time
from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.turn import turn_rate
from relguide.kernels.flight import path as on
from relguide.kernels.flight.flight_records import TURN_RATE, Control
from relguide.units import DEG
from tests.relguide.flying.guidance.beliefs import FIG_6B, Watched, observe
from tests.relguide.flying.guidance.commit.proposals import WINDY, committed_at


def test_the_lead_in_lasts_until_a_turn_can_be_half_rolled_into() -> None:
    belief, assignment = observe(FIG_6B)
    rate = belief.limits.max_roll_rate
    seconds = lead_time(assignment, rate)
    assert (assignment.planned_bank, rate) == pytest.approx((25.0 * DEG, 3.75 * DEG))
    half, lag = 0.5 * 25.0 / (on.ROLL_SHARE * 3.75), assignment.settings.lag
    assert seconds - 1.0 < half + lag <= seconds
    assert lead_time(assignment, 0.5 * rate) - 1.0 < 2.0 * half + lag
    assert lead_in(belief, assignment, None).seconds == seconds


@pytest.mark.parametrize("scenario", [FIG_6B, WINDY], ids=["calm", "wind"])
@pytest.mark.parametrize("rate", [0.0, 0.015, -0.015])
def test_it_ends_where_the_aircraft_then_is(scenario: Scenario, rate: float) -> None:
    """Flown on as it flies now, straight or turning, it is there to some metres."""
    watched = Watched(scenario)
    control = Control(TURN_RATE, rate, watched.assignment.tas)
    for _ in range(20):
        watched.fly(control)
    lead = lead_in(watched.belief, watched.assignment, None)
    for _ in range(round(lead.seconds)):
        watched.fly(control)
    own, planned = watched.belief.own, lead.pursuer
    assert hypot(own.x - planned.x, own.y - planned.y) < 5.0
    assert wrap_signed(own.heading - planned.heading) == pytest.approx(0.0, abs=0.2 * DEG)
    leader = watched.belief.leader
    assert hypot(leader.x - lead.leader.x, leader.y - lead.leader.y) < 1.0
    assert planned.max_bank == watched.assignment.planned_bank < watched.assignment.max_bank


def test_nearly_level_it_leads_straight_on() -> None:
    belief, assignment = observe(FIG_6B)
    slight = belief.own._replace(bank=0.9 * DEG)
    lead = lead_in(replace(belief, own=slight), assignment, None)
    assert lead.pieces.tolist() == [[lead.seconds * assignment.tas, 0.0]]
    turning = replace(belief, own=belief.own._replace(bank=10.0 * DEG))
    ((_, curvature),) = lead_in(turning, assignment, None).pieces
    assert curvature == pytest.approx(turn_rate(240.0, 10.0 * DEG) / 240.0)


@pytest.mark.parametrize(("early", "cut"), [(1.4, False), (0.9, True), (0.1, True), (-0.1, False)])
def test_it_ends_with_a_turn_that_ends_in_its_last_second(early: float, cut: bool) -> None:
    """So the next plan may go on turning, and a turn is not put off by bits of the opposite one."""
    watched = Watched(WINDY)
    old = committed_at(watched).committed
    turn = turn_rate(240.0, watched.assignment.planned_bank) / 240.0
    longest = lead_time(watched.assignment, watched.belief.limits.max_roll_rate)
    seconds = longest - early if cut else longest
    lengths = 240.0 * np.array([longest - early, 0.3, 60.0])
    bends = np.column_stack([lengths, [turn, -turn, turn]])
    path = on.lay_path(0.0, 0.0, 0.0, bends, 240.0, 0.0, watched.belief.limits.max_roll_rate)
    course = old.course._replace(path=path)
    lead = lead_in(watched.belief, watched.assignment, old._replace(course=course, s=0.0))
    assert lead.seconds == pytest.approx(seconds)
    assert lead.pieces[:, 0].sum() == pytest.approx(240.0 * seconds)
    end = on.pose_on(path, 240.0 * seconds)
    wind = watched.belief.wind
    assert lead.pursuer.x == pytest.approx(end[0] + wind.east * seconds, abs=1e-6)
    assert lead.leader.x == watched.belief.leader_after(seconds).x
