"""Labels behind leaders who turn: exact, in their box, and as good farther along their paths."""

from math import inf

import numpy as np
import pytest

from relguide import NoPlan, Plan, plan
from relguide.learn.boundary.turn_labels import (
    LEGS,
    TurnBox,
    TurnLabelRequest,
    advance_turning,
    turning_answers_of,
)
from tests.relguide.learn.boundary.turn_networks import labels
from tests.relguide.learn.boundary.turning_situations import situation_of


@pytest.mark.parametrize("mirrored", [False, True])
def test_the_answers_are_the_exact_planners(mirrored: bool) -> None:
    found = labels()
    for n in range(int(mirrored), len(found), 40):
        situation = situation_of(found.situations[n], final=0.3 * n, mirrored=mirrored)
        unit = situation.pursuer.turn_radius / situation.pursuer.tas
        answer, time = plan(situation), float(found.times[n, 2]) * unit
        if time < inf:
            assert isinstance(answer, Plan)
            assert answer.time_to_converge == pytest.approx(time, abs=0.05)
        elif isinstance(answer, NoPlan):  # else found by the last resort, which is not learnt
            assert found.counts[n] == 0


def test_every_situation_lies_in_the_box_and_costs_no_less_than_without_the_limit() -> None:
    found, box = labels(), TurnBox()
    assert all(box.holds(numbers) for numbers in found.situations)
    assert (found.times[:, 0] <= found.times[:, 2] + 1e-9).all()  # rounding of the release
    assert (found.times[:, 2] <= found.times[:, 1]).all()
    calm = found.situations[:, 6] == 0.0
    assert 0.3 < calm.mean() < 0.7


def test_what_is_left_of_a_path_is_the_fastest_from_there() -> None:
    left = advance_turning(labels().paths, np.random.default_rng(1))
    rows = np.arange(0, len(left.times), 10)
    assert len(rows) > 10
    times, counts, _ = turning_answers_of(left.situations[rows])
    known = counts <= LEGS
    assert np.abs(times[known, 2] - left.times[rows][known]).max() < 2e-3


def test_boxes_that_hold_nothing_are_refused() -> None:
    for wrong in ({"max_wind": 0.7}, {"min_limit": 1.5}, {"max_rate": inf}, {"min_rate": 0.0}):
        with pytest.raises(ValueError, match=r"must|bounded"):
            TurnBox(**wrong)
    with pytest.raises(ValueError, match="sum up to 1"):
        TurnLabelRequest(count=1, shares=(0.5, 0.4))
