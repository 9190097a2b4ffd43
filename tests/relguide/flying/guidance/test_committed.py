"""Plans are led in: from what is flown now, without a jump of place or heading."""

from dataclasses import replace
from math import hypot

import numpy as np
import pytest

from relguide.flying.flight import Scenario
from relguide.flying.guidance.committed import (
    Committed,
    lead_in,
    lead_time,
    place_on,
    segments_of,
    shown_plan,
    slot_mismatch,
)
from relguide.flying.guidance.converge import Proposal, propose
from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.turn import turn_rate
from relguide.kernels.flight import path as on
from relguide.kernels.flight.flight_records import HOLD_HEADING, TURN_RATE, Control
from relguide.planning.plan import plan
from relguide.planning.situation import wind_from
from relguide.planning.trajectory import LEFT, RIGHT, Arc, Straight
from relguide.units import DEG
from tests.relguide.flying.guidance.beliefs import FIG_6B, Watched, behind, observe

WINDY = replace(FIG_6B, situation=replace(FIG_6B.situation, wind=wind_from(300.0 * DEG, 30.0)))


def committed_at(watched: Watched, committed: Committed | None = None) -> Proposal:
    found = propose(watched.belief, watched.assignment, committed, plan)
    assert isinstance(found, Proposal)
    return found


def test_the_lead_in_lasts_until_a_turn_can_be_half_rolled_into() -> None:
    belief, assignment = observe(FIG_6B)
    rate = belief.limits.max_roll_rate
    seconds = lead_time(assignment, rate)
    assert seconds == 6.0  # 22.5° at two thirds of 3.75°/s, half of it, and the lag
    assert lead_time(assignment, 0.5 * rate) == 11.0
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
    assert lead.pieces.tolist() == [[6.0 * assignment.tas, 0.0]]
    turning = replace(belief, own=belief.own._replace(bank=10.0 * DEG))
    ((_, curvature),) = lead_in(turning, assignment, None).pieces
    assert curvature == pytest.approx(turn_rate(240.0, 10.0 * DEG) / 240.0)


def test_the_course_of_a_first_plan_begins_where_the_aircraft_is() -> None:
    belief, _ = observe(WINDY)
    committed = committed_at(Watched(WINDY)).committed
    x, y, heading = on.pose_on(committed.course.path, 0.0)
    assert (x, y, heading) == (belief.own.x, belief.own.y, belief.own.heading)
    assert committed.s == 0.0
    assert committed.begins == 6.0
    length = committed.course.path[-1, on.S]
    assert length == pytest.approx(240.0 * committed.due, abs=1e-6)


def test_a_new_course_goes_on_with_the_old_one_and_then_with_the_new_plan() -> None:
    """In place and heading: what is tracked does not jump when the plan changes."""
    watched = Watched(WINDY)
    old = committed_at(watched).committed
    for _ in range(8):
        watched.fly(Control(HOLD_HEADING, watched.scenario.situation.pursuer.heading, 240.0))
    s, _ = on.project(old.course.path, *_aloft(watched), 8 * 240.0)
    old = old._replace(s=s)
    new = committed_at(watched, old).committed
    cut = s + 6.0 * 240.0
    assert new.course.begun == old.course.begun
    assert new.s == s
    for place in np.linspace(s, cut, 25):
        was, now = on.pose_on(old.course.path, place), on.pose_on(new.course.path, place)
        assert now == pytest.approx(was, abs=1e-6)
    before, after = (on.pose_on(new.course.path, cut + d) for d in (-1e-6, 1e-6))
    assert after == pytest.approx(before, abs=1e-5)
    steps = [on.heading_on(new.course.path, p) for p in np.arange(s, cut + 20_000.0, 50.0)]
    fastest = turn_rate(240.0, watched.assignment.planned_bank) / 240.0
    assert np.abs(np.diff(steps)).max() <= 50.0 * fastest * 1.01


@pytest.mark.parametrize(("left_at_s", "seconds"), [(4.6, 6.0), (5.1, 5.1), (5.9, 5.9), (6.1, 6.0)])
def test_it_ends_with_a_turn_that_ends_in_its_last_second(left_at_s: float, seconds: float) -> None:
    """So the next plan may go on turning, and a turn is not put off by bits of the opposite one."""
    watched = Watched(WINDY)
    old = committed_at(watched).committed
    turn = turn_rate(240.0, watched.assignment.planned_bank) / 240.0
    lengths = 240.0 * np.array([left_at_s, 0.3, 60.0])
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


