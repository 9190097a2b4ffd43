"""Shapes of the 3D scene: which way is up, left and along."""

from math import pi, radians

import numpy as np
import pytest
from relguide_server.scene import shapes as shapes
from viser.transforms import SO3

from relguide.flying.cards import path_segments, plan_card
from relguide.planning.outcome import Plan
from relguide.planning.plan import plan
from tests.server.flown import SITUATION


def turn(heading: float, bank: float, body: tuple[float, float, float]) -> list[float]:
    return list(np.round(SO3(np.array(shapes.attitude(heading, bank))).apply(np.array(body)), 9))


@pytest.mark.parametrize(
    ("heading", "nose"), [(0.0, (0, 1, 0)), (pi / 2, (1, 0, 0)), (pi, (0, -1, 0))]
)
def test_the_nose_points_along_the_heading(heading: float, nose: tuple[int, int, int]) -> None:
    assert turn(heading, 0.3, (1, 0, 0)) == pytest.approx(list(nose), abs=1e-9)


def test_positive_bank_lowers_the_right_wing() -> None:
    right_wing = turn(radians(70), radians(25), (0, -1, 0))
    assert right_wing[2] < -0.4


def test_the_airliner_is_one_long_symmetric_and_whole() -> None:
    vertices, faces = shapes.airliner()
    assert np.ptp(vertices[:, 0]) == pytest.approx(1.0, abs=0.05)
    assert vertices[:, 1].max() == pytest.approx(-vertices[:, 1].min(), abs=1e-6)
    assert faces.max() < len(vertices)
    assert vertices[:, 2].max() > 0.15  # the fin stands up


def test_the_path_ends_where_its_last_segment_does() -> None:
    answer = plan(SITUATION)
    assert isinstance(answer, Plan)
    segments = plan_card(answer).segments
    wind = (SITUATION.wind.east, SITUATION.wind.north)
    points = shapes.path_points(segments, wind, 20.0)
    start, end = segments[0].start, segments[-1].end
    assert points[0] * 1000 == pytest.approx([start.x, start.y, 20_000.0], abs=1e-6)
    assert points[-1] * 1000 == pytest.approx([end.x, end.y, 20_000.0], abs=1e-3)


def test_every_turn_meets_the_straight_after_it() -> None:
    wind = (SITUATION.wind.east, SITUATION.wind.north)
    segments = path_segments(SITUATION.leader.trajectory, wind=SITUATION.wind, horizon=600.0)
    points = shapes.path_points(segments, wind, 0.0)
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1) * 1000
    assert steps.max() < shapes.LONGEST + 1.0


def test_a_timed_path_begins_where_the_aircraft_is_and_has_no_long_piece() -> None:
    times, x, y = (0.0, 100.0, 110.0), (0.0, 24_000.0, 24_000.0), (0.0, 0.0, 2_400.0)
    points = shapes.timed_points(times, x, y, height=5.0, since=50.0)
    assert points[0] == pytest.approx([12.0, 0.0, 5.0])
    assert points[-1] == pytest.approx([24.0, 2.4, 5.0])
    assert np.linalg.norm(np.diff(points, axis=0), axis=1).max() * 1000 < shapes.LONGEST + 1.0


def test_dashes_cover_their_share_of_the_line() -> None:
    line = np.array([[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [10.0, 10.0, 0.0]])
    dashes = shapes.dashes(line, (2.0, 2.0))
    assert dashes.shape == (5, 2, 3)
    assert np.linalg.norm(dashes[0, 1] - dashes[0, 0]) == pytest.approx(2.0)


def test_a_point_is_no_line() -> None:
    assert shapes.polyline(np.zeros((1, 3))).shape == (0, 2, 3)
    assert shapes.dashes(np.zeros((1, 3)), (1.0, 1.0)).shape == (0, 2, 3)


def test_what_is_flown_of_a_path_is_left_out() -> None:
    answer = plan(SITUATION)
    assert isinstance(answer, Plan)
    segments = plan_card(answer).segments
    wind = (SITUATION.wind.east, SITUATION.wind.north)
    for since in (0.3, 0.8):
        t = since * answer.time_to_converge
        here = answer.trajectory.sample(np.array([t]))
        points = shapes.path_points(segments, wind, 1.0, since=t)
        blown = [here.x[0] + wind[0] * t, here.y[0] + wind[1] * t]
        assert points[0, :2] * 1000.0 == pytest.approx(blown, abs=1.0)
    assert shapes.path_points(segments, wind, 1.0, since=1e6).shape == (0, 3)
