"""Many times at once are where one at a time would be, in the air and over the ground."""

from math import pi

import numpy as np
import pytest
from hypothesis import assume, given

from relguide import CALM, LEFT, Arc, Plan, Situation, Straight, Trajectory, Wind, plan
from relguide.planning.slot import over_ground
from tests.plans import find_plan, straight_behind
from tests.situations import golden, situations


@given(situation=situations())
def test_samples_are_the_poses_one_by_one(situation: Situation) -> None:
    answer = plan(situation)
    assume(isinstance(answer, Plan))
    assert isinstance(answer, Plan)
    times = np.linspace(0.0, 1.1 * answer.time_to_converge, 50)
    air, ground = answer.sample(times), answer.over_ground(times)
    for i, t in enumerate(times.tolist()):
        pose = answer.trajectory.pose_at(t)
        seen = over_ground(pose, t, situation.wind)
        assert (air.x[i], air.y[i]) == pytest.approx((pose.x, pose.y), abs=1e-5)
        assert (ground.x[i], ground.y[i]) == pytest.approx((seen.x, seen.y), abs=1e-5)
        turned = air.heading[i] - pose.heading
        assert (turned + pi) % (2.0 * pi) - pi == pytest.approx(0.0, abs=1e-9)


def test_over_the_ground_track_and_speed_are_those_of_the_motion() -> None:
    situation, _ = golden("wind")[0]
    found = find_plan(situation).over_ground()
    assert situation.wind != CALM
    step = np.diff(found.t)
    east, north = np.diff(found.x) / step, np.diff(found.y) / step
    assert np.hypot(east, north) == pytest.approx(found.speed[:-1], rel=0.02)
    off = np.arctan2(east, north) - found.track[:-1]
    assert np.abs((off + pi) % (2.0 * pi) - pi).max() < 0.03
    assert found.t[-1] == find_plan(situation).time_to_converge


def test_a_turn_has_its_rate_and_the_straight_after_it_none() -> None:
    turn = Arc(turn=LEFT, turn_angle=1.0, radius=8_000.0)
    path = Trajectory(x=0.0, y=0.0, heading=0.0, tas=200.0, segments=(turn, Straight(length=1e4)))
    found = path.sample([0.0, 39.9, 40.0, 1_000.0])
    assert found.turn_rate.tolist() == [-0.025, -0.025, 0.0, 0.0]
    assert found.heading.tolist() == pytest.approx([0.0, 2.0 * pi - 0.9975, 2 * pi - 1, 2 * pi - 1])
    assert set(found.speed) == {200.0}


def test_columns_have_names_and_one_length() -> None:
    found = find_plan(straight_behind()).sample(np.arange(5.0))
    assert list(found.to_dict()) == ["t", "x", "y", "heading", "turn_rate", "track", "speed"]
    assert {column.shape for column in found.to_dict().values()} == {(5,)}
    assert len(found) == 5
    assert repr(found) == "Samples(5 times: t, x, y, heading, turn_rate, track, speed)"
    assert len(find_plan(straight_behind()).sample(3.0)) == 1


def test_in_a_wind_the_air_mass_is_the_world_at_first() -> None:
    path = Trajectory(x=1.0, y=2.0, heading=0.0, tas=200.0, segments=(Straight(length=2e4),))
    found = path.over_ground(Wind(east=10.0), [0.0, 10.0])
    assert found.x.tolist() == [1.0, 101.0]
    assert found.y.tolist() == pytest.approx([2.0, 2_002.0])
    assert found.heading.tolist() == [0.0, 0.0]
    assert found.track == pytest.approx(np.arctan2(10.0, 200.0))


@pytest.mark.parametrize("times", [-1.0, float("nan"), float("inf"), [[1.0]], ["1"], [1.0, -1e-9]])
def test_what_is_no_time_is_refused(times: object) -> None:
    with pytest.raises(ValueError, match=r"^times must"):
        find_plan(straight_behind()).sample(times)  # type: ignore[arg-type]
