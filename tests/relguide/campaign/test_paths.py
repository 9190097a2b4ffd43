"""Paths of plans, circles and reversals."""

from itertools import pairwise
from math import pi

import numpy as np
import pytest

from benchmarks.draws import active
from relguide.campaign.paths import (
    circles,
    distance_from,
    lone_circles,
    path_in_air,
    reversals,
    reversals_of,
    turns_flown,
)
from relguide.flying.cards import plan_card
from relguide.units import DEG
from tests.plans import find_plan, golden_plan


@pytest.mark.slow
@pytest.mark.parametrize("seed", [0, 1, 11])
def test_the_path_of_a_card_is_the_path_of_its_plan(seed: int) -> None:
    found = find_plan(active(np.random.default_rng(seed), tight=True, intent=seed > 0))
    assert "B" in found.word
    path = path_in_air(plan_card(found).segments, found.situation.wind)
    flown = found.sample(np.linspace(0.0, found.time_to_converge, 200))
    off = [distance_from(path, x, y) for x, y in zip(flown.x, flown.y, strict=True)]
    assert max(off) < 20.0  # chords of a boundary arc, 5 s long, where it turns most
    assert distance_from(path, float(flown.x[-1]) + 3e5, float(flown.y[-1])) > 1e5


def test_circles_are_counted_across_short_straights() -> None:
    right = [(3.0 * DEG, 1.0)] * 120
    assert circles(right) == 1
    assert circles(right[:110]) == 0
    assert circles([*right[:60], (0.0, 20.0), *right[:60]]) == 1
    assert circles([*right[:60], (0.0, 60.0), *right[:60]]) == 0
    assert circles([*right[:60], (-1.0 * DEG, 1.0), *right[:60]]) == 0
    assert circles(right * 2) == 2
    assert circles([(-2.0 * pi, 100.0), (2.0 * pi, 100.0)]) == 2


def test_a_circle_behind_a_leader_that_circles_is_told_apart() -> None:
    right, still, back = [2.0 * DEG] * 185, [0.0] * 185, [-1.0 * DEG] * 185
    assert lone_circles(right, still, 1.0) == 1
    assert lone_circles(right, [0.5 * DEG] * 185, 1.0) == 1
    assert lone_circles(right, back, 1.0) == 0
    assert lone_circles([*still, *right], [*back, *still], 1.0) == 1


def test_plans_turn_only_as_far_as_they_are_flown() -> None:
    segments = plan_card(golden_plan("R061")).segments
    whole = list(turns_flown([(0.0, segments)], 1e6))
    assert sum(seconds for _, seconds in whole) == pytest.approx(
        sum(segment.duration for segment in segments)
    )
    assert reversals(angle for angle, _ in whole) == reversals_of(segments)
    first = segments[0].duration
    cut = list(turns_flown([(10.0, segments), (10.0 + 0.5 * first, segments)], 10.0 + 0.5 * first))
    assert cut == [(pytest.approx(0.5 * whole[0][0]), pytest.approx(0.5 * first))]
    again = list(turns_flown([(0.0, segments), (0.5 * first, segments)], 1.5 * first))
    assert sum(angle for angle, _ in again) == pytest.approx(1.5 * whole[0][0])
    assert not list(turns_flown([], 100.0))


def test_small_corrections_are_no_reversals() -> None:
    assert reversals(angle * DEG for angle in (30.0, 0.0, -0.6, 5.0, -0.6, 0.0, -0.6)) == 1
    assert reversals(angle * DEG for angle in (30.0, -0.6, 5.0, -40.0, 0.0, 2.0)) == 2


def test_a_plan_has_the_circles_and_reversals_of_its_turns() -> None:
    segments = plan_card(golden_plan("R061")).segments
    sides = [segment.direction for segment in segments if segment.kind == "turn"]
    assert reversals_of(segments) == sum(a != b for a, b in pairwise(sides))
    assert circles(turns_flown([(0.0, segments)], 1e6)) == 0
