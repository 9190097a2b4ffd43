"""From contact to contact where nobody can slide all the way: no path is sooner than said."""

from itertools import pairwise
from math import inf, pi, radians

import numpy as np

from relguide.kernels.base.records import Pose, Scene
from relguide.kernels.bounds.hop import standing
from relguide.kernels.bounds.needed_hop import hop_is_late, needs_hop
from relguide.kernels.bounds.round_time import times_round
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
