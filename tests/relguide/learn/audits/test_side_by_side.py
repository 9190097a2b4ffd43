"""The paper's network, its tree, direct regression and ours, on one ground."""

from functools import cache
from math import hypot, pi

import numpy as np
import pytest

from relguide.kernels.words.branches import BRANCHES
from relguide.learn.audits.side_by_side import (
    Ground,
    MethodResult,
    branches_like,
    draw_ground,
    ends_of,
    look_up_pairs,
    method_as_json,
    side_by_side,
)
from relguide.learn.training.options import NetworkShape, TrainingOptions
from relguide.learn.tree.nearest import lookup_in
from relguide.learn.tree.regular_words import RegularPiece
from relguide.learn.tree.train_regular import train_regular
from relguide.learn.tree.tree import regular_from_pairs
from relguide.learn.words.branch_labels import times_of
from relguide.maps.area import exact_times
from relguide.planning.regular import trajectory_from_regular
from tests.relguide.learn.tree.trees import A300, parameters, tree
from tests.relguide.learn.words.networks import network

RADIUS = A300.turn_radius
TINY = TrainingOptions(
    shape=NetworkShape(width=16, depth=1), epochs=5, batch=128, threads=1, device="cpu"
)


@cache
def ground() -> Ground:
    return draw_ground(parameters(3), 1000, 1, lambda _: None)


@cache
def methods() -> tuple[MethodResult, ...]:
    regressions = []
    for method in ("paper", "direct"):
        *_, last = train_regular(tree(), TINY, method=method, about={})  # type: ignore[arg-type]
        regressions.append(last.network)
    return tuple(side_by_side(ground(), network(), lookup_in(tree()), regressions))


def test_the_ground_is_the_area_of_the_tree() -> None:
    found = ground()
    assert len(found) == 1000
    assert found.binding > 0
    x, y, h, alpha = found.situations.T
    assert (alpha == A300.speed_ratio).all()
    assert np.array_equal(found.times, times_of(found.situations))
    exact = exact_times(A300, x * RADIUS, y * RADIUS, h)
    assert exact.proved.all()
    assert exact.time_to_converge.max() <= 400.0
    assert exact.time_to_converge == pytest.approx(found.times.min(axis=1) * RADIUS / 240.0)
    again = draw_ground(parameters(3), 1000, 1, lambda _: None)
    assert np.array_equal(again.situations, found.situations)


def test_ends_are_those_of_what_is_flown() -> None:
    rng = np.random.default_rng(2)
    rows = ground().situations[:40]
    x, y, h, _ = rows.T
    pairs = look_up_pairs(lookup_in(tree()), x, y, h)
    pairs[:, :, 1:] *= rng.uniform(0.9, 1.1, pairs[:, :, 1:].shape)
    for row, given, (missed, off) in zip(rows, pairs, ends_of(pairs, rows), strict=True):
        situation = A300.situation(row[0] * RADIUS, row[1] * RADIUS, row[2])
        regular = regular_from_pairs(given * (1.0, 1.0, RADIUS))
        flown = trajectory_from_regular(regular, situation)
        end = flown.pose_at(flown.duration)
        slot = situation.leader.tas * flown.duration - situation.slot_distance
        assert missed * RADIUS == pytest.approx(hypot(end.x - slot, end.y), rel=1e-6, abs=1e-3)
        assert off == pytest.approx(abs((end.heading - 0.5 * pi + pi) % (2 * pi) - pi), abs=1e-9)


def test_pieces_name_strategies() -> None:
    def named(*pieces: tuple[str, float]) -> list[str]:
        flags = branches_like([RegularPiece(*piece) for piece in pieces])
        return [name for name, flag in zip(BRANCHES, flags, strict=True) if flag]

    assert named(("L", 1.0), ("S", 2.0), ("R", 1.0)) == ["LSR"]
    assert named(("L", 1.0), ("R", 2.0), ("L", 1.0)) == ["LRL"]
    assert named(("L", 1.0), ("R", 4.0), ("L", 1.0)) == ["LRL long"]
    assert named(("R", 1.0), ("L", 4.0)) == ["RSL", "LRL", "LRL long", "RLR", "RLR long"]


def test_all_four_are_with_certificate() -> None:
    ours, nearest, paper, direct = methods()
    names = [method.name for method in methods()]
    assert names == ["ours", "nearest in tree", "paper's network", "direct regression"]
    for method in methods():
        assert method.right.of == 1000 == sum(share.of for share in method.classes)
        assert method.right.hits == sum(share.hits for share in method.classes)
        assert len(method.gap) + method.passed_on.hits == 1000
        assert method.fastest.of == len(method.gap)
        assert method.gaps == tuple(sorted(method.gaps))
        assert 0.0 < method.latency[0] <= method.latency[1]
    assert ours.reached is None
    for method in (nearest, paper, direct):
        assert method.reached is not None
        assert method.reached.value < 0.2
        assert method.places is not None
        assert np.median(method.places) > 100.0
    # five epochs of a tiny network are worse than the tree it was trained on
    assert paper.places is not None
    assert nearest.places is not None
    assert np.median(paper.places) > np.median(nearest.places)
    assert ours.right.value > max(method.right.value for method in (nearest, paper, direct))
    assert ours.gaps[1] <= min(method.gaps[1] for method in (nearest, paper, direct))


def test_they_are_written_as_json() -> None:
    ours, nearest, *_ = (method_as_json(method) for method in methods())
    assert "flown_as_given" not in ours
    assert set(nearest["flown_as_given"]) == {
        "reaches_the_slot", "from_the_slot_m", "off_heading_deg",
    }  # fmt: skip
    assert set(ours["branches"]) == set(BRANCHES)
