"""The proof of separation: never above the truth, never far below it."""

from math import inf

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from relguide import LEFT, RIGHT, Arc, Plan, Situation, Straight, Trajectory, certify, plan
from relguide.kernels.separation.approach import closest_of_straights
from relguide.planning.certificate import TOLERANCE
from tests.situations import numbers, situations

segments = st.lists(
    st.one_of(
        st.builds(Straight, length=numbers(0.0, 40_000.0)),
        st.builds(
            Arc,
            turn=st.sampled_from([LEFT, RIGHT]),
            turn_angle=numbers(0.0, 6.0),
            radius=numbers(3_000.0, 15_000.0),
        ),
    ),
    min_size=1,
    max_size=4,
).map(tuple)


def least_sampled(trajectory: Trajectory, leader: Trajectory, n: int) -> float:
    least = inf
    for t in np.linspace(0.0, trajectory.duration, n):
        ours, theirs = trajectory.pose_at(t), leader.pose_at(t)
        least = min(least, float(np.hypot(ours.x - theirs.x, ours.y - theirs.y)))
    return least


@given(situation=situations(reach=40_000.0), flown=segments)
def test_dense_sampling_never_goes_below_the_proof(
    situation: Situation, flown: tuple[Arc | Straight, ...]
) -> None:
    pursuer = situation.pursuer
    trajectory = Trajectory(
        x=pursuer.x, y=pursuer.y, heading=pursuer.heading, tas=pursuer.tas, segments=flown
    )
    certificate = certify(trajectory, situation)
    leader = situation.leader.trajectory
    seen = least_sampled(trajectory, leader, 400)
    assert seen >= certificate.lower_bound
    # the separation found is reached: it is a value of the function, at its time
    ours, theirs = trajectory.pose_at(certificate.at_time), leader.pose_at(certificate.at_time)
    reached = np.hypot(ours.x - theirs.x, ours.y - theirs.y)
    assert certificate.least_separation == pytest.approx(reached, abs=1e-5)
    # and the proof stops short of it by the stated tolerance only
    slack = TOLERANCE * pursuer.turn_radius + 1e-5
    assert certificate.least_separation - certificate.lower_bound <= slack


@given(situation=situations(with_intent=False, with_wind=False, reach=60_000.0))
def test_a_plan_that_touches_d_min_at_the_slot_is_certified(situation: Situation) -> None:
    touching = Situation(
        pursuer=situation.pursuer,
        leader=situation.leader,
        slot_distance=situation.min_separation,
        min_separation=situation.min_separation,
    )
    answer = plan(touching)
    if isinstance(answer, Plan):
        assert answer.certificate.least_separation >= touching.min_separation - 0.02
        assert answer.certificate.holds


@given(dx=numbers(-9.0, 9.0), dy=numbers(-9.0, 9.0), vx=numbers(-3.0, 3.0), vy=numbers(-3.0, 3.0))
def test_closest_approach_of_straights_is_the_least_of_samples(
    dx: float, dy: float, vx: float, vy: float
) -> None:
    t, d = closest_of_straights(dx, dy, vx, vy, 0.0, 4.0)
    times = np.linspace(0.0, 4.0, 4001)
    least = np.hypot(dx + times * vx, dy + times * vy).min()
    assert 0.0 <= t <= 4.0
    assert d <= least + 1e-12
    assert d == pytest.approx(least, abs=3e-3)  # half a sample step at 4.2 m/s
