"""From a trajectory to a reference: each roll begins half its duration early."""

from math import pi

import pytest

from relguide.flying.aircraft import A300, roll_lead
from relguide.flying.autopilot import HoldHeading, TurnRate
from relguide.flying.steering import HALF_TICK, remaining, steer
from relguide.planning.trajectory import LEFT, RIGHT, Arc, Segment, Straight, Trajectory
from relguide.units import DEG

RADIUS = 12_596.0
RATE = 240.0 / RADIUS


def path(*segments: Segment, heading: float = 90.0) -> Trajectory:
    return Trajectory(x=0.0, y=0.0, heading=heading * DEG, tas=240.0, segments=segments)


def arc(turn: int, degrees: float) -> Arc:
    return Arc(turn=LEFT if turn > 0 else RIGHT, turn_angle=degrees * DEG, radius=RADIUS)


def test_straight_is_a_heading_and_an_arc_a_turn_rate() -> None:
    assert steer(path(Straight(length=50e3)), A300).reference == HoldHeading(90.0 * DEG)
    assert steer(path(arc(1, 90.0)), A300).reference == TurnRate(pytest.approx(-RATE))
    assert steer(path(arc(-1, 90.0)), A300).reference == TurnRate(pytest.approx(RATE))


def test_end_of_a_turn_is_a_heading_to_roll_out_on() -> None:
    reference = steer(path(arc(-1, 3.0), Straight(length=50e3)), A300).reference
    assert reference == HoldHeading(pytest.approx(93.0 * DEG))


def test_turn_is_rolled_into_before_the_straight_ends() -> None:
    window = roll_lead(A300, 0.0, 25.0 * DEG) + HALF_TICK
    before = path(Straight(length=240.0 * (window + 0.5)), arc(-1, 60.0))
    within = path(Straight(length=240.0 * window / 2.0), arc(-1, 60.0))
    assert isinstance(steer(before, A300).reference, HoldHeading)
    eased = steer(within, A300)
    assert eased.reference == TurnRate(pytest.approx(RATE / 2.0, rel=0.01))
    assert eased.segments == within.segments[1:]


def test_sliver_of_the_opposite_turn_eases_the_bank_and_does_not_reverse_it() -> None:
    reference = steer(path(arc(1, 1.0), arc(-1, 120.0)), A300).reference
    assert isinstance(reference, TurnRate)
    assert 0.5 * RATE < reference.turn_rate < RATE


def test_reversal_begins_earlier_than_a_roll_in() -> None:
    left = 6.0 * RATE / DEG  # six seconds of turn
    assert isinstance(steer(path(arc(1, left), Straight(length=9e4)), A300).reference, TurnRate)
    reversing = steer(path(arc(1, left), arc(-1, 90.0)), A300).reference
    assert isinstance(reversing, TurnRate)
    assert reversing.turn_rate > -RATE


def test_nothing_left_is_the_final_heading() -> None:
    steering = steer(path(arc(-1, 0.5)), A300)
    assert steering.reference == HoldHeading(pytest.approx(90.5 * DEG))
    assert steering.segments == ()


@pytest.mark.parametrize("elapsed", [0.0, 10.0, 60.0, 200.0, 1000.0])
def test_rest_ends_where_the_whole_does(elapsed: float) -> None:
    whole = path(arc(1, 40.0), Straight(length=20e3), arc(-1, 200.0))
    left = remaining(whole, elapsed)
    assert left.duration == pytest.approx(max(whole.duration - elapsed, 0.0))
    when = max(whole.duration, elapsed)
    end, same = whole.pose_at(when), left.pose_at(when - elapsed)
    assert (same.x, same.y) == pytest.approx((end.x, end.y), abs=1e-6)
    assert (same.heading - end.heading + pi) % (2.0 * pi) == pytest.approx(pi)
