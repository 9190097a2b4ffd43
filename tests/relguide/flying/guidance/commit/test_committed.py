"""What is committed: how much of it has been flown, what is left, and where the slot will be."""

from dataclasses import replace

import pytest

from relguide.flying.guidance.commit.committed import place_on, slot_mismatch
from relguide.flying.guidance.commit.lead_in import lead_in
from relguide.kernels.flight import path as on
from relguide.kernels.flight.flight_records import HOLD_HEADING, Control
from tests.relguide.flying.guidance.beliefs import Watched, behind
from tests.relguide.flying.guidance.commit.proposals import WINDY, committed_at


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
