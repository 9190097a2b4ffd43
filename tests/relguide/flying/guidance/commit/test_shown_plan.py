"""A crew sees a plan from where the aircraft is now."""

import pytest

from tests.relguide.flying.guidance.beliefs import Watched
from tests.relguide.flying.guidance.commit.proposals import WINDY, committed_at


def test_the_plan_shown_begins_now_and_ends_as_planned() -> None:
    watched = Watched(WINDY)
    found = committed_at(watched)
    belief = watched.belief
    shown = found.shown
    assert (shown.trajectory.x, shown.trajectory.y) == (belief.own.x, belief.own.y)
    assert shown.time_to_converge == pytest.approx(found.committed.due, abs=1e-6)
    wind, lead = belief.wind, found.committed.begins
    end = shown.trajectory.pose_at(shown.time_to_converge)
    then = found.committed.plan.trajectory.pose_at(found.committed.plan.time_to_converge)
    assert end.x == pytest.approx(then.x - wind.east * lead, abs=1e-3)
    assert end.y == pytest.approx(then.y - wind.north * lead, abs=1e-3)
    assert shown.certificate.holds
    assert shown.optimality.lower_bound == found.committed.plan.optimality.lower_bound + lead
