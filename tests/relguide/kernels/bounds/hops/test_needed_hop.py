"""No path that must hop, or go past a bearing, is sooner than is said."""

from itertools import pairwise
from math import cos, inf, pi, radians, sin

import numpy as np
import pytest

from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.bounds.fronts.around import times_round
from relguide.kernels.bounds.hops.hop import standing
from relguide.kernels.bounds.hops.needed_hop import hop_is_late, needs_hop, passes_late
from tests.straight_contacts import pose_at, scenes, some_cell, straight, unrolled, words_between

MARGIN = 1.0 + 1e-6


def fly(scene: Scene, stops: list[Pose], rng: np.random.Generator) -> tuple[float, float]:
    """How long a path takes from stop to stop that keeps clear, and how far round it goes."""
    took, went = 0.0, 0.0
    for begin, end in pairwise(stops):
        rows = words_between(scene, begin, end)
        flown = [(row[0], unrolled(begin, row, scene.alpha, scene.d_min)) for row in rows]
        clear = [each for each in flown if not np.isnan(each[1])]
        if not clear:
            return inf, 0.0
        time, swept = clear[rng.integers(len(clear))]
        took, went = took + time, went + swept
    return took, went


def test_nobody_changes_sides_sooner_than_is_said() -> None:
    found, twice = 0, 0
    for scene, rng in scenes(8, False):
        table, side = times_round(scene.alpha, scene.d_min), rng.choice([1.0, -1.0])
        for _ in range(30):
            # from one to the other, or by way of another contact on either side
            first, between, last = rng.uniform(-pi, pi, 3)
            stops = [pose_at(scene, first, -side), pose_at(scene, last, side)]
            if rng.random() < 0.7:
                stops.insert(1, pose_at(scene, between, rng.choice([side, -side])))
            took, _ = fly(scene, stops, rng)
            if took > 12.0:
                continue
            cell, other = some_cell(first, -side, rng), some_cell(last, side, rng)
            found, twice = found + 1, twice + (len(stops) == 3)
            assert not hop_is_late(scene, table, cell, other, 0, took * MARGIN)
        if found > 200 and twice > 80:
            return


def test_nobody_goes_the_other_way_sooner_than_is_said() -> None:
    found, twice = 0, 0
    for scene, rng in scenes(11, False):
        table, side = times_round(scene.alpha, scene.d_min), rng.choice([1.0, -1.0])
        way = 1 if side > 0.0 else 0
        for _ in range(30):
            first, between, last = rng.uniform(-pi, pi, 3)
            stops = [pose_at(scene, first, side), pose_at(scene, last, side)]
            if rng.random() < 0.7:
                stops.insert(1, pose_at(scene, between, rng.choice([side, -side])))
            took, went = fly(scene, stops, rng)
            cell, other = some_cell(first, side, rng), some_cell(last, side, rng)
            if took > 15.0 or side * went > -0.1 or not needs_hop(scene, cell, other, way):
                continue
            found, twice = found + 1, twice + (len(stops) == 3)
            assert not hop_is_late(scene, table, cell, other, way, took * MARGIN)
        if found > 100 and twice > 40:
            return


def test_who_passes_ahead_clockwise_is_long_before_it_comes_round_behind() -> None:
    scene = straight(0.6548544682552312, 3.3264926568360593)
    table = times_round(scene.alpha, scene.d_min)
    first, last = standing(0, -1.0, radians(7.87), 3e-3), standing(0, 1.0, radians(148.0), 3e-3)
    assert hop_is_late(scene, table, first, last, 0, 6.88)
    assert not hop_is_late(scene, table, first, last, 0, 7.6)


def test_to_come_round_the_other_way_takes_longer_than_the_soonest_word() -> None:
    scene = straight(0.919, 2.17)
    table = times_round(scene.alpha, scene.d_min)
    first, last = (standing(0, -1.0, radians(b), 1e-6) for b in (32.78, -166.91))
    soonest = words_between(
        scene, pose_at(scene, first.bearing, -1.0), pose_at(scene, last.bearing, -1.0)
    )[0, 0]
    # all words between them come through the disc; by way of a contact of the other side it takes
    # 4.96 more than the soonest of these
    assert hop_is_late(scene, table, first, last, 0, soonest + 3.0)
    assert not hop_is_late(scene, table, first, last, 0, soonest + 4.96)


