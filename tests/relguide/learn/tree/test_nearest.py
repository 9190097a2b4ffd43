"""Looking a situation up in the tree."""

from dataclasses import replace
from math import hypot, pi

import numpy as np
import pytest
from hypothesis import given

from relguide import FlyStraight, Situation, Wind
from relguide.learn.tree.nearest import lookup_in, nearest, neighbours
from relguide.learn.tree.reverse_dp import reverse_tree
from relguide.learn.tree.tree import situation_of
from relguide.planning.regular import RegularTrajectory, trajectory_from_regular
from tests.relguide.learn.tree.trees import A300, parameters, regular_of, tree
from tests.situations import numbers

LOOKUP = lookup_in(tree())


def turn(regular: RegularTrajectory) -> RegularTrajectory:
    return replace(
        regular,
        triplets=tuple(
            replace(t, turn=-t.turn if t.turn_angle > 0.0 else t.turn) for t in regular.triplets
        ),
    )


def test_a_state_of_the_tree_is_its_own_nearest() -> None:
    for node in tree().minima[::53].tolist():
        situation = situation_of(tree(), node)
        found = nearest(LOOKUP, situation)
        assert found == regular_of(tree(), node)


@given(x=numbers(-20e3, 120e3), y=numbers(1.0, 80e3), heading=numbers(-pi, pi))
def test_mirrored_situations_get_mirrored_paths(x: float, y: float, heading: float) -> None:
    left = nearest(LOOKUP, A300.situation(x, y, heading))
    assert nearest(LOOKUP, A300.situation(x, -y, -heading)) == turn(left)


def test_it_is_the_nearest_of_all() -> None:
    rng = np.random.default_rng(5)
    x, y = rng.uniform(-20e3, 120e3, 50), rng.uniform(-80e3, 80e3, 50)
    heading = rng.uniform(-pi, pi, 50)
    found = neighbours(LOOKUP, x, y, heading)
    grown, radius = tree(), A300.turn_radius
    nodes = grown.minima
    for i in range(50):
        least = min(
            np.min(
                ((grown.x[nodes] - x[i]) / radius) ** 2
                + ((grown.y[nodes] - side * y[i]) / radius) ** 2
                + (2.0 * np.sin(0.5 * (grown.heading[nodes] - side * heading[i]))) ** 2
            )
            for side in (1.0, -1.0)
        )
        assert found.distance[i] ** 2 == pytest.approx(least, rel=1e-9)


def test_only_the_ratios_matter() -> None:
    """Twice as fast at the same bank is four times as large."""
    node = int(tree().minima[-1])
    small = situation_of(tree(), node)
    large = replace(
        small,
        pursuer=replace(small.pursuer, x=4 * small.pursuer.x, y=4 * small.pursuer.y, tas=360.0),
        leader=replace(small.leader, tas=300.0),
    )
    scale = (360.0 / small.pursuer.tas) ** 2
    large = Situation(
        pursuer=replace(large.pursuer, x=scale * small.pursuer.x, y=scale * small.pursuer.y),
        leader=large.leader,
        slot_distance=scale * small.slot_distance,
        min_separation=scale * small.min_separation,
    )
    flown = trajectory_from_regular(nearest(LOOKUP, large), large)
    end = flown.pose_at(flown.duration)
    slot = large.leader.tas * flown.duration - large.slot_distance
    assert hypot(end.x - slot, end.y) <= 1e-6 * large.pursuer.turn_radius


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"wind": Wind(east=5.0)}, "calm air; this situation has wind"),
        ({"slot_distance": 13e3}, "its D/R is 1.03.., here it is 0.95"),
        ({"min_separation": 8e3}, "its d_min/R is"),
    ],
)
def test_another_encounter_is_refused(changes: dict[str, float], sentence: str) -> None:
    situation = A300.situation(20e3, 10e3, 1.0)
    with pytest.raises(ValueError, match=sentence):
        nearest(LOOKUP, replace(situation, **changes))  # type: ignore[arg-type]
    leader = replace(situation.leader, intent=(FlyStraight(duration=60.0),))
    with pytest.raises(ValueError, match="a leader that keeps straight"):
        nearest(LOOKUP, replace(situation, leader=leader))
    with pytest.raises(ValueError, match="its V_L/V_P is"):
        nearest(LOOKUP, replace(situation, leader=replace(situation.leader, tas=190.0)))


def test_a_tree_of_the_slot_alone_cannot_be_asked() -> None:
    with pytest.raises(ValueError, match="no state but the slot"):
        lookup_in(reverse_tree(parameters(2, horizon=2.0)))
