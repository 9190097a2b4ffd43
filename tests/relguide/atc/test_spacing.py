"""How far an aircraft is behind its leader, round corners as on a straight."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from relguide.atc.spacing import behind_leader
from tests.relguide.atc.tracks import seen_on, track_of_legs, turning_legs

LEADER = track_of_legs(turning_legs(turned=90.0))


@given(
    st.floats(60.0, 400.0),
    st.floats(20.0, 80.0),
    st.floats(-10.0, 10.0),
    st.floats(-10.0, 10.0),
    st.floats(-300.0, 300.0),
)
def test_it_is_what_the_leader_flies_in_that_time(
    t: float, behind: float, wrong: float, early: float, right: float
) -> None:
    """The leader need not be in time on its path, nor the aircraft on it exactly."""
    leader = seen_on(LEADER, t, early=early)
    own = seen_on(LEADER, t, early=early - behind, right=right)
    found = behind_leader(LEADER, t, (leader.x, leader.y), (own.x, own.y), behind + wrong)
    # beside a knot of the turn, 2° are 1° to either side of a place 300 m off
    assert found.time == pytest.approx(behind, abs=0.1)
    assert found.length == pytest.approx(200.0 * behind, abs=20.0)


def test_who_is_ahead_of_its_leader_is_a_negative_distance_behind() -> None:
    leader, own = seen_on(LEADER, 60.0), seen_on(LEADER, 60.0, early=5.0)
    found = behind_leader(LEADER, 60.0, (leader.x, leader.y), (own.x, own.y), 10.0)
    assert found.time == pytest.approx(-5.0)
    assert found.length == pytest.approx(-1_000.0)
