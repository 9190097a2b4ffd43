"""Reverse dynamic programming: what it grows is flown, certified, compared and grown again."""

from dataclasses import replace
from itertools import islice, product
from math import cos, hypot, inf, pi, sin

import numpy as np
import pytest

from relguide import LEFT, Arc, Plan, Straight, certify, plan
from relguide.kernels.base.angles import wrap_signed
from relguide.kernels.tree.reverse import compass
from relguide.learn.tree import reverse_dp
from relguide.learn.tree.reverse_dp import Growth, grow_order, plant, reverse_tree, tree_from
from relguide.learn.tree.tree import (
    RegularTree,
    TreeParameters,
    losses,
    nodes_at,
    pairs_of,
    situation_of,
    tree_area,
)
from relguide.maps.area import exact_times
from relguide.planning.regular import trajectory_from_regular
from tests.plans import fly_planned
from tests.relguide.learn.tree.trees import A300, parameters, regular_of, tree

COLUMNS = (
    "x", "y", "heading_number", "time", "parent", "length_number", "angle_number", "turn",
    "mirrored", "best",
)  # fmt: skip


def same(one: RegularTree, other: RegularTree) -> bool:
    counts = one.laid == other.laid and one.close == other.close
    return counts and all(
        np.array_equal(getattr(one, name), getattr(other, name)) for name in COLUMNS
    )


def grow(growth: Growth, *, threads: int | None = None) -> RegularTree:
    while not growth.finished:
        *_, growth = grow_order(growth, threads=threads)
    return tree_from(growth, {})


# --- what the ways are --------------------------------------------------------------------------


