"""A turn and a straight that touches d = d_min: solved for, and found by a scan of the turn."""

from math import cos, hypot, inf, pi, sin

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.base.records import Contact, Pose, Scene
from relguide.kernels.contact.contact import contact_at, contact_distance
from relguide.kernels.contact.tangent import MAX_TANGENTS, straight_touches
from relguide.kernels.contact.touch_straight import touch_straight
from relguide.kernels.separation.clearance import leader_at
from relguide.kernels.words.extremals import SIGNS, fly_piece
from tests.situations import headings, numbers

ALPHA, D_MIN, BEGUN, LASTS = 0.7, 1.2, 0.5, 4.0


def scene_with(rate: float) -> Scene:
    """A leader that keeps one turn rate for a while, then heads on."""
    leader = np.zeros((2, 5))
    leader[0, 1], leader[0, 4], leader[1, 0] = 2.0, rate, BEGUN + LASTS
    leader[1, 1:4] = leader_at(Scene(leader, ALPHA, D_MIN, 0.0), 0, BEGUN + LASTS)
    return Scene(leader, ALPHA, D_MIN, 0.0)


@given(
    x=numbers(-4.0, 8.0), y=numbers(-6.0, 6.0), h=headings, turn=st.sampled_from([1.0, -1.0]),
    off=numbers(-0.02, 0.02), rate=st.sampled_from([-0.9, -0.4, 0.0, 0.7]),
)  # fmt: skip
def test_a_straight_that_touches_is_found_from_nearby_and_touches(
    x: float, y: float, h: float, turn: float, off: float, rate: float
) -> None:
    scene, start = scene_with(rate), Pose(x, y, h)
    found, row = np.empty((MAX_TANGENTS, 3)), np.empty(5)
    for touch in found[: straight_touches(start, BEGUN, scene, 0, turn, found)]:
        bearing, side, time = touch[0], touch[1], BEGUN + touch[2]
        # exactly there, and from a little beside
        at, when = touch_straight(start, BEGUN, scene, Contact(0, bearing, side), turn, row)
        if when == inf or abs(when - time) > 1e-6:
            continue  # another one, where two lie close together
        beside = Contact(0, bearing + off, side)
        again, then = touch_straight(start, BEGUN, scene, beside, turn, row)
        if abs(then - when) < 1e-3:
            assert (again, then) == pytest.approx((at, when), abs=1e-8)
        assert abs(wrap_signed(at - bearing)) < 1e-5
        touch_straight(start, BEGUN, scene, Contact(0, bearing, side), turn, row)
        end = start
        for sign, amount in zip(SIGNS[int(row[1])], row[2:5], strict=True):
            end = fly_piece(end, sign, amount)
        there = contact_at(scene, when, at, side)
        assert row[0] == when
        assert row[2:5].sum() == pytest.approx(when - BEGUN, abs=1e-10)
        assert row[4] == 0.0
        assert hypot(end.x - there.x, end.y - there.y) < 1e-10
        assert cos(end.h - there.h) > 1.0 - 1e-12
        # it touches: there it neither comes nearer nor goes away
        leader = leader_at(scene, 0, when)
        dx, dy = end.x - leader.x, end.y - leader.y
        closing = dx * (cos(end.h) - ALPHA * cos(leader.h)) + dy * (
            sin(end.h) - ALPHA * sin(leader.h)
        )
        assert hypot(dx, dy) == pytest.approx(contact_distance(D_MIN), abs=1e-10)
        assert closing == pytest.approx(0.0, abs=1e-9)


def test_most_of_them_are_met_by_newtons_method() -> None:
    rng, row, met, all_of_them = np.random.default_rng(5), np.empty(5), 0, 0
    for _ in range(1500):
        scene = scene_with(float(rng.choice([-0.9, 0.0, 0.7])))
        start = Pose(*rng.uniform(-4.0, 8.0, 2), rng.uniform(-3.0, 3.0))
        found = np.empty((MAX_TANGENTS, 3))
        for bearing, side, since in found[: straight_touches(start, BEGUN, scene, 0, 1.0, found)]:
            near = Contact(0, bearing + 0.02, side)
            _, time = touch_straight(start, BEGUN, scene, near, 1.0, row)
            met += abs(time - BEGUN - since) < 1e-6
            all_of_them += 1
    assert all_of_them > 100
    assert met > 0.9 * all_of_them


def test_a_straight_that_comes_after_the_leaders_piece_is_not_one() -> None:
    scene, row = scene_with(0.7), np.empty(5)
    far = Pose(-60.0, 0.0, 0.0)
    for bearing in np.linspace(0.0, 6.0, 13):
        for side in (1.0, -1.0):
            _, time = touch_straight(far, BEGUN, scene, Contact(0, bearing, side), 1.0, row)
            assert time == inf


def test_a_touch_far_away_is_solved_for_behind_a_leader_hardly_slower() -> None:
    """Guesses of its time, each from the last one, came nearer too slowly."""
    scene, start, row = Scene(np.zeros((1, 5)), 0.97, D_MIN, 0.0), Pose(-2.0, 3.0, pi), np.empty(5)
    found = np.empty((MAX_TANGENTS, 3))
    far = found[: straight_touches(start, 0.0, scene, 0, 1.0, found)]
    assert far[:, 2].max() > 20.0
    for bearing, side, time in far:
        _, then = touch_straight(start, 0.0, scene, Contact(0, bearing, side), 1.0, row)
        assert then == pytest.approx(time, abs=1e-6)
