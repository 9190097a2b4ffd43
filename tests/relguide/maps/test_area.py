"""The convergence area: the same answers as plan gives, in the frame of the slot."""

from dataclasses import replace
from math import pi

import numpy as np
import pytest

from relguide import Plan, plan
from relguide.maps.area import Area, Encounter, exact_times, middles, reach
from relguide.planning.slot import slot_frame
from tests.relguide.learn.tree.trees import A300


def test_places_are_those_of_the_slot_frame() -> None:
    rng = np.random.default_rng(1)
    for x, y, heading in rng.uniform((-50e3, -50e3, 0.0), (50e3, 50e3, 2.0 * pi), (20, 3)).tolist():
        situation = A300.situation(x, y, heading)
        frame = slot_frame(situation, situation.leader.trajectory)
        assert frame.x * frame.radius == pytest.approx(x, abs=1e-6)
        assert frame.y * frame.radius == pytest.approx(y, abs=1e-6)
        assert A300.place_of(situation) == pytest.approx((x, y, heading), rel=1e-9, abs=1e-6)


def test_exact_times_are_those_of_plan() -> None:
    rng = np.random.default_rng(2)
    x, y = rng.uniform(-60e3, 60e3, 60), rng.uniform(-60e3, 60e3, 60)
    heading = rng.uniform(0.0, 2.0 * pi, 60)
    counted: list[int] = []
    found = exact_times(A300, x, y, heading, progress=counted.append)
    assert sum(counted) == 60
    for i in range(60):
        answer = plan(A300.situation(x[i], y[i], heading[i]))
        expected = answer.time_to_converge if isinstance(answer, Plan) else np.inf
        assert found.time_to_converge[i] == pytest.approx(expected, abs=1e-3)


def test_no_places_have_no_times() -> None:
    none = np.empty(0)
    assert len(exact_times(A300, none, none, none).time_to_converge) == 0


def test_nothing_outside_reach_joins_in_time() -> None:
    least, greatest, aside = reach(A300, 600.0)
    assert (least, greatest, aside) == (-24_000.0, 264_000.0, 144_000.0)
    rng = np.random.default_rng(3)
    x, y = rng.uniform(-60e3, 300e3, 2000), rng.uniform(-200e3, 200e3, 2000)
    found = exact_times(A300, x, y, rng.uniform(0.0, 2.0 * pi, 2000))
    joins = found.time_to_converge <= 600.0
    assert joins.sum() > 100
    assert np.all((x[joins] >= least) & (x[joins] <= greatest) & (abs(y[joins]) <= aside))


def test_middles_are_in_the_order_of_the_cells() -> None:
    area = Area(
        heading=0.0, x=np.array([0.0, 2.0, 4.0]), y=np.array([-3.0, 0.0]), time=np.zeros((2, 1))
    )
    x, y = middles(area)
    assert x.tolist() == [1.0, 3.0]
    assert y.tolist() == [-1.5, -1.5]


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"pursuer_tas": 500.0}, "pursuer.tas must lie in"),
        ({"max_bank": 0.0}, "pursuer.max_bank must lie in"),
        ({"min_separation": 13e3}, "slot_distance must be at least min_separation"),
    ],
)
def test_an_encounter_checks_itself(changes: dict[str, float], sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        replace(A300, **changes)
    assert isinstance(A300, Encounter)
