"""The paper's network: it learns the tree, and what it gives ends kilometres from the slot."""

from dataclasses import replace
from functools import cache
from math import hypot, pi
from pathlib import Path

import numpy as np
import pytest
import torch

from relguide.learn.training.files import save_columns
from relguide.learn.training.options import NetworkShape, TrainingOptions
from relguide.learn.tree.regular_network import (
    Method,
    RegularNetwork,
    load_regular,
    regress_pairs,
    save_regular,
    shipped_weights,
)
from relguide.learn.tree.train_regular import exact_pairs, train_regular
from relguide.learn.tree.tree import regular_from_pairs
from relguide.learn.tree.tree_file import save_tree
from relguide.planning.regular import trajectory_from_regular
from relguide.planning.words import candidates
from tests.command_line import Run
from tests.relguide.learn.tree.trees import A300, parameters, tree

RADIUS = A300.turn_radius
OPTIONS = TrainingOptions(
    shape=NetworkShape(width=32, depth=2), epochs=40, batch=128, learning_rate=0.01, threads=1,
    device="cpu",
)  # fmt: skip


@cache
def train(method: Method = "paper") -> RegularNetwork:
    *_, last = train_regular(tree(), OPTIONS, method=method, about={})
    return last.network


def test_it_learns_the_tree() -> None:
    losses = [epoch.loss for epoch in train_regular(tree(), OPTIONS, method="paper", about={})]
    assert len(losses) == 40
    assert losses[-1] < 0.45 < 0.55 < losses[0]


def test_the_same_options_give_the_same_weights() -> None:
    *_, again = train_regular(tree(), OPTIONS, method="paper", about={})
    for here, there in zip(train().weights, again.network.weights, strict=True):
        assert np.array_equal(here, there)


def test_a_tree_too_small_is_refused() -> None:
    alone = replace(tree(), best=np.where(tree().best == tree().minima[0], tree().best, -1))
    with pytest.raises(ValueError, match=r"^1 states of the tree are too few to train"):
        next(train_regular(alone, OPTIONS, method="paper", about={}))


def test_half_of_what_it_gives_ends_within_a_turn_radius_of_the_slot() -> None:
    """Nothing holds the end in the slot: this network misses it by 8 km in the median."""
    rng = np.random.default_rng(3)
    nodes = rng.permutation(tree().minima)[:200]
    x, y, h = tree().x[nodes] / RADIUS, tree().y[nodes] / RADIUS, tree().heading[nodes]
    pairs = regress_pairs(train(), x, y, h)
    pairs[:, :, 2] *= RADIUS
    missed = []
    for i, node in enumerate(nodes.tolist()):
        situation = A300.situation(*(float(v[node]) for v in (tree().x, tree().y, tree().heading)))
        flown = trajectory_from_regular(regular_from_pairs(pairs[i]), situation)
        end = flown.pose_at(flown.duration)
        slot = situation.leader.tas * flown.duration - situation.slot_distance
        missed.append(hypot(end.x - slot, end.y))
    assert 100.0 < np.median(missed) < RADIUS


def test_mirrored_situations_get_mirrored_paths() -> None:
    rng = np.random.default_rng(4)
    x, y, h = rng.uniform(-5.0, 10.0, 50), rng.uniform(0.1, 8.0, 50), rng.uniform(0.1, 6.0, 50)
    here, there = regress_pairs(train(), x, y, h), regress_pairs(train(), x, -y, -h)
    assert np.array_equal(here[:, :, 1:], there[:, :, 1:])
    assert np.array_equal(here[:, :, 0], -there[:, :, 0])


def test_exact_ways_are_those_of_the_planner() -> None:
    nodes = tree().minima[::97]
    x, y, h = tree().x[nodes] / RADIUS, tree().y[nodes] / RADIUS, tree().heading[nodes]
    pairs = exact_pairs(x, y, h, parameters(4))
    for i, node in enumerate(nodes.tolist()):
        situation = A300.situation(*(float(v[node]) for v in (tree().x, tree().y, tree().heading)))
        scaled = pairs[i] * (1.0, 1.0, RADIUS)
        flown = trajectory_from_regular(regular_from_pairs(scaled), situation)
        best = next(iter(candidates(situation)))
        assert flown.duration == pytest.approx(best.time_to_converge, rel=1e-9)
        assert flown.letters == best.trajectory.letters


def test_it_is_read_as_it_was_written(tmp_path: Path) -> None:
    file = tmp_path / "paper.safetensors"
    save_regular(train(), file)
    read = load_regular(file)
    assert (read.method, read.parameters) == ("paper", tree().parameters)
    x = np.array([3.0])
    assert np.array_equal(regress_pairs(read, x, x, x), regress_pairs(train(), x, x, x))
    for content in (b"PK", file.read_bytes()[:-100]):
        file.write_bytes(content)
        with pytest.raises(ValueError, match="holds no network of relguide train --method paper"):
            load_regular(file)


@pytest.mark.parametrize("method", ["paper", "direct"])
def test_the_weights_that_come_along_say_how_they_were_made(method: Method) -> None:
    network = load_regular(shipped_weights(method))
    assert network.method == method
    assert f"--method {method}" in network.about["command"]
    assert network.parameters.encounter == A300
    assert shipped_weights(method).stat().st_size < 300e3
    # straight ahead of the slot's mirror line there is a way of some length
    length = regress_pairs(network, *(np.array([value]) for value in (4.0, 2.0, pi)))[
        0, :, 1:
    ].sum()
    assert 2.0 < length < 30.0


def test_the_command_trains_it_on_a_tree(run: Run) -> None:
    save_tree(tree(), Path("tree.npz"))
    small = ("--width", "8", "--depth", "1", "--epochs", "2", "--threads", "1")
    for method in ("paper", "direct"):
        code, out, err = run(
            "train", "tree.npz", "w.safetensors", *small, "--method", method, "--table"
        )
        assert (code, err) == (0, "")
        assert out.startswith("w.safetensors: after 2 epochs it misses ")
        about = load_regular(Path("w.safetensors")).about
        assert about["command"].startswith("relguide train tree.npz w.safetensors --width 8")
        assert about["command"].endswith(f" --method {method}")
    code, _, err = run("train", "tree.npz", "w.safetensors", "--method", "paper", "--resume")
    assert (code, err) == (
        2, "relguide: Such a network is trained in a minute, and nothing is left to resume.\n",
    )  # fmt: skip
    code, _, err = run("train", "tree.npz", "none/w.safetensors", "--method", "direct")
    assert (code, err) == (2, "relguide: none: No such file or directory.\n")
    save_columns(Path("labels.npz"), {"file": "relguide exact labels 1"}, {})
    code, _, err = run("train", "labels.npz", "w.safetensors", "--method", "paper")
    assert code == 2
    assert "is a file of another kind" in err
    if not torch.cuda.is_available():
        asked = ("train", "tree.npz", "w.safetensors", "--method", "direct", "--device", "cuda")
        assert run(*asked)[::2] == (
            2, "relguide: There is no CUDA device here: use --device cpu.\n",
        )  # fmt: skip
