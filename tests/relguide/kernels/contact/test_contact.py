"""Contacts are tangent; boundary arcs keep their distance, whatever the leader does meanwhile."""

from math import acos, cos, hypot, inf, pi, sin

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from relguide.kernels.base.records import Contact, Disc, Pose, Scene
from relguide.kernels.contact.boundary_arc import (
    MAX_NODES,
    boundary_arc_arrival,
    boundary_arc_pieces,
)
from relguide.kernels.contact.chain import BOUNDARY_ARC
from relguide.kernels.contact.contact import (
    boundary_arc_rates,
    boundary_arc_sense,
    contact_at,
    contact_distance,
    contact_exists,
    contact_heading,
    disc_on,
    slide_within,
)
from relguide.kernels.contact.paths_to_contact import paths_to_contact
from relguide.kernels.contact.tangent import MAX_TANGENTS, Leg, tangent_contacts
from relguide.kernels.separation.clearance import fly_rate, leader_at
from relguide.kernels.words.extremals import MAX_ROWS
from tests.situations import headings, numbers

sides = st.sampled_from([1.0, -1.0])
turn_rates = numbers(-0.5, 0.5)


@given(bearing=headings, side=sides, alpha=numbers(0.3, 1.4))
def test_a_contact_is_tangent(bearing: float, side: float, alpha: float) -> None:
    assume(contact_exists(bearing, alpha))
    heading = contact_heading(bearing, side, alpha)
    vx, vy = cos(heading) - alpha, sin(heading)
    assert vx * cos(bearing) + vy * sin(bearing) == pytest.approx(0.0, abs=1e-7)
    assume(abs(alpha * cos(bearing)) < 0.999)
    around = vy * cos(bearing) - vx * sin(bearing)
    rates = boundary_arc_rates(bearing, Disc(alpha, 2.0, side, 0.0))
    assert rates[0] == pytest.approx(around / 2.0)


@given(bearing=headings, side=sides, alpha=numbers(0.3, 1.3), turning=turn_rates)
def test_a_boundary_arc_turns_as_fast_as_the_contact_heading_does(
    bearing: float, side: float, alpha: float, turning: float
) -> None:
    assume(abs(alpha * cos(bearing)) < 0.99)
    round_it, rate = boundary_arc_rates(bearing, Disc(alpha, 2.0, side, turning))
    step = 1e-6
    turned = contact_heading(bearing + round_it * step, side, alpha)
    turned -= contact_heading(bearing - round_it * step, side, alpha)
    assert rate == pytest.approx(turning + turned / (2.0 * step), abs=1e-4)


@given(bearing=headings, side=sides, alpha=numbers(0.3, 0.95), turning=turn_rates)
def test_a_boundary_arc_takes_as_long_as_its_rate_says(
    bearing: float, side: float, alpha: float, turning: float
) -> None:
    disc = Disc(alpha, 3.0, side, turning)
    sense = boundary_arc_sense(bearing, disc)
    assume(sense != 0.0)
    goal = bearing + 0.3 * sense
    reached, took = slide_within(bearing, goal, disc, inf)
    assume(took < inf)
    assert reached == goal
    b, steps = bearing, 4_000
    for _ in range(steps):  # the midpoint rule, as something else than Simpson's
        half = b + 0.5 * took / steps * boundary_arc_rates(b, disc)[0]
        b += took / steps * boundary_arc_rates(half, disc)[0]
    assert b == pytest.approx(goal, abs=1e-5)
    # with half the time, about half the way
    reached, took_half = slide_within(bearing, goal, disc, 0.5 * took)
    assert took_half == 0.5 * took
    assert 0.0 < (reached - bearing) * sense < 0.3


LEADER = np.array(
    [[0.0, 0.0, 0.0, 0.4, 0.0], [2.0, 0.0, 0.0, 0.4, -0.3], [4.0, 0.0, 0.0, 0.0, 0.0]]
)
"""Straight, a right turn, straight again; the rows' poses are filled in below."""


def flown_leader(alpha: float) -> np.ndarray:
    leader = LEADER.copy()
    for i in (1, 2):
        leader[i, 1:4] = leader_at(Scene(leader, alpha, 0.0, 0.0), i - 1, leader[i, 0])
    return leader