def test_who_can_slide_needs_no_hop() -> None:
    tight, wide = straight(0.8, 2.9), straight(0.8, 3.3)
    ahead, behind, near = (standing(0, 1.0, radians(b), 1e-3) for b in (20.0, 160.0, 20.05))
    assert not needs_hop(wide, ahead, behind, 0)  # on the side that it passes on
    assert needs_hop(tight, ahead, behind, 0)  # where no bank is enough beside the leader
    assert needs_hop(wide, ahead, behind, 1)  # the other way round
    assert needs_hop(wide, ahead, behind._replace(side=-1.0), 0)  # to the other side
    assert not needs_hop(wide, ahead, near, 1)  # where one may be the other


@pytest.mark.parametrize("tight", [True, False])
def test_no_words_that_meet_at_the_bearing_are_ruled_out(tight: bool) -> None:
    found, long = 0, 0
    for scene, rng in scenes(21 + tight, tight):
        side, way = (1.0, 0) if rng.random() < 0.5 else (-1.0, 1)
        for _ in range(20):
            first = side * rng.uniform(-0.5 * pi, 0.5 * pi)
            bearing = first + side * rng.uniform(0.1, 1.5)
            last = bearing + side * rng.uniform(0.1, 1.5)
            out = scene.d_min + 10.0 ** rng.uniform(-6.0, 0.3)
            heading = rng.uniform(-pi, pi)
            pace = side * (sin(heading - bearing) + scene.alpha * sin(bearing))
            if pace < 0.0:
                continue
            met = Pose(out * cos(bearing), out * sin(bearing), heading)
            begin = pose_at(scene, first, side)
            end = pose_at(scene, last, rng.choice([side, -side]))
            last_side = side if end.h == pose_at(scene, last, side).h else -side
            there, on = words_between(scene, begin, met), words_between(scene, met, end)
            if len(there) == 0 or len(on) == 0:
                continue
            took = there[0, 0] + on[0, 0]
            cell = some_cell(np.arctan2(sin(first), cos(first)), side, rng)
            other = some_cell(np.arctan2(sin(last), cos(last)), last_side, rng)
            found, long = found + 1, long + (took > 6.0)
            assert not passes_late(scene, cell, other, way, bearing, took * MARGIN)
        if found > 150 and long > 30:
            return


def test_no_path_that_keeps_clear_is_ruled_out() -> None:
    found = 0
    for scene, rng in scenes(23, True):
        for _ in range(40):
            first, last = rng.uniform(-0.4, 1.4), rng.uniform(1.7, 3.1)
            begin, end = pose_at(scene, first, 1.0), pose_at(scene, last, 1.0)
            for row in words_between(scene, begin, end):
                went = unrolled(begin, row, scene.alpha, scene.d_min)
                if not abs(went - (last - first)) < 1e-6:
                    continue
                cell, other = some_cell(first, 1.0, rng), some_cell(last, 1.0, rng)
                found += 1
                assert not passes_late(scene, cell, other, 0, 0.5 * pi, row[0] * MARGIN)
        if found > 100:
            return


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_where_nobody_can_slide_it_takes_much_longer_than_round_the_disc(side: float) -> None:
    scene, way = straight(0.81, 3.019), 0 if side > 0.0 else 1
    cell, other = (standing(0, side, side * radians(b), 1e-4) for b in (33.44, 131.75))
    # 3.216 would be the time round the disc
    assert passes_late(scene, cell, other, way, side * 0.5 * pi, 3.25)
    assert passes_late(scene, cell, other, way, side * 0.5 * pi, 5.0)
    assert not passes_late(scene, cell, other, way, side * 0.5 * pi, 8.0)
