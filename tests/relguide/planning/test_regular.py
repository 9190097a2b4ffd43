"""Regular trajectories in the paper's own form: there, back, and what has no such form."""

from math import pi

import pytest
from hypothesis import given
from hypothesis import strategies as st

from relguide import LEFT, RIGHT, Arc, BoundaryArc, Plan, Situation, Straight, Trajectory, plan
from relguide.planning.regular import (
    RegularTrajectory,
    Triplet,
    regular_from_trajectory,
    trajectory_from_regular,
)
from relguide.planning.trajectory import Segment
from tests.plans import fly_planned, straight_behind
from tests.situations import numbers, situations

RADIUS = straight_behind().pursuer.turn_radius

pairs = st.lists(
    st.builds(
        Triplet,
        turn=st.sampled_from([LEFT, RIGHT]),
        turn_angle=numbers(0.01, 6.0),
        length=numbers(1.0, 30_000.0),
    ),
    max_size=5,
).map(tuple)


def pair(turn: int, turn_angle: float, length: float) -> Triplet:
    return Triplet(turn=LEFT if turn > 0 else RIGHT, turn_angle=turn_angle, length=length)


@given(triplets=pairs)
def test_there_and_back_is_the_same(triplets: tuple[Triplet, ...]) -> None:
    regular = RegularTrajectory(triplets=triplets)
    trajectory = trajectory_from_regular(regular, straight_behind())
    assert regular_from_trajectory(trajectory, turn_radius=RADIUS) == regular
    assert regular.order == len(triplets) + 1
    assert regular.length(RADIUS) == pytest.approx(trajectory.length, rel=1e-12)


@given(situation=situations(with_intent=False))
def test_a_plan_goes_there_and_back_unchanged(situation: Situation) -> None:
    answer = plan(situation)
    if isinstance(answer, Plan) and "B" not in answer.word:
        radius = situation.pursuer.turn_radius
        regular = regular_from_trajectory(answer.trajectory, turn_radius=radius)
        assert trajectory_from_regular(regular, situation) == answer.trajectory


L, R = Arc(turn=LEFT, turn_angle=1.0, radius=RADIUS), Arc(turn=RIGHT, turn_angle=5.0, radius=RADIUS)
S = Straight(length=7_000.0)


@pytest.mark.parametrize(
    ("word", "order", "triplets"),
    [
        ((L, S, R), 3, (pair(-1, 5.0, 0.0), pair(1, 1.0, 7_000.0))),
        ((L, R, L), 4, (pair(1, 1.0, 0.0), pair(-1, 5.0, 0.0), pair(1, 1.0, 0.0))),
        ((S, L, S, R), 4, (pair(-1, 5.0, 0.0), pair(1, 1.0, 7_000.0), pair(1, 0.0, 7_000.0))),
        ((S,), 2, (pair(1, 0.0, 7_000.0),)),
        ((), 1, ()),
    ],
)
def test_pairs_count_backward_from_the_slot_and_may_be_halves(
    word: tuple[Segment, ...], order: int, triplets: tuple[Triplet, ...]
) -> None:
    regular = regular_from_trajectory(fly_planned(straight_behind(), *word), turn_radius=RADIUS)
    assert regular.triplets == triplets
    assert regular.order == order
    assert trajectory_from_regular(regular, straight_behind()).segments == word


def test_other_radii_and_boundary_arcs_are_not_regular() -> None:
    with pytest.raises(ValueError, match="turns at one radius"):
        regular_from_trajectory(fly_planned(straight_behind(), L), turn_radius=2.0 * RADIUS)
    boundary_arc = BoundaryArc(side=LEFT, bends=((100.0, -1e-5),))
    pursuer = straight_behind().pursuer
    sliding = Trajectory(
        x=pursuer.x, y=pursuer.y, heading=pursuer.heading, tas=pursuer.tas, segments=(boundary_arc,)
    )
    with pytest.raises(ValueError, match="slides along d_min"):
        regular_from_trajectory(sliding, turn_radius=RADIUS)


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ((2, 1.0, 1.0), "ε must be"),
        ((1, -0.1, 1.0), "θ must be"),
        ((1, pi, float("nan")), "l must"),
    ],
)
def test_parameters_that_eq_17_does_not_allow_are_refused(
    values: tuple[int, float, float], sentence: str
) -> None:
    turn, turn_angle, length = values
    with pytest.raises(ValueError, match=sentence):
        Triplet(turn=turn, turn_angle=turn_angle, length=length)  # type: ignore[arg-type]
