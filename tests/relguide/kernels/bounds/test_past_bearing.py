"""Past a bearing from one contact to another: no two words that meet there are sooner than said."""

from math import cos, pi, radians, sin

import numpy as np
import pytest

from relguide.kernels.base.records import Pose
from relguide.kernels.bounds.hop import standing
from relguide.kernels.bounds.past_bearing import passes_late
from tests.straight_contacts import pose_at, scenes, some_cell, straight, unrolled, words_between

MARGIN = 1.0 + 1e-6


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
