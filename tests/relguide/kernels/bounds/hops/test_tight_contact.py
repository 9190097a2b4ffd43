"""From contact to contact behind a straight leader: nobody who keeps d_min is sooner than said."""

from math import atan2, inf, pi, radians

import numpy as np
import pytest

from relguide.kernels.base.angles import wrap
from relguide.kernels.base.records import Scene, Window
from relguide.kernels.base.roots import FloatArray
from relguide.kernels.bounds.fronts.around import round_most, round_time, times_round
from relguide.kernels.bounds.hops.hop import hop_bound, hops_within, standing, turned_round
from relguide.kernels.bounds.hops.tight_contact import LONGEST, tight_excess
from relguide.kernels.bounds.words.junction import slide_turns
from tests.straight_contacts import pose_at, scenes, some_cell, straight, unrolled, words_between

SLACK = 1e-6
ENOUGH = 3.0


def tight_bearing(scene: Scene, rng: np.random.Generator) -> float:
    """Where nobody can slide counter-clockwise."""
    while True:
        bearing = rng.uniform(0.0, pi)
        if slide_turns(scene, standing(0, 1.0, bearing, 0.0))[0] > 1.01:
            return bearing


@pytest.mark.parametrize("last", [True, False])
def test_no_path_to_a_tight_contact_or_from_one_is_longer_round_by_less(last: bool) -> None:
    found, raised = 0, 0
    for scene, rng in scenes(5 if last else 6, True):
        bearing = tight_bearing(scene, rng)
        side, other_side = rng.choice([1.0, -1.0]), rng.choice([1.0, 1.0, -1.0])
        cell = some_cell(side * bearing, side, rng)
        table, longest = times_round(scene.alpha, scene.d_min), rng.choice([LONGEST, 3.0, 1.0])
        excess = tight_excess(scene, table, cell, last, ENOUGH, longest)
        tight = pose_at(scene, side * bearing, side)
        for _ in range(60):
            # mostly from a little before it, or to a little after it
            before = rng.uniform(-0.4, 2.5) * side * (1.0 if last else -1.0)
            elsewhere = wrap(side * bearing - before + pi) - pi
            other = pose_at(scene, elsewhere, side * other_side)
            begin, end = (other, tight) if last else (tight, other)
            for row in words_between(scene, begin, end):
                went = unrolled(begin, row, scene.alpha, scene.d_min)
                if np.isnan(went) or row[0] >= longest or row[0] < 1e-3:
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


def least_excess(scene: Scene, table: FloatArray, bearing: float) -> float:
    """The least of all words to a contact that passes counter-clockwise, from many before it."""
    least = inf
    for p in np.linspace(0.0, bearing - 0.2, 4_000):
        begin, end = pose_at(scene, p, 1.0), pose_at(scene, bearing, 1.0)
        took = round_time(table, 0, bearing) - round_time(table, 0, p)
        for row in words_between(scene, begin, end):
            if row[0] - took < least and not np.isnan(
                unrolled(begin, row, scene.alpha, scene.d_min)
            ):
                least = row[0] - took
    return least


@pytest.mark.parametrize(
    ("alpha", "d_min", "bearing", "expected"),
    [
        (0.6568746823392786, 2.043434249423992, 55.5, 0.0034),
        (0.6568746823392786, 2.043434249423992, 64.0, 0.0318),
        (0.6602820237793915, 2.570147364974542, 84.34, 0.0053),
    ],
)
def test_leaving_the_circle_straight_comes_as_near_to_a_tight_contact_as_is_said(
    alpha: float, d_min: float, bearing: float, expected: float
) -> None:
    scene = straight(alpha, d_min)
    table = times_round(scene.alpha, scene.d_min)
    least = least_excess(scene, table, radians(bearing))
    assert least == pytest.approx(expected, abs=3e-4)
    said = tight_excess(scene, table, standing(0, 1.0, radians(bearing), 1e-6), True, ENOUGH, inf)
    assert least - 2e-3 < said <= least
    # no bearing of a cell that begins there comes nearer, and all of it is known nearly as well
    for half in (3e-4, 1e-3):
        cell = standing(0, 1.0, radians(bearing) + half, half)
        assert 0.7 * said < tight_excess(scene, table, cell, True, ENOUGH, inf) <= least


def test_words_that_come_through_the_disc_lead_to_no_contact() -> None:
    """They would be no longer than round it, to contacts far round that are passed either way."""
    scene, bearing, least = straight(0.965, 3.609), 1.3831, inf
    table, begin = times_round(scene.alpha, scene.d_min), pose_at(scene, bearing, 1.0)
    for ahead in np.linspace(0.1, 6.2, 1_500):
        other = wrap(bearing + ahead + pi) - pi
        for side in (1.0, -1.0):
            for row in words_between(scene, begin, pose_at(scene, other, side)):
                went = unrolled(begin, row, scene.alpha, scene.d_min)
                if row[0] < LONGEST and went > 0.0:
                    least = min(least, row[0] - round_most(table, bearing, went))
    said = tight_excess(scene, table, standing(0, 1.0, bearing, 1e-6), False, ENOUGH, inf)
    assert least == pytest.approx(0.063, abs=1e-3)
    assert least - 1e-3 < said <= least + SLACK


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
