"""From contact to contact behind a straight leader: nobody who keeps d_min is sooner than said."""

from collections.abc import Iterator
from math import atan2, cos, hypot, inf, pi, radians, sin

import numpy as np
import pytest
from numba import njit

from relguide.kernels.base.angles import wrap
from relguide.kernels.base.records import Pose, Scene, Velocity, Window
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.cells import Cell
from relguide.kernels.bounds.hop import hop_bound, hops_within, standing, turned_round
from relguide.kernels.bounds.junction import slide_turns
from relguide.kernels.bounds.round_time import round_most, round_time, times_round
from relguide.kernels.bounds.side_change import cannot_change_sides
from relguide.kernels.bounds.tight_contact import LONGEST, tight_excess
from relguide.kernels.contact.contact import contact_heading, to_frame_of
from relguide.kernels.words.extremals import MAX_ROWS, SIGNS, fly_piece, solve_toward
from tests.costates import with_costate

SLACK = 1e-6
ENOUGH = 3.0


def straight(alpha: float, d_min: float) -> Scene:
    """A leader that begins at the origin and keeps straight along the x axis."""
    return Scene(np.array([[0.0, 0.0, 0.0, 0.0, 0.0]]), alpha, d_min, 0.0)


def pose_at(scene: Scene, bearing: float, side: float) -> Pose:
    """A contact at t = 0."""
    heading = contact_heading(bearing, side, scene.alpha)
    return Pose(scene.d_min * cos(bearing), scene.d_min * sin(bearing), heading)


def words_between(scene: Scene, begin: Pose, end: Pose) -> FloatArray:
    """Words that some costate fits, from a contact to another one, which moves with the leader."""
    rows, seen = np.empty((MAX_ROWS, 5)), to_frame_of(begin, end)
    toward = Velocity(scene.alpha * cos(end.h), -scene.alpha * sin(end.h))
    n = solve_toward(seen._replace(h=seen.h % (2.0 * pi)), toward, 0.0, rows)
    return with_costate(rows[:n])


@njit(nogil=True)
def unrolled(pose: Pose, row: FloatArray, alpha: float, d_min: float) -> float:
    """How far a word goes round the leader, counter-clockwise; NaN if it does not keep d_min."""
    t, went, before = 0.0, 0.0, atan2(pose.y, pose.x)
    for k in range(3):
        sign, amount = SIGNS[int(row[1]), k], row[2 + k]
        for i in range(1, 201):
            along = amount * i / 200
            at = fly_piece(pose, sign, along)
            x = at.x - alpha * (t + along)
            if hypot(x, at.y) < d_min - 1e-9:
                return np.nan
            bearing = atan2(at.y, x)
            went += wrap(bearing - before + pi) - pi
            before = bearing
        pose = fly_piece(pose, sign, amount)
        t += amount
    return went


def scenes(seed: int, tight: bool) -> Iterator[tuple[Scene, np.random.Generator]]:
    """Leaders whom a pursuer can slide round, nearly everywhere or everywhere."""
    rng = np.random.default_rng(seed)
    while True:
        alpha = rng.uniform(0.3, 0.97)
        steepest = (1.0 + alpha) ** 2
        d_min = rng.uniform(1.02, 0.98 * steepest) if tight else steepest * rng.uniform(1.0, 1.4)
        yield straight(alpha, d_min), rng


def tight_bearing(scene: Scene, rng: np.random.Generator) -> float:
    """Where nobody can slide counter-clockwise."""
    while True:
        bearing = rng.uniform(0.0, pi)
        if slide_turns(scene, standing(0, 1.0, bearing, 0.0))[0] > 1.01:
            return bearing


def some_cell(bearing: float, side: float, rng: np.random.Generator) -> Cell:
    """A cell that holds a contact, within its quadrant."""
    half = 10.0 ** rng.uniform(-6.0, -2.0)
    low = np.floor(bearing / (0.5 * pi)) * 0.5 * pi
    middle = min(max(bearing + half * rng.uniform(-1.0, 1.0), low + half), low + 0.5 * pi - half)
    return standing(0, side, middle, half)