@given(bearing=headings, side=sides, alpha=numbers(0.4, 1.2), length=numbers(0.2, 2.5))
def test_the_arcs_of_a_boundary_arc_keep_their_distance(
    bearing: float, side: float, alpha: float, length: float
) -> None:
    scene, begin = Scene(flown_leader(alpha), alpha, 3.0, 0.0), 1.0
    assume(contact_exists(bearing, alpha))
    sense = boundary_arc_sense(bearing, disc_on(scene, 0, side))
    goal = bearing + sense * length
    arrival = boundary_arc_arrival(scene, begin, bearing, goal, side, 0)
    assume(sense != 0.0 and arrival < inf)
    pose = contact_at(scene, begin, bearing, side)
    arcs = np.empty((2 * MAX_NODES, 2))
    leg = np.array([BOUNDARY_ARC, side, bearing, goal, 0.0, 0.0])
    n, (ex, ey, eh), et = boundary_arc_pieces(pose, begin, begin, scene, leg, arcs)
    # round a faster leader, begun where it can hardly be touched, it is less exact
    loose = 10.0 if alpha > 1.0 else 1.0
    assert et == pytest.approx(arrival, abs=loose * 1e-4)
    gx, gy, gh = contact_at(scene, et, goal, side)
    assert hypot(ex - gx, ey - gy) < loose * 1e-5
    assert cos(eh - gh) > 1.0 - 1e-12
    t = begin
    for duration, rate in arcs[:n]:
        assert abs(rate) < 1.0 + 1e-3
        for part in (0.5, 1.0):
            px, py, _ = fly_rate(pose, rate, part * duration)
            i = int(np.searchsorted(scene.leader[:, 0], t + part * duration, side="right")) - 1
            lx, ly, _ = leader_at(scene, i, t + part * duration)
            assert hypot(px - lx, py - ly) == pytest.approx(contact_distance(3.0), abs=1e-6)
        pose = fly_rate(pose, rate, duration)
        t += duration


def test_a_boundary_arc_may_come_back_to_a_bearing_once_the_leader_turns() -> None:
    """Straight the leader is passed counter-clockwise; turning left he brings what is beside him
    back. The same bearing is reached twice, and the leader's piece says which time is meant.
    """
    alpha, side = 0.4, 1.0
    leader = np.array([[0.0, 0.0, 0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0, 0.5]])
    leader[1, 1] = alpha
    scene = Scene(np.vstack([leader, [5.0, 0.0, 0.0, 2.0, 0.0]]), alpha, 3.0, 0.0)
    scene.leader[2, 1:4] = leader_at(scene, 1, 5.0)
    begun, goal = 3.4, 3.5
    passed = boundary_arc_arrival(scene, 0.0, begun, goal, side, 0)
    again = boundary_arc_arrival(scene, 0.0, begun, goal, side, 1)
    assert 0.0 < passed < 1.0 < again < 5.0
    # on the final leg it is passed once more
    assert 5.0 < boundary_arc_arrival(scene, 0.0, begun, goal, side, 2) < inf
    arcs, leg = np.empty((2 * MAX_NODES, 2)), np.array([BOUNDARY_ARC, side, begun, goal, 1.0, 0.0])
    n, (ex, ey, eh), t = boundary_arc_pieces(
        contact_at(scene, 0.0, begun, side), 0.0, 0.0, scene, leg, arcs
    )
    assert n > 0
    assert t == pytest.approx(again, abs=1e-4)
    gx, gy, gh = contact_at(scene, t, goal, side)
    assert hypot(ex - gx, ey - gy) < 1e-5
    assert cos(eh - gh) > 1.0 - 1e-12


def test_where_the_leader_is_faster_some_bearings_cannot_be_touched() -> None:
    assert not contact_exists(0.0, 1.2)
    assert contact_exists(acos(1.0 / 1.2) + 1e-9, 1.2)
    assert boundary_arc_sense(0.0, Disc(1.2, 2.0, 1.0, 0.0)) == 0.0


def test_tangent_contacts_touch() -> None:
    found = np.empty((32, 3))
    n = tangent_contacts(Pose(6.0, 1.0, 2.5), Leg(0.8, 0.0, 0.0, inf), 2.0, found)
    assert n >= 2
    for bearing, side, time in found[:n]:
        assert 0.0 <= bearing < 2.0 * pi
        assert side in (1.0, -1.0)
        assert time > 0.0


@pytest.mark.parametrize("turning", [0.4, -0.8])
def test_tangent_contacts_are_reached_while_the_leader_turns(turning: float) -> None:
    rng = np.random.default_rng(3)
    leader = np.array([[0.0, 0.0, 0.0, 0.0, turning], [3.0, 2.0, 1.0, 3.0 * turning, 0.0]])
    scene = Scene(leader, 0.8, 2.0, 0.0)
    leg, distance = Leg(0.8, turning, 0.0, 3.0), contact_distance(2.0)
    found, rows, seen = np.empty((MAX_TANGENTS, 3)), np.empty((MAX_ROWS, 5)), 0
    for _ in range(20):
        away, around, heading = rng.uniform(2.1, 5.0), *rng.uniform(0.0, 2.0 * pi, 2)
        start = Pose(away * cos(around), away * sin(around), heading)
        for bearing, side, time in found[: tangent_contacts(start, leg, distance, found)]:
            assert 0.0 <= time <= 3.0
            # beside it the word has a last turn, which vanishes in it
            times = []
            for beside in (-1e-6, 1e-6):
                contact = Contact(0, bearing + beside, side)
                n = paths_to_contact(start, 0.0, scene, contact, inf, rows)
                times += rows[:n, 0].tolist()
            assert min(abs(reached - time) for reached in times) < 1e-4
            seen += 1
    assert seen > 10
