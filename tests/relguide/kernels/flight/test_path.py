"""A path is laid, measured and spliced as its pieces say, and its heading turns as one can roll."""

from math import cos, hypot, pi, sin

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from relguide.kernels.base.roots import FloatArray
from relguide.kernels.flight.path import (
    CURVATURE,
    HEADING,
    RAMP,
    ROLL_SHARE,
    S,
    X,
    Y,
    heading_on,
    lay_path,
    pieces_between,
    pose_on,
    project,
    row_at,
    splice,
    turning_after,
)
from relguide.planning.trajectory import LEFT, RIGHT, Arc, Segment, Straight, Trajectory
from relguide.units import DEG, G0
from tests.aloft import A306

TAS = 240.0
RADIUS = 14_000.0
ROLL = A306.max_roll_rate
BANK = np.arctan(TAS * TAS / (G0 * RADIUS))


def lay(*pieces: tuple[float, float], heading: float = 90.0, bank: float = 0.0) -> FloatArray:
    """Length [m] and side of each piece: +1 right, −1 left, 0 straight."""
    bends = np.array([(length, side / RADIUS) for length, side in pieces]).reshape(-1, 2)
    return lay_path(1_000.0, -2_000.0, heading * DEG, bends, TAS, bank, ROLL)


WINDING = ((5_000.0, 1.0), (8_000.0, 0.0), (9_000.0, -1.0), (7_000.0, 1.0))


def as_trajectory(*pieces: tuple[float, float]) -> Trajectory:
    segments: list[Segment] = []
    for length, side in pieces:
        if side == 0.0:
            segments.append(Straight(length=length))
        else:
            turn = RIGHT if side > 0.0 else LEFT
            segments.append(Arc(turn=turn, turn_angle=length / RADIUS, radius=RADIUS))
    return Trajectory(x=1_000.0, y=-2_000.0, heading=90.0 * DEG, tas=TAS, segments=tuple(segments))


@given(st.floats(0.0, 40_000.0))
def test_a_path_is_the_trajectory_of_its_pieces(s: float) -> None:
    x, y, heading = pose_on(lay(*WINDING), s)
    pose = as_trajectory(*WINDING).pose_at(s / TAS)
    assert (x, y) == pytest.approx((pose.x, pose.y), abs=1e-6)
    assert heading % (2.0 * pi) == pytest.approx(pose.heading)


def test_headings_are_counted_on_over_more_than_a_turn() -> None:
    path = lay((3.0 * pi * RADIUS, 1.0))
    assert pose_on(path, 1e6)[2] == pytest.approx(90.0 * DEG + 3.0 * pi)
    assert np.all(np.diff([heading_on(path, s) for s in np.linspace(0.0, 2e5, 200)]) >= 0.0)


@given(st.floats(500.0, 33_000.0), st.floats(-2_000.0, 2_000.0), st.floats(-1_500.0, 1_500.0))
def test_a_place_beside_the_path_is_found_on_it(s: float, right: float, wrong: float) -> None:
    path = lay(*WINDING)
    x, y, heading = pose_on(path, s)
    place = x + right * cos(heading), y - right * sin(heading)
    found, off = project(path, *place, s + wrong)
    fx, fy, _ = pose_on(path, found)
    # as near as what was to be found, if not nearer
    assert hypot(place[0] - fx, place[1] - fy) <= abs(right) + 1.0
    near = abs(wrong) < 300.0 and abs(right) < 500.0
    if near and min(abs(s - path[k, S]) for k in range(len(path))) > 1_000.0:
        assert found == pytest.approx(s, abs=0.1)
        assert off == pytest.approx(right, abs=0.1)


def test_before_its_start_and_behind_its_end_the_path_goes_on() -> None:
    path = lay((5_000.0, 0.0), (3_000.0, 1.0))
    x, y, heading = pose_on(path, -500.0)
    assert (x, y, heading) == pytest.approx((500.0, -2_000.0, 90.0 * DEG))
    end, later = pose_on(path, 8_000.0), pose_on(path, 1e5)
    assert later[2] == end[2]
    assert hypot(later[0] - end[0], later[1] - end[1]) == pytest.approx(92_000.0)


def numeric_rate(path: FloatArray, s: float) -> float:
    return (heading_on(path, s + 1.0) - heading_on(path, s - 1.0)) / 2.0


@pytest.mark.parametrize(("before", "after"), [(0.0, 1.0), (1.0, 0.0), (-1.0, 1.0), (0.0, -1.0)])
def test_the_heading_turns_as_an_aircraft_rolls(before: float, after: float) -> None:
    """Curvature goes from one piece's to the next's about the switch, at a constant rate."""
    path = lay((20_000.0, before), (20_000.0, after))
    half = 0.5 * TAS * abs(after - before) * BANK / (ROLL_SHARE * ROLL)
    assert path[1, RAMP] == pytest.approx(half)
    for share in (-1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5):
        way = min(max(0.5 * (share + 1.0), 0.0), 1.0)
        bend = (before + way * (after - before)) / RADIUS
        assert numeric_rate(path, 20_000.0 + share * half) == pytest.approx(bend, abs=1e-7)
    for s in (20_000.0 - half, 20_000.0 + half):
        assert heading_on(path, s) == pytest.approx(pose_on(path, s)[2])