@pytest.mark.parametrize("last", [True, False])
def test_no_path_to_a_tight_contact_or_from_one_is_longer_round_by_less(last: bool) -> None:
    found, raised = 0, 0
    for scene, rng in scenes(5 if last else 6, True):
        bearing = tight_bearing(scene, rng)
        side, other_side = rng.choice([1.0, -1.0]), rng.choice([1.0, 1.0, -1.0])
        cell = some_cell(side * bearing, side, rng)
        excess = tight_excess(scene, times_round(scene.alpha, scene.d_min), cell, last, ENOUGH)
        table = times_round(scene.alpha, scene.d_min)
        tight = pose_at(scene, side * bearing, side)
        for _ in range(60):
            # mostly from a little before it, or to a little after it
            before = rng.uniform(-0.4, 2.5) * side * (1.0 if last else -1.0)
            elsewhere = wrap(side * bearing - before + pi) - pi
            other = pose_at(scene, elsewhere, side * other_side)
            begin, end = (other, tight) if last else (tight, other)
            for row in words_between(scene, begin, end):
                went = unrolled(begin, row, scene.alpha, scene.d_min)
                if np.isnan(went) or row[0] >= LONGEST or row[0] < 1e-3:
                    continue
                # mirrored, if it is clockwise
                at = side * atan2(begin.y, begin.x)
                around = abs(went)
                if side * went >= 0.0:
                    took = round_most(table, at, around)
                else:
                    to = wrap(at - around + pi) - pi
                    took = -round_most(table, to, around)
                found += 1
                raised += excess > 1e-3
                assert row[0] - took >= excess - SLACK * (1.0 + table[0, -1])
        if found > 500 and raised > 150:
            return


def test_leaving_the_circle_straight_comes_as_near_to_a_tight_contact_as_is_said() -> None:
    scene = straight(0.6568746823392786, 2.043434249423992)
    table = times_round(scene.alpha, scene.d_min)
    for bearing, expected in ((radians(55.5), 0.0034), (radians(64.0), 0.0318)):
        said = tight_excess(scene, table, standing(0, 1.0, bearing, 1e-6), True, ENOUGH)
        least = inf
        for p in np.linspace(0.0, 0.7, 4_000):
            begin, end = pose_at(scene, p, 1.0), pose_at(scene, bearing, 1.0)
            took = round_time(table, 0, bearing) - round_time(table, 0, p)
            for row in words_between(scene, begin, end):
                if row[0] - took < least and not np.isnan(
                    unrolled(begin, row, scene.alpha, scene.d_min)
                ):
                    least = row[0] - took
        assert least - 2e-3 < said <= least
        assert said == pytest.approx(expected, abs=3e-4)


def test_flown_back_and_mirrored_a_hop_is_a_hop() -> None:
    scene = straight(0.7, 2.0)
    rng = np.random.default_rng(7)
    window = Window(0.0, 6.2)
    for _ in range(100):
        cell, other = (
            standing(0, rng.choice([1.0, -1.0]), rng.uniform(-pi, pi), 1e-9) for _ in range(2)
        )
        begin = pose_at(scene, cell.bearing, cell.side)
        end = pose_at(scene, other.bearing, other.side)
        back = [pose_at(scene, each.bearing, each.side) for each in
                (turned_round(other), turned_round(cell))]  # fmt: skip
        times = [sorted(words_between(scene, *pair)[:, 0]) for pair in ((begin, end), back)]
        assert np.allclose(*times, atol=1e-6)
        least = hop_bound(scene, cell, other, window)
        assert least >= times[0][0] - 1e-4
        assert hops_within(scene, cell, other, window) <= (least < window.beat)


def test_nobody_changes_sides_sooner_than_is_said() -> None:
    found = 0
    for scene, rng in scenes(8, False):
        table, side = times_round(scene.alpha, scene.d_min), rng.choice([1.0, -1.0])
        for _ in range(30):
            first, last = rng.uniform(-pi, pi, 2)
            begin, end = pose_at(scene, first, -side), pose_at(scene, last, side)
            for row in words_between(scene, begin, end):
                if row[0] > 12.0 or np.isnan(unrolled(begin, row, scene.alpha, scene.d_min)):
                    continue
                cell, other = some_cell(first, -side, rng), some_cell(last, side, rng)
                found += 1
                assert not cannot_change_sides(scene, table, cell, other, row[0] * (1.0 + 1e-6))
        if found > 200:
            return


def test_who_passes_ahead_clockwise_is_long_before_it_comes_round_behind() -> None:
    scene = straight(0.6548544682552312, 3.3264926568360593)
    table = times_round(scene.alpha, scene.d_min)
    first, last = standing(0, -1.0, radians(7.87), 3e-3), standing(0, 1.0, radians(148.0), 3e-3)
    assert cannot_change_sides(scene, table, first, last, 6.88)
    assert not cannot_change_sides(scene, table, first, last, 7.6)
