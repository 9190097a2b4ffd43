"""Trajectories: the integrated equations of motion, order, ends."""

from math import pi

import pytest
from hypothesis import given

from relguide import LEFT, RIGHT, Arc, BoundaryArc, Straight, Trajectory
from relguide.kernels.base.turn import turn_radius, turn_rate
from relguide.units import DEG
from tests.oracle import integrate, pieces_of
from tests.situations import numbers


def path(*segments: Arc | BoundaryArc | Straight) -> Trajectory:
    return Trajectory(x=1_000.0, y=-2_000.0, heading=0.3, tas=200.0, segments=segments)


S_LEFT_S_RIGHT = path(
    Straight(length=5_000.0),
    Arc(turn=LEFT, turn_angle=1.2, radius=8_000.0),
    Straight(length=3_000.0),
    Arc(turn=RIGHT, turn_angle=4.0, radius=6_000.0),
)


def test_poses_are_those_of_the_equations_of_motion() -> None:
    until = S_LEFT_S_RIGHT.duration + 30.0
    for t, x, y, psi in integrate(
        (1_000.0, -2_000.0, 0.3), 200.0, pieces_of(S_LEFT_S_RIGHT), (0.0, 0.0), until
    ):
        pose = S_LEFT_S_RIGHT.pose_at(t)
        assert pose.x == pytest.approx(x, abs=1e-3)
        assert pose.y == pytest.approx(y, abs=1e-3)
        assert pose.heading == pytest.approx(psi % (2.0 * pi), abs=1e-9)


def test_breakpoints_are_poses() -> None:
    t = 0.0
    for pose, duration in zip(
        S_LEFT_S_RIGHT.breakpoints(), (*S_LEFT_S_RIGHT.durations(), 0.0), strict=True
    ):
        there = S_LEFT_S_RIGHT.pose_at(t)
        assert (pose.x, pose.y) == pytest.approx((there.x, there.y), abs=1e-6)
        t += duration


def test_letters_turns_and_length() -> None:
    assert S_LEFT_S_RIGHT.letters == "SLSR"
    assert S_LEFT_S_RIGHT.turns == 2
    assert S_LEFT_S_RIGHT.length == pytest.approx(5_000 + 9_600 + 3_000 + 24_000)


@given(rate=numbers(1e-12, 1e-5))
def test_a_turn_of_almost_no_rate_is_a_straight(rate: float) -> None:
    arc = path(Arc(turn=LEFT, turn_angle=rate * 100.0, radius=200.0 / rate))
    line = path(Straight(length=20_000.0))
    end, straight = arc.breakpoints()[-1], line.breakpoints()[-1]
    # the arc leaves the line by l²/2R
    assert abs(end.x - straight.x) <= 0.5 * 20_000.0**2 * rate / 200.0 + 1e-6


def test_a_left_turn_lowers_the_heading() -> None:
    left = path(Arc(turn=LEFT, turn_angle=0.1, radius=8_000.0)).breakpoints()[-1]
    right = path(Arc(turn=RIGHT, turn_angle=0.1, radius=8_000.0)).breakpoints()[-1]
    assert left.heading == pytest.approx(0.2)
    assert right.heading == pytest.approx(0.4)


def test_radius_and_rate_belong_together() -> None:
    # figures of eq. (8): 230 m/s at 25° turns on 11.6 km
    assert turn_radius(230.0, 25 * DEG) == pytest.approx(11_568.0, abs=1.0)
    assert turn_rate(230.0, 25 * DEG) * turn_radius(230.0, 25 * DEG) == pytest.approx(230.0)
    assert turn_rate(230.0, -25 * DEG) < 0.0


@pytest.mark.parametrize("length", [-1.0, float("nan"), float("inf")])
def test_a_segment_that_cannot_be_flown_is_refused(length: float) -> None:
    with pytest.raises(ValueError, match=r"must (be|have) a finite"):
        path(Straight(length=length))


@pytest.mark.parametrize("backward", range(5))
def test_no_piece_of_a_boundary_arc_is_flown_backward(backward: int) -> None:
    bends = tuple((-20.0 if k == backward else 100.0, 1e-4) for k in range(5))
    with pytest.raises(ValueError, match=r"length of 0 m or more, not -20"):
        path(BoundaryArc(side=LEFT, bends=bends))


def test_a_boundary_arc_has_pairs_of_a_length_and_a_curvature() -> None:
    for bends in ([(1.0, 0.0)], (), ((1.0,),), ([1.0, 0.0],), (1.0, 0.0)):
        with pytest.raises(ValueError, match=r"must have bends: a tuple of \(length, curvature\)"):
            path(BoundaryArc(side=LEFT, bends=bends))  # type: ignore[arg-type]