@pytest.mark.parametrize(
    "grown_from",
    [
        parameters(2),
        parameters(3),
        parameters(4),
        parameters(4, encounter=replace(A300, slot_distance=A300.min_separation)),  # it touches
        parameters(3, encounter=replace(A300, leader_tas=A300.pursuer_tas)),
        parameters(3, encounter=replace(A300, leader_tas=260.0, min_separation=6_000.0)),
        parameters(3, delta_theta_deg=40.0),  # nine headings: none opposite the leader's
    ],
)
def test_every_way_flown_forward_reaches_the_slot_and_keeps_d_min(
    grown_from: TreeParameters,
) -> None:
    grown_tree = reverse_tree(grown_from)
    encounter, order = grown_from.encounter, grown_from.order
    radius = encounter.turn_radius
    assert len(grown_tree) > 20 * (order - 1) ** 3
    for node in range(0, len(grown_tree), 1 + len(grown_tree) // 1500):
        situation = situation_of(grown_tree, node)
        regular = regular_of(grown_tree, node)
        way = trajectory_from_regular(regular, situation)
        end = way.pose_at(way.duration)
        slot = encounter.leader_tas * way.duration - encounter.slot_distance
        assert hypot(end.x - slot, end.y) <= 1e-6 * radius
        assert abs(wrap_signed(end.heading - 0.5 * pi)) <= 1e-9
        assert way.duration == pytest.approx(grown_tree.time[node], rel=1e-12)
        assert certify(way, situation).holds
        assert regular.order <= order


def test_the_separation_matters() -> None:
    free = grow(plant(parameters(encounter=replace(A300, min_separation=0.0))))
    assert free.close == 0
    assert tree().close > 50
    broken = sum(
        not certify(trajectory_from_regular(regular_of(free, node), situation), situation).holds
        for node in range(1, len(free), 2)
        for situation in [replace(situation_of(free, node), min_separation=A300.min_separation)]
    )
    assert broken > 10


def test_no_way_is_faster_than_the_exact_plan() -> None:
    grown_tree = tree(4)
    nodes = grown_tree.minima[:: 1 + len(grown_tree.minima) // 400]
    places = grown_tree.x[nodes], grown_tree.y[nodes], grown_tree.heading[nodes]
    found = exact_times(A300, *places)
    compared = losses(grown_tree, nodes, found.time_to_converge)
    assert np.all(found.verdict == "planned")
    assert compared.loss.min() >= -1e-9
    # coarse as it is, the tree holds exact optima: a turn, a straight, a turn is an extremal
    assert compared.share_within(1e-9) > 0.1
    assert compared.share_within(inf) == 1.0
    answer = plan(situation_of(grown_tree, int(nodes[-1])))
    assert isinstance(answer, Plan)
    assert answer.time_to_converge == pytest.approx(compared.exact[-1], abs=1e-3)


def test_order_2_is_all_that_fig_3_lays_from_the_slot() -> None:
    """Every (θ, l) by hand, to the left; those to the right are its mirror images."""
    small, radius = parameters(2), A300.turn_radius
    least: dict[tuple[int, ...], float] = {}
    for k, h in product(range(small.headings), range(30)):
        angle, length = k * small.delta_theta, h * small.delta_l
        time = (length + radius * angle) / A300.pursuer_tas
        x = A300.leader_tas * time - length - radius * sin(angle)
        y = radius * (1.0 - cos(angle))
        cell = (
            -k % small.headings,
            int((x - small.x_low) // small.cell),
            int(y // small.cell),
        )
        at_slot = cell == (0, int(-small.x_low // small.cell), 0)  # which nothing is faster to
        if not at_slot and time <= small.horizon and time < least.get(cell, inf):
            arc, straight = Arc(turn=LEFT, turn_angle=angle, radius=radius), Straight(length=length)
            situation = A300.situation(x, y, -angle)
            if certify(fly_planned(situation, arc, straight), situation).holds:
                least[cell] = time
    cells = [tuple(map(int, cell)) for cell in np.argwhere(tree(2).best > 0)]
    assert least == pytest.approx({cell: tree(2).time[tree(2).best[cell]] for cell in cells})


def test_a_cell_holds_the_state_that_is_in_it() -> None:
    grown_tree = tree()
    small = grown_tree.parameters
    for cell in np.argwhere(grown_tree.best > 0)[::5]:
        node = grown_tree.best[tuple(cell)]
        assert grown_tree.heading_number[node] == cell[0]
        assert (grown_tree.x[node] - small.x_low) / small.cell == pytest.approx(
            cell[1] + 0.5, abs=0.5 + 1e-9
        )
        assert grown_tree.y[node] / small.cell == pytest.approx(cell[2] + 0.5, abs=0.5 + 1e-9)
        assert grown_tree.y[node] >= 0.0


def test_no_way_is_kept_twice() -> None:
    grown_tree = tree(4)
    kept = np.column_stack(
        [
            getattr(grown_tree, name)
            for name in ("parent", "length_number", "angle_number", "turn", "mirrored")
        ]
    )
    assert len(np.unique(kept, axis=0)) == len(grown_tree)


def test_a_higher_order_is_never_slower() -> None:
    for order in (3, 4):
        lower, higher = tree(order - 1), tree(order)
        filled = lower.best >= 0
        assert np.all(higher.best[filled] >= 0)
        before, after = lower.time[lower.best[filled]], higher.time[higher.best[filled]]
        assert np.all(after <= before + 1e-9)
        assert np.sum(higher.best >= 0) > np.sum(filled)


# --- mirror -------------------------------------------------------------------------------------


def test_the_two_sides_are_mirror_images() -> None:
    for number in range(12):
        left, right = tree_area(tree(), number), tree_area(tree(), -number)
        assert np.array_equal(left.time, right.time[:, ::-1])
        assert nodes_at(tree(), number).shape == left.time.shape
        assert np.array_equal(left.y, -right.y[::-1])


def test_a_mirrored_way_flies_the_mirrored_path() -> None:
    grown_tree = tree()
    nodes = grown_tree.minima[::37]
    for node, pairs in zip(nodes.tolist(), pairs_of(grown_tree, nodes), strict=True):
        situation = situation_of(grown_tree, node)
        regular = regular_of(grown_tree, node)
        other = A300.situation(
            float(grown_tree.x[node]), -float(grown_tree.y[node]), -float(grown_tree.heading[node])
        )
        flipped = replace(
            regular,
            triplets=tuple(
                replace(t, turn=-t.turn if t.turn_angle > 0.0 else t.turn) for t in regular.triplets
            ),
        )
        one = trajectory_from_regular(regular, situation)
        two = trajectory_from_regular(flipped, other)
        assert two.pose_at(two.duration).x == pytest.approx(one.pose_at(one.duration).x, abs=1e-6)
        assert two.pose_at(two.duration).y == pytest.approx(-one.pose_at(one.duration).y, abs=1e-6)
        assert np.count_nonzero(pairs[:, 0]) == len(regular.triplets)


def test_the_compass_is_symmetric_to_the_last_digit() -> None:
    for headings in (4, 7, 36, 72):
        table = compass(headings)
        for j in range(1, headings):
            assert table[j, 0] == table[headings - j, 0]
            assert table[j, 1] == -table[headings - j, 1]
        angles = 2.0 * pi * np.arange(headings) / headings
        assert np.allclose(table, np.column_stack((np.cos(angles), np.sin(angles))), atol=1e-15)


# --- the same whatever happens ------------------------------------------------------------------


def test_threads_change_nothing() -> None:
    assert same(grow(plant(parameters()), threads=1), grow(plant(parameters()), threads=2))


def test_blocks_change_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(reverse_dp, "BLOCK", 13)
    assert same(grow(plant(parameters())), tree())


@pytest.mark.parametrize("stop_after", [1, 3, 9])
def test_growing_on_from_a_stop_gives_the_same_tree(
    stop_after: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(reverse_dp, "BLOCK", 3)
    *_, growth = grow_order(plant(parameters()))
    *_, growth = islice(grow_order(growth), stop_after)
    assert 0 < growth.next < len(growth.latest)
    assert same(grow(growth), tree())


# --- misuse -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"order": 1}, "order must be 2 … 6, not 1"),
        ({"order": 7}, "order must be 2 … 6"),
        ({"delta_theta": 0.7}, "must go into 360° a whole number of times; 40.107° does not"),
        ({"delta_theta": 0.001}, "delta_theta must lie in 1 … 90°"),
        ({"delta_theta": inf}, "delta_theta must lie in"),
        ({"delta_l": 0.0}, "delta_l must be a length above 0 m"),
        ({"cell": -1.0}, "cell must be a length above 0 m"),
        ({"cell": 20.0}, "at most 8 GB are taken. Larger cells"),
        ({"horizon": 0.0}, "horizon must lie in 1 … 3600 s, not 0 s"),
        ({"horizon": inf}, "horizon must lie in"),
    ],
)
def test_what_cannot_be_grown_is_refused(changes: dict[str, float], sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        replace(parameters(), **changes)  # type: ignore[arg-type]


def test_the_memory_bound_holds() -> None:
    *_, growth = grow_order(plant(parameters(2)))
    arrays = (
        growth.states, growth.headings, growth.parents, growth.pairs, growth.best_time,
        growth.best, growth.origin, growth.pair,
    )  # fmt: skip
    assert sum(array.nbytes for array in arrays) <= growth.parameters.memory_bound
