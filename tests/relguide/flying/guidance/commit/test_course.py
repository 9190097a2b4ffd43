"""The path of a plan goes on with what is flown now, without a jump of place or heading."""

import numpy as np
import pytest

from relguide.flying.guidance.commit.lead_in import lead_time
from relguide.kernels.base.turn import turn_rate
from relguide.kernels.flight import path as on
from relguide.kernels.flight.flight_records import HOLD_HEADING, Control
from tests.relguide.flying.guidance.beliefs import Watched, observe
from tests.relguide.flying.guidance.commit.proposals import WINDY, committed_at


def test_the_course_of_a_first_plan_begins_where_the_aircraft_is() -> None:
    belief, assignment = observe(WINDY)
    committed = committed_at(Watched(WINDY)).committed
    x, y, heading = on.pose_on(committed.course.path, 0.0)
    assert (x, y, heading) == (belief.own.x, belief.own.y, belief.own.heading)
    assert committed.s == 0.0
    assert committed.begins == lead_time(assignment, belief.limits.max_roll_rate)
    length = committed.course.path[-1, on.S]
    assert length == pytest.approx(240.0 * committed.due, abs=1e-6)


def _aloft(watched: Watched) -> tuple[float, float]:
    own, wind = watched.belief.own, watched.belief.wind
    return own.x - wind.east * watched.t, own.y - wind.north * watched.t


def test_a_new_course_goes_on_with_the_old_one_and_then_with_the_new_plan() -> None:
    """In place and heading: what is tracked does not jump when the plan changes."""
    watched = Watched(WINDY)
    old = committed_at(watched).committed
    for _ in range(8):
        watched.fly(Control(HOLD_HEADING, watched.scenario.situation.pursuer.heading, 240.0))
    s, _ = on.project(old.course.path, *_aloft(watched), 8 * 240.0)
    old = old._replace(s=s)
    new = committed_at(watched, old).committed
    cut = s + (new.begins - watched.t) * 240.0
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
