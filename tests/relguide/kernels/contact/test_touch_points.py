"""Contacts by themselves: what touches the disc touches it, on its side, and no sooner."""

from math import cos, hypot, isnan, pi, sin

import numpy as np
import pytest

from relguide.kernels.base.records import Disc, Pose
from relguide.kernels.contact.contact import contact_heading
from relguide.kernels.contact.touch_points import (
    boundary_arc_end,
    next_contact,
    straight_tangents,
    turn_tangent,
)
from relguide.kernels.words.extremals import fly_piece

ALPHA, DISTANCE = 0.8, 2.0
SAME = 1e-9  # ≈ 1e-5 m at R = 12 km


def draw_pose(rng: np.random.Generator) -> Pose:
    """Somewhere outside of the disc, seen from the leader."""
    away, bearing, h = rng.uniform(2.1, 9.0), rng.uniform(0.0, 2 * pi), rng.uniform(0.0, 2 * pi)
    return Pose(away * cos(bearing), away * sin(bearing), float(h))


def disc(side: float) -> Disc:
    """The disc, passed on this side."""
    return Disc(ALPHA, DISTANCE, side, 0.0)


def fly_pieces(start: Pose, *pieces: tuple[float, float]) -> np.ndarray:
    """Where pieces of a sign and an amount end, seen from the leader, and the heading there."""
    end = start
    for sign, amount in pieces:
        end = fly_piece(end, sign, amount)
    return np.array((end.x - ALPHA * sum(amount for _, amount in pieces), end.y, end.h))


def touches(end: np.ndarray, bearing: float, side: float) -> None:
    """At the contact of a bearing, tangent to the disc, on its side."""
    assert end[:2] == pytest.approx((DISTANCE * cos(bearing), DISTANCE * sin(bearing)), abs=SAME)
    turned = end[2] - contact_heading(bearing, side, ALPHA)
    assert cos(turned) == pytest.approx(1.0, abs=SAME)


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_turn_and_a_straight_end_in_the_contact(sign: float, side: float) -> None:
    rng = np.random.default_rng(1)
    contacts, seen = np.empty((4, 3)), 0
    for _ in range(200):
        start = draw_pose(rng)
        for k in range(straight_tangents(start, disc(side), sign, contacts)):
            bearing, turn, straight = contacts[k].tolist()
            touches(fly_pieces(start, (sign, turn), (0.0, straight)), bearing, side)
            seen += 1
    assert seen > 150


def test_next_to_the_disc_hardly_any_tangent_is_overlooked() -> None:
    rng = np.random.default_rng(4)
    turns, contacts = np.linspace(0.0, 2.0 * pi, 20001), np.empty((4, 3))
    overlooked = seen = 0
    for _ in range(1500):
        distance, alpha = rng.uniform(0.3, 4.0), rng.uniform(0.5, 0.99)
        h = rng.uniform(0.0, 2.0 * pi)
        away = distance * (1.0 + 10.0 ** rng.uniform(-5.0, -0.5))
        bearing = rng.uniform(0.0, 2.0 * pi)
        px, py = away * cos(bearing), away * sin(bearing)
        sign, side = rng.choice((1.0, -1.0)), rng.choice((1.0, -1.0))
        # every turn of a fine grid, and the straight on from it
        heading = h + sign * turns
        qx = px + sign * (np.sin(heading) - sin(h)) - alpha * turns
        qy = py - sign * (np.cos(heading) - cos(h))
        vx, vy = np.cos(heading) - alpha, np.sin(heading)
        miss = qx * vy - qy * vx - side * distance * np.hypot(vx, vy)
        ahead = -(qx * vx + qy * vy) / (vx * vx + vy * vy)
        there = ((miss[1:] < 0.0) != (miss[:-1] < 0.0)) & (ahead[:-1] > 1e-6)
        n = straight_tangents(Pose(px, py, h), Disc(alpha, distance, side, 0.0), sign, contacts)
        overlooked += abs(there.sum() - np.sum(contacts[:n, 2] > 1e-6))
        seen += there.sum()
    assert seen > 1000
    assert overlooked < 0.01 * seen


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_two_turns_end_in_the_contact(sign: float, side: float) -> None:
    rng = np.random.default_rng(2)
    seen = 0
    for _ in range(300):
        start = draw_pose(rng)
        guess = rng.uniform(0.3, 5.0, 2).tolist()
        bearing, first, second = turn_tangent(start, disc(side), sign, *guess)
        if isnan(first):
            continue
        touches(fly_pieces(start, (sign, first), (-sign, second)), bearing, side)
        seen += 1
    assert seen > 15


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_where_a_boundary_arc_ends_a_straight_and_a_turn_lead_to_the_slot(side: float) -> None:
    slot = 2.9
    bearing, straight, turn = boundary_arc_end(slot, 0.0, disc(side))
    course = contact_heading(bearing, side, ALPHA)
    start = Pose(DISTANCE * cos(bearing), DISTANCE * sin(bearing), course)
    x, y, h = fly_pieces(start, (0.0, straight), (side, turn))
    assert hypot(x + slot, y) < SAME
    assert cos(h) == pytest.approx(1.0, abs=SAME)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_the_next_contact_is_another_on_the_same_side(side: float) -> None:
    contact, seen = np.empty(3), 0
    for bearing in np.linspace(0.0, 2.0 * pi, 90, endpoint=False).tolist():
        course = contact_heading(bearing, side, ALPHA)
        if not next_contact(bearing, disc(side), course, contact):
            continue
        there, turn, straight = contact.tolist()
        start = Pose(DISTANCE * cos(bearing), DISTANCE * sin(bearing), course)
        touches(fly_pieces(start, (side, turn), (0.0, straight)), there, side)
        assert turn > 0.01
        seen += 1
    assert seen > 3