def _aloft(watched: Watched) -> tuple[float, float]:
    own, wind = watched.belief.own, watched.belief.wind
    return own.x - wind.east * watched.t, own.y - wind.north * watched.t


def test_what_has_been_flown_is_where_the_aircraft_is_now() -> None:
    """Not where it was a second ago: else each new plan would begin 240 m behind it."""
    watched = Watched(WINDY)
    committed, before = committed_at(watched).committed, 0.0
    heading = watched.scenario.situation.pursuer.heading
    for second in range(1, 6):
        watched.fly(Control(HOLD_HEADING, heading, 240.0))
        committed, right = place_on(committed, watched.belief, before)
        before = committed.s
        assert committed.s == pytest.approx(240.0 * second, abs=1.0)
        assert right == pytest.approx(0.0, abs=1.0)
    lead = lead_in(watched.belief, watched.assignment, committed)
    own = watched.belief.own
    assert lead.start[:2] == pytest.approx((own.x, own.y), abs=2.0)


def test_the_plan_shown_begins_now_and_ends_as_planned() -> None:
    watched = Watched(WINDY)
    found = committed_at(watched)
    belief = watched.belief
    shown = shown_plan(found.committed.plan, found.lead, belief, watched.assignment)
    assert (shown.trajectory.x, shown.trajectory.y) == (belief.own.x, belief.own.y)
    assert shown.time_to_converge == pytest.approx(found.committed.due, abs=1e-6)
    wind = belief.wind
    end = shown.trajectory.pose_at(shown.time_to_converge)
    then = found.committed.plan.trajectory.pose_at(found.committed.plan.time_to_converge)
    assert end.x == pytest.approx(then.x - wind.east * 6.0, abs=1e-3)
    assert end.y == pytest.approx(then.y - wind.north * 6.0, abs=1e-3)
    assert shown.certificate.holds
    assert shown.optimality.lower_bound == found.committed.plan.optimality.lower_bound + 6.0


def test_what_remains_of_a_course_leads_to_its_end() -> None:
    watched = Watched(WINDY)
    committed = committed_at(watched).committed
    wind, t = watched.belief.wind, 100.0
    left = committed._replace(s=240.0 * t).remaining(t, 240.0)
    assert left.duration == pytest.approx(committed.due - t, abs=1e-6)
    end, row = left.pose_at(left.duration), committed.course.path[-1]
    assert end.x == pytest.approx(row[on.X] + wind.east * t, abs=1e-3)
    assert end.y == pytest.approx(row[on.Y] + wind.north * t, abs=1e-3)
    over = committed._replace(s=committed.course.path[-1, on.S] + 1.0)
    assert over.remaining(committed.due, 240.0).segments == ()


def test_pieces_that_go_on_across_a_cut_are_one_segment() -> None:
    bend = 1.0 / 8_000.0
    pieces = [
        [500.0, 0.0], [300.0, 0.0], [1e-6, bend], [4_000.0, bend], [4_000.0, bend],
        [800.0, -bend], [0.0, 0.0],
    ]  # fmt: skip
    straight, right, left = segments_of(np.array(pieces))
    assert straight == Straight(length=800.0)
    for segment, turn, angle in ((right, RIGHT, 1.0), (left, LEFT, 0.1)):
        assert isinstance(segment, Arc)
        assert segment.turn == turn
        assert segment.turn_angle == pytest.approx(angle)
        assert segment.radius == pytest.approx(8_000.0)
    assert segments_of(np.zeros((0, 2))) == ()


def test_a_leader_elsewhere_moves_the_slot_by_as_much() -> None:
    watched = Watched(behind(along=40_000.0, abeam=10_000.0))
    committed = committed_at(watched).committed
    belief = watched.belief
    assert slot_mismatch(belief, committed) < 1e-6
    aside = replace(belief, leader=belief.leader._replace(x=belief.leader.x + 120.0))
    assert slot_mismatch(aside, committed) == pytest.approx(120.0, abs=1e-3)
    faster = replace(belief, leader=belief.leader._replace(tas=belief.leader.tas + 1.0))
    assert slot_mismatch(faster, committed) == pytest.approx(committed.due, abs=1e-3)


def test_in_wind_a_leader_as_expected_moves_no_slot() -> None:
    watched = Watched(WINDY)
    committed = committed_at(watched).committed
    for _ in range(30):
        watched.fly(Control(HOLD_HEADING, 0.0, 240.0))
    assert slot_mismatch(watched.belief, committed) < 1.0
