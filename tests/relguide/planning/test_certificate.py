"""The proof of separation: never above the truth, never far below it."""

from dataclasses import replace
from itertools import islice
from math import inf

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from relguide import (
    LEFT,
    RIGHT,
    Arc,
    Cell,
    Disc,
    Plan,
    Situation,
    Straight,
    Trajectory,
    candidates,
    certify,
    plan,
)
from relguide.kernels.separation.approach import closest_of_straights
from relguide.planning.certificate import FOLLOWED, TOLERANCE
from tests.situations import numbers, situations
from tests.skies import any_sky, blocked, crossing, margins

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


@pytest.mark.parametrize("seed", range(30))
def test_dense_sampling_never_goes_below_the_proof_of_any_other(seed: int) -> None:
    """Traffic that turns, discs and polygons that move and grow, in wind, and on into the slot."""
    rng = np.random.default_rng(seed)
    situation = any_sky(rng, 6)
    pursuer = situation.pursuer
    for candidate in islice(candidates(situation), 2):
        certificate = certify(candidate.trajectory, situation)
        seen = margins(candidate.trajectory, situation)
        idents = {other.ident for other in certificate.others}
        assert idents == {other.ident for other in situation.others}
        gaps = [other.lower_bound - other.min_separation for other in certificate.others]
        assert gaps == sorted(gaps)  # least margin first
        for other in certificate.others:
            margin = seen[other.ident]
            assert margin >= other.lower_bound - other.min_separation
            # sampled at 10 Hz, they may be 50 m farther apart than between two samples
            assert margin <= other.least_separation - other.min_separation + 50.0
            assert other.lower_bound <= other.least_separation <= other.lower_bound + 0.2
            holds = other.lower_bound >= other.min_separation - 1e-6 * pursuer.turn_radius
            assert other.holds == holds
        keeps = certificate.lower_bound >= situation.min_separation - 1e-6 * pursuer.turn_radius
        assert certificate.holds == (keeps and all(other.holds for other in certificate.others))


def test_a_path_must_keep_clear_for_two_minutes_in_the_slot() -> None:
    alone = plan(blocked())
    assert isinstance(alone, Plan)
    time = alone.time_to_converge
    for late, holds in ((60.0, False), (FOLLOWED - 1.0, False), (FOLLOWED + 60.0, True)):
        # north of the slot's track until then, and on its place at that time
        there = crossing(x=-200.0 * (time + late), y=-12e3 + 200.0 * (time + late))
        (other,) = certify(alone.trajectory, blocked(there)).others
        assert other.holds is holds
        if late == 60.0:
            assert other.at_time == pytest.approx(time + late, abs=1.0)
            assert other.least_separation == pytest.approx(0.0, abs=1e-3)


def test_a_cell_that_grows_is_nearer_later() -> None:
    alone = plan(blocked())
    assert isinstance(alone, Plan)
    still = Cell(ident="STORM", shape=Disc(x=20e3, y=0.0, radius=5e3))
    for cell, least in ((still, 15e3), (replace(still, growth=10.0), 15e3 - 250.0 * 10.0)):
        (other,) = certify(alone.trajectory, blocked(cell)).others
        assert other.min_separation == 0.0
        # it passes abeam after 250 s, and is nearest a little later if the cell grows
        assert other.least_separation == pytest.approx(least, abs=20.0)
        assert other.holds