def test_ramps_that_overlap_add_up() -> None:
    """A short turn, out of which it must roll before it has rolled in."""
    path = lay((20_000.0, 0.0), (300.0, 1.0))
    assert path[1, RAMP] > 300.0
    assert heading_on(path, 30_000.0) == pytest.approx(90.0 * DEG + 300.0 / RADIUS)
    middle = [heading_on(path, s) for s in np.linspace(18_000.0, 22_500.0, 300)]
    assert np.all(np.diff(middle) >= -1e-12)
    single = lay((20_000.0, 0.0), (20_000.0, 1.0)), lay((20_300.0, 0.0), (20_000.0, -1.0))
    for s in np.linspace(18_000.0, 22_000.0, 50):
        alone = sum(heading_on(one, s) - 90.0 * DEG for one in single)
        assert heading_on(path, s) - 90.0 * DEG == pytest.approx(alone, abs=1e-12)


def test_what_the_aircraft_does_at_the_start_is_no_ramp() -> None:
    assert lay((9_000.0, 1.0), bank=-0.3)[0, RAMP] == 0.0


def test_turning_left_over_counts_both_sides() -> None:
    path = lay(*WINDING)
    assert turning_after(path, 0.0) == pytest.approx(21_000.0 / RADIUS)
    assert turning_after(path, 4_000.0) == pytest.approx(17_000.0 / RADIUS)
    assert turning_after(path, 22_000.0) == pytest.approx(7_000.0 / RADIUS)
    assert turning_after(path, 1e6) == 0.0


@given(st.floats(0.0, 33_000.0), st.floats(100.0, 10_000.0))
def test_a_spliced_path_is_the_old_one_up_to_the_cut_and_then_the_new(
    s: float, lead: float
) -> None:
    path, cut = lay(*WINDING), s + lead
    bends = np.array([[4_000.0, -1.0 / RADIUS], [6_000.0, 0.0], [2_000.0, 1.0 / RADIUS]])
    spliced = splice(path, s, cut, bends, TAS, ROLL)
    for before in np.linspace(max(s - 4_000.0, 0.0), cut, 12):
        assert pose_on(spliced, before) == pytest.approx(pose_on(path, before), abs=1e-6)
    x, y, heading = pose_on(path, cut)
    new = lay_path(x, y, heading, bends, TAS, 0.0, ROLL)
    for after in np.linspace(0.0, 20_000.0, 12):
        assert pose_on(spliced, cut + after) == pytest.approx(pose_on(new, after), abs=1e-6)
    # ramps reach 2.2 km to either side: those of the old path near the aircraft are still there
    for place in np.linspace(max(s - 1_800.0, 0.0), cut, 20):
        if place < cut - 4_400.0:
            assert heading_on(spliced, place) == pytest.approx(heading_on(path, place), abs=1e-9)


@pytest.mark.parametrize("side", [-1.0, 0.0, 1.0])
def test_the_seam_of_a_splice_has_the_ramp_of_its_jump(side: float) -> None:
    path = lay((30_000.0, 1.0))
    spliced = splice(path, 5_000.0, 9_000.0, np.array([[9_000.0, side / RADIUS]]), TAS, ROLL)
    assert spliced[1, S] == pytest.approx(9_000.0)
    jump = (1.0 - side) * BANK
    assert spliced[1, RAMP] == pytest.approx(0.5 * TAS * jump / (ROLL_SHARE * ROLL))


def test_a_splice_forgets_what_lies_far_behind() -> None:
    path = lay(*((1_000.0, float(k % 2)) for k in range(30)))
    bends = np.array([[4_000.0, 1.0 / RADIUS]])
    spliced = splice(path, 25_000.0, 26_500.0, bends, TAS, ROLL)
    assert len(spliced) < 10
    assert spliced[0, S] <= 25_000.0 - 4_000.0
    assert np.all(np.diff(spliced[:, S]) >= 0.0)


@given(st.floats(0.0, 35_000.0), st.floats(0.0, 35_000.0))
def test_pieces_between_two_lengths_lead_from_one_to_the_other(one: float, other: float) -> None:
    path, (s, until) = lay(*WINDING), sorted((one, other))
    pieces = pieces_between(path, s, until)
    assert np.all(pieces[:, 0] >= 0.0)
    assert np.sum(pieces[:, 0]) == pytest.approx(until - s, abs=1e-6)
    x, y, heading = pose_on(path, s)
    again = lay_path(x, y, heading, pieces, TAS, 0.0, ROLL)
    assert pose_on(again, until - s) == pytest.approx(pose_on(path, until), abs=1e-6)


def test_rows_hold_where_each_piece_begins() -> None:
    path = lay(*WINDING)
    assert path[:, S] == pytest.approx([0.0, 5e3, 13e3, 22e3, 29e3])
    assert path[0, [X, Y, HEADING]] == pytest.approx([1_000.0, -2_000.0, 90.0 * DEG])
    assert path[:, CURVATURE] * RADIUS == pytest.approx([1.0, 0.0, -1.0, 1.0, 0.0])
    assert [row_at(path, s) for s in (-1.0, 0.0, 4_999.0, 5_000.0, 28e3, 1e9)] == [0, 0, 0, 1, 3, 4]


@pytest.mark.parametrize("side", [-1.0, 1.0])
@pytest.mark.parametrize("share", [-0.6, 0.4])
def test_far_beside_a_turn_the_place_next_to_it_is_still_found(side: float, share: float) -> None:
    """Six tenths of the radius outside, four inside, a kilometre from where it was expected."""
    path = lay((40_000.0, side))
    x, y, heading = pose_on(path, 15_000.0)
    right = side * share * RADIUS
    place = x + right * cos(heading), y - right * sin(heading)
    found, off = project(path, *place, 16_000.0)
    assert (found, off) == pytest.approx((15_000.0, right), abs=1.0)
